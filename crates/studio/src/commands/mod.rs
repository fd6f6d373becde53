//! What the user can tell the window to do, as data: one [table] drives the menu bar, the keys, the palette and the list of keys.

mod keys;
mod menu;
mod table;

use egui::{Context, KeyboardShortcut};

use crate::app::Studio;
use crate::session::Mode;

pub use keys::KeyList;
pub use menu::menu_bar;
pub use table::MENUS;

/// When the keys of a command count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Always.
    Window,
    /// Unless a text is being typed, which has its own undo.
    NotTyping,
    /// After a click on the node canvas, until the next click elsewhere.
    Network,
}

/// Something that the user can tell the window to do.
pub struct Command {
    /// What it is called, everywhere.
    pub label: &'static str,
    /// What it does: a sentence.
    pub help: &'static str,
    /// What does it. The first is shown.
    pub keys: &'static [KeyboardShortcut],
    /// When the keys count.
    scope: Scope,
    /// Whether it makes sense at the moment.
    enabled: fn(&Studio) -> bool,
    /// For choices: whether this is what is chosen.
    ticked: Option<fn(&Studio, &Context) -> bool>,
    /// What exactly it would be done to.
    detail: Option<fn(&Studio) -> Option<&str>>,
    run: fn(&mut Studio, &Context),
}

/// A menu of the menu bar; its commands in groups.
pub struct Menu {
    /// Text in the menu bar.
    pub title: &'static str,
    /// Commands, with a line between groups.
    pub groups: &'static [&'static [Command]],
    /// What else belongs to the first group, and is no command.
    pub more: Option<fn(&mut egui::Ui, &mut Studio)>,
}

impl Menu {
    /// Its commands.
    pub fn commands(&self) -> impl Iterator<Item = &'static Command> {
        self.groups.iter().flat_map(|group| group.iter())
    }
}

impl Command {
    const fn new(label: &'static str, help: &'static str, run: fn(&mut Studio, &Context)) -> Self {
        Self { label, help, keys: &[], scope: Scope::Window, enabled: |_| true, ticked: None, detail: None, run }
    }

    const fn keys(self, keys: &'static [KeyboardShortcut]) -> Self {
        Self { keys, ..self }
    }

    const fn scope(self, scope: Scope) -> Self {
        Self { scope, ..self }
    }

    const fn enabled(self, enabled: fn(&Studio) -> bool) -> Self {
        Self { enabled, ..self }
    }

    const fn ticked(self, ticked: fn(&Studio, &Context) -> bool) -> Self {
        Self { ticked: Some(ticked), ..self }
    }

    const fn detail(self, detail: fn(&Studio) -> Option<&str>) -> Self {
        Self { detail: Some(detail), ..self }
    }

    /// Whether it makes sense at the moment.
    pub fn is_enabled(&self, studio: &Studio) -> bool {
        (self.enabled)(studio)
    }

    /// Does it.
    pub fn run(&self, studio: &mut Studio, context: &Context) {
        (self.run)(studio, context);
    }

    /// The keys as text; empty where there are none.
    pub fn keys_text(&self, context: &Context) -> String {
        self.keys.first().map(|keys| context.format_shortcut(keys)).unwrap_or_default()
    }

    /// Whether its keys count now.
    fn listens(&self, studio: &Studio, context: &Context) -> bool {
        match self.scope {
            Scope::Window => true,
            Scope::NotTyping => !context.text_edit_focused(),
            Scope::Network => {
                studio.session.mode == Mode::Development
                    && studio.panels.network.is_attentive()
                    && !studio.palette.is_open()
                    && !context.egui_wants_keyboard_input()
            }
        }
    }
}

/// All commands, in the order of the menus.
pub fn all() -> impl Iterator<Item = &'static Command> {
    MENUS.iter().flat_map(Menu::commands)
}

/// Does what the pressed keys stand for.
pub fn run_pressed(studio: &mut Studio, context: &Context) {
    if studio.is_asking(context) {
        return;
    }
    let mut bound: Vec<_> = all().flat_map(|command| command.keys.iter().map(move |keys| (keys, command))).collect();
    // Those with most modifiers first: a shortcut also matches when more modifiers are held.
    let modifiers = |keys: &KeyboardShortcut| {
        let held = keys.modifiers;
        usize::from(held.alt) + usize::from(held.shift) + usize::from(held.ctrl) + usize::from(held.command)
    };
    bound.sort_by_key(|(keys, _)| std::cmp::Reverse(modifiers(keys)));
    for (keys, command) in bound {
        if command.is_enabled(studio)
            && command.listens(studio, context)
            && context.input_mut(|input| input.consume_shortcut(keys))
        {
            command.run(studio, context);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn labels_are_unique_helpful_and_no_two_commands_share_keys() {
        let mut labels = BTreeMap::new();
        let mut keys = BTreeMap::new();
        for command in all() {
            assert!(labels.insert(command.label, ()).is_none(), "`{}` twice", command.label);
            assert!(command.help.len() > 10 && command.help.ends_with('.'), "help of `{}`", command.label);
            for bound in command.keys {
                let other = keys.insert(format!("{bound:?}"), command.label);
                assert_eq!(other, None, "keys of `{}`", command.label);
            }
        }
    }
}
