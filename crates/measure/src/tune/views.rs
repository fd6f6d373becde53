//! An endless row of views all around a scene.

use glam::DVec3;
use rayloom_network::Camera;

/// Steps of height and turn: multiples of the golden ratio and of the root of two fill their ranges evenly however many there
/// are.
const STEPS: [f64; 2] = [0.618_033_988_749_895, std::f64::consts::SQRT_2 - 1.0];
/// Distances from the focus, shares of the saved one: what fills the picture errs otherwise than what is far away.
const DISTANCES: [f64; 3] = [1.0, 0.75, 1.2];

/// View 0 is the saved one; the others look at its focus from directions spread over the whole sphere.
pub(super) fn view(saved: &Camera, index: usize) -> Camera {
    if index == 0 {
        return *saved;
    }
    let at = |step: f64| (0.5 + step * index as f64).fract();
    let (z, turn) = (2.0 * at(STEPS[0]) - 1.0, std::f64::consts::TAU * at(STEPS[1]));
    let flat = (1.0 - z * z).max(0.0).sqrt();
    let direction = DVec3::new(flat * turn.cos(), flat * turn.sin(), z);
    let upright = DVec3::from(saved.up).normalize_or_zero();
    let up = if upright.dot(direction).abs() < 0.95 { upright } else { direction.any_orthonormal_vector() };
    let position = DVec3::from(saved.focus) + saved.distance() * direction;
    let mut camera = Camera { position: position.into(), up: up.into(), ..*saved };
    camera.zoom(DISTANCES[index % DISTANCES.len()]);
    camera
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_are_sound_and_lie_all_around() {
        let saved = Camera::default();
        let directions: Vec<DVec3> = (1..25)
            .map(|index| {
                let camera = view(&saved, index);
                assert_eq!(camera.validate(), Ok(()));
                assert!((0.7..1.3).contains(&(camera.distance() / saved.distance())));
                (DVec3::from(camera.position) - DVec3::from(camera.focus)).normalize()
            })
            .collect();
        assert_eq!(view(&saved, 0), saved);
        for axis in [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z] {
            assert!(directions.iter().any(|direction| direction.dot(axis) > 0.8), "none from {axis}");
        }
    }
}
