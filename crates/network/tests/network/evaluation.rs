//! The evaluator runs what must run, and nothing else.

use crate::fake::{Counter, pipeline};
use rayloom_network::*;

/// A network with its evaluator.
struct Bench {
    network: Network,
    evaluator: Evaluator<Counter>,
    backend: Counter,
}

impl Bench {
    fn new(network: Network) -> Self {
        Self { network, evaluator: Evaluator::new(), backend: Counter::default() }
    }

    fn evaluate(&mut self) -> Report {
        self.with(&Request::default())
    }

    fn with(&mut self, request: &Request) -> Report {
        self.evaluator.evaluate(&self.network, &mut self.backend, request)
    }

    fn set(&mut self, processor: &str, property: &str, value: Value) {
        self.network.set_property(processor, property, value).unwrap();
    }
}

fn watch(processor: &str, outport: &str) -> Request {
    Request { watch: vec![Address::new(processor, outport)], ..Request::default() }
}

/// One line a run: who, at which level, why.
fn log(report: &Report) -> String {
    report.runs.iter().map(|run| format!("{} [{}]: {}\n", run.processor, run.level, run.why())).collect()
}

#[test]
fn everything_runs_once_and_then_nothing() {
    let mut bench = Bench::new(pipeline());
    let first = bench.evaluate();
    assert_eq!(first.ran(), ["data", "proxy", "view", "filter", "canvas"]);
    assert!(first.is_complete());
    assert!(bench.evaluate().runs.is_empty());
    let shown: Vec<_> =
        bench.evaluator.inputs(&bench.network, "canvas", "image").map(|made| made.how.clone()).collect();
    assert_eq!(shown, ["filter(view(proxy(data()), data()))"]);
}

#[test]
fn a_burst_of_edits_is_one_evaluation_and_a_value_set_back_is_none() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    for rate in [2.0, 3.0, 4.0] {
        bench.set("view", "rate", Value::Float(rate));
    }
    bench.set("view", "early", Value::Bool(false));
    let report = bench.evaluate();
    insta::assert_snapshot!(log(&report), @r"
    view [shader]: view.rate changed, view.early changed
    filter [result]: input `image` changed (view ran)
    canvas [result]: input `image` changed (filter ran)
    ");
    bench.set("view", "rate", Value::Float(9.0));
    bench.set("view", "rate", Value::Float(4.0));
    assert!(bench.evaluate().runs.is_empty());
    assert_eq!(bench.backend.runs["data"], 1);
    assert_eq!(bench.backend.runs["view"], 2);
}

#[test]
fn what_reaches_no_sink_never_runs_until_it_is_watched() {
    let mut bench = Bench::new(pipeline());
    bench.network.add("preview", "side").unwrap();
    bench.network.connect(("data", "volume"), ("side", "volume")).unwrap();
    assert!(!bench.evaluate().ran().contains(&"side"));
    let report = bench.with(&watch("side", "image"));
    insta::assert_snapshot!(log(&report), @"side [ports]: first run");
    assert_eq!(bench.backend.sizes["side"], [640, 480]);
    // Looking away and back costs nothing.
    assert!(bench.evaluate().runs.is_empty());
    assert!(bench.evaluator.output("side", "image").is_none());
    assert!(bench.with(&watch("side", "image")).runs.is_empty());
    assert!(bench.evaluator.output("side", "image").is_some());
}

#[test]
fn an_outport_is_computed_only_once_it_is_used() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    assert!(bench.evaluator.output("view", "depth").is_none());
    let report = bench.with(&watch("view", "depth"));
    insta::assert_snapshot!(log(&report), @r"
    view [ports]: output `depth` is now used
    filter [result]: input `image` changed (view ran)
    canvas [result]: input `image` changed (filter ran)
    ");
    assert!(bench.evaluator.output("view", "depth").is_some());
    assert!(bench.evaluate().runs.is_empty());
}

