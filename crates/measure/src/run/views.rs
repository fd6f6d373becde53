//! Camera views of a measurement: one view shows little of what a user will see.

use rayloom_network::Camera;

/// Turn between one view and the next, radians: the golden angle spreads any number of views evenly.
const TURN: f64 = 2.399_963_229_728_653;

/// `count` views: the camera itself, then orbits around its focus, by turns from above and from below.
pub(crate) fn views(camera: &Camera, count: usize) -> Vec<Camera> {
    let orbit = |index: usize| {
        let mut camera = *camera;
        let pitch = if index.is_multiple_of(2) { -0.45 } else { 0.35 };
        camera.orbit(TURN * index as f64, if index == 0 { 0.0 } else { pitch });
        camera
    };
    (0..count.max(1)).map(orbit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_begin_with_the_saved_one_and_keep_their_distance() {
        let camera = Camera::default();
        let views = views(&camera, 5);
        assert_eq!(views[0].position, camera.position);
        for view in &views {
            assert_eq!(view.validate(), Ok(()));
            assert!((view.distance() - camera.distance()).abs() < 1e-9);
        }
        assert!(views[1].position != views[2].position);
    }
}
