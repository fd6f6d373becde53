//! The camera in the user's hand.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use egui::{Key, PointerButton, Pos2, Rect};
use glam::DVec3;
use rayloom_network::{Camera, Projection, Value};
use rayloom_processors::{Data, Image};

use super::cube;
use super::walk::Walker;
use crate::inspect::Pixel;
use crate::navigation::Navigation;
use crate::pointer::dragged_by;
use crate::session::{Session, Severity};
use crate::views::VIEWS;

/// Radians that the camera turns while the pointer crosses the picture.
const TURN: f64 = PI;
/// Radians that an arrow key turns, and that a key rolls.
const STEP: f64 = PI / 12.0;
/// With inertia: what is left of the turning after a second, and radians a second at which it ends.
const KEPT: f64 = 0.02;
const SLOWEST: f64 = 0.03;
/// Longest time that one frame counts for, seconds.
const LONGEST_FRAME: f64 = 0.1;

/// What keys and the menu do.
#[derive(Clone, Copy)]
enum Command {
    ShowAll,
    Project,
    Walk,
    /// From one of the usual sides.
    Side(usize),
    Cube,
    Inertia,
    Turn([f64; 2]),
    Roll(f64),
}

/// Commands by key, with their names in the menu.
const COMMANDS: [(Key, &str, Command); 8] = [
    (Key::A, "Show everything", Command::ShowAll),
    (Key::O, "Orthographic or perspective", Command::Project),
    (Key::W, "Walk", Command::Walk),
    (Key::Num1, "From the front", Command::Side(0)),
    (Key::Num3, "From the right", Command::Side(3)),
    (Key::Num7, "From above", Command::Side(4)),
    (Key::V, "Orientation cube", Command::Cube),
    (Key::I, "Inertia", Command::Inertia),
];

/// Keys that are in no menu.
const KEYS: [(Key, Command); 7] = [
    (Key::Home, Command::ShowAll),
    (Key::Q, Command::Roll(-STEP)),
    (Key::E, Command::Roll(STEP)),
    (Key::ArrowLeft, Command::Turn([-STEP, 0.0])),
    (Key::ArrowRight, Command::Turn([STEP, 0.0])),
    (Key::ArrowUp, Command::Turn([0.0, STEP])),
    (Key::ArrowDown, Command::Turn([0.0, -STEP])),
];

/// A camera and what it waits for.
#[derive(Default)]
pub(super) struct Held {
    /// The pixel whose surface is to be the centre, once its depth is known.
    centring: Option<(Arc<Pixel>, Camera)>,
    walker: Option<Walker>,
    /// Radians a second to the right and up that the camera turns by itself.
    spin: [f64; 2],
    /// Where the camera was left; one that is elsewhere was moved by something else, which ends the turning.
    left: Option<Camera>,
}

impl Held {
    /// Moves the camera `[canvas, processor, property]` as the user wants.
    pub(super) fn interact(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        shown: Rect,
        image: &Arc<Image>,
        session: &mut Session,
        [canvas, processor, property]: [&str; 3],
    ) {
        let Some(Value::Camera(before)) = session.network().value(processor, property) else { return };
        session.interacting |= response.dragged();
        let mut camera = before;
        let size = bounds(session, image).map_or(camera.distance(), |(_, radius)| 2.0 * radius);
        match &self.walker {
            Some(walker) => stroll(ui, response, shown, walker, size, &mut camera),
            None => {
                drag(ui, response, shown, &mut camera);
                session.coasting |= self.spin(ui, response, shown, session.navigation, &mut camera);
            }
        }
        zoom(ui, response, shown, &mut camera);
        for command in self.commands(ui, response) {
            self.apply(command, session, image, &mut camera);
        }
        if session.navigation.cube
            && let Some(seen) = cube::show(ui, shown, canvas, &camera)
        {
            camera = seen;
        }
        if response.double_clicked()
            && let Some(pixel) = response.hover_pos().and_then(|pointer| pixel_at(shown, image, pointer))
        {
            self.centring = Some((Arc::new(pixel), before));
        }
        if let Some(centred) = self.centred(ui, session, canvas) {
            camera = centred;
        }
        self.left = Some(camera);
        if camera != before && camera.validate().is_ok() {
            session.interacting = true;
            session.set(processor, property, Value::Camera(camera));
        }
    }

