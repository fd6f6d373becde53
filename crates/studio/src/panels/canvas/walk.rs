//! Walking: the eye goes where the keys say and looks where the pointer does.

use egui::Key;
use glam::{DQuat, DVec3};
use rayloom_network::{Camera, Projection};

/// Radians that the view turns while the pointer crosses the height of the picture.
const LOOK: f64 = 1.5;
/// The view comes no nearer than this to straight up and down, radians.
const POLE: f64 = 0.05;
/// Parts of the size of the scene walked in a second, and how much faster with Shift.
const SPEED: f64 = 0.35;
const RUN: f64 = 4.0;
/// Longest time that one frame counts for, seconds.
const LONGEST_FRAME: f64 = 0.1;

/// Keys and the directions that they walk in: right, up, forward.
const KEYS: [(Key, [f64; 3]); 6] = [
    (Key::W, [0.0, 0.0, 1.0]),
    (Key::S, [0.0, 0.0, -1.0]),
    (Key::A, [-1.0, 0.0, 0.0]),
    (Key::D, [1.0, 0.0, 0.0]),
    (Key::E, [0.0, 1.0, 0.0]),
    (Key::Q, [0.0, -1.0, 0.0]),
];

/// Someone who walks through the scene.
pub(super) struct Walker {
    /// What is up for them, world coordinates.
    vertical: DVec3,
}

impl Walker {
    /// Starts from where the camera is.
    pub(super) fn start(camera: &Camera) -> Self {
        Self { vertical: camera.basis()[1] }
    }

    /// Moves the camera by the keys that are held. `size`: of the scene, world units.
    pub(super) fn step(&self, ui: &egui::Ui, size: f64, camera: &mut Camera) {
        let (held, shift, time) = ui.input(|input| {
            let held = KEYS.iter().filter(|(key, _)| input.key_down(*key)).map(|(_, way)| DVec3::from(*way));
            (held.sum::<DVec3>(), input.modifiers.shift, f64::from(input.stable_dt).min(LONGEST_FRAME))
        });
        if held == DVec3::ZERO {
            return;
        }
        ui.ctx().request_repaint();
        let parts = SPEED * time * if shift { RUN } else { 1.0 };
        walk(camera, held * parts, size);
    }

    /// Turns the view around the eye; parts of the height of the picture to the right and down.
    pub(super) fn look(&self, [right, down]: [f64; 2], camera: &mut Camera) {
        let [sideways, _, forward] = camera.basis();
        let elevation = forward.dot(self.vertical).clamp(-1.0, 1.0).asin();
        let most = std::f64::consts::FRAC_PI_2 - POLE;
        let pitch = (elevation - down * LOOK).clamp(-most, most) - elevation;
        let turn = DQuat::from_axis_angle(self.vertical, -right * LOOK) * DQuat::from_axis_angle(sideways, pitch);
        let eye = DVec3::from(camera.position);
        camera.focus = (eye + turn * forward * camera.distance()).into();
        camera.up = self.vertical.into();
    }
}

/// Moves eye and focus by parts of the size of the scene, to the right, up and forward. Parallel rays look the same from
/// farther ahead, so there the picture gets larger instead.
fn walk(camera: &mut Camera, way: DVec3, size: f64) {
    let [right, up, forward] = camera.basis();
    let mut shift = (right * way.x + up * way.y) * size;
    match &mut camera.projection {
        Projection::Perspective { .. } => shift += forward * way.z * size,
        Projection::Orthographic { height } => *height *= (-2.0 * way.z).exp(),
    }
    camera.position = (DVec3::from(camera.position) + shift).into();
    camera.focus = (DVec3::from(camera.focus) + shift).into();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walking_keeps_the_direction_and_looking_keeps_the_place() {
        let before = Camera::default();
        let mut camera = before;
        walk(&mut camera, DVec3::new(0.0, 0.0, 0.5), 100.0);
        assert_eq!(camera.position, [0.0, -350.0, 0.0]);
        assert_eq!(camera.basis(), before.basis());
        let walker = Walker::start(&camera);
        for _ in 0..50 {
            walker.look([0.1, 0.3], &mut camera);
            assert_eq!(camera.validate(), Ok(()));
        }
        assert_eq!(camera.position, [0.0, -350.0, 0.0]);
        assert!((camera.distance() - before.distance()).abs() < 1e-9);
        assert!(camera.basis()[2].z < -0.99, "it looks down");
        assert!(camera.basis()[1].dot(DVec3::Z) > 0.0, "but not over its back");
    }
}
