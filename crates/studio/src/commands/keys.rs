//! The list under F1: what keys and the pointer do.

use egui::{Align2, Context, Key, Modifiers, RichText, ScrollArea, Ui};

use super::MENUS;
use crate::panels::GESTURES;

/// Width of the window, points.
const WIDTH: f32 = 900.0;

/// The list of keys and gestures, over everything else while it is open.
#[derive(Default)]
pub struct KeyList {
    is_open: bool,
}

impl KeyList {
    /// Opens it, or closes it when it is open.
    pub fn toggle(&mut self) {
        self.is_open = !self.is_open;
    }

    /// Shows it while it is open.
    pub fn show(&mut self, context: &Context) {
        if self.is_open && context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            self.is_open = false;
        }
        let height = 0.8 * context.content_rect().height();
        egui::Window::new("Keys and gestures")
            .open(&mut self.is_open)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .fixed_size([WIDTH, height])
            .show(context, |ui| {
                ScrollArea::vertical().auto_shrink([false, true]).max_height(height).show(ui, |ui| {
                    ui.horizontal_top(|ui| {
                        ui.vertical(commands);
                        ui.add_space(40.0);
                        ui.vertical(gestures);
                    });
                });
            });
    }
}

fn commands(ui: &mut Ui) {
    for menu in MENUS {
        let bound: Vec<_> = menu.commands().filter(|command| !command.keys.is_empty()).collect();
        let context = ui.ctx().clone();
        section(ui, menu.title, bound.into_iter().map(|command| (command.keys_text(&context), command.label)));
    }
}

fn gestures(ui: &mut Ui) {
    for (place, lines) in GESTURES {
        section(ui, place, lines.iter().map(|(keys, effect)| ((*keys).to_owned(), *effect)));
    }
}

fn section<'a>(ui: &mut Ui, title: &str, lines: impl Iterator<Item = (String, &'a str)>) {
    let lines: Vec<_> = lines.collect();
    ui.add_space(8.0);
    ui.label(RichText::new(title).strong());
    egui::Grid::new(("keys", title)).num_columns(2).spacing([16.0, 4.0]).min_col_width(120.0).show(ui, |ui| {
        for (keys, effect) in lines {
            ui.label(RichText::new(keys).weak());
            ui.label(effect);
            ui.end_row();
        }
    });
}
