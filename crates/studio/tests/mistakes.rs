//! A mistake in a shader is told, the last good picture stays, and mending it makes a new one.

mod window;

use rayloom_network::{EditError, Network};
use rayloom_studio::{Session, Studio};
use serde_json::json;

fn set(session: &mut Session, property: &'static str, value: &str) {
    let set = |network: &mut Network| -> Result<(), EditError> {
        network.set_from_json("traversal", property, &json!(value)).map(|_| ())
    };
    assert!(session.edit("set", set), "{:?}", session.messages);
}

fn failed(studio: &Studio) -> bool {
    studio.session.engine.results.report.failed.contains_key("traversal")
}

#[test]
fn a_broken_snippet_keeps_the_last_good_picture_until_it_is_mended() {
    let mut harness = window::studio(window::flagship());
    window::wait_until(&mut harness, |studio| studio.session.engine.results.canvases.contains_key("canvas"));
    set(
        &mut harness.state_mut().session,
        "shading.text",
        "//! slot: shading\nfn shade(medium: vec4f, surface: Surface) -> vec4f { return medum; }\n",
    );
    window::wait_until(&mut harness, failed);
    let results = &harness.state().session.engine.results;
    assert!(results.report.failed["traversal"].message.contains("edited/shading.wgsl:2:"));
    assert!(results.canvases.contains_key("canvas"), "the last good picture is gone");
    set(&mut harness.state_mut().session, "shading.text", "");
    window::wait_until(&mut harness, |studio| !failed(studio) && !studio.session.engine.is_busy());
    assert!(harness.state().session.engine.results.report.is_complete());
}
