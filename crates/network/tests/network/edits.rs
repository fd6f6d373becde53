//! Edits are checked when they are made and refused with a sentence.

use crate::fake::{pipeline, registry};
use rayloom_network::*;
use serde_json::json;

fn refusal(network: &mut Network, from: (&str, &str), to: (&str, &str)) -> String {
    let before = network.to_text(None);
    let text = network.connect(from, to).expect_err("must be refused").to_string();
    assert_eq!(network.to_text(None), before, "a refused edit changes nothing");
    text
}

#[test]
fn connections_that_do_not_fit_are_refused_with_the_reason() {
    let n = &mut pipeline();
    n.add("filter", "second").unwrap();
    n.connect(("filter", "image_out"), ("second", "image")).unwrap();
    n.add("compositor", "over").unwrap();
    n.connect(("second", "image_out"), ("over", "layers")).unwrap();
    n.add("filter", "third").unwrap();
    n.connect(("over", "image"), ("third", "image")).unwrap();
    insta::assert_snapshot!(refusal(n, ("data", "volume"), ("canvas", "image")), @"data.volume gives a volume, but canvas.image takes an image of colour or an image of depth.");
    insta::assert_snapshot!(refusal(n, ("view", "depth"), ("filter", "image")), @"view.depth gives an image of depth, but filter.image takes an image of colour.");
    insta::assert_snapshot!(refusal(n, ("third", "image_out"), ("over", "layers")), @"the connection would close a cycle: over -> third -> over.");
    insta::assert_snapshot!(refusal(n, ("filter", "image_out"), ("filter", "image")), @"`filter` cannot feed itself; connect two different processors.");
    insta::assert_snapshot!(refusal(n, ("second", "image_out"), ("over", "layers")), @"second.image_out and over.layers are already connected.");
    insta::assert_snapshot!(refusal(n, ("second", "image_out"), ("canvas", "image")), @"canvas.image is already fed by filter.image_out and takes one connection; disconnect that first.");
    insta::assert_snapshot!(refusal(n, ("dta", "volume"), ("proxy", "volume")), @"there is no processor `dta`. Did you mean `data`?");
    insta::assert_snapshot!(refusal(n, ("view", "imag"), ("canvas", "image")), @"`view` (a traversal) has no outport `imag`. Did you mean `image`?");
    insta::assert_snapshot!(refusal(n, ("view", "image"), ("proxy", "picture")), @"`proxy` (a proxy) has no inport `picture`. There are: `volume`.");
}

