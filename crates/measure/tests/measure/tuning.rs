//! Tuning a small network.

use std::ops::ControlFlow;

use rayloom_measure::{Goal, MeasureError, Tuned, Verdict, draw, picture_error, silent, tune};
use rayloom_network::{Address, Camera, Evaluator, Network, Request, Value};
use rayloom_processors::{Data, Runner};
use rayloom_reference::{Cache, Reference, RenderError};
use serde_json::json;

use crate::network::{gpu, network};

const SIZE: [u32; 2] = [32, 28];

fn goal(max_error: Option<f64>, budget_ms: Option<f64>) -> Goal {
    Goal { port: None, max_error, budget_ms, size: SIZE, picture: SIZE, views: 4, unseen: 3, standard: None }
}

fn tuned(network: &Network, goal: &Goal) -> Result<Tuned, MeasureError> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    tune(network, goal, gpu(), &Cache::new(folder.path()), &|_, _| ControlFlow::Continue(()))
}

/// The error of a network from some side, against the exact picture of what is meant.
fn error(network: &Network, meant: &Network, turn: f64) -> f64 {
    let turned = |network: &Network| {
        let mut network = network.clone();
        let Some(Value::Camera(mut camera)) = network.value("view", "camera") else { panic!("no camera") };
        Camera::orbit(&mut camera, turn, 0.5 * turn);
        network.set_property("view", "camera", Value::Camera(camera)).expect("a sound camera");
        network
    };
    let (mut runner, mut evaluator) = (Runner::new(gpu()).expect("a runner"), Evaluator::new());
    let watch = vec![Address::new("traversal", "image")];
    evaluator.evaluate(&turned(network), &mut runner, &Request { watch, size: Some(SIZE), ..Request::default() });
    let Some(Data::Image(image)) = evaluator.output("traversal", "image") else { panic!("no picture") };
    let found = image.read_back(&runner.context).expect("a picture");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = Cache::new(folder.path());
    let (exact, _) = draw(&turned(meant), None, Reference::Exact, SIZE, gpu(), &cache, &silent).expect("a picture");
    picture_error(&found.pixels, &exact.pixels).expect("pictures of one size")
}

#[test]
fn the_target_is_met_on_other_views_by_a_preset_that_names_every_knob() {
    let meant = network(&[("traversal.sampling_rate", json!(0.25)), ("traversal.jitter", json!(true))]);
    let allowed = 0.01;
    let found = tuned(&meant, &goal(Some(allowed), None)).expect("a setting");
    assert_eq!(found.verdict, Verdict::Met, "{}", found.message());
    assert!(found.worst() <= allowed && found.unseen.len() == 3 && found.seen.len() >= 4, "{:?}", found.unseen);
    assert!(found.saved_error.is_some_and(|saved| saved > allowed), "{:?}", found.saved_error);
    let message = found.message();
    assert!(message.contains("the cheapest setting that keeps the error within 0.01"), "{message}");
    let knobs: Vec<String> = found.preset.values.keys().map(ToString::to_string).collect();
    for knob in ["sampling_rate", "termination_error", "classification", "sampling", "skipping", "target", "jitter"] {
        assert!(knobs.contains(&format!("traversal.{knob}")), "{knob}: {knobs:?}");
    }
    assert!(knobs.contains(&"view.format".into()) && knobs.contains(&"source.precision".into()), "{knobs:?}");
    let mut set = meant.clone();
    found.preset.apply(&mut set).expect("a preset that fits");
    for turn in [1.0, 2.3, -2.0] {
        let error = error(&set, &meant, turn);
        assert!(error <= allowed, "turned by {turn}: {error}");
    }
}

#[test]
fn what_cannot_be_met_is_said() {
    let found = tuned(&network(&[]), &goal(Some(1e-9), None)).expect("a setting");
    assert_eq!(found.verdict, Verdict::Missed);
    assert!(found.worst() > 1e-9 && found.worst() < 1e-3, "{}", found.worst());
    assert!(
        found.message().starts_with("No setting keeps the error within 1e-9 on every view."),
        "{}",
        found.message()
    );
}

#[test]
fn a_budget_is_spent_on_accuracy() {
    let coarse = network(&[("traversal.sampling_rate", json!(0.125))]);
    let found = tuned(&coarse, &goal(None, Some(1e6))).expect("a setting");
    assert_eq!(found.verdict, Verdict::InTime, "{}", found.message());
    assert!(found.worst() < 1e-3, "{}", found.message());
    let slow = tuned(&coarse, &goal(Some(1e-9), Some(1e-6))).expect("a setting");
    assert_eq!(slow.verdict, Verdict::TooSlow);
    assert!(slow.message().contains("It does not keep the error within 1e-9."), "{}", slow.message());
}

#[test]
fn tuning_can_be_cancelled_and_nonsense_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let stop = |_: &str, _: f64| ControlFlow::Break(());
    let found = tune(&network(&[]), &goal(Some(0.01), None), gpu(), &Cache::new(folder.path()), &stop);
    assert!(matches!(found, Err(MeasureError::Render(RenderError::Cancelled))));
    for (wrong, reason) in [
        (goal(None, None), "how large the error may be"),
        (goal(Some(0.0), None), "must lie above 0"),
        (goal(None, Some(-1.0)), "more than 0"),
    ] {
        let error = tuned(&network(&[]), &wrong).expect_err("a refusal").to_string();
        assert!(error.contains(reason), "{error}");
    }
}
