//! Slices in the user's hand: scrolling, and a crosshair that slices of the same volume share.

use egui::{Color32, Key, PointerButton, Pos2, Rect, Stroke};
use rayloom_network::{Address, Network, Value};
use rayloom_processors::Data;
use rayloom_processors::types::SLICE_VIEW;
use rayloom_volume::Volume;

use super::number;
use crate::pointer::{dragged_by, notches};
use crate::probe::Mark;
use crate::session::Session;

/// A slice across an axis, and how it lies in the picture.
struct Slice {
    /// The axes of the volume across, to the right, and up.
    axes: [usize; 3],
    /// World units for a point of the screen.
    per_point: f64,
    /// World lengths of the volume's box along its axes.
    extent: [f64; 3],
    pan: [f64; 2],
    middle: Pos2,
}

impl Slice {
    fn of(network: &Network, processor: &str, volume: &Volume, shown: Rect) -> Option<Self> {
        let axes = axes(network, processor)?;
        let extent = (volume.dims_f64() * volume.spacing()).to_array();
        let zoom = number(network, processor, "zoom")?;
        let Value::Vector(pan) = network.value(processor, "pan")? else { return None };
        let [right, up] = [extent[axes[1]], extent[axes[2]]];
        let per_point = (right / f64::from(shown.width())).max(up / f64::from(shown.height())) / zoom;
        Some(Self { axes, per_point, extent, pan: [*pan.first()?, *pan.get(1)?], middle: shown.center() })
    }

    /// Volume coordinates (0 to 1 in the box) to the right and up of a point of the screen.
    fn coordinates(&self, point: Pos2) -> [f64; 2] {
        let offset = point - self.middle;
        let [right, up] = [f64::from(offset.x), -f64::from(offset.y)].map(|points| points * self.per_point);
        [0.5 + (right + self.pan[0]) / self.extent[self.axes[1]], 0.5 + (up + self.pan[1]) / self.extent[self.axes[2]]]
    }

    /// What to pan by so that a point of the screen shows the same when a point of the screen is `scale` times as many world units.
    fn pan_for(&self, point: Pos2, scale: f64) -> [f64; 2] {
        let offset = point - self.middle;
        let kept = self.per_point * (1.0 - scale);
        [self.pan[0] + f64::from(offset.x) * kept, self.pan[1] - f64::from(offset.y) * kept]
    }

    /// The point of the screen with these volume coordinates to the right and up.
    fn point(&self, [right, up]: [f64; 2]) -> Pos2 {
        let x = ((right - 0.5) * self.extent[self.axes[1]] - self.pan[0]) / self.per_point;
        let y = ((up - 0.5) * self.extent[self.axes[2]] - self.pan[1]) / self.per_point;
        Pos2::new(self.middle.x + x as f32, self.middle.y - y as f32)
    }
}

/// The axes across, to the right and up of a slice view; none when it is oblique.
fn axes(network: &Network, processor: &str) -> Option<[usize; 3]> {
    match network.value(processor, "plane")? {
        Value::Text(plane) => match plane.as_str() {
            "x" => Some([0, 1, 2]),
            "y" => Some([1, 0, 2]),
            "z" => Some([2, 0, 1]),
            _ => None,
        },
        _ => None,
    }
}

/// The slice views across another axis of the volume that a slice view shows, with that axis.
fn siblings(network: &Network, processor: &str) -> Vec<(String, usize)> {
    let source = |id: &str| network.inputs(id).next().map(|connection| connection.from.clone());
    let mine = source(processor);
    let others = network.processors().filter(|other| other.type_id() == SLICE_VIEW && other.id() != processor);
    others
        .filter(|other| source(other.id()) == mine)
        .filter_map(|other| Some((other.id().to_owned(), axes(network, other.id())?[0])))
        .collect()
}

