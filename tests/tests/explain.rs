//! What a run says about itself: what it computed, bound and allocated, what it left out, and why.

use rayloom_processors::{Explanation, Role};
use rayloom_tests::Workbench;
use serde_json::json;

/// A blob in a small box with some properties of the traversal set.
fn explained(settings: &[(&str, serde_json::Value)]) -> Vec<Explanation> {
    let mut bench = Workbench::of_generator(
        &json!({"field": "gaussian_blob", "sigma": 0.3, "dims": [32, 32, 32], "extent": [32.0, 32.0, 32.0]}),
    );
    bench.put(
        "traversal.transfer_function",
        json!({"knots": [
        {"at": 0.3, "color": [1, 0.2, 0.1], "opacity": 0}, {"at": 0.9, "color": [1, 1, 0.5], "opacity": 0.6}]}),
    );
    for (property, value) in settings {
        bench.put(&format!("traversal.{property}"), value.clone());
    }
    bench.runner.explain(true);
    bench.render([40, 30]);
    Explanation::of(bench.evaluator.last_run("traversal").expect("it ran"))
}

/// The lines of some roles, without numbers of lines, which change with every snippet.
fn lines(explanations: &[Explanation], roles: &[Role]) -> Vec<String> {
    let line = |one: &Explanation| match one.bytes {
        Some(bytes) => format!("{}: {}, {bytes}", one.role.label(), one.what),
        None => format!("{}: {}; {}", one.role.label(), one.what, one.why),
    };
    let shown = explanations.iter().filter(|one| roles.contains(&one.role) && !one.what.starts_with("ray loop of"));
    shown.map(line).collect()
}

#[test]
fn a_sparse_unshaded_scene() {
    assert_eq!(
        lines(&explained(&[]), &Role::ALL),
        [
            "computed: sampling `filtered`; chosen",
            "computed: classification `transfer_function`; chosen",
            "computed: skipping `distance`; 12 % of the bricks may show something, no more than 60 %",
            "computed: output `image`: 40 x 30 rgba32float with depth; something uses it",
            "bound: frame: buffer, 128",
            "bound: linear_sampler: linear filter; the sampling snippet leaves interpolation to the texture unit",
            "bound: entry_points: 40 x 30 rgba32float, 19200",
            "bound: exit_points: 40 x 30 rgba32float, 19200",
            "bound: source: buffer, 224",
            "bound: volume: 32 x 32 x 32 r32float, 131072",
            "bound: transfer_table: 1024 x 1 rgba32float, 16384",
            "bound: skip_map: 8 x 8 x 8 r8uint, 512",
            "bound: out1_color: 40 x 30 rgba32float; the picture and its depth",
            "bound: out1_depth: 40 x 30 r32float; the picture and its depth",
            "allocated: image: 40 x 30 rgba32float, 19200",
            "allocated: view depth: 40 x 30 r32float, 4800",
            "left out: gradient; neither shading, classification nor compositing reads it",
            "left out: shading; `none` is chosen",
            "left out: refinement; the compositing looks for no surface",
            "left out: early termination; the allowed error is 0: whole rays",
            "left out: sums of faint samples; no ray takes more than 8192 samples",
            "left out: cuts of the transfer function's table; the function has no steps and no steep ramps",
            "left out: pre-integrated table; samples are classified one by one: the transfer function has no step, so midpoints err less",
            "left out: jitter of the samples; switched off",
            "left out: map of voxels without a value; every voxel has one",
            "left out: counting of samples; nobody asked for it",
            "left out: output `image2`; nothing uses it",
            "left out: output `image3`; nothing uses it",
            "left out: output `samples`; nothing uses it",
        ]
    );
}

