//! Views from everywhere of boxes of every shape: a homogeneous medium has the opacity `1 - exp(-sigma L)`, where `L` is the
//! length of each pixel's ray within the box, computed in float64.

use glam::DVec3;
use rayloom_reference::Camera;
use rayloom_reference::closed_forms::homogeneous_opacity;
use rayloom_reference::ray::{AxisBox, Segment};
use rayloom_tests::rays::{chords, homogeneous};
use rayloom_tests::{Workbench, tolerances::*};
use serde_json::json;

const SIZE: [u32; 2] = [64, 48];

/// A homogeneous box around the origin of optical depth 1 along its mean edge.
struct Medium {
    bench: Workbench,
    extent: DVec3,
    sigma: f64,
}

impl Medium {
    fn new(dims: [u32; 3], extent: DVec3) -> Self {
        let properties = json!({"field": "constant", "dims": dims, "extent": extent.to_array()});
        let mut bench = Workbench::of_generator(&properties);
        let edge = (extent.x.cbrt() * extent.y.cbrt() * extent.z.cbrt()).abs();
        // Opacities are those of one mean edge.
        bench.put("traversal.reference_length", json!(edge)).classify(&homogeneous(1.0, [0.3, 0.6, 0.9]));
        Self { bench, extent, sigma: 1.0 / edge }
    }

    /// Holds a picture to the closed form; at least this share of its pixels must meet the box.
    fn judge(&mut self, name: &str, camera: &Camera, coverage: f64) {
        let volume = self.bench.volume();
        let picture = self.bench.look(camera).render(SIZE);
        let chords = chords(camera, SIZE, &volume, &AxisBox::UNIT);
        let (mut met, mut worst, mut outlines) = (0, 0.0_f64, 0);
        for (index, (chord, pixel)) in chords.iter().zip(&picture.color).enumerate() {
            let length = chord.as_ref().map_or(0.0, |chord| chord.length);
            let (exact, found) = (homogeneous_opacity(self.sigma, length), f64::from(pixel[3]));
            met += usize::from(exact > 0.0);
            assert!(pixel.iter().all(|c| c.is_finite()), "{name}, pixel {index}: {pixel:?}");
            assert!((f64::from(pixel[0]) - 0.3 * found).abs() <= ONE_COLOR, "{name}, pixel {index}: {pixel:?}");
            let error = (found - exact).abs();
            let allowed = VIEW_OPACITY + self.slope(chord.as_ref().map(|c| c.segment.exit - c.segment.entry), length);
            if error <= allowed {
                worst = worst.max(error);
            } else {
                let around = self.around(camera, index as u32);
                assert!(
                    around.contains(&found),
                    "{name}, pixel {index}: {found} for {exact} (length {length:e}, around {around:?})"
                );
                outlines += 1;
            }
        }
        let share = f64::from(met as u32) / chords.len() as f64;
        println!(
            "{name}: largest error {worst:.2e}, {:.0} % of the pixels meet the box, {outlines} on its outline",
            100.0 * share
        );
        assert!(share >= coverage, "{name}: only {share} of the pixels meet the box");
        assert!(
            f64::from(outlines) <= OUTLINE * chords.len() as f64,
            "{name}: {outlines} pixels are wrong on the outline"
        );
    }

    /// The opacities about the centre of a pixel on the outline, where the rasteriser's grid of 1/256 pixel decides; one value
    /// for other pixels.
    fn around(&mut self, camera: &Camera, index: u32) -> std::ops::RangeInclusive<f64> {
        // A picture 255 times as fine has the same ray at the centre of each pixel, and its neighbours 1/255 beside.
        let view = camera.view(SIZE.map(|pixels| pixels * 255)).expect("a camera that has been used");
        let to_texture = self.bench.volume().texture_to_world().inverse();
        let [x, y] = [index % SIZE[0], index / SIZE[0]].map(|pixel| pixel * 255 + 127);
        let opacity = |(dx, dy): (u32, u32)| {
            let ray = view.ray(x + dx - 1, y + dy - 1);
            let length = |s: Segment| (s.to - s.from) * ray.direction.length();
            AxisBox::UNIT.clip(&ray.transformed(&to_texture)).map(|s| homogeneous_opacity(self.sigma, length(s)))
        };
        let all: Vec<_> = (0..9).map(|n| opacity((n % 3, n / 3))).collect();
        let center = all[4].unwrap_or(0.0);
        if all.iter().all(Option::is_some) {
            return center..=center;
        }
        all.iter().map(|o| o.unwrap_or(0.0)).fold(center..=center, |range, o| range.start().min(o)..=range.end().max(o))
    }

    /// What a rounding of [`CHORD`] of the box at the ends of a chord can change in the opacity.
    fn slope(&self, span: Option<DVec3>, length: f64) -> f64 {
        let Some(span) = span else { return 0.0 };
        let edges = self.extent.abs() * CHORD;
        // A world length's change along each axis, by the direction of the chord.
        let along = (span * self.extent).abs() / length.max(f64::MIN_POSITIVE);
        self.sigma * (-self.sigma * length).exp() * along.dot(edges)
    }
}

