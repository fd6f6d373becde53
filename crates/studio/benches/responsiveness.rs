//! Prints how well the studio keeps up: pictures a second while the camera is dragged, the longest frame of everything that could
//! hold the window up, what hovering costs, and a large network. A window without a screen, on the real device.
//!
//!     cargo bench -p rayloom-studio --bench responsiveness [drag] [frames] [hovering] [large]

#[path = "../tests/window/mod.rs"]
mod window;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_network::Value;
use rayloom_studio::{Chooser, Mode, Options, Session, Studio};

type Window = Harness<'static, Studio>;

/// Time between two frames of a screen.
const FRAME: Duration = Duration::from_micros(16_667);
/// Pointer positions of the drag.
const MOVES: usize = 240;

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wanted = |name: &str| named.is_empty() || named.iter().any(|wanted| wanted == name);
    if wanted("drag") {
        drag("networks/brain.json", false);
        drag("networks/brain.json", true);
        drag("networks/apps/mri_viewer.json", true);
    }
    if wanted("frames") {
        frames();
    }
    if wanted("hovering") {
        hovering();
    }
    if wanted("large") {
        large_network();
    }
}

fn open(network: &Path, mode: Mode) -> Window {
    let mut window =
        window::studio(Options { network: Some(network.to_owned()), mode: Some(mode), ..Options::default() });
    settle(&mut window);
    window
}

/// Frames until nothing is left to be computed; the longest of them.
fn settle(window: &mut Window) -> Duration {
    let mut longest = Duration::ZERO;
    let mut quiet = 0;
    while quiet < 20 {
        longest = longest.max(step(window));
        quiet = if window.state().session.engine.is_busy() { 0 } else { quiet + 1 };
    }
    longest
}

/// One frame of the window, and the rest of its time; how long it took without painting.
fn step(window: &mut Window) -> Duration {
    let start = Instant::now();
    window.step();
    let took = start.elapsed();
    std::thread::sleep(FRAME.saturating_sub(took));
    took
}

fn press(window: &Window, pos: Pos2, pressed: bool) {
    window.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE });
}

/// What the first canvas shows, to be told from what it showed before.
fn picture(session: &Session) -> Option<(usize, [u32; 2])> {
    let image = session.engine.results.canvases.get("canvas")?;
    Some((Arc::as_ptr(image) as usize, image.size()))
}

/// Drags the camera of the canvas in a window of 1280 x 800 in visualization mode. `painted`: the window is drawn in every frame,
/// on the device that renders the pictures, and read back, as no real window is.
fn drag(network: &str, painted: bool) {
    let mut window = open(&window::project(network), Mode::Visualization);
    let middle = window.get_by_label("canvas canvas").rect().center();
    let full = picture(&window.state().session).map(|(_, size)| size).unwrap_or_default();
    window.hover_at(middle);
    step(&mut window);
    press(&window, middle, true);
    let (mut pictures, mut evaluations, mut frames) = (vec![Instant::now()], Vec::new(), Vec::new());
    let mut paintings = Vec::new();
    let mut runs: BTreeMap<String, Vec<Duration>> = BTreeMap::new();
    let mut last = picture(&window.state().session);
    for number in 0..MOVES {
        let angle = number as f32 / MOVES as f32 * std::f32::consts::TAU;
        window.hover_at(middle + 120.0 * egui::vec2(angle.sin(), 0.5 - 0.5 * angle.cos()));
        let start = Instant::now();
        window.step();
        frames.push(start.elapsed());
        if painted {
            let start = Instant::now();
            window.render().expect("painted");
            paintings.push(start.elapsed());
        }
        std::thread::sleep(FRAME.saturating_sub(start.elapsed()));
        let now = picture(&window.state().session);
        if now.map(|(id, _)| id) != last.map(|(id, _)| id) {
            pictures.push(Instant::now());
            let report = &window.state().session.engine.results.report;
            evaluations.push(report.elapsed);
            for run in &report.runs {
                runs.entry(run.processor.clone()).or_default().push(run.cpu);
            }
            last = now;
        }
    }
    let coarse = last.map(|(_, size)| size).unwrap_or_default();
    press(&window, middle, false);
    let released = Instant::now();
    window.step();
    while picture(&window.state().session).is_none_or(|(_, size)| size != full) {
        step(&mut window);
    }
    let refined = released.elapsed();
    let mut rates: Vec<f64> = pictures.windows(2).map(|pair| 1.0 / (pair[1] - pair[0]).as_secs_f64()).collect();
    rates.sort_by(f64::total_cmp);
    evaluations.sort();
    frames.sort();
    let rate = |part: f64| rates.get((part * rates.len() as f64) as usize).copied().unwrap_or_default();
    println!(
        "{network}{}: {} pictures in {MOVES} frames, {:.1} a second (5 %: {:.1}, 95 %: {:.1}), {coarse:?} of {full:?} pixels; \
         an evaluation {}; full size {} after letting go; the window's thread {} a frame, at most {}",
        if painted { ", painted" } else { "" },
        rates.len(),
        rate(0.5),
        rate(0.05),
        rate(0.95),
        ms(evaluations.get(evaluations.len() / 2).copied().unwrap_or_default()),
        ms(refined),
        ms(frames[frames.len() / 2]),
        ms(frames.last().copied().unwrap_or_default()),
    );
    paintings.sort();
    if let Some(longest) = paintings.last() {
        println!("    painting and reading back {}, at most {}", ms(paintings[paintings.len() / 2]), ms(*longest));
    }
    let median = |mut times: Vec<Duration>| {
        times.sort();
        ms(times[times.len() / 2])
    };
    let runs: Vec<String> = runs.into_iter().map(|(id, times)| format!("{id} {}", median(times))).collect();
    println!("    of an evaluation: {}", runs.join(", "));
}

