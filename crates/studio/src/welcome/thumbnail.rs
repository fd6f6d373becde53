//! Small pictures of networks: rendered once by the evaluator that renders everything, then kept on the disk.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use egui::ColorImage;
use rayloom_network::{Evaluator, Network, PropertyKind, Request, Sinks, Value};
use rayloom_processors::{Data, Picture, Runner, read_picture, write_picture};

use crate::visualization::Application;

/// Width and height, pixels.
pub const SIZE: [u32; 2] = [352, 220];

/// Pixels between the pictures of several canvases.
const GAP: u32 = 4;

/// Where the picture of a network is kept: another network, other data or another program have another name.
pub fn file(network: &Network, cache: &Path) -> PathBuf {
    let mut hasher = DefaultHasher::new();
    (env!("CARGO_PKG_VERSION"), SIZE, GAP, network.to_text(None)).hash(&mut hasher);
    for processor in network.processors() {
        for decl in processor.property_decls() {
            if let (PropertyKind::File { .. }, Some(Value::Text(path))) = (&decl.kind, processor.value(&decl.id)) {
                let facts = std::fs::metadata(path).map(|facts| (facts.len(), facts.modified().ok()));
                facts.ok().hash(&mut hasher);
            }
        }
    }
    cache.join(format!("{:016x}.png", hasher.finish()))
}

/// The picture that is kept.
pub fn load(file: &Path) -> Option<ColorImage> {
    let picture = read_picture(file).ok().filter(|picture| picture.size == SIZE)?;
    Some(image(&picture))
}

/// Renders what the canvases of a network show, side by side, and keeps it in a file. `None` when a canvas has nothing to show.
pub fn render(network: &Network, runner: &mut Runner, file: Option<&Path>) -> Option<ColorImage> {
    let application = Application::of(network).0;
    let canvases = application.shown_canvases(network);
    let columns = (1..).find(|columns| columns * columns >= canvases.len())? as u32;
    let rows = (canvases.len() as u32).div_ceil(columns.max(1)).max(1);
    let cell = [(SIZE[0] + GAP) / columns.max(1) - GAP, (SIZE[1] + GAP) / rows - GAP];
    let request = Request {
        sinks: Sinks::Only(canvases.iter().map(ToString::to_string).collect()),
        sizes: canvases.iter().map(|canvas| (canvas.to_string(), cell)).collect::<BTreeMap<_, _>>(),
        ..Request::default()
    };
    let mut evaluator = Evaluator::new();
    evaluator.finish(network, runner, &request);
    let mut whole = Picture { size: SIZE, pixels: vec![[0.0; 4]; (SIZE[0] * SIZE[1]) as usize], depth: None };
    for (index, canvas) in (0..).zip(&canvases) {
        let Some(Data::Image(shown)) = evaluator.inputs(network, canvas, "image").next() else { return None };
        let part = shown.read_back(&runner.context).ok()?;
        paste(&mut whole, &part, [index % columns * (cell[0] + GAP), index / columns * (cell[1] + GAP)]);
    }
    runner.tidy(|_| false);
    if let Some(file) = file {
        // What cannot be kept is rendered again the next time.
        let _ = file.parent().map(std::fs::create_dir_all);
        let _ = write_picture(file, &whole);
    }
    Some(image(&whole))
}

fn paste(whole: &mut Picture, part: &Picture, [left, top]: [u32; 2]) {
    let [width, height] = [part.size[0].min(whole.size[0] - left), part.size[1].min(whole.size[1] - top)];
    for row in 0..height {
        let (from, to) = ((row * part.size[0]) as usize, ((top + row) * whole.size[0] + left) as usize);
        whole.pixels[to..to + width as usize].copy_from_slice(&part.pixels[from..from + width as usize]);
    }
}

fn image(picture: &Picture) -> ColorImage {
    // Casts saturate.
    let bytes: Vec<u8> = picture.pixels.iter().flatten().map(|value| (value * 255.0).round() as u8).collect();
    ColorImage::from_rgba_premultiplied(picture.size.map(|side| side as usize), &bytes)
}
