//! Malformed files: always an error that names the file and the place, never a panic, never a half-loaded network.

use std::path::Path;

use proptest::prelude::*;
use rayloom_network::*;

use crate::fake::registry;

fn load(text: &str) -> Result<Loaded, LoadError> {
    Network::from_text(text, Path::new("n.json"), &registry())
}

fn error(text: &str) -> String {
    match load(text) {
        Ok(_) => panic!("loaded although malformed: {text}"),
        Err(error) => error.to_string(),
    }
}

/// A network with one processor of a type.
fn one(type_id: &str, properties: &str) -> String {
    format!(r#"{{"rayloom": 1, "processors": [{{"id": "x", "type": "{type_id}", "properties": {properties}}}]}}"#)
}

/// A view and a canvas with these connections and links.
fn wired(connections: &str, links: &str) -> String {
    format!(
        r#"{{"rayloom": 1, "processors": [
            {{"id": "data", "type": "generator"}}, {{"id": "view", "type": "traversal"}}, {{"id": "side", "type": "preview"}},
            {{"id": "canvas", "type": "canvas"}}, {{"id": "f", "type": "filter"}}, {{"id": "g", "type": "filter"}}
        ], "connections": {connections}, "links": {links}}}"#
    )
}

#[test]
fn the_texts_of_errors() {
    insta::assert_snapshot!(error("{\n  \"rayloom\": 1,\n  \"processors\": [}\n"), @"n.json:3:18: this is not JSON: expected value.");
    insta::assert_snapshot!(error(r#"{"rayloom": 1, "rayloom": 1}"#), @"n.json:1:24: this is not JSON: the field `rayloom` appears twice in one object.");
    insta::assert_snapshot!(error(r#"{"rayloom": 2, "anything": "goes"}"#), @"n.json: the network is in format version 2, but this Rayloom reads versions up to 1; open it with a newer one.");
    insta::assert_snapshot!(error(r#"{"processors": []}"#), @"n.json: found no field `rayloom`, expected one with the format version, which is 1 now.");
    insta::assert_snapshot!(error(r#"{"rayloom": 1, "processors": [], "conections": []}"#), @"n.json: conections: found an unknown field, expected a known one. Did you mean `connections`?");
    insta::assert_snapshot!(error(&one("traversal", r#"{"rate": 99}"#)), @"n.json: processors[0].properties.rate: found 99, expected a number from 0.1 to 16 samples per voxel.");
    insta::assert_snapshot!(error(&one("traversal", r#"{"camera": {"position": [0, 0, 0], "focus": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 30}}"#)), @"n.json: processors[0].properties.camera.position: found a camera that forms no image (the camera's position and focus are the same point, so it looks nowhere; move one of them), expected a valid camera.");
    insta::assert_snapshot!(error(&wired(r#"["data.volume -> canvas.image"]"#, "[]")), @r#"n.json: connections[0]: found "data.volume -> canvas.image" (data.volume gives a volume, but canvas.image takes an image of colour or an image of depth), expected a connection that fits."#);
    insta::assert_snapshot!(error(&wired(r#"["f.image_out -> g.image", "g.image_out -> f.image"]"#, "[]")), @r#"n.json: connections[1]: found "g.image_out -> f.image" (the connection would close a cycle: f -> g -> f), expected a connection that fits."#);
    insta::assert_snapshot!(error(&wired("[]", r#"[["view.rate", "view.camera"]]"#)), @r#"n.json: links[0]: found "view.rate = view.camera" (view.rate is a number in samples per voxel, but view.camera is a camera; only properties of the same kind can be linked), expected a link that fits."#);
}

#[test]
fn every_malformed_file_is_refused_with_its_name_and_place() {
    let mut seen = 0;
    let mut check = |text: &str, place: &str| {
        let message = error(text);
        assert!(message.starts_with("n.json") && message.contains(place), "`{place}` is not in: {message}\nfor {text}");
        seen += 1;
    };
    // Not JSON at all, or not whole.
    for text in [
        "",
        " ",
        "{",
        "[",
        "nul",
        "{\"rayloom\": 1",
        "{'rayloom': 1}",
        "{\"rayloom\": 1,}",
        "{\"rayloom\": 01}",
        "\u{0}",
        "{\"rayloom\": 1} x",
        "{\"rayloom\": 1e999}",
        "{\"a\": \"\\ud800\"}",
        "{\"rayloom\": NaN}",
        "// {}\n{}",
    ] {
        check(text, "this is not JSON");
    }
    check(&"[".repeat(100_000), "recursion limit");
    // The document.
    for text in ["null", "1", "\"x\"", "[]", "true", "[1, {\"rayloom\": 1}]"] {
        check(text, "expected an object");
    }
    for version in ["0", "-1", "1.5", "\"1\"", "null", "[]", "true", "1e300"] {
        check(&format!("{{\"rayloom\": {version}, \"processors\": []}}"), "rayloom: found");
    }
    for (field, value) in
        [("name", "1"), ("description", "[]"), ("connections", "{}"), ("links", "\"x\""), ("name", "null")]
    {
        check(
            &format!("{{\"rayloom\": 1, \"processors\": [], \"{field}\": {value}}}"),
            &format!("n.json: {field}: found"),
        );
    }
    check("{\"rayloom\": 1}", "no field `processors`");
    check("{\"rayloom\": 1, \"processors\": {}}", "processors: found an object");
    // Processors.
    for (processor, place) in [
        ("1", "processors[0]: found 1"),
        ("null", "processors[0]: found null"),
        ("{}", "processors[0]: found no field `type`"),
        (r#"{"id": "x"}"#, "processors[0]: found no field `type`"),
        (r#"{"type": "filter"}"#, "processors[0]: found no field `id`"),
        (r#"{"id": 1, "type": "filter"}"#, "processors[0].id: found 1"),
        (r#"{"id": "", "type": "filter"}"#, "processors[0].id: found \"\""),
        (r#"{"id": "a.b", "type": "filter"}"#, "processors[0].id"),
        (r#"{"id": "a b", "type": "filter"}"#, "processors[0].id"),
        (r#"{"id": "x", "type": 7}"#, "processors[0].type: found 7"),
        (r#"{"id": "x", "type": "filter", "extra": 1}"#, "processors[0].extra"),
        (r#"{"id": "x", "type": "filter", "label": 1}"#, "processors[0].label"),
        (r#"{"id": "x", "type": "filter", "position": [1]}"#, "processors[0].position: found an array of 1"),
        (r#"{"id": "x", "type": "filter", "position": [1, null]}"#, "processors[0].position[1]: found null"),
        (r#"{"id": "x", "type": "filter", "position": "left"}"#, "processors[0].position"),
        (r#"{"id": "x", "type": "filter", "properties": []}"#, "processors[0].properties: found an array"),
        (r#"{"id": "x", "type": "gone", "properties": 3}"#, "processors[0].properties: found 3"),
        (r#"{"id": "x", "type": "filter"}, {"id": "x", "type": "proxy"}"#, "processors[1].id: found `x` a second time"),
    ] {
        check(&format!("{{\"rayloom\": 1, \"processors\": [{processor}]}}"), place);
    }
    // Values of every kind.
    for (type_id, property, value) in [
        ("traversal", "rate", "\"1\""),
        ("traversal", "rate", "0"),
        ("traversal", "rate", "null"),
        ("traversal", "early", "1"),
        ("traversal", "shading", "true"),
        ("traversal", "tint", "\"red\""),
        ("traversal", "tint", "[1, 2]"),
        ("traversal", "tint", "[1, 2, 3]"),
        ("traversal", "tint", "[1, \"0\", 1, 1]"),
        ("traversal", "camera", "{}"),
        ("traversal", "camera", "[0, 0, 1]"),
        ("traversal", "transfer", "{\"knots\": 1}"),
        ("traversal", "transfer", "[]"),
        ("traversal", "transfer", "{\"knots\": [{\"at\": 1, \"color\": [1, 1, 1], \"opacity\": 2}]}"),
        ("traversal", "light", "{\"space\": \"moon\", \"direction\": [0, 0, 1], \"color\": [1, 1, 1]}"),
        ("traversal", "light", "{\"space\": \"camera\", \"direction\": [0, 0, 0], \"color\": [1, 1, 1]}"),
        ("traversal", "light", "{\"space\": \"camera\", \"direction\": [0, 0, 1], \"color\": [1, -1, 1]}"),
        ("generator", "channels", "0"),
        ("generator", "channels", "1.5"),
        ("generator", "channels", "1e30"),
        ("generator", "extent", "[1, 1]"),
        ("generator", "extent", "[1, 1, -1]"),
        ("source", "file", "7"),
        ("source", "precision", "\"9-bit\""),
        ("canvas", "size", "[0, 0]"),
        ("canvas", "size", "[1e9, 1]"),
    ] {
        check(&one(type_id, &format!("{{\"{property}\": {value}}}")), &format!("processors[0].properties.{property}"));
    }
    // Cameras.
    let camera = |change: &str| {
        one(
            "traversal",
            &format!(r#"{{"camera": {{"position": [0, 1, 0], "focus": [0, 0, 0], "up": [0, 0, 1], {change}}}}}"#),
        )
    };
    for (change, place) in [
        ("\"fov_degrees\": 0", "camera.fov_degrees"),
        ("\"fov_degrees\": 180", "camera.fov_degrees"),
        ("\"fov_degrees\": \"wide\"", "camera.fov_degrees"),
        ("\"orthographic_height\": -3", "camera.orthographic_height"),
        ("\"fov_degrees\": 30, \"orthographic_height\": 3", "one of them"),
        ("\"near\": 1", "one of them"),
        ("\"fov_degrees\": 30, \"near\": -1", "camera.near"),
        ("\"fov_degrees\": 30, \"roll\": 1", "camera.roll"),
    ] {
        check(&camera(change), place);
    }
    // Connections and links.
    for (connection, place) in [
        ("1", "connections[0]: found 1"),
        ("\"\"", "connections[0]"),
        ("\"data.volume\"", "connections[0]"),
        ("\"data.volume > view.volume\"", "connections[0]"),
        ("\"data -> view\"", "connections[0]"),
        ("\"nobody.volume -> view.volume\"", "no processor `nobody`"),
        ("\"data.volume -> nobody.volume\"", "no processor `nobody`"),
        ("\"data.picture -> view.volume\"", "no outport `picture`"),
        ("\"data.volume -> view.picture\"", "no inport `picture`"),
        ("\"view.image -> view.volume\"", "cannot feed itself"),
        ("\"view.depth -> f.image\"", "an image of depth"),
        ("\"data.volume -> view.volume\", \"data.volume -> view.volume\"", "connections[1]"),
        ("\"view.image -> f.image\", \"side.image -> f.image\"", "connections[1]"),
    ] {
        check(&wired(&format!("[{connection}]"), "[]"), place);
    }
    for (link, place) in [
        ("1", "links[0]: found 1"),
        ("[]", "links[0]: found an array of 0"),
        ("[\"view.rate\"]", "links[0]: found an array of 1"),
        ("[\"view.rate\", 1]", "links[0][1]: found 1"),
        ("[\"view.rate\", \"rate\"]", "links[0][1]: found \"rate\""),
        ("[\"nobody.rate\", \"view.rate\"]", "links[0][0]: found \"nobody.rate\""),
        ("[\"view.rate\", \"view.rate\"]", "cannot be linked to itself"),
        ("[\"view.rate\", \"canvas.size\"]", "only properties of the same kind"),
        ("[\"view.rate\", \"side.rate\"], [\"side.rate\", \"view.rate\"]", "links[1]"),
    ] {
        check(&wired("[]", &format!("[{link}]")), place);
    }
    assert!(seen >= 100, "only {seen} files were tried");
}

const FIXTURE: &str = include_str!("../fixtures/v1.json");

/// JSON values that are rarely right.
fn odd() -> impl Strategy<Value = serde_json::Value> {
    use serde_json::{Value as Json, json};
    prop_oneof![
        Just(Json::Null),
        Just(json!(true)),
        Just(json!(-1e308)),
        Just(json!(u64::MAX)),
        Just(json!([])),
        Just(json!({})),
        Just(json!([[[]]])),
        any::<f64>().prop_map(Json::from),
        "\\PC{0,12}".prop_map(Json::from),
    ]
}

/// Replaces the `n`th value of a document, counted depth first.
fn replace(json: &mut serde_json::Value, n: &mut usize, with: &serde_json::Value) {
    if *n == 0 {
        *json = with.clone();
    }
    *n = n.wrapping_sub(1);
    match json {
        serde_json::Value::Array(items) => items.iter_mut().for_each(|item| replace(item, n, with)),
        serde_json::Value::Object(map) => map.values_mut().for_each(|value| replace(value, n, with)),
        _ => {}
    }
}

/// Loads; an error must name the file, and what loads must be whole and save stably.
fn survives(text: &str) -> Result<(), TestCaseError> {
    match load(text) {
        Err(error) => prop_assert!(error.to_string().starts_with("n.json")),
        Ok(loaded) => {
            let saved = loaded.network.to_text(None);
            let again = load(&saved).map_err(|e| TestCaseError::fail(format!("{e}\n{saved}")))?;
            prop_assert_eq!(again.network.to_text(None), saved);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_file_with_one_value_replaced_never_panics(n in 0..160_usize, with in odd()) {
        let mut json: serde_json::Value = serde_json::from_str(FIXTURE).unwrap();
        replace(&mut json, &mut n.clone(), &with);
        survives(&json.to_string())?;
    }

    #[test]
    fn a_file_with_bytes_changed_never_panics(at in 0..FIXTURE.len(), cut in 0..20_usize, insert in "[\\PC]{0,4}") {
        let mut bytes = FIXTURE.as_bytes().to_vec();
        bytes.splice(at..(at + cut).min(FIXTURE.len()), insert.bytes());
        survives(&String::from_utf8_lossy(&bytes))?;
    }
}