/// A camera with +z up.
fn upright(camera: Camera) -> Camera {
    Camera { up: DVec3::Z, ..camera }
}

#[test]
fn an_eye_on_the_box_or_inside() {
    let extent = DVec3::new(2.0, 3.0, 1.5);
    let mut medium = Medium::new([20, 30, 15], extent);
    let half = 0.5 * extent;
    for (name, eye) in [
        ("on a face", DVec3::new(half.x, 0.3, -0.2)),
        ("on an edge", DVec3::new(half.x, -half.y, 0.11)),
        ("on a corner", half),
        ("on the far corner", -half),
        ("inside", DVec3::new(0.3, -0.4, 0.2)),
        ("at the centre", DVec3::ZERO),
    ] {
        let inwards = if eye == DVec3::ZERO { DVec3::new(0.1, 0.2, 0.05) } else { -0.3 * eye };
        medium.judge(&format!("{name}, looking in"), &upright(Camera::perspective(eye, inwards, 70.0)), 0.6);
        // Along the face or the edge, half of the view or a quarter of it lies within.
        let along = eye + DVec3::new(0.0, if eye.y > 0.0 { -1.0 } else { 1.0 }, 0.0);
        medium.judge(&format!("{name}, looking along"), &upright(Camera::perspective(eye, along, 60.0)), 0.2);
    }
    let out = upright(Camera::perspective(half, 2.0 * half, 40.0));
    let picture = medium.bench.look(&out).render(SIZE);
    assert!(picture.color.iter().flatten().all(|c| *c == 0.0), "an eye on a corner looks away and sees something");
}

#[test]
fn a_near_plane_within_the_box() {
    let mut medium = Medium::new([16, 16, 16], DVec3::splat(2.0));
    for near in [0.0, 0.5, 1.7, 3.0, 4.1] {
        let camera = upright(Camera::perspective(DVec3::new(-3.0, 0.4, 0.5), DVec3::ZERO, 40.0));
        medium.judge(&format!("near {near}"), &Camera { near: Some(near), ..camera }, 0.1);
        let camera = upright(Camera::orthographic(DVec3::new(-3.0, 0.4, 0.5), DVec3::ZERO, 2.5));
        medium.judge(&format!("parallel, near {near}"), &Camera { near: Some(near), ..camera }, 0.1);
    }
}

#[test]
fn an_eye_far_away() {
    let mut medium = Medium::new([16, 16, 16], DVec3::splat(1.0));
    for distance in [1e2_f64, 1e4, 1e6, 1e9] {
        let eye = DVec3::new(0.6, -0.7, 0.39).normalize() * distance;
        let fov = 2.0 * (0.9 / distance).atan().to_degrees();
        medium.judge(&format!("{distance:e} extents away"), &upright(Camera::perspective(eye, DVec3::ZERO, fov)), 0.25);
        let parallel = upright(Camera::orthographic(eye, DVec3::ZERO, 1.8));
        medium.judge(&format!("{distance:e} extents away, parallel"), &parallel, 0.25);
    }
}

#[test]
fn parallel_rays() {
    let mut medium = Medium::new([16, 20, 12], DVec3::new(1.6, 2.0, 1.2));
    for (name, eye, up) in [
        ("along x", DVec3::X, DVec3::Z),
        ("along -y", -DVec3::Y, DVec3::Z),
        ("along z", DVec3::Z, DVec3::Y),
        ("askew", DVec3::new(0.4, -0.9, 0.3), DVec3::Z),
    ] {
        let camera = Camera { up, ..Camera::orthographic(5.0 * eye, DVec3::ZERO, 2.3) };
        medium.judge(name, &camera, 0.2);
        // The eye of a parallel view only says where the picture is centred.
        let inside = Camera { eye: 0.1 * eye, ..camera };
        medium.judge(&format!("{name} from inside"), &inside, 0.2);
    }
}

/// Rays in a face of the box show the whole chord or nothing, and nothing else.
#[test]
fn rays_that_run_within_a_face() {
    let mut medium = Medium::new([8, 8, 8], DVec3::splat(1.0));
    // 8 rows of an eighth: the first and the last run exactly along the edges of a picture 9 rows high.
    let camera = upright(Camera::orthographic(DVec3::X * 3.0, DVec3::ZERO, 9.0 / 8.0));
    let picture = medium.bench.look(&camera).render([9, 9]);
    let whole = homogeneous_opacity(1.0, 1.0);
    for (index, pixel) in picture.color.iter().enumerate() {
        let (x, y) = (index % 9, index / 9);
        let alpha = f64::from(pixel[3]);
        let full = (alpha - whole).abs() <= VIEW_OPACITY;
        let edge = x == 0 || x == 8 || y == 0 || y == 8;
        assert!(full || edge && alpha == 0.0, "({x}, {y}): {pixel:?}");
    }
}