/// Moves a slice view and the crosshair as the user wants.
pub(super) fn interact(ui: &egui::Ui, response: &egui::Response, shown: Rect, session: &mut Session, processor: &str) {
    let source = session.network().inputs(processor).next().map(|connection| connection.from.clone());
    let Some(source) = source else { return };
    let Some(Data::Volume(data)) = session.engine.results.outputs.get(&source).cloned() else { return };
    let Some(slice) = Slice::of(session.network(), processor, &data.volume, shown) else { return };
    let siblings = siblings(session.network(), processor);
    let before = session.document.revision();
    scroll(ui, response, session, processor, data.volume.dims[slice.axes[0]]);
    zoom(ui, response, session, processor, &slice);
    if shows_all(ui, response) {
        session.set(processor, "zoom", Value::Float(1.0));
        session.set(processor, "pan", Value::Vector(vec![0.0; 2]));
    }
    let moves = response.dragged_by(PointerButton::Middle)
        || (response.dragged_by(PointerButton::Primary) && ui.input(|input| input.modifiers.shift));
    if moves {
        let delta = dragged_by(response);
        let [x, y] = [f64::from(delta.x), f64::from(-delta.y)].map(|points| points * slice.per_point);
        session.set(processor, "pan", Value::Vector(vec![slice.pan[0] - x, slice.pan[1] - y]));
    } else if let Some(pointer) = response.interact_pointer_pos().filter(|_| is_held(ui, response)) {
        place(session, &slice, &siblings, pointer);
    }
    session.interacting |= session.document.revision() != before;
    if let Some(pointer) = response.hover_pos()
        && let Some(value) = value_at(session.network(), processor, &data.volume, &slice, pointer)
    {
        mark(ui, session, &source, value);
    }
    crosshair(ui, shown, session.network(), &slice, &siblings);
}

/// The value of the voxel under the pointer, in the volume's unit; none outside of it and where it has none.
fn value_at(network: &Network, processor: &str, volume: &Volume, slice: &Slice, pointer: Pos2) -> Option<f64> {
    let mut place = [number(network, processor, "position")?; 3];
    [place[slice.axes[1]], place[slice.axes[2]]] = slice.coordinates(pointer);
    let mut voxel = [0; 3];
    for ((index, place), voxels) in voxel.iter_mut().zip(place).zip(volume.dims) {
        let inside = (0.0..=1.0).contains(&place);
        *index = inside.then(|| ((place * f64::from(voxels)) as u32).min(voxels - 1))?;
    }
    let Value::Int(channel) = network.value(processor, "channel")? else { return None };
    let channel = u32::try_from(channel).ok().filter(|channel| *channel < volume.channels)?;
    Some(volume.value(voxel, channel)).filter(|value| value.is_finite())
}

/// Marks a value in every transfer function of the volume.
fn mark(ui: &egui::Ui, session: &mut Session, source: &Address, value: f64) {
    let network = session.network();
    let fed = network.outputs(&source.processor).filter(|connection| connection.from == *source);
    let fed = fed.map(|connection| connection.to.processor.clone()).collect();
    if session.probe.mark(Mark { value, gradient: None }, fed) {
        ui.ctx().request_repaint();
    }
}

fn is_held(ui: &egui::Ui, response: &egui::Response) -> bool {
    // A quick click is pressed and released within one frame.
    response.clicked() || (response.is_pointer_button_down_on() && ui.input(|input| input.pointer.primary_down()))
}

/// The wheel goes through the volume: a notch leads to the middle of the next slice of voxels.
fn scroll(ui: &egui::Ui, response: &egui::Response, session: &mut Session, processor: &str, voxels: u32) {
    if !response.hovered() {
        return;
    }
    let steps = notches(ui, response.id.with("slices"));
    if steps != 0
        && let Some(before) = number(session.network(), processor, "position")
    {
        session.set(processor, "position", Value::Float(stepped(before, steps, voxels)));
    }
}

/// The middle of the slice of voxels so many further on, as a place from 0 to 1.
fn stepped(position: f64, steps: i32, voxels: u32) -> f64 {
    let last = f64::from(voxels.saturating_sub(1));
    let slice = (position * f64::from(voxels)).floor().clamp(0.0, last) + f64::from(steps);
    (slice.clamp(0.0, last) + 0.5) / f64::from(voxels.max(1))
}

