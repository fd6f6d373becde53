//! The picture of the ray loop against the same samples taken in float64, by a renderer that shares no code with it.
//!
//! Where single pixels differ, the two disagree about a jump that rounding decides: whether a ray that grazes a surface meets
//! it (*silhouette*, *another crossing*), or to which side the normal of a surface that is seen edge-on is turned by two-sided
//! lighting (*same place*: without `two_sided` these vanish).

use std::path::PathBuf;

use glam::DVec3;
use rayloom_reference::field::Sampling;
use rayloom_reference::gradient::GradientOperator;
use rayloom_reference::shading::{Diffuse, Highlight, Shading};
use rayloom_reference::{Camera, Comparison, Image, MISS, Method, Refinement, Scene, same_samples};
use rayloom_tests::chain::step;
use rayloom_tests::{Picture, VolumeFile, Workbench, root, tolerances::*};
use rayloom_volume::{Knot, TransferFunction, Volume};
use serde_json::json;

const SIZE: [u32; 2] = [160, 160];
const SURFACE: [f64; 3] = [0.9, 0.7, 0.5];

/// What is shown of a volume.
struct Subject {
    name: &'static str,
    bench: Workbench,
    isovalue: f64,
    function: TransferFunction,
}

/// Everything but the volume and the camera.
#[derive(Clone, Copy)]
struct Look {
    name: &'static str,
    compositing: &'static str,
    method: fn(f64) -> Method,
    shading: &'static str,
    jitter: Option<u32>,
    sampling: (&'static str, Sampling),
    gradient: (&'static str, GradientOperator),
}

const fn look(name: &'static str, compositing: &'static str, method: fn(f64) -> Method, shading: &'static str) -> Look {
    let sampling = ("filtered", Sampling::Trilinear);
    Look {
        name,
        compositing,
        method,
        shading,
        jitter: None,
        sampling,
        gradient: ("central", GradientOperator::Central),
    }
}

const LOOKS: [Look; 5] = [
    look("dvr", "dvr", |_| Method::Dvr, "none"),
    look("mip", "mip", |_| Method::Mip, "none"),
    look("mean", "mean", |_| Method::Mean, "none"),
    look("isosurface", "isosurface", surface, "blinn_phong"),
    look("shaded dvr", "dvr", |_| Method::Dvr, "blinn_phong"),
];

fn surface(value: f64) -> Method {
    Method::Isosurface { value, refinement: Refinement::Bisection(8) }
}

/// A snippet with its parameters at their defaults.
fn shading(snippet: &str) -> Option<Shading> {
    let matt = |diffuse_term| Shading { diffuse_term, specular: 0.0, ..Shading::default() };
    let shiny = |specular, highlight| Shading { diffuse: 0.7, specular, highlight, ..Shading::default() };
    let blinn = Highlight::BlinnPhong { shininess: 32.0 };
    let of_snippet = match snippet {
        "none" => return None,
        "diffuse" => matt(Diffuse::Lambert),
        "oren_nayar" => matt(Diffuse::OrenNayar { roughness: 0.5 }),
        "toon" => matt(Diffuse::Toon { steps: 3 }),
        "specular" => Shading { diffuse: 0.0, ..shiny(0.8, blinn) },
        "blinn_phong" => shiny(0.3, blinn),
        "phong" => shiny(0.3, Highlight::Phong { shininess: 16.0 }),
        "cook_torrance" => shiny(0.6, Highlight::CookTorrance { roughness: 0.3, reflectance: 0.2 }),
        "ward" => shiny(0.3, Highlight::Ward { along: 0.2, across: 0.4 }),
        other => panic!("the reference has no shading {other}"),
    };
    Some(Shading { gradient_fade: 0.002, ..of_snippet })
}

fn function(knots: &[(f64, [f64; 3], f64)]) -> TransferFunction {
    let knots = knots.iter().map(|&(at, color, opacity)| Knot::new(at, color, opacity)).collect();
    TransferFunction::new(knots).expect("sorted knots")
}

/// A volume from above, from close below, from its inside, and in parallel projection.
fn views(volume: &Volume) -> [(&'static str, Camera); 4] {
    let to_world = volume.texture_to_world();
    let center = to_world.transform_point3(DVec3::splat(0.5));
    let diagonal = to_world.transform_vector3(DVec3::ONE).length();
    let from = |direction: DVec3, distance: f64| center + diagonal * distance * direction.normalize();
    let up = |camera: Camera| Camera { up: DVec3::Z, ..camera };
    let inside = to_world.transform_point3(DVec3::new(0.52, 0.57, 0.61));
    [
        ("above", up(Camera::perspective(from(DVec3::new(-0.6, 0.7, 0.45), 1.6), center, 32.0))),
        ("below", up(Camera::perspective(from(DVec3::new(0.83, -0.37, -0.5), 0.8), center, 55.0))),
        ("inside", up(Camera::perspective(inside, center + diagonal * DVec3::new(0.3, -0.4, 0.11), 75.0))),
        ("parallel", up(Camera::orthographic(from(DVec3::new(0.31, 0.9, -0.22), 1.0), center, 0.8 * diagonal))),
    ]
}

impl Subject {
    fn head() -> Self {
        let function = function(&[
            (30.0, [0.4, 0.2, 0.1], 0.0),
            (70.0, [0.8, 0.5, 0.4], 0.08),
            (110.0, [0.9, 0.8, 0.7], 0.2),
            (200.0, [1.0, 1.0, 0.9], 0.7),
        ]);
        Self { name: "ch2", bench: Workbench::of_file(&root().join("data/ch2.nii.gz")), isovalue: 45.5, function }
    }

    /// Kept with the file that describes the raw data, which must outlive the source.
    fn small_brain() -> (Self, VolumeFile) {
        let raw: PathBuf = root().join("data/brainsmall.den");
        let description =
            json!({"raw": raw, "dims": [128, 128, 84], "type": "u8", "offset": 62, "spacing": [1, 1, 1.5]});
        let file = VolumeFile::described(None, &description);
        let function =
            function(&[(25.0, [0.3, 0.3, 0.6], 0.0), (60.0, [0.8, 0.6, 0.4], 0.1), (140.0, [1.0, 0.9, 0.8], 0.5)]);
        (Self { name: "brainsmall", bench: Workbench::of_file(file.path()), isovalue: 50.5, function }, file)
    }

    fn ball() -> Self {
        let function =
            function(&[(0.1, [0.2, 0.4, 1.0], 0.0), (0.4, [0.9, 0.9, 0.2], 0.15), (0.9, [1.0, 0.3, 0.1], 0.6)]);
        let properties = json!({"field": "bucky_ball", "dims": [60, 44, 30], "extent": [60.0, 66.0, 75.0]});
        Self { name: "bucky ball", bench: Workbench::of_generator(&properties), isovalue: 0.35, function }
    }

    /// The same picture as a scene of the reference.
    fn scene<'a>(&self, look: Look, camera: Camera, volume: &'a Volume) -> Scene<'a> {
        let function = match look.compositing {
            "isosurface" => function(&[(0.0, SURFACE, 1.0)]),
            _ => self.function(look, volume),
        };
        Scene {
            method: (look.method)(self.isovalue),
            shading: shading(look.shading),
            jitter: look.jitter,
            sampling: look.sampling.1,
            gradient: look.gradient.1,
            step: step(&camera, SIZE, volume, 1.0),
            ..Scene::new(volume, function, camera, SIZE)
        }
    }

    /// Means of whole rays are small: all of the lower half of the range is shown.
    fn function(&self, look: Look, volume: &Volume) -> TransferFunction {
        let range = volume.ranges()[0];
        let knots = [(range.min, [0.2, 0.1, 0.4], 0.0), (range.denormalise(0.5), [1.0, 0.9, 0.6], 0.9)];
        if look.compositing == "mean" { function(&knots) } else { self.function.clone() }
    }

    fn render(&mut self, look: Look, camera: &Camera) -> Picture {
        let volume = self.bench.volume();
        let function = self.function(look, &volume);
        self.bench.look(camera).classify(&function);
        self.bench.put("traversal.sampling", json!(look.sampling.0));
        self.bench.put("traversal.gradient", json!(look.gradient.0));
        self.bench.put("traversal.shading", json!(look.shading));
        self.bench.put("traversal.compositing", json!(look.compositing));
        self.bench.put("traversal.jitter", json!(look.jitter.is_some()));
        self.bench.put("traversal.jitter_seed", json!(look.jitter.unwrap_or(0)));
        if look.compositing == "isosurface" {
            let [r, g, b] = SURFACE;
            self.bench.put("traversal.refinement", json!("bisection"));
            self.bench.put("traversal.compositing.isovalue", json!(self.isovalue));
            self.bench.put("traversal.compositing.color", json!([r, g, b, 1.0]));
        }
        self.bench.render(SIZE)
    }

    /// Holds a picture to that of the reference; the largest difference of a pixel.
    fn judge(&mut self, look: Look, (view, camera): &(&'static str, Camera)) -> f64 {
        let volume = self.bench.volume();
        let expected = same_samples::render(&self.scene(look, *camera, &volume)).expect("a scene that makes sense");
        let found = self.render(look, camera);
        let shown = expected.color.iter().filter(|pixel| pixel[3] > 0.05).count() as f64 / expected.color.len() as f64;
        assert!(shown > 0.1, "{} {} {view}: only {shown:.3} of the picture shows something", self.name, look.name);
        let comparison = Comparison::new(&found.color, &expected.color).expect("pictures of one size");
        let mean = comparison.channels.iter().map(|channel| channel.mean).fold(0.0, f64::max);
        let share = comparison.share_within(AGREEMENT_PIXEL);
        let case = format!("{} | {} | {} {} | {view}", self.name, look.name, look.sampling.0, look.gradient.0);
        println!(
            "{case} | mean {:.4}/255 max {:.3}/255 within 2/255 {:.4} % {}",
            mean * 255.0,
            comparison.pixels.max * 255.0,
            share * 100.0,
            rest(&comparison, &found, &expected)
        );
        assert!(mean <= AGREEMENT_MEAN, "{case}: the mean difference is {}/255", mean * 255.0);
        assert!(share >= AGREEMENT_SHARE, "{case}: only {share} of the pixels agree");
        comparison.pixels.max
    }
}

/// Where the pixels are that do not agree.
fn rest(comparison: &Comparison, found: &Picture, expected: &Image) -> String {
    let width = SIZE[0] as usize;
    let beyond: Vec<usize> = (0..found.color.len()).filter(|&i| comparison.pixel_errors[i] > AGREEMENT_PIXEL).collect();
    if beyond.is_empty() {
        return String::new();
    }
    let missed = |depth: f64| depth >= 0.99 * MISS;
    let (mut silhouette, mut crossing) = (0, 0);
    for &i in &beyond {
        let (f, e) = (f64::from(found.depth[i]), expected.depth[i]);
        if missed(f) != missed(e) {
            silhouette += 1;
        } else if !missed(f) && (f - e).abs() > 0.5 {
            crossing += 1;
        }
    }
    let worst = comparison.worst;
    format!(
        "| rest {}: silhouette {silhouette}, another crossing {crossing}, same place {}; worst ({}, {}) {:?} for {:?}, depth {} for {}",
        beyond.len(),
        beyond.len() - silhouette - crossing,
        worst % width,
        worst / width,
        found.color[worst],
        expected.color[worst],
        found.depth[worst],
        expected.depth[worst],
    )
}

fn judge_all(mut subject: Subject) {
    let volume = subject.bench.volume();
    for view in &views(&volume) {
        for look in LOOKS {
            subject.judge(look, view);
        }
    }
}

#[test]
fn head_of_byte_codes() {
    judge_all(Subject::head());
}

#[test]
fn brain_of_described_raw_data() {
    let (subject, _file) = Subject::small_brain();
    judge_all(subject);
}

#[test]
fn anisotropic_ball_of_floats() {
    judge_all(Subject::ball());
}

#[test]
fn jittered_samples() {
    let mut subject = Subject::ball();
    let volume = subject.bench.volume();
    let [above, _, inside, _] = views(&volume);
    for (seed, look) in [(0, LOOKS[0]), (77, LOOKS[2]), (5, LOOKS[3])] {
        for view in [&above, &inside] {
            subject.judge(Look { jitter: Some(seed), ..look }, view);
        }
    }
}

#[test]
fn every_reconstruction() {
    let mut subject = Subject::ball();
    let volume = subject.bench.volume();
    let [above, _, _, parallel] = views(&volume);
    for sampling in [
        ("nearest", Sampling::Nearest),
        ("trilinear", Sampling::Trilinear),
        ("catmull_rom", Sampling::CatmullRom),
        ("bspline", Sampling::BSplinePrefiltered),
    ] {
        subject.judge(Look { sampling, ..LOOKS[0] }, &above);
        subject.judge(Look { sampling, ..LOOKS[4] }, &parallel);
    }
}

/// Refinements take the same steps: what differs is rounding, and depths show more of it than colours.
#[test]
fn every_refinement() {
    let mut subject = Subject::ball();
    let volume = subject.bench.volume();
    let [above, ..] = views(&volume);
    let method = |value: f64, refinement: Refinement| Method::Isosurface { value, refinement };
    for (name, refinement) in [
        ("none", Refinement::None),
        ("linear", Refinement::Linear),
        ("bisection", Refinement::Bisection(8)),
        ("secant", Refinement::Secant(4)),
    ] {
        subject.render(LOOKS[3], &above.1);
        let found = subject.bench.put("traversal.refinement", json!(name)).render(SIZE);
        let scene = Scene { method: method(subject.isovalue, refinement), ..subject.scene(LOOKS[3], above.1, &volume) };
        let expected = same_samples::render(&scene).expect("a scene that makes sense");
        let pairs = found.depth.iter().map(|d| f64::from(*d)).zip(expected.depth.iter().copied());
        let errors: Vec<f64> =
            pairs.filter(|(a, b)| *a < 0.99 * MISS && *b < 0.99 * MISS).map(|(a, b)| (a - b).abs()).collect();
        let close = errors.iter().filter(|error| **error <= REFINED).count() as f64 / errors.len() as f64;
        println!("{name}: {} hits, {:.3} % within {REFINED} of the depth", errors.len(), 100.0 * close);
        assert!(errors.len() > 2000 && close >= AGREEMENT_SHARE, "{name}: {close}");
    }
}

/// Light from behind and a low exponent: where the light does not reach there is no highlight.
#[test]
fn highlights_end_where_the_light_does() {
    let mut subject = Subject::ball();
    let volume = subject.bench.volume();
    let [above, ..] = views(&volume);
    subject.render(LOOKS[3], &above.1);
    subject.bench.put("traversal.light", json!({"direction": [0.9, 0.3, -0.5], "space": "camera"}));
    subject.bench.put("traversal.shading.shininess", json!(2)).put("traversal.shading.specular", json!(1));
    let found = subject.bench.render(SIZE);
    let mut scene = subject.scene(LOOKS[3], above.1, &volume);
    scene.shading = scene.shading.map(|shading| Shading {
        light_direction: DVec3::new(0.9, 0.3, -0.5),
        highlight: Highlight::BlinnPhong { shininess: 2.0 },
        specular: 1.0,
        ..shading
    });
    let expected = same_samples::render(&scene).expect("a scene that makes sense");
    let comparison = Comparison::new(&found.color, &expected.color).expect("pictures of one size");
    let share = comparison.share_within(AGREEMENT_PIXEL);
    println!("light from behind: {:.3} % of the pixels agree", 100.0 * share);
    assert!(share >= AGREEMENT_SHARE, "{share}");
}

#[test]
fn every_shading() {
    let mut subject = Subject::ball();
    let volume = subject.bench.volume();
    let [above, below, ..] = views(&volume);
    for shading in ["diffuse", "oren_nayar", "toon", "specular", "phong", "cook_torrance", "ward"] {
        subject.judge(Look { shading, name: shading, ..LOOKS[3] }, &above);
        subject.judge(Look { shading, name: shading, ..LOOKS[4] }, &below);
    }
}

#[test]
fn every_gradient() {
    let mut subject = Subject::ball();
    let volume = subject.bench.volume();
    let [above, below, ..] = views(&volume);
    for gradient in [
        ("forward", GradientOperator::Forward),
        ("backward", GradientOperator::Backward),
        ("central", GradientOperator::Central),
        ("central4", GradientOperator::CentralFourth),
        ("sobel", GradientOperator::Sobel),
    ] {
        let surface = subject.judge(Look { gradient, ..LOOKS[3] }, &above);
        let medium = subject.judge(Look { gradient, ..LOOKS[4] }, &below);
        assert!(surface.max(medium) <= AGREEMENT_GRADIENT, "{}: {surface} {medium}", gradient.0);
    }
}
