//! How an image sees the box of a volume: rays, projection and depth, built in f64 and handed to shaders in f32.

use glam::{DAffine3, DMat4, DVec3, DVec4};
use rayloom_network::{Camera, ProcessError, Projection};

/// Nearest depth that a perspective projection can hold, as a share of the scene's. Rays do not depend on it: they start at
/// the eye if that is inside.
const NEAREST: f64 = 1e-6;

/// Whether two mappings of volume coordinates to the world are of the same box, but for rounding in files.
pub fn same_box(a: &DAffine3, b: &DAffine3) -> bool {
    const SAME: f64 = 1e-4;
    let scale = a.matrix3.to_cols_array().iter().fold(f64::MIN_POSITIVE, |largest, x| largest.max(x.abs()));
    a.to_cols_array().into_iter().zip(b.to_cols_array()).all(|(a, b)| (a - b).abs() <= SAME * scale)
}

/// A camera, an image size and a volume box seen together.
///
/// Rays are not derived from a depth range: planes just before and behind the box are fitted in f64, and a pixel's ray
/// runs from its point on the first to its point on the second. Both points are affine in the pixel for perspective and
/// orthographic cameras alike, so nothing cancels however far away the eye is.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The camera, world coordinates.
    pub camera: Camera,
    /// Width and height of the image in pixels.
    pub size: [u32; 2],
    /// Volume coordinates (0 ..= 1 in the box) to world coordinates.
    pub texture_to_world: DAffine3,
    /// View depth of the near and far planes, world units.
    near: f64,
    far: f64,
}

/// The rays of a view as a shader needs them: ray of the normalised device point (x, y), x right and y up in -1 ..= 1, runs
/// from `start + x start_x + y start_y` to `end + x end_x + y end_y`, in volume coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayPlanes {
    /// Centre of the near plane and its half axes to the right and up.
    pub near: [DVec3; 3],
    /// Centre of the far plane and its half axes to the right and up.
    pub far: [DVec3; 3],
}

impl View {
    /// A view of the unit box of a volume's coordinates.
    ///
    /// # Errors
    /// A camera that cannot form an image, with the reason; an image without pixels.
    pub fn new(camera: &Camera, size: [u32; 2], texture_to_world: DAffine3) -> Result<Self, ProcessError> {
        camera.validate().map_err(|error| ProcessError::new(error.to_string()))?;
        if size.contains(&0) {
            return Err(ProcessError::new(format!(
                "an image of {} x {} pixels was asked for; give it pixels",
                size[0], size[1]
            )));
        }
        let mut view = Self { camera: *camera, size, texture_to_world, near: 0.0, far: 1.0 };
        (view.near, view.far) = view.fitted_planes();
        Ok(view)
    }

