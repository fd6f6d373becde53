//! Networks as scenes of the reference.

use rayloom_measure::{Errors, MeasureError, draw, silent};
use rayloom_network::{Address, Evaluator, Network, Request};
use rayloom_processors::{Data, Picture, Runner};
use rayloom_reference::{Cache, Reference};
use serde_json::{Value as Json, json};

use crate::network::{gpu, network};

const SIZE: [u32; 2] = [48, 40];

/// What the device shows.
fn shown(network: &Network) -> Picture {
    let mut runner = Runner::new(gpu()).expect("a runner");
    let mut evaluator = Evaluator::new();
    let watch = vec![Address::new("traversal", "image")];
    let report = evaluator.evaluate(network, &mut runner, &Request { watch, size: Some(SIZE), ..Request::default() });
    assert!(report.is_complete(), "{report:?}");
    match evaluator.output("traversal", "image") {
        Some(Data::Image(image)) => image.read_back(&runner.context).expect("a picture"),
        other => panic!("{other:?}"),
    }
}

fn drawn(network: &Network, reference: Reference) -> Result<Picture, MeasureError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    Ok(draw(network, None, reference, SIZE, gpu(), &Cache::new(folder.path()), &silent)?.0)
}

/// The means of the project's agreement tests (0.2/255), of the largest channel error of each pixel.
const AGREEMENT: f64 = 0.2 / 255.0;

#[test]
fn the_same_samples_agree_with_the_device() {
    let cases: &[&[(&str, Json)]] = &[
        &[],
        &[
            ("traversal.shading", json!("blinn_phong")),
            ("traversal.shading.specular", json!(0.7)),
            ("traversal.gradient", json!("central4")),
        ],
        &[
            ("traversal.shading", json!("diffuse")),
            ("traversal.light", json!({"space": "world", "direction": [1, -1, 0.5]})),
        ],
        &[("traversal.shading", json!("toon")), ("traversal.shading.steps", json!(4))],
        &[("traversal.shading", json!("oren_nayar")), ("traversal.shading.roughness", json!(0.8))],
        &[("traversal.shading", json!("specular")), ("traversal.shading.shininess", json!(5))],
        &[("traversal.shading", json!("phong")), ("traversal.shading.shininess", json!(5))],
        &[("traversal.shading", json!("cook_torrance")), ("traversal.shading.reflectance", json!(0.6))],
        &[("traversal.shading", json!("ward")), ("traversal.shading.across", json!(0.9))],
        &[
            ("traversal.compositing", json!("mip")),
            ("proxy.clip_x", json!([3, 17])),
            ("traversal.sampling", json!("catmull_rom")),
        ],
        &[("traversal.compositing", json!("sum")), ("traversal.compositing.gain", json!(0.5))],
        &[
            ("traversal.compositing", json!("isosurfaces")),
            ("traversal.compositing.isovalue_b", json!(0.4)),
            ("traversal.compositing.opacity_c", json!(0.8)),
            ("traversal.compositing.isovalue_c", json!(0.2)),
            ("traversal.shading", json!("phong")),
        ],
        &[
            ("traversal.compositing", json!("first_hit_point")),
            (
                "traversal.transfer_function",
                json!({"knots": [
                {"at": 0.4, "color": [1, 1, 1], "opacity": 0, "right": {"color": [1, 1, 1], "opacity": 0.5}}]}),
            ),
        ],
        &[
            ("traversal.compositing", json!("first_hit_normal")),
            ("traversal.gradient", json!("sobel")),
            (
                "traversal.transfer_function",
                json!({"knots": [
                {"at": 0.4, "color": [1, 1, 1], "opacity": 0, "right": {"color": [1, 1, 1], "opacity": 0.5}}]}),
            ),
        ],
        // Without labels of its own, the volume is one.
        &[
            ("traversal.classification", json!("labels")),
            (
                "traversal.label_table",
                json!({"0": {"name": "faint", "transfer_function": {"knots": [
                {"at": 0.1, "color": [0.2, 0.5, 1], "opacity": 0.2}]}}}),
            ),
        ],
        &[
            ("traversal.compositing", json!("isosurface")),
            ("traversal.compositing.isovalue", json!(0.35)),
            ("traversal.shading", json!("blinn_phong")),
        ],
        &[
            ("clip.enabled", json!(true)),
            ("clip.normal", json!([0, 0, 1])),
            ("clip.distance", json!(4)),
            ("traversal.reference_length", json!(0)),
        ],
    ];
    for case in cases {
        let network = network(case);
        let (found, expected) =
            (shown(&network), drawn(&network, Reference::SameSamples).unwrap_or_else(|e| panic!("{case:?}: {e}")));
        let visible = expected.pixels.iter().filter(|pixel| pixel[3] > 0.05).count();
        assert!(visible > expected.pixels.len() / 20, "{case:?}: only {visible} pixels show something");
        let (errors, _) = Errors::of(&found.pixels, &expected.pixels).expect("pictures of one size");
        assert!(errors.mean <= AGREEMENT, "{case:?}: {errors:?}");
    }
}