    /// What keys and the context menu ask for.
    fn commands(&mut self, ui: &egui::Ui, response: &egui::Response) -> Vec<Command> {
        let mut commands = Vec::new();
        response.context_menu(|ui| {
            for (key, name, command) in COMMANDS {
                if ui.add(egui::Button::new(name).shortcut_text(key.symbol_or_name())).clicked() {
                    commands.push(command);
                }
            }
        });
        let pressed = |key| ui.input(|input| input.modifiers.is_none() && input.key_pressed(key));
        if self.walker.is_some() {
            // The other keys walk.
            self.walker.take_if(|_| pressed(Key::Escape));
        } else if response.hovered() && !ui.ctx().text_edit_focused() {
            let listed = COMMANDS.iter().map(|(key, _, command)| (key, command));
            let all = listed.chain(KEYS.iter().map(|(key, command)| (key, command)));
            commands.extend(all.filter(|(key, _)| pressed(**key)).map(|(_, command)| *command));
        }
        commands
    }

    fn apply(&mut self, command: Command, session: &mut Session, image: &Image, camera: &mut Camera) {
        match command {
            Command::ShowAll => {
                if let Some((center, radius)) = bounds(session, image) {
                    *camera = camera.framing(center.into(), radius);
                }
            }
            Command::Project => camera.projection = other_projection(camera),
            Command::Walk => {
                self.walker = match self.walker {
                    Some(_) => None,
                    None => Some(Walker::start(camera)),
                }
            }
            Command::Side(index) => *camera = VIEWS[index].of(camera),
            Command::Cube => session.navigation.cube ^= true,
            Command::Inertia => {
                session.navigation.inertia ^= true;
                let state = if session.navigation.inertia { "on" } else { "off" };
                session.tell(Severity::Note, format!("inertia is {state}"));
            }
            Command::Turn([yaw, pitch]) => camera.orbit(yaw, pitch),
            Command::Roll(angle) => roll(camera, angle),
        }
    }

    /// With inertia a camera that was let go while it turned goes on turning, ever slower, until something is pressed or moves
    /// it. Whether it does.
    fn spin(
        &mut self,
        ui: &egui::Ui,
        response: &egui::Response,
        shown: Rect,
        wishes: Navigation,
        camera: &mut Camera,
    ) -> bool {
        if !wishes.inertia || response.is_pointer_button_down_on() {
            let turning = wishes.inertia && response.dragged_by(PointerButton::Primary);
            let velocity = ui.input(|input| input.pointer.velocity()) / shown.height().max(1.0);
            let spin = [f64::from(-velocity.x) * TURN, f64::from(velocity.y) * TURN];
            self.spin = if turning && ui.input(|input| !input.modifiers.shift) { spin } else { [0.0; 2] };
            return false;
        }
        let disturbed = self.left != Some(*camera) || ui.input(|input| input.pointer.any_pressed());
        if disturbed || self.spin[0].hypot(self.spin[1]) < SLOWEST {
            self.spin = [0.0; 2];
            return false;
        }
        let time = ui.input(|input| f64::from(input.stable_dt).min(LONGEST_FRAME));
        camera.orbit(self.spin[0] * time, self.spin[1] * time);
        self.spin = self.spin.map(|speed| speed * KEPT.powf(time));
        ui.ctx().request_repaint();
        true
    }

    /// What the user is to know about the keys just now.
    pub(super) fn hint(&self) -> Option<&'static str> {
        self.walker.is_some().then_some("Walking: W A S D, Q down, E up, Shift runs, the pointer looks, Esc ends")
    }

    /// The camera that looks at the surface which was double clicked, once its depth is known.
    fn centred(&mut self, ui: &egui::Ui, session: &mut Session, canvas: &str) -> Option<Camera> {
        let (pixel, camera) = self.centring.as_ref()?;
        // A key of its own for each question, so that no older answer is taken for it.
        let who = format!("{canvas} {:p}", Arc::as_ptr(pixel));
        let reading = session.reading(ui.ctx(), &who, pixel)?;
        let (size, at, camera) = (pixel.image.size(), pixel.at, *camera);
        self.centring = None;
        match reading.as_ref() {
            Ok(reading) => reading.depth.map(|depth| looking_at(&camera, size, at, depth.into())),
            Err(error) => {
                session.tell(Severity::Error, error.to_string());
                None
            }
        }
    }
}

