//! `explain`.

use serde_json::Value as Json;

use crate::program::rayloom;

#[test]
fn a_saved_network_is_explained() {
    let text = rayloom(["explain", "networks/mip.json", "--size", "24x18"]).output();
    for part in [
        "traversal (ray_traversal)",
        "set        compositing mip, default dvr",
        "default    sampling filtered, ",
        "skipping structure",
        "which needs every sample of the ray",
        "output `image2`",
        "together: ",
    ] {
        assert!(text.contains(part), "no `{part}` in\n{text}");
    }
    let text = rayloom(["explain", "networks/mip.json", "--size", "24x18", "--json"]).output();
    let json: Json = serde_json::from_str(&text).expect("JSON");
    let processors = json["processors"].as_array().expect("processors");
    let traversal = processors.iter().find(|one| one["type"] == "ray_traversal").expect("a traversal");
    let properties = &traversal["properties"];
    assert_eq!(properties["set"]["compositing"], serde_json::json!({"value": "mip", "default": "dvr"}));
    assert_eq!(properties["default"]["sampling"], "filtered");
    let bound =
        |one: &&Json| one["role"] == "bound" && one["what"].as_str().is_some_and(|what| what.starts_with("volume: "));
    let volume = traversal["explanations"].as_array().and_then(|all| all.iter().find(bound)).expect("a volume");
    assert!(volume["bytes"].as_u64() > Some(1_000_000), "{volume}");
}
