//! The table of commands.

use egui::{Context, Key, KeyboardShortcut, Modifiers, ThemePreference, ViewportCommand};

use super::{Command, Menu, Scope};
use crate::app::Studio;
use crate::pane::Pane;
use crate::panels::{self, NetworkAction};
use crate::screenshot::Screenshot;
use crate::session::Mode;

const fn plain(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

/// All commands by menu.
pub const MENUS: &[Menu] = &[
    Menu { title: "File", groups: FILE, more: Some(super::menu::recent_files) },
    Menu { title: "Edit", groups: EDIT, more: None },
    Menu { title: "View", groups: VIEW, more: None },
    Menu { title: "Help", groups: HELP, more: None },
];

const FILE: &[&[Command]] = &[
    &[
        Command::new("New", "Starts an empty network.", |studio, context| {
            studio.files.new_network(&mut studio.session, context);
        })
        .keys(&[ctrl(Key::N)]),
        Command::new("Open...", "Opens a network file.", |studio, context| {
            studio.files.choose(&mut studio.session, context);
        })
        .keys(&[ctrl(Key::O)]),
    ],
    &[
        Command::new("Save", "Saves the network to its file.", |studio, context| {
            studio.files.save(&mut studio.session, context);
        })
        .keys(&[ctrl(Key::S)]),
        Command::new("Save as...", "Saves the network to a file that you choose.", |studio, context| {
            studio.files.save_as(&mut studio.session, context);
        })
        .keys(&[ctrl_shift(Key::S)]),
    ],
    &[
        Command::new(
            "Picture of a canvas...",
            "Renders what a canvas shows, at any size, into a file.",
            |studio, _| {
                studio.screenshot.open();
            },
        )
        .keys(&[ctrl(Key::E)])
        .enabled(|studio| Screenshot::has_canvas(&studio.session)),
        editing("Picture of the network...", "Draws the node canvas into an SVG file.", |studio, _| {
            studio.panels.network.draw(&mut studio.session);
        })
        .enabled(|studio| is_development(studio) && studio.session.network().processors().next().is_some()),
    ],
    &[Command::new("Quit", "Closes the window; asks first when something is not saved.", |studio, context| {
        studio.files.quit(&mut studio.session, context);
    })
    .keys(&[ctrl(Key::Q)])],
];

const EDIT: &[&[Command]] = &[
    &[
        Command::new("Undo", "Takes the last edit back.", |studio, _| {
            studio.session.document.undo();
        })
        .keys(&[ctrl(Key::Z)])
        .scope(Scope::NotTyping)
        .enabled(|studio| studio.session.document.undo_label().is_some())
        .detail(|studio| studio.session.document.undo_label()),
        Command::new("Redo", "Does the edit again that was taken back last.", |studio, _| {
            studio.session.document.redo();
        })
        .keys(&[ctrl_shift(Key::Z), ctrl(Key::Y)])
        .scope(Scope::NotTyping)
        .enabled(|studio| studio.session.document.redo_label().is_some())
        .detail(|studio| studio.session.document.redo_label()),
    ],
    // Windowing systems turn the keys of these three into events of their own, which the node canvas takes.
    &[
        on_selection("Cut", "Copies the selected processors and deletes them.", |studio, context| {
            network(studio, context, NetworkAction::Copy);
            network(studio, context, NetworkAction::Delete { reconnect: false });
        })
        .keys(&[ctrl(Key::X)]),
        on_selection("Copy", "Copies the selected processors and their wires as text.", |studio, context| {
            network(studio, context, NetworkAction::Copy);
        })
        .keys(&[ctrl(Key::C)]),
        editing("Paste", "Adds the processors that were copied, here or in another window.", |studio, context| {
            studio.panels.network.attend();
            context.send_viewport_cmd(ViewportCommand::RequestPaste);
        })
        .keys(&[ctrl(Key::V)])
        .scope(Scope::Network),
        on_selection(
            "Duplicate",
            "Adds copies of the selected processors, fed by what feeds them.",
            |studio, context| {
                network(studio, context, NetworkAction::Duplicate);
            },
        )
        .keys(&[ctrl(Key::D)]),
    ],
    &[
        on_selection("Delete", "Removes the selected processors and wires.", |studio, context| {
            network(studio, context, NetworkAction::Delete { reconnect: false });
        })
        .keys(&[plain(Key::Delete), plain(Key::Backspace)]),
        on_selection(
            "Delete and reconnect",
            "Removes the selected processors; what fed them feeds what they fed.",
            |studio, context| network(studio, context, NetworkAction::Delete { reconnect: true }),
        )
        .keys(&[shift(Key::Delete), shift(Key::Backspace)]),
        editing("Select all", "Selects every processor.", |studio, context| {
            network(studio, context, NetworkAction::SelectAll);
        })
        .keys(&[ctrl(Key::A)])
        .scope(Scope::Network),
    ],
    &[
        editing("Add a processor...", "Opens the palette, to search a processor by name or purpose.", |studio, _| {
            studio.palette.open();
        })
        .keys(&[plain(Key::Space)])
        .scope(Scope::Network),
        editing("Arrange", "Lays all processors out along the wires.", |studio, context| {
            network(studio, context, NetworkAction::Arrange);
        })
        .keys(&[plain(Key::L)])
        .scope(Scope::Network),
        editing("Add a frame", "Puts a titled rectangle with notes around what is selected.", |studio, context| {
            network(studio, context, NetworkAction::AddFrame(None));
        })
        .keys(&[plain(Key::G)])
        .scope(Scope::Network),
    ],
];

const VIEW: &[&[Command]] = &[
    &[Command::new(
        "Visualization mode",
        "Switches between everything, and canvases with what the author exposed.",
        |studio, _| studio.switch_mode(),
    )
    .keys(&[plain(Key::F5)])
    .ticked(|studio, _| studio.session.mode == Mode::Visualization)],
    &[
        editing("Show all", "Brings the whole network into view.", |studio, context| {
            network(studio, context, NetworkAction::Fit);
        })
        .keys(&[plain(Key::F)])
        .scope(Scope::Network),
        editing("Map", "Shows the whole network small in a corner; a click there goes there.", |studio, context| {
            network(studio, context, NetworkAction::Map);
        })
        .keys(&[plain(Key::M)])
        .scope(Scope::Network),
        Command::new("Larger", "Makes text and everything else in the window larger.", |_, context| {
            egui::gui_zoom::zoom_in(context);
        })
        .keys(&[ctrl(Key::Plus), ctrl(Key::Equals)]),
        Command::new("Smaller", "Makes text and everything else in the window smaller.", |_, context| {
            egui::gui_zoom::zoom_out(context);
        })
        .keys(&[ctrl(Key::Minus)]),
        Command::new("Normal size", "Gives everything the size that the system asks for.", |_, context| {
            context.set_zoom_factor(1.0);
        })
        .keys(&[ctrl(Key::Num0)]),
    ],
    &[
        Command::new("Orientation cube", "Shows in canvases how the world lies; its sides are views.", |studio, _| {
            studio.session.navigation.cube ^= true;
        })
        .ticked(|studio, _| studio.session.navigation.cube),
        Command::new("Inertia", "A camera that is let go while it turns goes on for a while.", |studio, _| {
            studio.session.navigation.inertia ^= true;
        })
        .ticked(|studio, _| studio.session.navigation.inertia),
    ],
    &[
        Command::new("Dark theme", "Light text on dark panels.", |_, context| context.set_theme(ThemePreference::Dark))
            .ticked(|_, context| preference(context) == ThemePreference::Dark),
        Command::new("Light theme", "Dark text on light panels.", |_, context| {
            context.set_theme(ThemePreference::Light)
        })
        .ticked(|_, context| preference(context) == ThemePreference::Light),
        Command::new("System theme", "Dark or light as the system is.", |_, context| {
            context.set_theme(ThemePreference::System);
        })
        .ticked(|_, context| preference(context) == ThemePreference::System),
    ],
    &[
        editing("Show processors", "Brings the list of processors to the front.", |studio, _| {
            studio.session.to_open.push(Pane::Processors);
        }),
        editing("Show network", "Brings the node canvas to the front.", |studio, _| {
            studio.panels.network.attend();
            studio.session.to_open.push(Pane::Network);
        }),
        editing("Show canvas", "Brings the picture to the front.", |studio, _| {
            studio.session.to_open.push(Pane::Canvas);
        }),
        editing("Show properties", "Brings the properties of the selection to the front.", |studio, _| {
            studio.session.to_open.push(Pane::Properties);
        }),
        editing("Show messages", "Brings what you were told to the front.", |studio, _| {
            studio.session.to_open.push(Pane::Messages);
        }),
        editing("Show accuracy", "Compares the picture with an exact one.", |studio, _| {
            studio.session.to_open.push(Pane::Accuracy);
        }),
        editing("Show ray probe", "Follows the ray of a pixel: Ctrl and click on one.", |studio, _| {
            studio.session.to_open.push(Pane::RayProbe);
        }),
        editing("Show frame budget", "Lists what every processor took, and why it ran.", |studio, _| {
            studio.session.to_open.push(Pane::Budget);
        }),
        editing("Show application", "Brings to the front what visualization mode shows, to choose it.", |studio, _| {
            studio.session.to_open.push(Pane::Application);
        }),
        editing(
            "Estimate the error",
            "Tells in the status line how exact the picture is, once it stands still.",
            |studio, _| {
                studio.session.estimating = !studio.session.estimating;
            },
        )
        .ticked(|studio, _| studio.session.estimating),
        editing("Default layout", "Puts all panels where they were at first.", |studio, _| {
            studio.tiles = panels::default_layout();
        }),
    ],
];

const HELP: &[&[Command]] = &[&[
    editing("Welcome page", "Shows what comes with Rayloom and what was opened lately.", |studio, _| {
        studio.welcome.open(&studio.session);
    }),
    Command::new("All commands...", "Opens the palette, to search commands and processors.", |studio, _| {
        studio.palette.open();
    })
    .keys(&[ctrl(Key::P), ctrl_shift(Key::P)]),
    Command::new("Keys and gestures", "Lists what keys and the pointer do.", |studio, _| studio.key_list.toggle())
        .keys(&[plain(Key::F1)]),
]];

/// A command that edits the network, or how it is shown.
const fn editing(label: &'static str, help: &'static str, run: fn(&mut Studio, &Context)) -> Command {
    Command::new(label, help, run).enabled(is_development)
}

/// A command for what is selected in the network.
const fn on_selection(label: &'static str, help: &'static str, run: fn(&mut Studio, &Context)) -> Command {
    Command::new(label, help, run).scope(Scope::Network).enabled(|studio| {
        is_development(studio) && (!studio.session.selection.is_empty() || studio.panels.network.has_selected_wires())
    })
}

fn is_development(studio: &Studio) -> bool {
    studio.session.mode == Mode::Development
}

fn preference(context: &Context) -> ThemePreference {
    context.options(|options| options.theme_preference)
}

fn network(studio: &mut Studio, context: &Context, action: NetworkAction) {
    studio.panels.network.apply(action, context, &mut studio.session);
}