/// The pixel of an image under the pointer.
fn pixel_at(shown: Rect, image: &Arc<Image>, pointer: Pos2) -> Option<Pixel> {
    let part = (pointer - shown.min) / shown.size();
    let inside = (0.0..1.0).contains(&part.x) && (0.0..1.0).contains(&part.y);
    let [width, height] = image.size().map(|pixels| pixels as f32);
    inside.then(|| Pixel { image: image.clone(), at: [(part.x * width) as u32, (part.y * height) as u32] })
}

/// The camera moved, neither turned nor brought nearer, so that what a pixel shows at a view depth is its focus.
fn looking_at(camera: &Camera, size: [u32; 2], at: [u32; 2], depth: f64) -> Camera {
    let [width, height] = size.map(f64::from);
    let x = (f64::from(at[0]) + 0.5 - 0.5 * width) / (0.5 * height);
    let y = (0.5 * height - f64::from(at[1]) - 0.5) / (0.5 * height);
    let surface = seen_at(camera, [x, y], depth);
    let shift = surface - DVec3::from(camera.focus);
    Camera { position: (DVec3::from(camera.position) + shift).into(), focus: surface.into(), ..*camera }
}

/// The world point at a view depth that is seen so many half heights of the picture to the right of its middle and above it.
fn seen_at(camera: &Camera, [x, y]: [f64; 2], depth: f64) -> DVec3 {
    let [right, up, forward] = camera.basis();
    let half = match camera.projection {
        Projection::Perspective { fov_degrees } => depth * (0.5 * fov_degrees.to_radians()).tan(),
        Projection::Orthographic { height } => 0.5 * height,
    };
    DVec3::from(camera.position) + forward * depth + right * (x * half) + up * (y * half)
}

/// The left button turns, the middle one or Shift moves, the right one zooms.
fn drag(ui: &egui::Ui, response: &egui::Response, shown: Rect, camera: &mut Camera) {
    let drag = dragged_by(response) / shown.height().max(1.0);
    let (x, y) = (f64::from(drag.x), f64::from(drag.y));
    let shift = ui.input(|input| input.modifiers.shift);
    let height = visible_height(camera);
    if response.dragged_by(PointerButton::Middle) || (response.dragged_by(PointerButton::Primary) && shift) {
        camera.pan(-x * height, y * height);
    } else if response.dragged_by(PointerButton::Primary) {
        camera.orbit(-x * TURN, y * TURN);
    } else if response.dragged_by(PointerButton::Secondary) {
        camera.zoom((2.0 * y).exp());
    }
}

/// The wheel and two fingers zoom where they are; two fingers also move and roll.
fn zoom(ui: &egui::Ui, response: &egui::Response, shown: Rect, camera: &mut Camera) {
    let (touch, scroll, pinch) =
        ui.input(|input| (input.multi_touch(), input.smooth_scroll_delta.y, f64::from(input.zoom_delta())));
    let about = |camera: &Camera, at: Pos2| {
        let from_middle = (at - shown.center()) / (0.5 * shown.height().max(1.0));
        seen_at(camera, [from_middle.x.into(), f64::from(-from_middle.y)], camera.distance()).into()
    };
    if let Some(touch) = touch.filter(|touch| shown.contains(touch.center_pos)) {
        let moved = touch.translation_delta / shown.height().max(1.0);
        let height = visible_height(camera);
        camera.pan(-f64::from(moved.x) * height, f64::from(moved.y) * height);
        let point = about(camera, touch.center_pos);
        camera.zoom_about(point, 1.0 / f64::from(touch.zoom_delta).max(1e-3));
        roll(camera, -f64::from(touch.rotation_delta));
    } else if let Some(pointer) = response.hover_pos().filter(|_| scroll != 0.0 || pinch != 1.0) {
        let point = about(camera, pointer);
        camera.zoom_about(point, f64::from(-scroll * 0.003).exp() / pinch.max(1e-3));
    }
}