/// The longest frame of everything that could hold the window up.
fn frames() {
    let folder = std::env::temp_dir().join(format!("rayloom-responsiveness-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    // A copy, because it is saved.
    let text = std::fs::read_to_string(window::project("networks/brain.json")).expect("the flagship");
    let data = window::project("data").canonicalize().expect("the data");
    let brain = folder.join("brain.json");
    std::fs::write(&brain, text.replace("../data", &data.display().to_string())).expect("a copy");
    let chooser = Chooser::new(move |_| Box::pin(std::future::ready(Some(brain.clone()))));
    let mut window = window::studio(Options { chooser, ..Options::default() });
    settle(&mut window);
    let set = |window: &mut Window, property: &str, value: &str| {
        window.state_mut().session.set("traversal", property, Value::Text(value.into()));
    };
    let command = |window: &mut Window, key| window.key_press_modifiers(Modifiers::COMMAND, key);
    measure(&mut window, "opening networks/brain.json", |window| command(window, Key::O));
    measure(&mut window, "selecting the traversal", |window| {
        window.state_mut().session.selection = ["traversal".to_owned()].into();
    });
    measure(&mut window, "another shading", |window| set(window, "shading", "toon"));
    measure(&mut window, "another gradient", |window| set(window, "gradient", "sobel"));
    measure(&mut window, "another compositing", |window| set(window, "compositing", "mip"));
    measure(&mut window, "back to compositing", |window| set(window, "compositing", "dvr"));
    measure(&mut window, "editing a snippet", |window| {
        let source = include_str!("../../../shaders/shading/toon.wgsl").replace("return", "/* edited */ return");
        set(window, "shading.text", &source);
    });
    measure(&mut window, "saving", |window| command(window, Key::S));
    measure(&mut window, "undoing it all", |window| while window.state_mut().session.document.undo() {});
    measure(&mut window, "visualization mode", |window| window.key_press(Key::F5));
    std::fs::remove_dir_all(&folder).expect("removed");
}

fn measure(window: &mut Window, what: &str, act: impl FnOnce(&mut Window)) {
    let start = Instant::now();
    act(window);
    let itself = start.elapsed();
    let longest = settle(window);
    println!("{what}: longest frame {}, settled after {}", ms(itself.max(longest)), ms(start.elapsed()));
}

/// What there is in memory and what runs with and without something under the pointer.
fn hovering() {
    let mut window = open(&window::project("networks/brain.json"), Mode::Development);
    let report = |window: &mut Window, what: &str| {
        let longest = settle(window);
        let mut frames = Vec::new();
        let before = window.state().session.engine.results.number;
        for _ in 0..60 {
            frames.push(step(window));
        }
        frames.sort();
        let session = &window.state().session;
        let (pictures, bytes) = session.display.load();
        let evaluations = session.engine.results.number - before;
        println!(
            "{what}: {pictures} pictures of {:.1} MB, {evaluations} evaluations, frame {} (longest {})",
            bytes as f64 * 1e-6,
            ms(frames[30]),
            ms(longest)
        );
    };
    report(&mut window, "pointer on nothing");
    for (from, to) in [("traversal.image", "background.front"), ("source.volume", "traversal.volume")] {
        let end = |label: String| window.get_by_label(&label).rect().center();
        let middle = end(format!("output {from}")).lerp(end(format!("input {to}")), 0.5);
        window.hover_at(middle);
        report(&mut window, &format!("pointer on the wire from {from}"));
    }
    window.hover_at(Pos2::new(2.0, 2.0));
    report(&mut window, "pointer on nothing again");
}

/// A network of 300 processors and 500 wires, panned and zoomed.
fn large_network() {
    let folder = std::env::temp_dir().join(format!("rayloom-large-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("large.json");
    let node = |i: usize| {
        let position = [(i % 20) * 220, (i / 20) * 140];
        serde_json::json!({"id": format!("n{i}"), "type": "compositor", "position": position})
    };
    let first = (0..299).map(|i| format!("n{i}.image -> n{}.first", i + 1));
    let second = (0..201).map(|i| format!("n{i}.image -> n{}.second", i + 2));
    let network = serde_json::json!({
        "rayloom": 1,
        "processors": (0..300).map(node).collect::<Vec<_>>(),
        "connections": first.chain(second).collect::<Vec<_>>(),
    });
    std::fs::write(&file, network.to_string()).expect("written");
    let mut window = open(&file, Mode::Development);
    let on_canvas = window.get_by_label_contains("processor n150").rect().center();
    window.hover_at(on_canvas);
    for (name, zoom) in [("everything in view", 1.0), ("zoomed in", 4.0)] {
        window.event(Event::Zoom(zoom));
        window.run_steps(5);
        let mut frames: Vec<Duration> = (0..60)
            .map(|frame| {
                let scroll = if frame % 2 == 0 { 9.0 } else { -7.0 };
                window.event(Event::MouseWheel {
                    unit: egui::MouseWheelUnit::Point,
                    delta: egui::Vec2::splat(scroll),
                    phase: egui::TouchPhase::Move,
                    modifiers: Modifiers::NONE,
                });
                step(&mut window)
            })
            .collect();
        frames.sort();
        println!("300 nodes, 500 wires, panned, {name}: {} a frame (95 %: {})", ms(frames[30]), ms(frames[57]));
    }
    std::fs::remove_dir_all(&folder).expect("removed");
}

fn ms(time: Duration) -> String {
    format!("{:.1} ms", time.as_secs_f64() * 1e3)
}