/// The wheel with Ctrl, or two fingers, zoom where the pointer is.
fn zoom(ui: &egui::Ui, response: &egui::Response, session: &mut Session, processor: &str, slice: &Slice) {
    let factor = f64::from(ui.input(egui::InputState::zoom_delta));
    if let Some(pointer) = response.hover_pos().filter(|_| factor != 1.0)
        && let Some(before) = number(session.network(), processor, "zoom")
    {
        let after = (before * factor).clamp(0.01, 1000.0);
        session.set(processor, "zoom", Value::Float(after));
        session.set(processor, "pan", Value::Vector(slice.pan_for(pointer, before / after).into()));
    }
}

/// Whether the user wants to see all of the slice, by a key or the menu.
fn shows_all(ui: &egui::Ui, response: &egui::Response) -> bool {
    let key = |key| ui.input(|input| input.modifiers.is_none() && input.key_pressed(key));
    let mut wanted = response.hovered() && !ui.ctx().text_edit_focused() && (key(Key::A) || key(Key::Home));
    response.context_menu(|ui| {
        wanted |= ui.add(egui::Button::new("Show everything").shortcut_text("A")).clicked();
    });
    wanted
}

/// Puts the other slices through the point under the pointer.
fn place(session: &mut Session, slice: &Slice, siblings: &[(String, usize)], pointer: Pos2) {
    let coordinates = slice.coordinates(pointer);
    for (sibling, axis) in siblings {
        let direction = slice.axes[1..].iter().position(|shown| shown == axis);
        if let Some(direction) = direction {
            let position = coordinates[direction].clamp(0.0, 1.0);
            session.set(sibling, "position", Value::Float(position));
        }
    }
}

/// Lines where the other slices cut this one.
fn crosshair(ui: &egui::Ui, shown: Rect, network: &Network, slice: &Slice, siblings: &[(String, usize)]) {
    let painter = ui.painter().with_clip_rect(shown);
    for (sibling, axis) in siblings {
        let Some(position) = number(network, sibling, "position") else { continue };
        let stroke = Stroke::new(1.0, AXES[*axis].gamma_multiply(0.7));
        let point = slice.point([position, position]);
        if *axis == slice.axes[1] {
            painter.vline(point.x, shown.y_range(), stroke);
        } else if *axis == slice.axes[2] {
            painter.hline(shown.x_range(), point.y, stroke);
        }
    }
}

/// Colours of planes across x, y and z.
const AXES: [Color32; 3] =
    [Color32::from_rgb(0xe0, 0x7a, 0x6a), Color32::from_rgb(0x7f, 0xbf, 0x7f), Color32::from_rgb(0x6f, 0xa8, 0xe0)];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_notch_is_one_slice() {
        for voxels in [1, 2, 7, 181, 218, 512] {
            let mut position = 0.0;
            for slice in 1..=voxels {
                position = stepped(position, 1, voxels);
                let expected = slice.min(voxels - 1);
                assert_eq!((position * f64::from(voxels)) as u32, expected, "of {voxels}");
            }
            assert_eq!(stepped(position, -10_000, voxels), 0.5 / f64::from(voxels));
        }
    }

    #[test]
    fn points_and_coordinates_are_inverse() {
        let slice = Slice {
            axes: [1, 0, 2],
            per_point: 0.25,
            extent: [100.0, 50.0, 80.0],
            pan: [3.0, -4.0],
            middle: Pos2::new(200.0, 100.0),
        };
        let [right, up] = slice.coordinates(slice.point([0.3, 0.8]));
        assert!((right - 0.3).abs() < 1e-5 && (up - 0.8).abs() < 1e-5);
        let point = Pos2::new(310.0, 40.0);
        let zoomed = Slice { per_point: 0.125, pan: slice.pan_for(point, 0.5), ..slice };
        let pairs = zoomed.coordinates(point).into_iter().zip(slice.coordinates(point));
        assert!(pairs.into_iter().all(|(zoomed, before)| (zoomed - before).abs() < 1e-9));
        // The wheel of a mouse and the arithmetic agree about up.
        assert!(slice.point([0.3, 0.8]).y < slice.point([0.3, 0.7]).y);
    }
}