/// Walking: the keys move, the pointer looks.
fn stroll(ui: &egui::Ui, response: &egui::Response, shown: Rect, walker: &Walker, size: f64, camera: &mut Camera) {
    if !ui.ctx().text_edit_focused() {
        walker.step(ui, size, camera);
    }
    let moved = match response.dragged() {
        true => dragged_by(response),
        false if response.hovered() => ui.input(|input| input.pointer.delta()),
        false => egui::Vec2::ZERO,
    } / shown.height().max(1.0);
    if moved != egui::Vec2::ZERO {
        walker.look([moved.x.into(), moved.y.into()], camera);
    }
}

/// Rolls the camera around its direction.
fn roll(camera: &mut Camera, angle: f64) {
    let [_, up, forward] = camera.basis();
    camera.up = (glam::DQuat::from_axis_angle(forward, angle) * up).into();
}

/// The other projection with the same height of the picture at the focus, and the eye where it is if a field of view can be
/// that wide.
fn other_projection(camera: &Camera) -> Projection {
    match camera.projection {
        Projection::Perspective { .. } => Projection::Orthographic { height: visible_height(camera) },
        Projection::Orthographic { height } => {
            let half = (0.5 * height / camera.distance()).atan().min(0.48 * FRAC_PI_2 * 2.0);
            Projection::Perspective { fov_degrees: 2.0 * half.to_degrees() }
        }
    }
}

/// World height of the picture at the focus.
fn visible_height(camera: &Camera) -> f64 {
    match camera.projection {
        Projection::Perspective { fov_degrees } => 2.0 * camera.distance() * (0.5 * fov_degrees.to_radians()).tan(),
        Projection::Orthographic { height } => height,
    }
}

/// Centre and radius of the sphere around what is shown, world units.
fn bounds(session: &Session, image: &Image) -> Option<(DVec3, f64)> {
    let volume = || {
        session.engine.results.outputs.values().find_map(|data| match data {
            Data::Volume(data) => Some(data.volume.texture_to_world()),
            _ => None,
        })
    };
    let to_world = image.view.as_ref().map(|view| view.texture_to_world).or_else(volume)?;
    let m = to_world.matrix3;
    // The longest of the four diagonals; a slanted box has different ones.
    let diagonals = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];
    let radius = diagonals.map(|signs| (m * DVec3::from(signs)).length() / 2.0).into_iter().fold(0.0, f64::max);
    Some((to_world.transform_point3(DVec3::splat(0.5)), radius))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_double_clicked_becomes_the_focus_at_the_same_distance() {
        for projection in [Projection::Perspective { fov_degrees: 30.0 }, Projection::Orthographic { height: 214.3593 }]
        {
            let camera = Camera { projection, ..Camera::default() };
            // Half of the height above the middle, at the depth of the focus.
            let centred = looking_at(&camera, [200, 100], [99, 24], 400.0);
            let expected = 0.51 * 0.5 * 214.3593;
            assert!((centred.focus[2] - expected).abs() < 1e-2, "{centred:?}");
            assert!((centred.distance() - camera.distance()).abs() < 1e-9);
            assert_eq!(centred.basis(), camera.basis());
        }
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        for projection in [Projection::Perspective { fov_degrees: 30.0 }, Projection::Orthographic { height: 214.3593 }]
        {
            let before = Camera { projection, ..Camera::default() };
            let point = seen_at(&before, [0.7, -0.3], before.distance());
            let mut camera = before;
            camera.zoom_about(point.into(), 0.25);
            assert!(point.distance(seen_at(&camera, [0.7, -0.3], camera.distance())) < 1e-9, "{camera:?}");
            assert!((visible_height(&camera) - 0.25 * visible_height(&before)).abs() < 1e-9);
            assert_eq!(camera.basis(), before.basis());
        }
    }

    #[test]
    fn projections_there_and_back_show_the_same() {
        let camera = Camera::default();
        let flat = Camera { projection: other_projection(&camera), ..camera };
        let back = Camera { projection: other_projection(&flat), ..flat };
        assert!((visible_height(&camera) - visible_height(&flat)).abs() < 1e-9);
        let Projection::Perspective { fov_degrees } = back.projection else { panic!("not perspective") };
        assert!((fov_degrees - 30.0).abs() < 1e-9);
    }
}
