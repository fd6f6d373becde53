//! Where rays meet planes and spheres.

use glam::DVec3;

/// T12: parameter `t` at which `origin + t direction` reaches the plane `normal · x = offset`; `None` when parallel.
pub fn plane_hit(origin: DVec3, direction: DVec3, normal: DVec3, offset: f64) -> Option<f64> {
    let speed = normal.dot(direction);
    (speed != 0.0).then(|| (offset - normal.dot(origin)) / speed)
}

/// T13: smaller parameter `t` at which the line `origin + t direction` meets a sphere; `None` when it passes by.
///
/// `t` is negative when the sphere, or its first wall, lies behind the origin. For a unit direction this is `D - √(R² - b²)`.
pub fn sphere_hit(origin: DVec3, direction: DVec3, center: DVec3, radius: f64) -> Option<f64> {
    let squared_speed = direction.length_squared();
    let closest = (center - origin).dot(direction) / squared_speed;
    // The impact vector is formed first: the textbook discriminant cancels for far origins.
    let impact = (origin + closest * direction - center).length();
    let half_chord_squared = (radius - impact) * (radius + impact);
    (half_chord_squared >= 0.0).then(|| closest - (half_chord_squared / squared_speed).sqrt())
}

/// T13: outward unit normal of a sphere around `center` at the point `position`, which must not be the centre.
pub fn sphere_normal(position: DVec3, center: DVec3) -> DVec3 {
    (position - center).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane() {
        let t = plane_hit(DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0), DVec3::new(0.0, 0.6, 0.8), 4.0);
        assert_eq!(t, Some(2.5));
        assert_eq!(plane_hit(DVec3::ZERO, DVec3::X, DVec3::Z, 1.0), None);
    }

    #[test]
    fn sphere() {
        // D = 10, R = 5, b = 3: t = 10 - 4.
        let origin = DVec3::new(3.0, 0.0, -10.0);
        assert_eq!(sphere_hit(origin, DVec3::Z, DVec3::ZERO, 5.0), Some(6.0));
        assert_eq!(sphere_hit(origin, DVec3::Z * 2.0, DVec3::ZERO, 5.0), Some(3.0));
        assert_eq!(sphere_hit(origin, DVec3::Z, DVec3::ZERO, 2.9), None);
        let far = sphere_hit(DVec3::new(3.0, 0.0, -1e7), DVec3::Z, DVec3::ZERO, 5.0);
        assert!((far.unwrap_or(f64::NAN) - (1e7 - 4.0)).abs() < 1e-8);
        assert_eq!(sphere_normal(DVec3::new(1.0, 2.0, 5.0), DVec3::new(1.0, 2.0, 3.0)), DVec3::Z);
    }
}
