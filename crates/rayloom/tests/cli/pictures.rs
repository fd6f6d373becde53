//! `render`, `probe` and `shader`, with the files that they give.

use std::fs;
use std::path::Path;

use rayloom_processors::read_picture;

use crate::program::rayloom;

/// Slices of a generated volume: all that a picture needs and no more.
const SLICE: &str = r#"{"rayloom": 1, "processors": [
    {"id": "source", "type": "volume_generator"},
    {"id": "slice", "type": "slice_view"},
    {"id": "canvas", "type": "canvas", "properties": {"size": [40, 30]}}],
    "connections": ["source.volume -> slice.volume", "slice.image -> canvas.image"]}"#;

/// A ray traversal of a generated volume.
const TRAVERSAL: &str = r#"{"rayloom": 1, "processors": [
    {"id": "source", "type": "volume_generator"},
    {"id": "proxy", "type": "cube_proxy"},
    {"id": "view", "type": "entry_exit_points"},
    {"id": "traversal", "type": "ray_traversal"},
    {"id": "canvas", "type": "canvas", "properties": {"size": [40, 30]}}],
    "connections": ["source.volume -> proxy.volume", "proxy.geometry -> view.geometry", "source.volume -> traversal.volume",
    "view.entry -> traversal.entry", "view.exit -> traversal.exit", "traversal.image -> canvas.image"]}"#;

/// A network file in a folder of its own.
fn network(text: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("network.json");
    fs::write(&file, text).expect("a file in it");
    let file = file.to_str().expect("a path in UTF-8").to_owned();
    (folder, file)
}

fn within(folder: &tempfile::TempDir, name: &str) -> String {
    folder.path().join(name).to_str().expect("a path in UTF-8").to_owned()
}

#[test]
fn every_kind_of_file_has_the_size_of_the_canvas() {
    let (folder, network) = network(SLICE);
    for name in ["a.png", "b.EXR"] {
        let file = within(&folder, name);
        let text = rayloom(["render", &network, "-o", &file]).output();
        assert!(text.contains(&file) && text.contains("40 x 30"), "{text}");
        assert_eq!(read_picture(Path::new(&file)).expect("a picture").size, [40, 30]);
    }
    let file = within(&folder, "c.npy");
    rayloom(["render", &network, "--size", "20x10", "-o", &file]).output();
    let bytes = fs::read(&file).expect("a file");
    let array = npyz::NpyFile::new(&bytes[..]).expect("an array");
    assert_eq!(array.shape(), [10, 20, 4]);
    let pixels: Vec<f32> = array.into_vec().expect("32-bit floats");
    assert!(pixels.iter().any(|&x| x > 0.0) && pixels.iter().all(|x| x.is_finite()));
}

