//! Frames with notes behind the nodes: dragged by their heading with all that stands in them, sized by their corner.

use egui::{Color32, CornerRadius, CursorIcon, Pos2, Rect, Response, Sense, Stroke, StrokeKind, TextEdit, Ui, Vec2};
use rayloom_network::{EditError, Frame, Network};

use super::action::Action;
use super::geometry::Geometry;
use super::text::Text;
use crate::pointer::dragged_by;
use crate::session::Session;

/// Height of a heading.
const HEAD: f32 = 26.0;
/// Side of the corner that sizes.
const CORNER: f32 = 16.0;
/// Smallest width and height.
const LEAST: f32 = 60.0;
/// Space around the nodes that a new frame holds.
const MARGIN: f32 = 24.0;
/// Size of a new frame that holds nothing.
const EMPTY: Vec2 = Vec2::new(260.0, 160.0);
/// Heights of the fonts of heading and text.
const TITLE: f32 = 14.0;
const NOTE: f32 = 12.0;

/// What is done to a frame.
#[derive(Clone, Debug, PartialEq)]
pub enum FrameEdit {
    /// A new one around nodes, or at a point.
    Add(Rect),
    /// Moved with the processors in it; how far in all.
    Move(usize, Vec2),
    /// Sized; how far its corner moved in all.
    Size(usize, Vec2),
    /// Other words.
    Write(usize, String, String),
    /// Taken away; what stands in it stays.
    Remove(usize),
}

/// A drag of a frame: the network when it began, and how far the pointer is from there.
#[derive(Default)]
pub struct Dragged {
    before: Option<Network>,
    moved: Vec2,
}

/// Where a frame lies on the canvas.
pub fn rect(frame: &Frame) -> Rect {
    let [x, y, width, height] = frame.rect.map(|x| x as f32);
    Rect::from_min_size(Pos2::new(x, y), Vec2::new(width, height))
}

/// Draws the frames and collects what is done to them.
pub fn show(ui: &mut Ui, session: &Session, zoom: f32, actions: &mut Vec<Action>) {
    for (index, frame) in session.network().frames().iter().enumerate() {
        let area = rect(frame);
        paint(ui, frame, area, zoom);
        let head = Rect::from_min_size(area.min, Vec2::new(area.width(), HEAD));
        let response = ui.interact(head, ui.id().with(("frame", index)), Sense::click_and_drag());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::WidgetType::Button, true, format!("frame {}", frame.title))
        });
        drag(&response, |by| FrameEdit::Move(index, by), actions);
        menu(&response, index, frame, actions);
        let corner = Rect::from_min_max(area.max - Vec2::splat(CORNER), area.max);
        let corner = ui.interact(corner, ui.id().with(("corner", index)), Sense::drag());
        drag(&corner.on_hover_cursor(CursorIcon::ResizeNwSe), |by| FrameEdit::Size(index, by), actions);
    }
}

fn drag(response: &Response, edit: impl FnOnce(Vec2) -> FrameEdit, actions: &mut Vec<Action>) {
    if response.dragged_by(egui::PointerButton::Primary) {
        actions.push(Action::Frame(edit(dragged_by(response))));
    }
}

fn paint(ui: &Ui, frame: &Frame, area: Rect, zoom: f32) {
    let accent = ui.visuals().selection.stroke.color;
    let fill: Color32 = accent.gamma_multiply(0.07);
    let stroke = Stroke::new(1.0, accent.gamma_multiply(0.35));
    ui.painter().rect(area, CornerRadius::same(8), fill, stroke, StrokeKind::Inside);
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    let at = area.min + Vec2::new(12.0, 7.0);
    Text::new(&painter, &frame.title, TITLE, ui.visuals().strong_text_color(), zoom).paint(&painter, at);
    for (line, text) in frame.text.lines().enumerate() {
        let at = area.min + Vec2::new(12.0, HEAD + 16.0 * line as f32);
        Text::new(&painter, text, NOTE, ui.visuals().weak_text_color(), zoom).paint(&painter, at);
    }
    let [x, y] = [area.max.x - 4.0, area.max.y - 4.0];
    for length in [4.0, 8.0] {
        ui.painter().line_segment([Pos2::new(x - length, y), Pos2::new(x, y - length)], stroke);
    }
}

