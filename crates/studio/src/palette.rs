//! The palette: type a few letters, press Enter, and the processor is there or the command done.

use egui::{Align, Align2, Button, Context, Key, Layout, Modifiers, RichText, ScrollArea, TextEdit};

use crate::app::Studio;
use crate::catalog::search;
use crate::commands::{Command, MENUS};
use crate::session::Mode;

/// Width of the palette, points.
const WIDTH: f32 = 460.0;

/// What was chosen.
pub enum Chosen {
    /// A processor to add: the id of its type.
    Processor(String),
    /// A command to run.
    Command(&'static Command),
}

/// A searchable list of processors and commands over everything else.
#[derive(Default)]
pub struct Palette {
    /// What is typed and which entry is chosen, while it is open.
    open: Option<Search>,
}

#[derive(Default)]
struct Search {
    text: String,
    chosen: usize,
}

/// A line of the list.
struct Entry<'a> {
    label: &'a str,
    help: &'a str,
    keys: String,
    chosen: Chosen,
}

impl Palette {
    /// Opens it, or closes it when it is open.
    pub fn open(&mut self) {
        self.open = if self.open.is_some() { None } else { Some(Search::default()) };
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Shows a window's palette while it is open.
    pub fn show(studio: &mut Studio, context: &Context) -> Option<Chosen> {
        let mut search = studio.palette.open.take()?;
        let closing = context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        let mut chosen = None;
        let shown = egui::Window::new("Palette")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, [0.0, 90.0])
            .fixed_size([WIDTH, 360.0])
            .show(context, |ui| chosen = search.contents(ui, studio));
        let outside = shown.is_some_and(|shown| shown.response.clicked_elsewhere());
        if !(closing || outside || chosen.is_some()) {
            studio.palette.open = Some(search);
        }
        chosen
    }
}

impl Search {
    /// What matches: processors where there is a network in sight, then commands.
    fn groups<'a>(&self, studio: &'a Studio, context: &Context) -> Vec<(&'a str, Vec<Entry<'a>>)> {
        let mut groups = Vec::new();
        if studio.session.mode == Mode::Development {
            groups.extend(search(&studio.session.registry, &self.text).into_iter().map(|(task, members)| {
                let entry = |declaration: &'a rayloom_network::Declaration| Entry {
                    label: &declaration.label,
                    help: &declaration.help,
                    keys: String::new(),
                    chosen: Chosen::Processor(declaration.id.clone()),
                };
                (task, members.into_iter().map(entry).collect())
            }));
        }
        let words: Vec<String> = self.text.split_whitespace().map(str::to_lowercase).collect();
        for menu in MENUS {
            let matches = |command: &&Command| {
                let text = format!("{} {} {}", menu.title, command.label, command.help).to_lowercase();
                command.is_enabled(studio) && words.iter().all(|word| text.contains(word))
            };
            let entry = |command: &'static Command| Entry {
                label: command.label,
                help: command.help,
                keys: command.keys_text(context),
                chosen: Chosen::Command(command),
            };
            groups.push((menu.title, menu.commands().filter(matches).map(entry).collect()));
        }
        groups.retain(|(_, members): &(_, Vec<_>)| !members.is_empty());
        groups
    }

    /// The number of the first entry that has all words in its name, not only in its help.
    fn best(&self, groups: &[(&str, Vec<Entry<'_>>)]) -> usize {
        let words: Vec<String> = self.text.split_whitespace().map(str::to_lowercase).collect();
        let named = |entry: &Entry<'_>| words.iter().all(|word| entry.label.to_lowercase().contains(word));
        groups.iter().flat_map(|(_, members)| members).position(named).unwrap_or_default()
    }

    fn contents(&mut self, ui: &mut egui::Ui, studio: &Studio) -> Option<Chosen> {
        // Before the text field sees them: these keys move the choice, not the cursor.
        let pressed = |ui: &egui::Ui, key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let (up, down, enter) = (pressed(ui, Key::ArrowUp), pressed(ui, Key::ArrowDown), pressed(ui, Key::Enter));
        let hint = "Search processors and commands";
        let field = ui.add(TextEdit::singleline(&mut self.text).hint_text(hint).desired_width(f32::INFINITY));
        field.request_focus();
        let groups = self.groups(studio, ui.ctx());
        if field.changed() {
            self.chosen = self.best(&groups);
        }
        let count = groups.iter().map(|(_, members)| members.len()).sum::<usize>();
        self.chosen = match count {
            0 => 0,
            _ if down => (self.chosen + 1) % count,
            _ if up => (self.chosen + count - 1) % count,
            _ => self.chosen.min(count - 1),
        };
        if count == 0 {
            ui.weak("Nothing matches.");
        }
        let clicked = self.list(ui, &groups, up || down);
        let index = if enter && count > 0 { Some(self.chosen) } else { clicked };
        let mut all = groups.into_iter().flat_map(|(_, members)| members);
        index.and_then(|index| all.nth(index)).map(|entry| entry.chosen)
    }

    /// The number of the entry that was clicked.
    fn list(&self, ui: &mut egui::Ui, groups: &[(&str, Vec<Entry<'_>>)], moved: bool) -> Option<usize> {
        let mut clicked = None;
        let mut index = 0;
        let rows = |ui: &mut egui::Ui| {
            for (title, members) in groups {
                ui.add_space(4.0);
                ui.label(RichText::new(*title).small().weak());
                for entry in members {
                    let chosen = index == self.chosen;
                    let button = Button::selectable(chosen, entry.label).shortcut_text(&entry.keys);
                    let row = ui.add(button).on_hover_text(entry.help);
                    if chosen && moved {
                        row.scroll_to_me(None);
                    }
                    if chosen {
                        // All of it is told by the tooltip.
                        let first = entry.help.split_inclusive(". ").next().unwrap_or_default();
                        let help = RichText::new(first.trim_end()).size(11.0).weak();
                        ui.with_layout(Layout::top_down(Align::Min), |ui| ui.label(help));
                    }
                    if row.clicked() {
                        clicked = Some(index);
                    }
                    index += 1;
                }
            }
        };
        ScrollArea::vertical()
            .auto_shrink([false, true])
            .max_height(310.0)
            .show(ui, |ui| ui.with_layout(Layout::top_down_justified(Align::Min), rows));
        clicked
    }
}