#[test]
fn a_failure_stays_on_its_processor_and_is_not_retried_before_a_change() {
    let mut network = pipeline();
    network.add("canvas", "other").unwrap();
    network.connect(("view", "image"), ("other", "image")).unwrap();
    let mut bench = Bench::new(network);
    bench.set("filter", "fail", Value::Text("the kernel has no size".into()));
    let report = bench.evaluate();
    assert_eq!(report.ran(), ["data", "proxy", "view", "filter", "other"]);
    assert_eq!(report.failed["filter"].message, "the kernel has no size");
    insta::assert_snapshot!(report.not_ready["canvas"].join("\n"), @"canvas waits for filter.image_out; filter failed");
    assert_eq!(report.not_ready.len(), 1);

    let again = bench.evaluate();
    assert!(again.runs.is_empty());
    assert_eq!(again.failed, report.failed);
    assert_eq!(again.not_ready, report.not_ready);

    bench.set("filter", "fail", Value::Text(String::new()));
    assert_eq!(bench.evaluate().ran(), ["filter", "canvas"]);
}

#[test]
fn a_processor_that_gives_nothing_fails() {
    let mut bench = Bench::new(pipeline());
    bench.backend.silent = true;
    let report = bench.evaluate();
    insta::assert_snapshot!(report.failed["data"], @"it ran but gave nothing on `volume`");
    insta::assert_snapshot!(report.not_ready["view"].join("\n"), @"view waits for data.volume; data failed");
}

#[test]
fn a_condition_on_data_keeps_the_connection_and_says_why() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    bench.set("data", "channels", Value::Int(3));
    let report = bench.evaluate();
    assert_eq!(report.ran(), ["data", "proxy"]);
    insta::assert_snapshot!(report.not_ready["canvas"].join("\n"), @"canvas waits for filter.image_out; filter waits for view.image; view: input `volume` needs a volume with one channel");
    bench.set("data", "channels", Value::Int(1));
    assert_eq!(bench.evaluate().ran(), ["data", "proxy", "view", "filter", "canvas"]);
}

#[test]
fn a_connection_cut_and_made_again_costs_nothing() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    assert!(bench.network.disconnect(("view", "image"), ("filter", "image")));
    let report = bench.evaluate();
    assert!(report.runs.is_empty());
    insta::assert_snapshot!(report.not_ready["canvas"].join("\n"), @"canvas waits for filter.image_out; filter: input `image` is not connected");
    bench.network.connect(("view", "image"), ("filter", "image")).unwrap();
    assert!(bench.evaluate().runs.is_empty());
}

#[test]
fn a_change_of_what_feeds_an_inport_is_named() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    bench.network.disconnect(("proxy", "geometry"), ("view", "geometry"));
    insta::assert_snapshot!(log(&bench.evaluate()).lines().next().unwrap(), @"view [ports]: input `geometry` is no longer connected");
    bench.network.disconnect(("view", "image"), ("filter", "image"));
    bench.network.add("preview", "side").unwrap();
    bench.network.connect(("data", "volume"), ("side", "volume")).unwrap();
    bench.network.connect(("side", "image"), ("filter", "image")).unwrap();
    insta::assert_snapshot!(log(&bench.evaluate()), @r"
    side [ports]: first run
    filter [ports]: input `image` now comes from side.image
    canvas [result]: input `image` changed (filter ran)
    ");
}

#[test]
fn the_render_size_travels_upstream_and_the_largest_wins() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    bench.set("canvas", "size", Value::Vector(vec![512.0, 512.0]));
    insta::assert_snapshot!(log(&bench.evaluate()), @r"
    view [result]: size changed to 512x512
    filter [result]: input `image` changed (view ran)
    canvas [result]: canvas.size changed, input `image` changed (filter ran)
    ");
    bench.network.add("canvas", "wide").unwrap();
    bench.set("wide", "size", Value::Vector(vec![900.0, 100.0]));
    bench.network.connect(("view", "image"), ("wide", "image")).unwrap();
    bench.evaluate();
    assert_eq!(bench.backend.sizes["view"], [900, 512]);
    assert_eq!(bench.backend.sizes["filter"], [512, 512]);
    bench.with(&Request { size: Some([64, 32]), ..Request::default() });
    assert_eq!(bench.backend.sizes["view"], [64, 32]);
    assert_eq!(bench.backend.runs["data"], 1);
}

