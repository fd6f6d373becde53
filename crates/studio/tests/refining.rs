//! First results on the canvas, and refining them while nothing newer is ordered.

mod window;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use egui_kittest::kittest::Queryable;
use rayloom_network::{Declaration, ImageKind, InportDecl, OutportDecl, Outputs, PortType, ProcessError, Unfinished};
use rayloom_processors::{PlainProcess, Process};
use rayloom_studio::Options;
use serde_json::json;

/// Whether the second half of the sketch may be done.
static OPEN: AtomicBool = AtomicBool::new(false);
/// How often the second half was given up because something newer was ordered.
static GIVEN_UP: AtomicUsize = AtomicUsize::new(0);

/// A processor that passes an image on, at first as a sketch.
fn sketch() -> Vec<Arc<dyn Process>> {
    let color = PortType::Image(ImageKind::Color);
    let declaration = Declaration::new("sketch", "Sketch", "Image")
        .input(InportDecl::new("image", "Image", &[color]))
        .output(OutportDecl::new("drawn", "Drawn", color));
    vec![PlainProcess::shared(declaration, |context, job| {
        let image = job.input("image").cloned().ok_or_else(|| ProcessError::new("no image"))?;
        let mut outputs = Outputs::new().with("drawn", image);
        if !job.refines() {
            outputs.unfinished = Some(Unfinished { share: 0.5, message: "A sketch at first.".into() });
            return Ok(outputs);
        }
        while !OPEN.load(Ordering::Relaxed) {
            if context.interrupted() {
                GIVEN_UP.fetch_add(1, Ordering::Relaxed);
                return Err(ProcessError::new("interrupted"));
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        Ok(outputs)
    })]
}

#[test]
fn a_first_picture_is_shown_and_refined_until_something_newer_is_ordered() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("sketch.json");
    let network = json!({
        "rayloom": 1,
        "processors": [
            {"id": "paper", "type": "background", "position": [0, 0]},
            {"id": "sketch", "type": "sketch", "position": [220, 0]},
            {"id": "canvas", "type": "canvas", "position": [440, 0]},
        ],
        "connections": ["paper.image -> sketch.image", "sketch.drawn -> canvas.image"],
    });
    std::fs::write(&file, network.to_string()).expect("written");
    let options = Options { network: Some(file), more_processors: Some(sketch), ..Options::default() };
    let mut window = window::studio(options);
    window::wait_for(&mut window, "refining sketch: 50 %");
    let results = &window.state().session.engine.results;
    assert!(results.canvases.contains_key("canvas") && results.report.failed.is_empty());
    assert!(window.state().session.engine.is_busy());
    window.run_steps(4);
    window::keep_picture(&mut window, "refining");

    // Something newer ends it at once, and is refined in its turn.
    let turned = |window: &mut egui_kittest::Harness<'static, rayloom_studio::Studio>| {
        let session = &mut window.state_mut().session;
        session.edit("set", |network| network.set_from_json("paper", "mode", &json!("checkerboard")).map(drop))
    };
    assert!(turned(&mut window));
    window::wait_until(&mut window, |studio| {
        let results = &studio.session.engine.results;
        GIVEN_UP.load(Ordering::Relaxed) > 0 && results.runs["paper"].why().contains("paper.mode changed")
    });
    window::wait_for(&mut window, "refining sketch: 50 %");
    OPEN.store(true, Ordering::Relaxed);
    window::wait_until(&mut window, |studio| !studio.session.engine.is_busy());
    let engine = &window.state().session.engine;
    assert!(engine.results.report.is_complete() && engine.refining().is_none());
    assert_eq!(engine.results.runs["sketch"].why(), "refines its first result");
    window.run_steps(2);
    assert!(window.query_by_label("ready").is_some());
}