    /// Planes that enclose the box with some air, but start no earlier than the camera allows.
    fn fitted_planes(&self) -> (f64, f64) {
        let depths: Vec<f64> = (0..8)
            .map(|corner| {
                self.depth(DVec3::new(f64::from(corner & 1), f64::from(corner >> 1 & 1), f64::from(corner >> 2 & 1)))
            })
            .collect();
        let (low, high) =
            depths.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &z| (low.min(z), high.max(z)));
        let extent = (high - low).max(f64::MIN_POSITIVE);
        let air = 1e-2 * extent;
        let first = match (self.camera.projection, self.camera.near) {
            (Projection::Perspective { .. }, near) => near.unwrap_or(0.0),
            (Projection::Orthographic { .. }, Some(near)) => near,
            (Projection::Orthographic { .. }, None) => f64::NEG_INFINITY,
        };
        let near = first.max(low - air);
        (near, (high + air).max(near + extent))
    }

    /// View depth of the planes on which rays begin and end, world units.
    pub fn depths(&self) -> [f64; 2] {
        [self.near, self.far]
    }

    /// View depth of a point in volume coordinates: its distance from the eye along the viewing direction, world units.
    pub fn depth(&self, p: DVec3) -> f64 {
        let [_, _, forward] = self.camera.basis();
        (self.texture_to_world.transform_point3(p) - DVec3::from(self.camera.position)).dot(forward)
    }

    /// The affine function that [`View::depth`] is: `dot(xyz, p) + w`.
    pub fn depth_plane(&self) -> DVec4 {
        let [_, _, forward] = self.camera.basis();
        let slope = self.texture_to_world.matrix3.transpose() * forward;
        slope.extend(self.depth(DVec3::ZERO))
    }

    /// Half width and half height of the picture at a view depth, world units.
    fn half_size(&self, depth: f64) -> [f64; 2] {
        let aspect = f64::from(self.size[0]) / f64::from(self.size[1]);
        let height = match self.camera.projection {
            Projection::Perspective { fov_degrees } => depth * (0.5 * fov_degrees.to_radians()).tan(),
            Projection::Orthographic { height } => 0.5 * height,
        };
        [height * aspect, height]
    }

    /// The rays in volume coordinates.
    pub fn ray_planes(&self) -> RayPlanes {
        let world_to_texture = self.texture_to_world.inverse();
        let [right, up, forward] = self.camera.basis();
        let plane = |depth: f64| {
            let [x, y] = self.half_size(depth);
            let center = DVec3::from(self.camera.position) + forward * depth;
            [
                world_to_texture.transform_point3(center),
                world_to_texture.transform_vector3(right * x),
                world_to_texture.transform_vector3(up * y),
            ]
        };
        RayPlanes { near: plane(self.near), far: plane(self.far) }
    }

    /// Volume coordinates to clip coordinates, depth 1 on the near and 0 on the far plane.
    pub fn clip_matrix(&self) -> DMat4 {
        let [right, up, forward] = self.camera.basis();
        let eye = DVec3::from(self.camera.position);
        let [x, y] = self.half_size(1.0);
        // Clip coordinates are homogeneous: a common scale keeps tiny and huge scenes within f32.
        let scale = 1.0 / self.far.abs().max(self.near.abs());
        let row = |axis: DVec3| (axis * scale).extend(-axis.dot(eye) * scale);
        let near = match self.camera.projection {
            Projection::Perspective { .. } => self.near.max(NEAREST * (self.far - self.near)),
            Projection::Orthographic { .. } => self.near,
        };
        let range = self.far - near;
        let (depth, unit) = (row(forward), DVec4::new(0.0, 0.0, 0.0, scale));
        let rows = match self.camera.projection {
            Projection::Perspective { .. } => {
                [row(right) / x, row(up) / y, (unit * self.far - depth) * (near / range), depth]
            }
            Projection::Orthographic { .. } => [row(right) / x, row(up) / y, (unit * self.far - depth) / range, unit],
        };
        DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose() * DMat4::from(self.texture_to_world)
    }

    /// A direction in camera coordinates (x right, y up, z towards the viewer) as a world direction.
    pub fn camera_to_world(&self, direction: DVec3) -> DVec3 {
        let [right, up, forward] = self.camera.basis();
        right * direction.x + up * direction.y - forward * direction.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxed() -> DAffine3 {
        DAffine3::from_scale_rotation_translation(
            DVec3::new(2.0, -3.0, 5.0),
            glam::DQuat::from_rotation_z(0.3),
            DVec3::new(1.0, 2.0, 3.0),
        )
    }

    fn camera(projection: Projection) -> Camera {
        Camera { position: [20.0, -30.0, 9.0], focus: [1.0, 1.0, 4.0], projection, ..Camera::default() }
    }

    #[test]
    fn projection_rays_and_depth_agree() {
        for projection in [Projection::Perspective { fov_degrees: 25.0 }, Projection::Orthographic { height: 12.0 }] {
            let view = View::new(&camera(projection), [300, 200], boxed()).expect("valid");
            let planes = view.ray_planes();
            let clip = view.clip_matrix();
            for (x, y, t) in [(0.3, -0.7, 0.2), (-0.9, 0.1, 0.9), (0.0, 0.0, 0.5)] {
                let at = |plane: [DVec3; 3]| plane[0] + plane[1] * x + plane[2] * y;
                let p = at(planes.near).lerp(at(planes.far), t);
                let c = clip * p.extend(1.0);
                assert!((c.x / c.w - x).abs() < 1e-9 && (c.y / c.w - y).abs() < 1e-9, "{projection:?} {c}");
                assert!((0.0..=1.0).contains(&(c.z / c.w)));
                assert!((view.depth_plane().dot(p.extend(1.0)) - view.depth(p)).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn an_eye_far_away_keeps_the_planes_close_to_the_box() {
        let far = Camera {
            position: [0.0, -1e9, 0.0],
            projection: Projection::Perspective { fov_degrees: 1e-7 },
            ..Camera::default()
        };
        let view = View::new(&far, [64, 64], DAffine3::IDENTITY).expect("valid");
        for p in view.ray_planes().near.iter().chain(&view.ray_planes().far) {
            assert!(p.abs().max_element() < 2.0, "{p}");
        }
    }

    #[test]
    fn an_eye_inside_starts_its_rays_at_the_eye() {
        let inside = Camera { position: [0.5, 0.5, 0.5], focus: [0.5, 1.0, 0.5], ..Camera::default() };
        let view = View::new(&inside, [64, 64], DAffine3::IDENTITY).expect("valid");
        assert!(view.ray_planes().near[0].distance(DVec3::splat(0.5)) < 1e-15);
    }

    #[test]
    fn images_without_pixels_and_broken_cameras_are_refused() {
        assert!(View::new(&Camera::default(), [0, 5], DAffine3::IDENTITY).is_err());
        let broken = Camera { position: [0.0; 3], focus: [0.0; 3], ..Camera::default() };
        assert!(View::new(&broken, [5, 5], DAffine3::IDENTITY).is_err());
    }
}