#[test]
fn every_sink_may_have_a_size_of_its_own() {
    let mut network = pipeline();
    network.add("canvas", "other").unwrap();
    network.add("preview", "side").unwrap();
    network.connect(("data", "volume"), ("side", "volume")).unwrap();
    network.connect(("side", "image"), ("other", "image")).unwrap();
    let mut bench = Bench::new(network);
    let sizes = |canvas, other| Request {
        size: Some([300, 300]),
        sizes: [("canvas".to_owned(), canvas), ("other".to_owned(), other)].into(),
        ..Request::default()
    };
    bench.with(&sizes([200, 100], [30, 40]));
    assert_eq!((bench.backend.sizes["view"], bench.backend.sizes["side"]), ([200, 100], [30, 40]));
    // Only what feeds the canvas whose size changed runs.
    assert_eq!(bench.with(&sizes([200, 100], [60, 80])).ran(), ["side", "other"]);
    assert_eq!(bench.with(&Request { size: Some([60, 80]), ..Request::default() }).ran(), ["view", "filter", "canvas"]);
}

#[test]
fn images_that_meet_are_of_one_size() {
    let mut network = pipeline();
    network.add("preview", "side").unwrap();
    network.add("compositor", "over").unwrap();
    network.add("canvas", "other").unwrap();
    network.connect(("data", "volume"), ("side", "volume")).unwrap();
    network.connect(("view", "image"), ("over", "layers")).unwrap();
    network.connect(("side", "image"), ("over", "layers")).unwrap();
    network.connect(("over", "image"), ("other", "image")).unwrap();
    let mut bench = Bench::new(network);
    let sizes = [("canvas".to_owned(), [200, 100]), ("other".to_owned(), [30, 40])].into();
    bench.with(&Request { sizes, ..Request::default() });
    assert_eq!((bench.backend.sizes["view"], bench.backend.sizes["side"]), ([200, 100], [200, 100]));
}

#[test]
fn one_sink_can_be_asked_for() {
    let mut network = pipeline();
    network.add("canvas", "other").unwrap();
    network.connect(("view", "image"), ("other", "image")).unwrap();
    let mut bench = Bench::new(network);
    let report = bench.with(&Request { sinks: Sinks::Only(vec!["other".into()]), ..Request::default() });
    assert_eq!(report.ran(), ["data", "proxy", "view", "other"]);
    assert_eq!(bench.evaluate().ran(), ["filter", "canvas"]);
}

#[test]
fn results_that_nothing_needs_are_told_to_be_outdated() {
    let mut network = pipeline();
    network.add("canvas", "other").unwrap();
    network.connect(("filter", "image_out"), ("other", "image")).unwrap();
    network.add("canvas", "early").unwrap();
    network.connect(("view", "image"), ("early", "image")).unwrap();
    let mut bench = Bench::new(network);
    let only = |sink: &str| Request { sinks: Sinks::Only(vec![sink.into()]), ..Request::default() };
    let stale = |report: &Report| report.stale.iter().cloned().collect::<Vec<_>>();
    assert_eq!(stale(&bench.evaluate()), Vec::<String>::new());
    assert_eq!(stale(&bench.with(&only("early"))), Vec::<String>::new());
    bench.set("view", "rate", Value::Float(2.0));
    let report = bench.with(&only("early"));
    assert_eq!(report.needed, ["data", "proxy", "view", "early"]);
    assert_eq!(stale(&report), ["canvas", "filter", "other"]);
    assert_eq!(stale(&bench.with(&only("canvas"))), ["other"]);
    assert_eq!(stale(&bench.evaluate()), Vec::<String>::new());
}

#[test]
fn parameters_of_a_chosen_snippet_are_resolved() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    bench.set("view", "shading", Value::Text("phong".into()));
    bench.set("view", "shading.ambient", Value::Float(0.5));
    insta::assert_snapshot!(log(&bench.evaluate()).lines().next().unwrap(), @"view [shader]: view.shading changed, the parameters of view changed");
    bench.set("view", "shading.ambient", Value::Float(0.6));
    insta::assert_snapshot!(log(&bench.evaluate()).lines().next().unwrap(), @"view [result]: view.shading.ambient changed");
    // Away and back: the parameter is where it was.
    bench.set("view", "shading", Value::Text("flat".into()));
    assert_eq!(bench.network.value("view", "shading.ambient"), None);
    bench.set("view", "shading", Value::Text("phong".into()));
    assert_eq!(bench.network.value("view", "shading.ambient"), Some(Value::Float(0.6)));
    assert!(bench.evaluate().runs.is_empty());
}