/// E7: along and beside the axes from eyes on planes, edges and corners of the box, inside and outside: directions have one or
/// two components that are exactly 0.
#[test]
fn axes_and_diagonals_from_planes_of_the_box() {
    let mut medium = Medium::new([8, 8, 8], DVec3::splat(2.0));
    let axes = |n: i32| DVec3::new(f64::from(n % 3 - 1), f64::from(n / 3 % 3 - 1), f64::from(n / 9 - 1));
    for toward in (0..27).map(axes).filter(|direction| *direction != DVec3::ZERO) {
        let up = if toward.x == 0.0 && toward.y == 0.0 { DVec3::X } else { DVec3::Z };
        for (place, coverage) in [(0.0, 0.5), (-1.0, 0.2), (-3.0, 0.02)] {
            let eye = place * toward;
            let perspective = Camera { up, ..Camera::perspective(eye, eye + toward, 50.0) };
            medium.judge(&format!("from {place} along {toward}"), &perspective, coverage);
            let parallel = Camera { up, ..Camera::orthographic(eye, eye + toward, 1.99) };
            medium.judge(&format!("parallel from {place} along {toward}"), &parallel, coverage);
        }
    }
}

/// E9: turned by ten-thousandths of a degree, rays begin to graze a face; none of them drops out.
#[test]
fn grazing_rays() {
    let mut medium = Medium::new([8, 8, 8], DVec3::splat(2.0));
    for step in -10..=10 {
        let angle = (1e-4 * f64::from(step)).to_radians();
        let direction = DVec3::new(angle.cos(), angle.sin(), 0.0);
        let camera = upright(Camera::orthographic(-4.0 * direction, DVec3::ZERO, 2.4));
        medium.judge(&format!("parallel, turned by {step}e-4 degrees"), &camera, 0.5);
        let beside =
            upright(Camera::perspective(DVec3::new(-3.0, 1.0, 0.2), DVec3::new(-3.0, 1.0, 0.2) + direction, 50.0));
        medium.judge(&format!("in the plane of a face, turned by {step}e-4 degrees"), &beside, 0.05);
    }
}

#[test]
fn boxes_of_every_shape_and_scale() {
    // Eye and focus in extents: needles are looked at from beside one place of them.
    let around = [DVec3::new(1.1, -1.3, 0.9), DVec3::ZERO];
    let beside_z = [DVec3::new(2.5, -3.0, 0.4), DVec3::new(0.0, 0.0, 0.3985)];
    let beside_x = [DVec3::new(0.4, -3.0, 2.5), DVec3::new(0.3985, 0.0, 0.0)];
    let beside_y = [DVec3::new(6.0, 0.3, -1.5), DVec3::new(0.0, 0.27, 0.0)];
    let above = [DVec3::new(0.6, -0.7, 90.0), DVec3::ZERO];
    for (name, dims, extent, [eye, focus]) in [
        ("spacing 1:1:1000", [32, 32, 32], DVec3::new(32.0, 32.0, 32_000.0), beside_z),
        ("spacing 1000:1:1", [32, 32, 32], DVec3::new(32_000.0, 32.0, 32.0), beside_x),
        ("1x1x1", [1, 1, 1], DVec3::splat(1.0), around),
        ("256x256x1", [256, 256, 1], DVec3::new(256.0, 256.0, 1.0), above),
        ("1x200x3", [1, 200, 3], DVec3::new(1.0, 200.0, 3.0), beside_y),
        ("extent 1e-9", [16, 16, 16], DVec3::new(1e-9, 1.5e-9, 0.7e-9), around),
        ("extent 1e9", [16, 16, 16], DVec3::new(1e9, 0.7e9, 1.5e9), around),
        ("mirrored", [16, 16, 16], DVec3::new(-1.0, 1.2, 0.9), around),
    ] {
        let mut medium = Medium::new(dims, extent);
        let size = extent.abs();
        let [eye, focus] = [eye * size, focus * size];
        medium.judge(&format!("{name}, outside"), &upright(Camera::perspective(eye, focus, 40.0)), 0.1);
        let parallel = upright(Camera::orthographic(eye, focus, 0.7 * eye.distance(focus)));
        medium.judge(&format!("{name}, parallel"), &parallel, 0.1);
        // From above a needle along y would fall between two columns of pixels.
        if size.x > 0.1 * size.y {
            let above = Camera::orthographic(DVec3::Z * 2.0 * size.z, DVec3::ZERO, 1.1 * size.y);
            medium.judge(&format!("{name}, along z"), &above, 0.4);
        }
        let within = upright(Camera::perspective(0.2 * size, -0.3 * size, 60.0));
        medium.judge(&format!("{name}, inside"), &within, 0.9);
    }
}