#[test]
fn an_inport_for_several_keeps_what_it_has_and_loses_one_at_a_time() {
    let n = &mut pipeline();
    for (type_id, id) in [("generator", "more"), ("mixture", "mix")] {
        n.add(type_id, id).unwrap();
    }
    for source in ["more", "data"] {
        n.connect((source, "volume"), ("mix", "volumes")).unwrap();
    }
    let sources = |n: &Network| n.inputs_in_order("mix").iter().map(|c| c.from.processor.clone()).collect::<Vec<_>>();
    assert_eq!(sources(n), ["data", "more"]);
    insta::assert_snapshot!(refusal(n, ("data", "volume"), ("mix", "volumes")), @"data.volume and mix.volumes are already connected.");
    let before = n.clone();
    assert!(n.disconnect(("data", "volume"), ("mix", "volumes")));
    assert!(!n.disconnect(("data", "volume"), ("mix", "volumes")), "it was there once");
    assert_eq!(sources(n), ["more"]);
    assert!(readiness(n, "mix").is_ready());
    n.remove("more").unwrap();
    insta::assert_snapshot!(format!("{:?}", readiness(n, "mix")), @r#"NotReady(["mix: input `volumes` is not connected"])"#);
    *n = before;
    n.rename("more", "another").unwrap();
    assert_eq!(sources(n), ["another", "data"]);
}

fn set_error(network: &mut Network, processor: &str, property: &str, json: serde_json::Value) -> String {
    let before = network.to_text(None);
    let text = network.set_from_json(processor, property, &json).expect_err("must be refused").to_string();
    assert_eq!(network.to_text(None), before, "a refused edit changes nothing");
    text
}

#[test]
fn values_that_make_no_sense_are_refused_and_the_last_good_one_stays() {
    let n = &mut pipeline();
    insta::assert_snapshot!(set_error(n, "view", "rate", json!(0)), @"view.rate cannot be set: found 0, expected a number from 0.1 to 16 samples per voxel.");
    insta::assert_snapshot!(set_error(n, "view", "rate", json!("fast")), @r#"view.rate cannot be set: found the text "fast", expected a finite number."#);
    insta::assert_snapshot!(set_error(n, "view", "raet", json!(1)), @"`view` (a traversal) has no property `raet`. Did you mean `rate`?");
    insta::assert_snapshot!(set_error(n, "vew", "rate", json!(1)), @"there is no processor `vew`. Did you mean `view`?");
    insta::assert_snapshot!(set_error(n, "view", "shading.ambient", json!(1)), @"`view` (a traversal) has no property `shading.ambient`. Did you mean `shading`?");
    insta::assert_snapshot!(set_error(n, "view", "tint", json!([0, 2, 0])), @"view.tint cannot be set: [1]: found 2, expected a number from 0 to 1.");
    insta::assert_snapshot!(set_error(n, "view", "camera", json!({"fov_degrees": 180})), @"view.camera cannot be set: fov_degrees: found a camera that forms no image (the camera's field of view is 180 degrees; it must be above 0 and below 180), expected a valid camera.");
    insta::assert_snapshot!(set_error(n, "view", "camera", json!({"positon": [0, 0, 1]})), @"view.camera cannot be set: positon: found an unknown field, expected a known one. Did you mean `position`?");
    insta::assert_snapshot!(set_error(n, "view", "light", json!({"direction": [0, 0, 0]})), @"view.light cannot be set: direction: found an impossible light (the light's direction is zero or not finite; give three finite numbers, not all zero), expected a valid light.");
    insta::assert_snapshot!(set_error(n, "canvas", "size", json!([0, 100])), @"canvas.size cannot be set: [0]: found 0, expected a number from 1 to 16384 pixels.");
    insta::assert_snapshot!(set_error(n, "canvas", "size", json!([10.5, 100])), @"canvas.size cannot be set: [0]: found 10.5, expected a whole number.");
    n.add("source", "file").unwrap();
    insta::assert_snapshot!(set_error(n, "file", "precision", json!("8bit")), @"file.precision cannot be set: found `8bit`, expected one of the choices. Did you mean `8-bit`?");
    let nan = n.set_property("view", "rate", Value::Float(f64::NAN)).unwrap_err().to_string();
    insta::assert_snapshot!(nan, @"view.rate cannot be set: found NaN, expected a finite number.");
    let kind = n.set_property("view", "rate", Value::Bool(true)).unwrap_err().to_string();
    insta::assert_snapshot!(kind, @"view.rate cannot be set: found a yes/no value, expected a number.");
}

#[test]
fn a_camera_set_in_part_keeps_the_rest() {
    let mut n = pipeline();
    n.set_from_json("view", "camera", &json!({"position": [0, -80, 10], "orthographic_height": 50})).unwrap();
    let Some(Value::Camera(camera)) = n.value("view", "camera") else { panic!("a camera") };
    assert_eq!(camera.projection, Projection::Orthographic { height: 50.0 });
    assert_eq!(camera.up, Camera::default().up);
    n.set_from_json("view", "light", &json!({"space": "world"})).unwrap();
    let Some(Value::Light(light)) = n.value("view", "light") else { panic!("a light") };
    assert_eq!(light, Light { space: LightSpace::World, ..Light::default() });
}

#[test]
fn links_carry_values_through_chains_and_rings() {
    let mut n = Network::new(registry());
    for id in ["a", "b", "c", "d"] {
        n.add("preview", id).unwrap();
    }
    let rate = |id: &str| Address::new(id, "rate");
    n.set_property("a", "rate", Value::Float(2.0)).unwrap();
    for (a, b) in [("a", "b"), ("b", "c"), ("c", "a")] {
        n.link(rate(a), rate(b)).unwrap();
    }
    assert_eq!(n.value("c", "rate"), Some(Value::Float(2.0)));
    assert_eq!(n.set_property("b", "rate", Value::Float(3.0)).unwrap(), [rate("b"), rate("a"), rate("c")]);
    assert_eq!(n.set_property("c", "rate", Value::Float(3.0)).unwrap(), []);
    assert_eq!(n.value("d", "rate"), Some(Value::Float(1.0)));
    assert!(n.unlink(rate("b"), rate("a")) && n.unlink(rate("c"), rate("a")));
    n.set_property("a", "rate", Value::Float(1.0)).unwrap();
    assert_eq!(n.value("b", "rate"), Some(Value::Float(3.0)));
    n.link(rate("c"), rate("d")).unwrap();
    n.link(rate("d"), rate("a")).unwrap();
    n.unlink(rate("b"), rate("c"));
    n.link(rate("a"), rate("b")).unwrap();
    assert_eq!(n.set_property("c", "rate", Value::Float(0.5)).unwrap().len(), 4);
    assert_eq!(n.value("b", "rate"), Some(Value::Float(0.5)));
    n.remove("d").unwrap();
    assert_eq!(n.links().len(), 1);
}

#[test]
fn links_that_could_not_hold_are_refused() {
    let mut n = pipeline();
    n.add("preview", "side").unwrap();
    let link = |n: &mut Network, a: (&str, &str), b: (&str, &str)| n.link(a, b).unwrap_err().to_string();
    insta::assert_snapshot!(link(&mut n, ("view", "rate"), ("view", "camera")), @"view.rate is a number in samples per voxel, but view.camera is a camera; only properties of the same kind can be linked.");
    insta::assert_snapshot!(link(&mut n, ("data", "extent"), ("canvas", "size")), @"data.extent is a vector of 3 numbers in mm, but canvas.size is a vector of 2 whole numbers in pixels; only properties of the same kind can be linked.");
    insta::assert_snapshot!(link(&mut n, ("view", "rate"), ("view", "rate")), @"view.rate cannot be linked to itself; choose two properties.");
    n.set_property("view", "rate", Value::Float(8.0)).unwrap();
    insta::assert_snapshot!(link(&mut n, ("view", "rate"), ("side", "rate")), @"the value of view.rate does not fit side.rate: found 8, expected a number from 0.1 to 4 samples per voxel. Change it first.");
    n.set_property("view", "rate", Value::Float(4.0)).unwrap();
    n.link(("view", "rate"), ("side", "rate")).unwrap();
    insta::assert_snapshot!(link(&mut n, ("side", "rate"), ("view", "rate")), @"side.rate and view.rate are already linked.");
    insta::assert_snapshot!(set_error(&mut n, "view", "rate", json!(9)), @"view.rate cannot be set: it is linked to side.rate, which refuses the value: found 9, expected a number from 0.1 to 4 samples per voxel.");
}

#[test]
fn readiness_names_the_cause_and_the_way_to_it() {
    let mut n = Network::new(registry());
    for (type_id, id) in [("source", "source"), ("proxy", "proxy"), ("traversal", "view"), ("canvas", "canvas")] {
        n.add(type_id, id).unwrap();
    }
    n.connect(("view", "image"), ("canvas", "image")).unwrap();
    n.connect(("source", "volume"), ("view", "volume")).unwrap();
    n.connect(("proxy", "geometry"), ("view", "geometry")).unwrap();
    let why = |n: &Network| match readiness(n, "canvas") {
        Readiness::Ready => "ready".to_owned(),
        Readiness::NotReady(reasons) => reasons.join("\n"),
    };
    insta::assert_snapshot!(why(&n), @r"
    canvas waits for view.image; view waits for source.volume; source: no file chosen
    canvas waits for view.image; view waits for proxy.geometry; proxy: input `volume` is not connected
    ");
    n.connect(("source", "volume"), ("proxy", "volume")).unwrap();
    insta::assert_snapshot!(why(&n), @"canvas waits for view.image; view waits for source.volume; source: no file chosen");
    n.set_property("source", "file", Value::Text("head.nrrd".into())).unwrap();
    insta::assert_snapshot!(why(&n), @"ready");
}

#[test]
fn ids_are_checked_and_connections_and_links_follow_a_new_one() {
    let mut n = pipeline();
    n.add("preview", "side").unwrap();
    n.link(("view", "camera"), ("side", "camera")).unwrap();
    n.rename("view", "rays").unwrap();
    assert!(n.connections().iter().any(|c| c.to_string() == "rays.image -> filter.image"));
    assert_eq!(n.links()[0].to_string(), "rays.camera = side.camera");
    insta::assert_snapshot!(n.rename("rays", "side").unwrap_err(), @"there is already a processor `side`; choose another id.");
    insta::assert_snapshot!(n.add("filter", "a.b").unwrap_err(), @"`a.b` cannot be an id; use 1 to 64 letters, digits, `_` or `-`.");
    insta::assert_snapshot!(n.add("traversel", "x").unwrap_err(), @"there is no processor type `traversel`. Did you mean `traversal`?");
    assert_eq!(n.free_id("side"), "side_2");
    assert!(n.set_position("side", [f64::NAN, 0.0]).is_err());
}

#[test]
fn a_type_cannot_be_registered_twice_or_with_a_wrong_default() {
    struct Plain(Declaration);
    impl ProcessorType for Plain {
        fn declaration(&self) -> &Declaration {
            &self.0
        }
    }
    let mut registry = Registry::new();
    let plain = || std::sync::Arc::new(Plain(Declaration::new("plain", "Plain", "Test")));
    registry.add(plain()).unwrap();
    insta::assert_snapshot!(registry.add(plain()).unwrap_err(), @"there is already a processor type `plain`; give one of the two another id");
    let rate = PropertyDecl::float("rate", "Rate", 0.0).range(1.0, 2.0);
    let wrong = Plain(Declaration::new("wrong", "Wrong", "Test").property(rate));
    insta::assert_snapshot!(registry.add(std::sync::Arc::new(wrong)).unwrap_err(), @"the declaration of processor type `wrong` is wrong: the default of property `rate`: found 0, expected a number from 1 to 2.");
}

#[test]
fn single_fields_of_cameras_and_lights_can_be_set() {
    let n = &mut pipeline();
    n.set_from_json("view", "camera.fov_degrees", &json!(30)).unwrap();
    n.set_from_json("view", "light.direction", &json!([0, 0, 1])).unwrap();
    let value = |n: &Network, property: &str| n.value("view", property).unwrap().to_json();
    assert_eq!(value(n, "camera")["fov_degrees"], json!(30.0));
    assert_eq!(value(n, "light")["direction"], json!([0.0, 0.0, 1.0]));
    n.set_from_json("view", "camera.orthographic_height", &json!(2)).unwrap();
    assert_eq!(value(n, "camera").get("fov_degrees"), None, "the new projection replaces the old one");
    let camera = Camera::default().to_json();
    for field in camera.as_object().unwrap().keys() {
        let same = camera[field].clone();
        n.set_from_json("view", &format!("camera.{field}"), &same).unwrap_or_else(|error| panic!("{error}"));
    }
    insta::assert_snapshot!(set_error(n, "view", "camera.positon", json!([0, 0, 1])), @"view.camera cannot be set: positon: found an unknown field, expected a known one. Did you mean `position`?");
    insta::assert_snapshot!(set_error(n, "view", "camra.position", json!([0, 0, 1])), @"`view` (a traversal) has no property `camra.position`. There are: `camera`, `light`, `rate`, `transfer`, `tint`, `early`, `shading`.");
}
