//! The usual sides to look from.

use rayloom_network::Camera;

/// A usual view. World axes are right, anterior, superior.
pub struct View {
    /// What it is called.
    pub name: &'static str,
    /// From the focus to the eye.
    pub towards: [f64; 3],
    /// What is up in the picture.
    pub up: [f64; 3],
}

const fn view(name: &'static str, towards: [f64; 3], up: [f64; 3]) -> View {
    View { name, towards, up }
}

/// The six sides of a box.
pub const VIEWS: [View; 6] = [
    view("Front", [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
    view("Back", [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]),
    view("Left", [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    view("Right", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    view("Top", [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
    view("Bottom", [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
];

impl View {
    /// The camera with the same focus and distance, seen from this side.
    pub fn of(&self, camera: &Camera) -> Camera {
        let distance = camera.distance();
        let position = std::array::from_fn(|axis| camera.focus[axis] + distance * self.towards[axis]);
        Camera { position, up: self.up, ..*camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_view_is_valid_and_keeps_focus_and_distance() {
        let camera = Camera { focus: [1.0, 2.0, 3.0], ..Camera::default() };
        for view in VIEWS {
            let seen = view.of(&camera);
            assert_eq!(seen.validate(), Ok(()), "{}", view.name);
            assert_eq!(seen.focus, camera.focus);
            assert!((seen.distance() - camera.distance()).abs() < 1e-9);
        }
    }
}
