//! Lists whose items are moved by a handle, with the pointer or with arrow keys.

use egui::{CursorIcon, EventFilter, Key, Rect, Sense, Stroke, Ui, Vec2};

use crate::visualization::Place;

/// Size of a handle.
const HANDLE: Vec2 = Vec2::new(12.0, 18.0);

/// Which list an item belongs to. Properties can move to another group, everything else stays in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum List {
    Canvases,
    Groups,
    Properties,
    Presets,
}

/// An item on its way to another place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Carried {
    list: List,
    from: Place,
}

/// The handle of an item. Returns -1 or 1 when a key moves it up or down.
pub fn handle(ui: &mut Ui, list: List, from: Place, name: &str) -> Option<isize> {
    let (area, _) = ui.allocate_exact_size(HANDLE, Sense::hover());
    // By name, so that the keyboard stays with an item that moves.
    let response = ui.interact(area, egui::Id::new(("handle", list as u8, name)), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Button, true, format!("Move {name}")));
    response.dnd_set_drag_payload(Carried { list, from });
    let strong = response.hovered() || response.dragged() || response.has_focus();
    let color = if strong { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
    for row in -1..=1 {
        for column in [-2.0, 2.0] {
            ui.painter().circle_filled(area.center() + Vec2::new(column, 4.0 * row as f32), 1.2, color);
        }
    }
    let response =
        response.on_hover_cursor(CursorIcon::Grab).on_hover_text("Drag to move; or click and use the arrow keys");
    if response.clicked() {
        response.request_focus();
    }
    if !response.has_focus() {
        return None;
    }
    let filter = EventFilter { vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let pressed = |key| ui.input(|input| input.key_pressed(key));
    match (pressed(Key::ArrowUp), pressed(Key::ArrowDown)) {
        (true, false) => Some(-1),
        (false, true) => Some(1),
        _ => None,
    }
}

/// Lets an item of the same list be dropped before or after the one that fills an area. Returns where it came from, and
/// whether it goes after.
pub fn drop_at(ui: &Ui, area: Rect, list: List) -> Option<(Place, bool)> {
    let carried = *egui::DragAndDrop::payload::<Carried>(ui.ctx())?;
    let pointer = ui.input(|input| input.pointer.latest_pos())?;
    let area = area.expand2(Vec2::new(0.0, 0.5 * ui.spacing().item_spacing.y));
    if carried.list != list || !area.contains(pointer) || !ui.clip_rect().contains(pointer) {
        return None;
    }
    let after = pointer.y > area.center().y;
    let line = if after { area.bottom() } else { area.top() };
    ui.painter().hline(area.x_range(), line, Stroke::new(2.0, ui.visuals().selection.stroke.color));
    let released = ui.input(|input| input.pointer.primary_released());
    released.then_some((carried.from, after))
}

/// The place among the others of an item dropped before or after another.
pub fn landing(from: usize, at: usize, after: bool) -> usize {
    let before = at + usize::from(after);
    if before > from { before - 1 } else { before }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_item_lands_beside_the_one_it_is_dropped_on() {
        for (from, at, after, expected) in
            [(0, 2, true, 2), (0, 2, false, 1), (2, 0, false, 0), (2, 0, true, 1), (1, 1, true, 1)]
        {
            assert_eq!(landing(from, at, after), expected, "{from} {at} {after}");
        }
    }
}