#[test]
fn a_run_can_be_asked_for_and_a_renamed_processor_keeps_its_result() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    bench.evaluator.invalidate("data", Level::Parameters, "the file changed on disk");
    let report = bench.evaluate();
    insta::assert_snapshot!(log(&report).lines().next().unwrap(), @"data [parameters]: the file changed on disk");
    assert_eq!(report.runs.len(), 5);
    bench.network.rename("view", "rays").unwrap();
    bench.evaluator.rename("view", "rays");
    assert!(bench.evaluate().runs.is_empty());
}

/// Three volumes mixed on a canvas, wired in the order given.
fn mixture(order: [&str; 3]) -> Network {
    let mut network = Network::new(crate::fake::registry());
    for id in ["a", "b", "c"] {
        network.add("generator", id).unwrap();
    }
    for (type_id, id) in [("mixture", "mix"), ("canvas", "canvas")] {
        network.add(type_id, id).unwrap();
    }
    for id in order {
        network.connect((id, "volume"), ("mix", "volumes")).unwrap();
    }
    network.connect(("mix", "image"), ("canvas", "image")).unwrap();
    network
}

#[test]
fn the_order_in_which_wires_were_made_changes_nothing() {
    let mut bench = Bench::new(mixture(["b", "c", "a"]));
    bench.evaluate();
    let fed = ["a.volume -> volumes", "b.volume -> volumes", "c.volume -> volumes"];
    assert_eq!(bench.backend.fed["mix"], fed);
    for order in [["a", "b", "c"], ["c", "b", "a"], ["c", "a", "b"]] {
        bench.network = mixture(order);
        assert!(bench.evaluate().runs.is_empty(), "{order:?}");
    }
    assert!(bench.network.disconnect(("b", "volume"), ("mix", "volumes")));
    insta::assert_snapshot!(log(&bench.evaluate()), @r"
    mix [ports]: input `volumes` now comes from a.volume, c.volume
    canvas [result]: input `image` changed (mix ran)
    ");
    assert_eq!(bench.backend.fed["mix"], [fed[0], fed[2]]);
    assert_eq!(bench.evaluator.inputs(&bench.network, "mix", "volumes").count(), 2);
    bench.network.connect(("b", "volume"), ("mix", "volumes")).unwrap();
    assert_eq!(bench.evaluate().ran(), ["mix", "canvas"]);
    assert_eq!(bench.backend.fed["mix"], fed);
}

#[test]
fn every_one_of_several_connections_must_hold_data_that_fits() {
    let mut bench = Bench::new(mixture(["c", "b", "a"]));
    for (id, channels) in [("b", 2), ("c", 3)] {
        bench.set(id, "channels", Value::Int(channels));
    }
    insta::assert_snapshot!(bench.evaluate().not_ready["mix"].join("\n"), @r"
    mix: input `volumes` needs a volume with one channel from b.volume
    mix: input `volumes` needs a volume with one channel from c.volume
    ");
    bench.set("c", "channels", Value::Int(1));
    assert!(bench.network.disconnect(("b", "volume"), ("mix", "volumes")));
    assert!(bench.evaluate().is_complete());
    assert_eq!(bench.backend.fed["mix"], ["a.volume -> volumes", "c.volume -> volumes"]);
}

#[test]
fn layers_arrive_sorted_by_what_they_come_from() {
    let mut network = pipeline();
    network.add("compositor", "over").unwrap();
    network.add("preview", "side").unwrap();
    network.connect(("data", "volume"), ("side", "volume")).unwrap();
    network.disconnect(("filter", "image_out"), ("canvas", "image"));
    network.connect(("side", "image"), ("over", "layers")).unwrap();
    network.connect(("view", "image"), ("over", "layers")).unwrap();
    network.connect(("over", "image"), ("canvas", "image")).unwrap();
    let mut bench = Bench::new(network);
    assert!(!bench.evaluate().ran().contains(&"filter"));
    let how = &bench.evaluator.output("over", "image").unwrap().how;
    assert_eq!(how, "over(side(data()), view(proxy(data()), data()))");
}

#[test]
fn an_interrupted_evaluation_keeps_what_ran_and_goes_on_where_it_was() {
    let mut bench = Bench::new(pipeline());
    bench.evaluate();
    bench.evaluator.invalidate("view", Level::Result, "the disk changed");
    bench.set("data", "channels", Value::Int(1));
    bench.set("data", "extent", Value::Vector(vec![2.0; 3]));
    bench.backend.interrupt = Some("view".into());
    let report = bench.evaluate();
    assert!(report.interrupted && !report.is_complete());
    assert_eq!(report.ran(), ["data", "proxy"]);
    assert!(report.failed.is_empty() && report.not_ready.is_empty(), "{report:?}");
    assert!(bench.evaluator.last_run("view").is_some_and(|run| run.outcome == Outcome::Done));

    (bench.backend.interrupt, bench.backend.interrupted) = (None, false);
    let report = bench.evaluate();
    assert_eq!(report.ran(), ["view", "filter", "canvas"]);
    assert!(report.runs[0].why().contains("the disk changed"), "{}", report.runs[0].why());
    assert!(report.is_complete() && bench.evaluate().runs.is_empty());
}

#[test]
fn a_first_result_is_passed_on_and_refined_by_further_evaluations() {
    let mut bench = Bench::new(pipeline());
    bench.backend.steps = [("view".to_owned(), 3)].into();
    let first = bench.evaluate();
    assert_eq!(first.ran(), ["data", "proxy", "view", "filter", "canvas"]);
    let expected = Unfinished { share: 1.0 / 3.0, message: "step 1 of 3".into() };
    assert_eq!(first.unfinished, [("view".to_owned(), expected)].into());
    assert!(!first.is_complete() && bench.evaluator.output("filter", "image_out").is_some());
    let second = bench.evaluate();
    insta::assert_snapshot!(log(&second), @r"
    view [result]: refines its first result
    filter [result]: input `image` changed (view ran)
    canvas [result]: input `image` changed (filter ran)
    ");
    assert_eq!(second.unfinished["view"].message, "step 2 of 3");
    // A change begins anew.
    bench.set("view", "rate", Value::Float(2.0));
    let third = bench.evaluate();
    assert!(third.runs[0].why().contains("view.rate changed") && !third.runs[0].why().contains("refines"));
    assert_eq!(third.unfinished["view"].message, "step 1 of 3");
    // What nothing needs is not refined, and is told to be outdated.
    let elsewhere = Request { sinks: Sinks::Only(Vec::new()), ..Request::default() };
    let report = bench.with(&elsewhere);
    assert!(report.runs.is_empty() && report.unfinished.is_empty() && report.stale.contains("view"), "{report:?}");
    let last = bench.evaluator.finish(&bench.network, &mut bench.backend, &Request::default());
    assert_eq!(last.ran(), ["view", "filter", "canvas", "view", "filter", "canvas"]);
    assert!(last.is_complete() && bench.evaluate().runs.is_empty());
}

#[test]
fn finishing_waits_for_every_one_that_refines() {
    let mut bench = Bench::new(pipeline());
    bench.backend.steps = [("data".to_owned(), 2), ("view".to_owned(), 3)].into();
    let report = bench.evaluator.finish(&bench.network, &mut bench.backend, &Request::default());
    assert!(report.is_complete());
    // The view begins anew with the final data.
    assert_eq!((bench.backend.runs["data"], bench.backend.runs["view"]), (2, 4));
    assert_eq!(report.runs.len(), 2 + 2 + 4 + 4 + 4);
}

#[test]
fn an_interrupted_refinement_is_made_up_for_and_one_without_progress_fails() {
    let mut bench = Bench::new(pipeline());
    bench.backend.steps = [("view".to_owned(), 2)].into();
    bench.evaluate();
    bench.backend.interrupt = Some("view".into());
    let report = bench.evaluator.finish(&bench.network, &mut bench.backend, &Request::default());
    assert!(report.interrupted && report.runs.is_empty());
    (bench.backend.interrupt, bench.backend.interrupted) = (None, false);
    assert_eq!(bench.evaluate().ran(), ["view", "filter", "canvas"]);
    assert!(bench.evaluate().is_complete());

    bench.backend.stuck = true;
    bench.set("view", "rate", Value::Float(3.0));
    let report = bench.evaluator.finish(&bench.network, &mut bench.backend, &Request::default());
    insta::assert_snapshot!(report.failed["view"], @"it says that 0.5 of its work is done after 0.5, which comes to no end");
}
