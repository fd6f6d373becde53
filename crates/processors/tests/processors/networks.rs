//! The registry, and processors together in a network.

use std::sync::Arc;

use rayloom_network::{Address, Evaluator, Network, PropertyKind, Request, Value};
use rayloom_processors::{Data, processors, registry};

use crate::common::{GPU, runner};

#[test]
fn every_processor_is_registered_and_explains_itself() {
    let all = processors();
    assert_eq!(registry().iter().count(), all.len(), "every declaration is valid and every id unique");
    for process in all {
        let declaration = process.declaration();
        let id = &declaration.id;
        let helps = |what: &str, help: &str| assert!(help.ends_with('.'), "{id}: {what} has no help");
        helps("it", &declaration.help);
        declaration.inports.iter().for_each(|port| helps(&port.id, &port.help));
        declaration.outports.iter().for_each(|port| helps(&port.id, &port.help));
        for property in &declaration.properties {
            helps(&property.id, &property.help);
            if let PropertyKind::Choice { choices } = &property.kind {
                choices.iter().for_each(|choice| helps(&choice.id, &choice.help));
            }
        }
    }
}

/// generator -> slice -> background -> canvas
fn network() -> Network {
    let mut network = Network::new(Arc::new(registry()));
    for (kind, id) in
        [("volume_generator", "source"), ("slice_view", "slice"), ("background", "back"), ("canvas", "canvas")]
    {
        network.add(kind, id).expect("added");
    }
    network.set_property("source", "dims", Value::Vector(vec![16.0; 3])).expect("set");
    for (from, to) in [("source.volume", "slice.volume"), ("slice.image", "back.front"), ("back.image", "canvas.image")]
    {
        let [from, to] = [from, to].map(|address| address.parse::<Address>().expect("an address"));
        network.connect(from, to).expect("connected");
    }
    network
}

#[test]
fn a_network_runs_on_the_device_once_and_measures_itself() {
    let mut network = network();
    let mut evaluator = Evaluator::new();
    let mut runner = runner();
    runner.measure(true);
    let request = Request { size: Some([40, 30]), ..Request::default() };

    let report = evaluator.evaluate(&network, &mut runner, &request);
    assert!(report.is_complete(), "{:?} {:?}", report.failed, report.not_ready);
    assert_eq!(report.ran(), ["source", "slice", "back", "canvas"]);
    let timed: Vec<bool> = report.runs.iter().map(|run| run.gpu.is_some()).collect();
    assert_eq!(timed, [false, GPU.features.timestamps, GPU.features.timestamps, false]);
    let Some(Data::Image(shown)) = evaluator.output("canvas", "shown") else { panic!("nothing is shown") };
    assert_eq!(shown.size(), [40, 30]);

    assert!(evaluator.evaluate(&network, &mut runner, &request).runs.is_empty(), "nothing changed");
    let compiled = runner.context.pipelines.counts().misses;
    for position in [0.1, 0.2, 0.3, 0.4] {
        network.set_property("slice", "position", Value::Float(position)).expect("set");
        let report = evaluator.evaluate(&network, &mut runner, &request);
        assert_eq!(report.ran(), ["slice", "back", "canvas"]);
    }
    assert_eq!(runner.context.pipelines.counts().misses, compiled, "numbers never compile");
    assert!(runner.context.pool.counts().created <= 4, "{:?}", runner.context.pool.counts());
}

#[test]
fn a_failing_processor_says_why_and_recovers() {
    let mut network = network();
    let mut evaluator = Evaluator::new();
    let mut runner = runner();
    let request = Request { size: Some([16, 16]), ..Request::default() };
    network.set_property("slice", "channel", Value::Int(3)).expect("set");
    let report = evaluator.evaluate(&network, &mut runner, &request);
    assert!(report.failed["slice"].to_string().contains("channel 3"), "{:?}", report.failed);
    network.set_property("slice", "channel", Value::Int(0)).expect("set");
    assert!(evaluator.evaluate(&network, &mut runner, &request).is_complete());
    runner.tidy(|id| network.processor(id).is_some());
}