#[test]
fn settings_change_the_picture_and_ports_give_other_images() {
    let (folder, network) = network(TRAVERSAL);
    let render = |name: &str, arguments: &[&str]| {
        let file = within(&folder, name);
        let all = ["render", &network, "-o", &file].into_iter().chain(arguments.iter().copied());
        rayloom(all).output();
        read_picture(Path::new(&file)).expect("a picture").pixels
    };
    let plain = render("plain.exr", &[]);
    let moved = render("moved.exr", &["--set", r#"view.camera={"position": [3, 0.5, 0.2]}"#]);
    let mip = render("mip.exr", &["--set", "traversal.compositing=mip"]);
    let entry = render("entry.exr", &["--port", "view.entry"]);
    let arriving = render("arriving.exr", &["--port", "traversal.entry"]);
    assert!(plain != moved && plain != mip && plain != entry && entry == arriving);
}

#[test]
fn statistics_name_every_run_and_count_samples() {
    let (folder, network) = network(TRAVERSAL);
    let (picture, stats) = (within(&folder, "a.png"), within(&folder, "stats.json"));
    rayloom(["render", &network, "-o", &picture, "--stats", &stats]).output();
    let stats: serde_json::Value = serde_json::from_str(&fs::read_to_string(stats).expect("a file")).expect("JSON");
    let runs = stats["processors"].as_array().expect("a list of runs");
    let ids: Vec<_> = runs.iter().filter_map(|run| run["id"].as_str()).collect();
    assert_eq!(ids[..4], ["source", "proxy", "view", "traversal"]);
    assert!(runs.iter().all(|run| run["reasons"][0] == "first run" && run["cpu_ms"].is_number()));
    let count = |key: &str| stats[key].as_u64().expect("a count");
    assert!(count("rays") > 0 && count("samples") >= count("rays") && count("contributing") <= count("samples"));
    assert!(stats["adapter"].as_str().is_some_and(|adapter| !adapter.is_empty()));
    assert_eq!(stats["size"], serde_json::json!([40, 30]));
}

#[test]
fn the_shader_tells_where_its_parts_come_from() {
    let (_folder, network) = network(TRAVERSAL);
    let shader = |snippet: &str| {
        let setting = format!("traversal.compositing={snippet}");
        rayloom(["shader", &network, "traversal", "--set", &setting]).output()
    };
    let (dvr, mip) = (shader("dvr"), shader("mip"));
    assert!(dvr.contains("// --- compositing/dvr.wgsl:") && dvr.contains("// --- traversal/traversal.wgsl:"), "{dvr}");
    assert!(mip.contains("// --- compositing/mip.wgsl:") && !mip.contains("compositing/dvr.wgsl"), "{mip}");
    let error = rayloom(["shader", &network, "source"]).error();
    assert!(error.contains("ask for `traversal`"), "{error}");
}

#[test]
fn a_probed_ray_is_a_table_of_its_samples() {
    let (folder, network) = network(TRAVERSAL);
    let file = within(&folder, "ray.csv");
    let text = rayloom(["probe", &network, "--pixel", "20,15", "-o", &file]).output();
    let table = fs::read_to_string(&file).expect("a table");
    let mut rows = table.lines();
    let header = rows.next().expect("a header");
    assert!(header.starts_with("sample,distance,x,y,z,value,classified_r"), "{header}");
    assert!(header.ends_with("image_r,image_g,image_b,image_a") && !header.contains("gradient"), "{header}");
    let numbers = |row: &str| row.split(',').map(|cell| cell.parse::<f64>().expect("a number")).collect::<Vec<_>>();
    let rows: Vec<_> = rows.map(numbers).collect();
    assert!(rows.len() > 10 && text.contains(&format!("{} of", rows.len())), "{text}");
    assert!(rows.iter().all(|row| row.len() == header.split(',').count()));
    assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] < pair[1][1]));

    let error = rayloom(["probe", &network, "--pixel", "40,0"]).error();
    assert!(error.contains("no pixel 40,0 in a picture of 40 x 30"), "{error}");
    let error = rayloom(["probe", &network, "--pixel", "1,1", "--processor", "view"]).error();
    assert!(error.contains("`view` is no ray traversal; there are `traversal`"), "{error}");
}

#[test]
fn the_studio_writes_the_very_picture_at_any_size() {
    let (folder, network) = network(TRAVERSAL);
    let (file, other) = (within(&folder, "render.png"), within(&folder, "studio.png"));
    rayloom(["render", &network, "--size", "97x61", "-o", &file]).output();
    let registry = std::sync::Arc::new(rayloom_processors::registry());
    let loaded = rayloom_network::Network::load(Path::new(&network), &registry).expect("a network").network;
    let gpu = rayloom_gpu::Gpu::new(&rayloom_gpu::GpuOptions::default()).expect("a device");
    let mut engine = rayloom_studio::Engine::start(gpu, Vec::new(), || {}).expect("an engine");
    // What the window shows meanwhile has another size and does not matter.
    engine.order(1, &loaded, rayloom_network::Request { size: Some([64, 64]), ..Default::default() }, false);
    let picture = engine.photographer().picture(loaded.clone(), "canvas", [97, 61]).expect("a picture");
    rayloom_processors::write_picture(Path::new(&other), &picture).expect("a file");
    assert_eq!(fs::read(file).expect("a file"), fs::read(other).expect("a file"));
    let refused = engine.photographer().picture(loaded, "view", [97, 61]).expect_err("no canvas");
    assert!(refused.contains("`view` shows nothing"), "{refused}");
}