#[test]
fn a_shaded_scene_computes_gradients_and_searches() {
    let found = explained(&[("shading", json!("blinn_phong")), ("termination_error", json!(0.002))]);
    assert_eq!(
        lines(&found, &[Role::Computed, Role::LeftOut]),
        [
            "computed: sampling `filtered`; chosen",
            "computed: classification `transfer_function`; chosen",
            "computed: gradient `central`; shading reads it",
            "computed: shading `blinn_phong`; chosen; visible samples are searched first and shaded together",
            "computed: skipping `distance`; 12 % of the bricks may show something, no more than 60 %",
            "computed: early termination; rays stop where the rest is below the allowed error, or nothing more is looked for",
            "computed: output `image`: 40 x 30 rgba32float with depth; something uses it",
            "left out: refinement; the compositing looks for no surface",
            "left out: sums of faint samples; no ray takes more than 8192 samples",
            "left out: cuts of the transfer function's table; the function has no steps and no steep ramps",
            "left out: pre-integrated table; samples are classified one by one: the transfer function has no step, so midpoints err less",
            "left out: jitter of the samples; switched off",
            "left out: map of voxels without a value; every voxel has one",
            "left out: counting of samples; nobody asked for it",
            "left out: output `image2`; nothing uses it",
            "left out: output `image3`; nothing uses it",
            "left out: output `samples`; nothing uses it",
        ]
    );
}

#[test]
fn a_projection_of_values_takes_every_sample() {
    let found =
        explained(&[("compositing", json!("mip")), ("sampling", json!("nearest")), ("shading", json!("diffuse"))]);
    assert_eq!(
        lines(&found, &Role::ALL),
        [
            "computed: sampling `nearest`; chosen",
            "computed: classification `transfer_function`; chosen",
            "computed: gradient `central`; shading reads it",
            "computed: shading `diffuse`; chosen",
            "computed: output `image`: 40 x 30 rgba32float with depth; something uses it",
            "bound: frame: buffer, 128",
            "bound: params: buffer, 16",
            "bound: entry_points: 40 x 30 rgba32float, 19200",
            "bound: exit_points: 40 x 30 rgba32float, 19200",
            "bound: source: buffer, 224",
            "bound: volume: 32 x 32 x 32 r32float, 131072",
            "bound: transfer_table: 1024 x 1 rgba32float, 16384",
            "bound: out1_color: 40 x 30 rgba32float; the picture and its depth",
            "bound: out1_depth: 40 x 30 r32float; the picture and its depth",
            "allocated: image: 40 x 30 rgba32float, 19200",
            "allocated: view depth: 40 x 30 r32float, 4800",
            "left out: refinement; the compositing looks for no surface",
            "left out: skipping structure; skipping `distance` cannot be combined with compositing `mip`, which needs every sample of the ray: choose skipping `none`.",
            "left out: early termination; the allowed error is 0: whole rays",
            "left out: cuts of the transfer function's table; the function has no steps and no steep ramps",
            "left out: pre-integrated table; samples are classified one by one: the transfer function has no step, so midpoints err less",
            "left out: jitter of the samples; switched off",
            "left out: map of voxels without a value; every voxel has one",
            "left out: counting of samples; nobody asked for it",
            "left out: output `image2`; nothing uses it",
            "left out: output `image3`; nothing uses it",
            "left out: output `samples`; nothing uses it",
        ]
    );
}

#[test]
fn a_dense_scene_with_a_step_has_no_skipping_structure() {
    let dense = json!({"knots": [{"at": 0.5, "color": [1, 1, 1], "opacity": 0.1, "right": {"color": [1, 1, 1], "opacity": 0.4}}]});
    let found = explained(&[("transfer_function", dense)]);
    assert_eq!(
        lines(&found, &[Role::LeftOut]),
        [
            "left out: gradient; neither shading, classification nor compositing reads it",
            "left out: shading; `none` is chosen",
            "left out: refinement; the compositing looks for no surface",
            "left out: skipping structure; 100 % of the bricks may show something, more than 60 %: leaping costs more",
            "left out: early termination; the allowed error is 0: whole rays",
            "left out: sums of faint samples; no ray takes more than 8192 samples",
            "left out: pre-integrated table; samples are classified one by one, though the transfer function has a step, which `preintegrated_full` would meet exactly",
            "left out: jitter of the samples; switched off",
            "left out: map of voxels without a value; every voxel has one",
            "left out: counting of samples; nobody asked for it",
            "left out: output `image2`; nothing uses it",
            "left out: output `image3`; nothing uses it",
            "left out: output `samples`; nothing uses it",
        ]
    );
}

#[test]
fn nothing_is_recorded_unless_asked_for() {
    let mut bench = Workbench::of_generator(&json!({"field": "constant", "dims": [4, 4, 4]}));
    bench.render([8, 8]);
    let run = bench.evaluator.last_run("traversal").expect("it ran");
    assert!(Explanation::of(run).is_empty() && run.statistics.is_empty(), "{run:?}");
}
