//! The camera in the user's hand.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use egui::{Key, PointerButton, Pos2, Rect};
use glam::DVec3;
use rayloom_network::{Camera, Projection, Value};
use rayloom_processors::{Data, Image};

use crate::inspect::Pixel;
use crate::session::{Session, Severity};

/// Radians that the camera turns while the pointer crosses the picture.
const TURN: f64 = PI;
/// Radians that an arrow key turns, and that a key rolls.
const STEP: f64 = PI / 12.0;

/// A camera and what it waits for.
#[derive(Default)]
pub(super) struct Held {
    /// The pixel whose surface is to be the centre, once its depth is known.
    centring: Option<(Arc<Pixel>, Camera)>,
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

        let mut camera = before;
        session.interacting |= response.dragged();
        drag(ui, response, shown, &mut camera);
        if response.hovered() && !ui.ctx().text_edit_focused() {
            keys(ui, session, image, &mut camera);
        }
        if response.double_clicked()
            && let Some(pixel) = response.hover_pos().and_then(|pointer| pixel_at(shown, image, pointer))
        {
            self.centring = Some((Arc::new(pixel), before));
        }
        if let Some(centred) = self.centred(ui, session, canvas) {
            camera = centred;
        }
        if camera != before && camera.validate().is_ok() {
            session.interacting = true;
            session.set(processor, property, Value::Camera(camera));
        }
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
    let [right, up, forward] = camera.basis();
    let height = match camera.projection {
        Projection::Perspective { fov_degrees } => depth * (0.5 * fov_degrees.to_radians()).tan(),
        Projection::Orthographic { height } => 0.5 * height,
    };
    let [width_pixels, height_pixels] = size.map(f64::from);
    let x = (f64::from(at[0]) + 0.5 - 0.5 * width_pixels) / (0.5 * height_pixels);
    let y = (0.5 * height_pixels - f64::from(at[1]) - 0.5) / (0.5 * height_pixels);
    let surface = DVec3::from(camera.position) + forward * depth + right * (x * height) + up * (y * height);
    let shift = surface - DVec3::from(camera.focus);
    Camera { position: (DVec3::from(camera.position) + shift).into(), focus: surface.into(), ..*camera }
}

/// The left button turns, the middle one or Shift moves, the wheel and the right one zoom.
fn drag(ui: &egui::Ui, response: &egui::Response, shown: Rect, camera: &mut Camera) {
    let drag = response.drag_delta() / shown.height().max(1.0);
    let (x, y) = (f64::from(drag.x), f64::from(drag.y));
    let (shift, scroll) = ui.input(|input| (input.modifiers.shift, input.smooth_scroll_delta.y));
    let height = visible_height(camera);
    if response.dragged_by(PointerButton::Middle) || (response.dragged_by(PointerButton::Primary) && shift) {
        camera.pan(-x * height, y * height);
    } else if response.dragged_by(PointerButton::Primary) {
        camera.orbit(-x * TURN, y * TURN);
    } else if response.dragged_by(PointerButton::Secondary) {
        camera.zoom((2.0 * y).exp());
    }
    if response.hovered() && scroll != 0.0 {
        camera.zoom(f64::from(-scroll * 0.003).exp());
    }
}

/// What the keys do; see the list under F1.
fn keys(ui: &egui::Ui, session: &Session, image: &Image, camera: &mut Camera) {
    let pressed = |key| ui.input(|input| input.modifiers.is_none() && input.key_pressed(key));
    if pressed(Key::O) {
        camera.projection = other_projection(camera);
    }
    if (pressed(Key::A) || pressed(Key::Home))
        && let Some((center, radius)) = bounds(session, image)
    {
        *camera = camera.framing(center.into(), radius);
    }
    let turns = [
        (Key::ArrowLeft, [-STEP, 0.0]),
        (Key::ArrowRight, [STEP, 0.0]),
        (Key::ArrowUp, [0.0, STEP]),
        (Key::ArrowDown, [0.0, -STEP]),
    ];
    for (_, [yaw, pitch]) in turns.into_iter().filter(|(key, _)| pressed(*key)) {
        camera.orbit(yaw, pitch);
    }
    for (_, angle) in [(Key::Q, -STEP), (Key::E, STEP)].into_iter().filter(|(key, _)| pressed(*key)) {
        let [_, up, forward] = camera.basis();
        camera.up = (glam::DQuat::from_axis_angle(forward, angle) * up).into();
    }
    let sides =
        [(Key::Num1, DVec3::Y, DVec3::Z), (Key::Num3, DVec3::NEG_X, DVec3::Z), (Key::Num7, DVec3::NEG_Z, DVec3::Y)];
    for (_, forward, up) in sides.into_iter().filter(|(key, ..)| pressed(*key)) {
        camera.position = (DVec3::from(camera.focus) - forward * camera.distance()).into();
        camera.up = up.into();
    }
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
    fn projections_there_and_back_show_the_same() {
        let camera = Camera::default();
        let flat = Camera { projection: other_projection(&camera), ..camera };
        let back = Camera { projection: other_projection(&flat), ..flat };
        assert!((visible_height(&camera) - visible_height(&flat)).abs() < 1e-9);
        let Projection::Perspective { fov_degrees } = back.projection else { panic!("not perspective") };
        assert!((fov_degrees - 30.0).abs() < 1e-9);
    }
}
