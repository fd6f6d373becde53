//! The palette: type a few letters, press Enter, and the processor is there.

use egui::{Align2, Context, Key, Modifiers, RichText, ScrollArea, TextEdit};
use rayloom_network::{Declaration, Registry};

use crate::catalog::search;

/// Width of the palette, points.
const WIDTH: f32 = 420.0;

/// A searchable list of processors over everything else.
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

impl Palette {
    /// Opens it, or closes it when it is open.
    pub fn open(&mut self) {
        self.open = if self.open.is_some() { None } else { Some(Search::default()) };
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Shows it while it is open. Returns the id of the type that was chosen.
    pub fn show(&mut self, context: &Context, registry: &Registry) -> Option<String> {
        let search = self.open.as_mut()?;
        let closing = context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        let mut clicked = None;
        let shown = egui::Window::new("Add a processor")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_TOP, [0.0, 90.0])
            .fixed_size([WIDTH, 360.0])
            .show(context, |ui| clicked = search.contents(ui, registry));
        let outside = shown.is_some_and(|shown| shown.response.clicked_elsewhere());
        if closing || outside || clicked.is_some() {
            self.open = None;
        }
        clicked
    }
}

impl Search {
    fn contents(&mut self, ui: &mut egui::Ui, registry: &Registry) -> Option<String> {
        // Before the text field sees them: these keys move the choice, not the cursor.
        let pressed = |ui: &egui::Ui, key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let (up, down, enter) = (pressed(ui, Key::ArrowUp), pressed(ui, Key::ArrowDown), pressed(ui, Key::Enter));
        let field = TextEdit::singleline(&mut self.text).hint_text("Search processors").desired_width(f32::INFINITY);
        let field = ui.add(field);
        field.request_focus();
        if field.changed() {
            self.chosen = 0;
        }
        let groups = search(registry, &self.text);
        let count = groups.iter().map(|(_, members)| members.len()).sum::<usize>();
        self.chosen = match count {
            0 => 0,
            _ if down => (self.chosen + 1) % count,
            _ if up => (self.chosen + count - 1) % count,
            _ => self.chosen.min(count - 1),
        };
        let mut all = groups.iter().flat_map(|(_, members)| members);
        if enter && let Some(declaration) = all.nth(self.chosen) {
            return Some(declaration.id.clone());
        }
        if count == 0 {
            ui.weak("No processor matches.");
        }
        self.list(ui, &groups, up || down)
    }

    fn list(&self, ui: &mut egui::Ui, groups: &[(&str, Vec<&Declaration>)], moved: bool) -> Option<String> {
        let mut clicked = None;
        let mut index = 0;
        ScrollArea::vertical().auto_shrink([false, true]).max_height(310.0).show(ui, |ui| {
            for (task, members) in groups {
                ui.add_space(4.0);
                ui.label(RichText::new(*task).small().weak());
                for declaration in members {
                    let chosen = index == self.chosen;
                    let row = ui.selectable_label(chosen, &declaration.label).on_hover_text(&declaration.help);
                    if chosen && moved {
                        row.scroll_to_me(None);
                    }
                    if chosen {
                        ui.label(RichText::new(&declaration.help).small());
                    }
                    if row.clicked() {
                        clicked = Some(declaration.id.clone());
                    }
                    index += 1;
                }
            }
        });
        clicked
    }
}
