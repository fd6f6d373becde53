//! Network files: what is kept, what is left out, and what a failed save leaves behind.

use std::fs;
use std::path::Path;

use rayloom_network::*;
use serde_json::json;

use crate::fake::{pipeline, registry, registry_without};

fn load(text: &str) -> Loaded {
    Network::from_text(text, Path::new("/nets/some.json"), &registry()).unwrap()
}

fn warnings(loaded: &Loaded) -> String {
    loaded.warnings.iter().map(|warning| format!("{warning}\n")).collect()
}

#[test]
fn version_1_loads_as_it_always_did_and_saves_byte_for_byte() {
    let text = include_str!("../fixtures/v1.json");
    let loaded = load(text);
    assert_eq!(loaded.warnings, []);
    let network = loaded.network;
    assert_eq!(network.value("head", "file"), Some(Value::Text("/data/head.nrrd".into())));
    assert_eq!(network.value("view", "shading.ambient"), Some(Value::Float(0.4)));
    assert_eq!(network.value("view", "shading.shininess"), Some(Value::Float(20.0)));
    assert_eq!(network.processor("head").unwrap().label(), Some("The head"));
    assert_eq!(network.connections().len(), 7);
    assert_eq!(network.to_text(Some(Path::new("/nets"))), text);
}

#[test]
fn frames_come_back_byte_for_byte_and_those_without_a_size_are_refused() {
    let text = include_str!("../fixtures/v1_frames.json");
    let mut network = load(text).network;
    assert_eq!(network.frames()[0].text, "Any volume does.\nThis one has a closed form.");
    assert_eq!(network.to_text(None), text);
    let flat = Frame { title: "Flat".into(), rect: [0.0, 0.0, 10.0, 0.0], ..Frame::default() };
    insta::assert_snapshot!(network.set_frames(vec![flat]).unwrap_err(), @"the frame `Flat` has no size or is not finite; give a place, and a width and height above 0.");
    assert_eq!(network.frames().len(), 2);
    let error =
        Network::from_text(&text.replace("100, 100]", "100, -1]"), Path::new("x.json"), &registry()).unwrap_err();
    insta::assert_snapshot!(error, @"x.json: frames[1].rect: found [300,0,100,-1], expected [left, top, width, height], the last two above 0.");
}