/// The words of a frame, to be edited where they are right-clicked.
fn menu(response: &Response, index: usize, frame: &Frame, actions: &mut Vec<Action>) {
    let menu = egui::Popup::context_menu(response).close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
    menu.show(|ui| {
        let (mut title, mut text) = (frame.title.clone(), frame.text.clone());
        let head = ui.add(TextEdit::singleline(&mut title).hint_text("Title").desired_width(240.0));
        ui.ctx().accesskit_node_builder(head.id, |node| node.set_label("Title of the frame"));
        let note = ui.add(TextEdit::multiline(&mut text).hint_text("Notes").desired_width(240.0).desired_rows(4));
        ui.ctx().accesskit_node_builder(note.id, |node| node.set_label("Notes of the frame"));
        if head.changed() || note.changed() {
            actions.push(Action::Frame(FrameEdit::Write(index, title, text)));
        }
        if ui.button("Remove the frame").clicked() {
            actions.push(Action::Frame(FrameEdit::Remove(index)));
            ui.close();
        }
    });
}

/// The rectangle of a new frame: around the selected nodes, else at a point.
pub fn around(session: &Session, geometry: &Geometry, at: Pos2) -> Rect {
    let nodes = session.selection.iter().filter_map(|id| geometry.nodes.get(id).copied());
    match nodes.reduce(|all, node| all.union(node)) {
        Some(all) => {
            let all = all.expand(MARGIN);
            all.with_min_y(all.top() - HEAD)
        }
        None => Rect::from_min_size(at, EMPTY),
    }
}

/// Does to the document what was done to a frame; a drag is one step.
pub fn apply(edit: FrameEdit, dragged: &mut Dragged, geometry: &Geometry, session: &mut Session) {
    let mut frames = session.network().frames().to_vec();
    let numbers = |area: Rect| [area.left(), area.top(), area.width(), area.height()].map(|x| f64::from(x.round()));
    match edit {
        FrameEdit::Add(area) => {
            frames.push(Frame { title: "Notes".into(), text: String::new(), rect: numbers(area) });
            session.edit("add a frame", |network| network.set_frames(frames));
        }
        FrameEdit::Remove(index) => {
            frames.remove(index);
            session.edit("remove a frame", |network| network.set_frames(frames));
        }
        FrameEdit::Write(index, title, text) => {
            (frames[index].title, frames[index].text) = (title, text);
            merged(session, &format!("frame {index}"), |network| network.set_frames(frames));
        }
        FrameEdit::Move(index, by) | FrameEdit::Size(index, by) => {
            let before = dragged.before.get_or_insert_with(|| session.network().clone()).clone();
            dragged.moved += by;
            let moved = dragged.moved.round();
            let area = before.frames().get(index).map(rect).unwrap_or(Rect::ZERO);
            if matches!(edit, FrameEdit::Size(..)) {
                let size = (area.size() + moved).max(Vec2::splat(LEAST));
                frames[index].rect = numbers(Rect::from_min_size(area.min, size));
                merged(session, "size a frame", |network| network.set_frames(frames));
                return;
            }
            frames[index].rect = numbers(area.translate(moved));
            merged(session, "move a frame", |network| {
                network.set_frames(frames)?;
                let inside = before.processors().filter(|processor| {
                    let at = Pos2::from(processor.position().map(|x| x as f32));
                    let size = geometry.nodes.get(processor.id()).map_or(Vec2::ZERO, Rect::size);
                    area.contains_rect(Rect::from_min_size(at, size))
                });
                inside.into_iter().try_for_each(|processor| {
                    let [x, y] = processor.position();
                    network.set_position(processor.id(), [x + f64::from(moved.x), y + f64::from(moved.y)])
                })
            });
        }
    }
}

fn merged(session: &mut Session, key: &str, change: impl FnOnce(&mut Network) -> Result<(), EditError>) {
    if let Err(error) = session.document.edit_merged("edit a frame", key, change) {
        session.tell(crate::session::Severity::Error, error.to_string());
    }
}