/// Cubes of the labels 0 and 1 on a grid of their own, which the medium shows in two looks; label 7 does not occur.
fn labelled(set: &[(&str, Json)]) -> Network {
    let white = json!({"knots": [{"at": 0.0, "color": [1, 1, 1], "opacity": 0.3}]});
    let red = json!({"knots": [
        {"at": 0.1, "color": [0.8, 0.1, 0.2], "opacity": 0.1}, {"at": 0.5, "color": [1, 0.7, 0.2], "opacity": 0.8}]});
    let table = json!({
        "0": {"name": "even", "transfer_function": {"knots": [{"at": 0.1, "color": [0.2, 0.5, 1], "opacity": 0.05}]}},
        "1": {"name": "odd", "transfer_function": red}, "7": {"name": "none", "transfer_function": white},
    });
    let mut network = network(&[]);
    network.add("volume_generator", "labels").expect("a generator");
    network.connect(Address::new("labels", "volume"), Address::new("traversal", "labels")).expect("a connection");
    let cubes = [
        ("labels.field", json!("checkerboard")),
        ("labels.cells", json!(3)),
        ("labels.dims", json!([7, 9, 5])),
        ("labels.extent", json!([24, 22, 24])),
        ("traversal.classification", json!("labels")),
        ("traversal.label_table", table),
    ];
    for (property, value) in cubes.iter().chain(set) {
        let (processor, property) = property.split_once('.').expect("PROCESSOR.PROPERTY");
        network.set_from_json(processor, property, value).unwrap_or_else(|error| panic!("{error}"));
    }
    network
}

#[test]
fn labels_are_those_of_the_device() {
    let lit = [("traversal.shading", json!("blinn_phong")), ("traversal.gradient", json!("sobel"))];
    for set in [&[][..], &lit] {
        let network = labelled(set);
        let expected = drawn(&network, Reference::SameSamples).expect("a picture");
        let (errors, _) = Errors::of(&shown(&network).pixels, &expected.pixels).expect("pictures of one size");
        assert!(errors.mean <= AGREEMENT, "{set:?}: {errors:?}");
    }
    let exact = drawn(&labelled(&[]), Reference::Exact).expect("a picture");
    let error = |rate: f64| {
        let finer = [("traversal.sampling_rate", json!(rate)), ("traversal.termination_error", json!(0))];
        Errors::of(&shown(&labelled(&finer)).pixels, &exact.pixels).expect("pictures of one size").0.rmse
    };
    // The faces of labels are jumps: halved steps halve the error.
    let errors = [2.0, 4.0, 8.0, 16.0].map(error);
    println!("{errors:?}");
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!((0.8..1.3).contains(&order), "order {order} of {errors:?}");

    let unknown = labelled(&[("labels.field", json!("constant")), ("labels.value", json!(-2))]);
    for picture in [shown(&unknown), drawn(&unknown, Reference::Exact).expect("a picture")] {
        assert!(picture.pixels.iter().all(|pixel| *pixel == [0.0; 4]), "labels that mean nothing are transparent");
    }
}

#[test]
fn finer_samples_come_closer_to_the_exact_picture() {
    let at = |rate: f64| {
        let network = network(&[("traversal.sampling_rate", json!(rate)), ("traversal.termination_error", json!(0))]);
        let exact = drawn(&network, Reference::Exact).expect("a picture");
        Errors::of(&shown(&network).pixels, &exact.pixels).expect("pictures of one size").0.rmse
    };
    let (coarse, fine) = (at(1.0), at(8.0));
    assert!(fine < coarse / 20.0 && fine > 0.0, "{coarse} {fine}");
}

#[test]
fn what_the_reference_cannot_draw_is_refused_with_a_reason() {
    let refusal = |set: &[(&str, Json)], reference| match drawn(&network(set), reference) {
        Err(error @ MeasureError::Refusal(_)) => error.to_string(),
        other => panic!("{set:?}: {other:?}"),
    };
    let lit = ("traversal.shading", json!("blinn_phong"));
    let cases: &[(&[(&str, Json)], &str)] = &[
        (&[("traversal.compositing", json!("mida"))], "the compositing `mida` has no counterpart there"),
        (&[lit.clone(), ("traversal.gradient", json!("filtered"))], "the gradient `filtered` has no counterpart there"),
        (&[lit, ("traversal.compositing", json!("mip"))], "it does not light the extremes of rays"),
        (
            &[("traversal.classification", json!("transfer_function_2d"))],
            "no transfer functions over value and gradient",
        ),
        (
            &[("traversal.classification", json!("labels")), ("traversal.compositing", json!("mean"))],
            "it classifies by labels in direct volume rendering and first hits only",
        ),
        (&[("clip.enabled", json!(true))], "the proxy geometry is not a box along the voxel axes"),
        (&[("traversal.sampling.text", json!("fn x() {}"))], "the slot `sampling` holds a text of your own"),
    ];
    for (set, expected) in cases {
        let found = refusal(set, Reference::Exact);
        assert!(found.starts_with("The float64 reference cannot draw this: ") && found.contains(expected), "{found}");
    }
    let segments = [("traversal.classification", json!("preintegrated_full"))];
    assert!(refusal(&segments, Reference::SameSamples).contains("looks at segments, not samples"));
    assert!(drawn(&network(&segments), Reference::Exact).is_ok());
}