#[test]
fn several_connections_into_an_inport_come_back_byte_for_byte_and_none_twice() {
    let text = include_str!("../fixtures/v1_several.json");
    let loaded = load(text);
    assert_eq!(loaded.warnings, []);
    assert_eq!(loaded.network.to_text(None), text);
    let sources: Vec<String> =
        loaded.network.inputs_in_order("mix").iter().map(|connection| connection.from.to_string()).collect();
    assert_eq!(sources, ["bone.volume", "head.volume", "vessels.volume"]);
    let twice = text.replace("bone.volume -> mix", "head.volume -> mix");
    let error = Network::from_text(&twice, Path::new("x.json"), &registry()).unwrap_err();
    insta::assert_snapshot!(error, @r#"x.json: connections[2]: found "head.volume -> mix.volumes" (head.volume and mix.volumes are already connected), expected a connection that fits."#);
}

#[test]
fn defaults_are_left_out() {
    let mut network = pipeline();
    network.set_property("view", "rate", Value::Float(2.0)).unwrap();
    network.set_property("view", "rate", Value::Float(1.0)).unwrap();
    insta::assert_snapshot!(network.to_text(None), @r#"
    {
      "rayloom": 1,
      "processors": [
        {"id": "data", "type": "generator"},
        {"id": "proxy", "type": "proxy"},
        {"id": "view", "type": "traversal"},
        {"id": "filter", "type": "filter"},
        {"id": "canvas", "type": "canvas"}
      ],
      "connections": [
        "data.volume -> proxy.volume",
        "data.volume -> view.volume",
        "proxy.geometry -> view.geometry",
        "view.image -> filter.image",
        "filter.image_out -> canvas.image"
      ]
    }
    "#);
}

#[test]
fn unknown_types_are_kept_whole() {
    let text = r#"{
  "rayloom": 1,
  "processors": [
    {"id": "data", "type": "generator"},
    {
      "id": "magic",
      "type": "preview",
      "properties": {"rate": 2, "spell": {"a": [1, 2], "b": null}},
      "position": [1, 2],
      "future": true
    },
    {"id": "canvas", "type": "canvas"}
  ],
  "connections": [
    "data.volume -> magic.anything",
    "magic.image -> canvas.image"
  ],
  "links": [
    ["magic.rate", "canvas.size"]
  ]
}
"#;
    let loaded = Network::from_text(text, Path::new("x.json"), &registry_without("preview")).unwrap();
    insta::assert_snapshot!(warnings(&loaded), @r"
    processors[1]: the processor type `preview` is unknown; `magic` is kept as it is but cannot run. There are: `canvas`, `compositor`, `filter`, `generator`, `mixture`, `proxy`, `source`, `traversal`.
    links[0]: there is no magic.rate now; the link is kept but does nothing.
    ");
    let mut network = loaded.network;
    assert_eq!(network.to_text(None), text);
    assert!(network.processor("magic").unwrap().is_placeholder());
    insta::assert_snapshot!(network.set_from_json("magic", "rate", &json!(1)).unwrap_err(), @"`magic` is of the unknown type `preview`, so its properties cannot be changed.");
    insta::assert_snapshot!(format!("{:?}", readiness(&network, "canvas")), @r#"NotReady(["canvas waits for magic.image; magic: its type `preview` is not known here"])"#);
}

#[test]
fn unknown_properties_are_kept_with_a_warning() {
    let text = r#"{
  "rayloom": 1,
  "processors": [
    {
      "id": "view",
      "type": "traversal",
      "properties": {"rtae": 3, "shading": "phong", "shading.ambient": 7, "shading.gloss": [1]}
    }
  ],
  "connections": []
}
"#;
    let loaded = load(text);
    insta::assert_snapshot!(warnings(&loaded), @r"
    processors[0].properties.rtae: `view` (a traversal) has no property `rtae`; it is kept but does nothing. Did you mean `rate`?
    processors[0].properties.shading.ambient: found 7, expected a number from 0 to 1. It is kept, and the default is used.
    processors[0].properties.shading.gloss: `view` (a traversal) has no property `shading.gloss`; it is kept but does nothing. Did you mean `shading`?
    ");
    assert_eq!(loaded.network.value("view", "shading.ambient"), Some(Value::Float(0.2)));
    assert_eq!(loaded.network.to_text(None), text);
}

#[test]
fn linked_properties_that_differ_are_made_equal_with_a_warning() {
    let loaded = load(
        r#"{"rayloom": 1, "processors": [
            {"id": "a", "type": "preview", "properties": {"rate": 2}}, {"id": "b", "type": "preview"}
        ], "links": [["a.rate", "b.rate"]]}"#,
    );
    insta::assert_snapshot!(warnings(&loaded), @"links[0]: the linked properties differ; b.rate takes the value of a.rate.");
    assert_eq!(loaded.network.value("b", "rate"), Some(Value::Float(2.0)));
}

#[test]
fn saving_is_atomic_and_paths_are_relative() {
    let folder = tempfile::tempdir().unwrap();
    let nets = folder.path().join("nets");
    fs::create_dir(&nets).unwrap();
    let file = nets.join("n.json");
    let mut network = Network::new(registry());
    network.add("source", "source").unwrap();
    let data = folder.path().join("data").join("head.nrrd");
    network.set_property("source", "file", Value::Text(data.to_string_lossy().into())).unwrap();
    network.save(&file).unwrap();
    let text = fs::read_to_string(&file).unwrap();
    assert!(text.contains(r#""file": "../data/head.nrrd""#), "{text}");
    let again = Network::load(&file, &registry()).unwrap().network;
    assert_eq!(again.value("source", "file"), network.value("source", "file"));
    again.save(&file).unwrap();
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    assert_eq!(fs::read_dir(&nets).unwrap().count(), 1, "nothing is left beside the file");

    let missing = nets.join("none").join("n.json");
    let error = network.save(&missing).unwrap_err().to_string();
    assert!(error.contains("none") && error.contains("cannot be saved"), "{error}");
    // A folder in place of the file: refused, and nothing is left behind.
    assert!(network.save(&nets).is_err());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_missing_file_is_named() {
    let error = Network::load(Path::new("/nowhere/x.json"), &registry()).unwrap_err();
    insta::assert_snapshot!(error, @"/nowhere/x.json: the network cannot be read: No such file or directory (os error 2).");
}

/// A cycle is found although it is looked for once, and the connection that closes it is the one that is named.
#[test]
fn the_connection_that_closes_a_cycle_is_named() {
    let processors: Vec<_> = (0..5).map(|i| json!({"id": format!("c{i}"), "type": "compositor"})).collect();
    let connection = |from: usize, to: usize| json!(format!("c{from}.image -> c{to}.layers"));
    let ends = [(3, 4), (2, 3), (1, 2), (0, 1), (3, 1), (4, 0), (0, 2)];
    let connections: Vec<_> = ends.into_iter().map(|(from, to)| connection(from, to)).collect();
    let text = json!({"rayloom": 1, "processors": processors, "connections": connections}).to_string();
    let error = Network::from_text(&text, Path::new(""), &registry()).expect_err("a cycle").to_string();
    insta::assert_snapshot!(error, @r#": connections[4]: found "c3.image -> c1.layers" (the connection would close a cycle: c1 -> c2 -> c3 -> c1), expected a connection that fits."#);
}

/// The way to a cause is told by its ends, however long it is, and the order does not depend on how the file is sorted.
#[test]
fn long_ways_to_a_cause_are_shortened() {
    let mut network = Network::new(registry());
    network.add("canvas", "canvas").unwrap();
    for i in (0..100).rev() {
        network.add("filter", &format!("f{i}")).unwrap();
    }
    network.connect(("f99", "image_out"), ("canvas", "image")).unwrap();
    for i in 1..100 {
        let (from, to) = (format!("f{}", i - 1), format!("f{i}"));
        network.connect((from.as_str(), "image_out"), (to.as_str(), "image")).unwrap();
    }
    let expected: Vec<String> = (0..100).map(|i| format!("f{i}")).chain(["canvas".into()]).collect();
    assert_eq!(network.order(), expected);
    let Readiness::NotReady(reasons) = readiness(&network, "canvas") else { panic!("nothing feeds f0") };
    insta::assert_snapshot!(reasons.join("\n"), @"canvas waits for f99.image_out; f99 waits for f98.image_out; f98 waits for f97.image_out; ... (94 further processors wait); f3 waits for f2.image_out; f2 waits for f1.image_out; f1 waits for f0.image_out; f0: input `image` is not connected");
}
