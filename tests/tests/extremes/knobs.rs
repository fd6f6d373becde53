//! E10, E56, E69: every property of the ray traversal at the ends of its range: a finite picture, or an error that says what to do; never a
//! panic, a NaN or a hang.

use rayloom_network::{Network, Outcome, PropertyDecl, PropertyKind, Request, Value};
use rayloom_processors::Data;
use rayloom_tests::{Picture, Workbench, root, types};

const SIZE: [u32; 2] = [12, 12];

const SCENE: &str = r#"{
  "rayloom": 1,
  "processors": [
    {"id": "source", "type": "volume_generator", "properties": {"field": "shells", "dims": [8, 6, 7], "extent": [2, 1.5, 1.75]}},
    {"id": "proxy", "type": "cube_proxy"},
    {"id": "view", "type": "entry_exit_points", "properties": {
      "camera": {"position": [3, -4, 2.5], "focus": [0, 0, 0], "up": [0, 0, 1], "fov_degrees": 30}}},
    {"id": "traversal", "type": "ray_traversal"},
    {"id": "canvas", "type": "canvas"}
  ],
  "connections": ["source.volume -> proxy.volume", "proxy.geometry -> view.geometry", "source.volume -> traversal.volume",
    "view.entry -> traversal.entry", "view.exit -> traversal.exit", "traversal.image -> canvas.image"]
}"#;

/// The ends of a property's range, and all its choices.
fn ends(property: &PropertyDecl) -> Vec<Value> {
    match &property.kind {
        PropertyKind::Float { range, .. } => range.map(|end| Value::Float(end.clamp(-1e30, 1e30))).to_vec(),
        // The largest label tables and counts are tested where they belong; here they would only take long.
        PropertyKind::Int { range, .. } => range.map(|end| Value::Int(end.clamp(-1 << 20, 1 << 20))).to_vec(),
        PropertyKind::Bool => vec![Value::Bool(false), Value::Bool(true)],
        PropertyKind::Color => vec![Value::Color([0.0; 4]), Value::Color([1.0; 4])],
        PropertyKind::Choice { choices } => choices.iter().map(|choice| Value::Text(choice.id.clone())).collect(),
        _ => Vec::new(),
    }
}

/// The picture, or the message.
fn outcome(bench: &mut Workbench) -> Result<Picture, String> {
    let request = Request { watch: vec![("traversal", "image").into()], size: Some(SIZE), ..Request::default() };
    let report = bench.evaluate(&request);
    let failed = report.runs.iter().find_map(|run| match &run.outcome {
        Outcome::Failed(error) => Some(error.to_string()),
        Outcome::Done => None,
    });
    match (failed, bench.evaluator.output("traversal", "image")) {
        (Some(error), _) => Err(error),
        (None, Some(Data::Image(image))) => Ok(Picture::of(image, &bench.runner.context.gpu)),
        (None, other) => panic!("neither error nor picture but {other:?}: {report:?}"),
    }
}

#[test]
fn every_number_at_the_ends_of_its_range_gives_a_finite_picture() {
    let scene =
        Network::from_text(SCENE, &root().join("scene.json"), &types()).unwrap_or_else(|error| panic!("{error}"));
    let mut bench = Workbench::new(scene.network);
    let compositings =
        ["dvr", "mida", "isosurface", "isosurfaces", "isosurface_dvr", "attenuated_mip", "sum", "first_hit_normal"];
    let (mut tried, mut refused) = (0, 0);
    for compositing in compositings {
        bench.put("traversal.compositing", compositing.into()).put("traversal.shading", "cook_torrance".into());
        let properties =
            bench.network.processor("traversal").map(|traversal| traversal.property_decls()).unwrap_or_default();
        for property in properties.iter().filter(|property| property.id != "compositing") {
            let before = bench.network.value("traversal", &property.id).expect("declared");
            for value in ends(property) {
                bench.assign("traversal", &property.id, value.clone());
                tried += 1;
                match outcome(&mut bench) {
                    Ok(picture) => {
                        let all_finite = picture.color.iter().flatten().chain(&picture.depth).all(|x| x.is_finite());
                        assert!(all_finite, "{compositing} with {} = {value:?} is not finite", property.id);
                    }
                    Err(message) => {
                        refused += 1;
                        assert!(
                            property.id == "channel" && message.contains("choose a smaller one"),
                            "{} = {value:?}: {message}",
                            property.id
                        );
                    }
                }
            }
            bench.assign("traversal", &property.id, before);
        }
    }
    println!("{tried} values tried, {refused} refused with a reason");
    assert!(tried > 200 && refused == compositings.len());
}
