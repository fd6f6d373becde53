//! The estimated error of a picture against its true one, on ten scenes.

use rayloom_measure::{Estimate, draw, silent};
use rayloom_reference::{Cache, Comparison, Reference};
use rayloom_tests::{Picture, Workbench, tolerances::*};
use serde_json::{Value as Json, json};

const SIZE: [u32; 2] = [48, 48];

/// A generated field with properties of the traversal.
fn bench(field: Json, settings: Json) -> Workbench {
    let mut bench = Workbench::of_generator(&field);
    let voxels = field["dims"][0].as_f64().expect("dims");
    bench.put("source.extent", json!([voxels, voxels, voxels]));
    let at = |scale: [f64; 3]| scale.map(|x| x * voxels);
    bench.put(
        "view.camera",
        json!({"position": at([1.9, 1.3, 1.05]), "focus": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 36}),
    );
    for (id, value) in settings.as_object().into_iter().flatten() {
        bench.put(&format!("traversal.{id}"), value.clone());
    }
    bench
}

/// Knots of value, colour and opacity, the opacity before and at the value.
fn function(knots: &[(f64, [f64; 3], [f64; 2])]) -> Json {
    let knot = |(at, color, [left, right]): &(f64, [f64; 3], [f64; 2])| json!({"at": at, "color": color, "opacity": left, "right": {"color": color, "opacity": right}});
    json!({"knots": knots.iter().map(knot).collect::<Vec<_>>()})
}

fn smooth() -> Json {
    function(&[(0.0, [0.2, 0.4, 1.0], [0.0, 0.0]), (1.0, [1.0, 0.6, 0.2], [0.4, 0.4])])
}

/// Clear, then dense from a value on, and clear again from another.
fn layer(from: f64, to: f64) -> Json {
    function(&[(from, [1.0, 0.7, 0.3], [0.0, 0.3]), (to, [1.0, 0.9, 0.8], [0.3, 0.0])])
}

/// Name, whether the material is smooth, scene.
fn scenes() -> Vec<(&'static str, bool, Workbench)> {
    let blob = || json!({"field": "gaussian_blob", "sigma": 0.4, "dims": [16, 16, 16]});
    let ball = || json!({"field": "bucky_ball", "dims": [24, 24, 24]});
    let signal = json!({"field": "marschner_lobb", "dims": [20, 20, 20], "frequency": 2});
    let shells = json!({"field": "shells", "count": 2, "dims": [24, 24, 24]});
    let lit =
        |two_sided: bool| json!({"transfer_function": smooth(), "shading": "blinn_phong", "two_sided": two_sided});
    vec![
        ("blob", true, bench(blob(), json!({"transfer_function": smooth()}))),
        ("bucky ball", true, bench(ball(), json!({"transfer_function": smooth()}))),
        ("Marschner-Lobb signal", true, bench(signal, json!({"transfer_function": smooth()}))),
        (
            "shells, mean value",
            true,
            bench(shells.clone(), json!({"transfer_function": smooth(), "compositing": "mean"})),
        ),
        ("blob, lit from one side", true, bench(blob(), lit(false))),
        ("blob, a layer of values", false, bench(blob(), json!({"transfer_function": layer(0.4, 0.7)}))),
        ("bucky ball, a thin layer", false, bench(ball(), json!({"transfer_function": layer(0.5, 0.53)}))),
        ("shells, a layer", false, bench(shells, json!({"transfer_function": layer(0.55, 0.9)}))),
        ("nearest voxels", false, bench(blob(), json!({"transfer_function": smooth(), "sampling": "nearest"}))),
        ("bucky ball, lit from both sides", true, bench(ball(), lit(true))),
    ]
}

#[test]
fn estimates_hold_on_ten_scenes() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = Cache::new(folder.path());
    let mut failed = Vec::new();
    for (name, is_smooth, mut bench) in scenes() {
        let gpu = bench.runner.context.gpu.clone();
        let exact = draw(&bench.network, None, Reference::Exact, SIZE, gpu, &cache, &silent);
        let exact = exact.unwrap_or_else(|error| panic!("{name}: {error}")).0.pixels;
        let pictures: Vec<Picture> =
            [2, 4, 8].map(|rate| bench.put("traversal.sampling_rate", json!(rate)).render(SIZE)).into();
        let color = |i: usize| &pictures[i].color[..];
        let fine = Estimate::of(Some(color(0)), color(1), color(2)).expect("pictures of one size");
        for (which, estimate, picture) in [("finer", fine, 2), ("coarser", fine.of_coarser(), 1)] {
            let truth = Comparison::new(color(picture), &exact).expect("pictures of one size").pixels;
            for (measure, estimated, truth) in [("rms", estimate.rmse, truth.rmse), ("99 %", estimate.p99, truth.p99)] {
                let ratio = estimated / truth;
                let order = fine.order.unwrap_or(f64::NAN);
                println!("| {name} | {which} | {measure} | {order:.2} | {truth:.1e} | {estimated:.1e} | {ratio:.2} |");
                let holds = ratio >= ESTIMATE_LEAST && (!is_smooth || (1.0 / ESTIMATE..=ESTIMATE).contains(&ratio));
                if !holds {
                    failed.push(format!("{name}, {which}, {measure}: {ratio:.2}"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
