//! What the window says about data is what the data is.

mod window;

use std::sync::{Arc, Mutex};

use egui_kittest::kittest::Queryable;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuOptions, PipelineCache};
use rayloom_network::{Address, ImageKind};
use rayloom_processors::{Image, MISS};
use rayloom_studio::{Layer, Look, Statistics, hover, statistics};

/// An image of 37 x 21 pixels: red runs from 0 to 1 along x, green is 2 in one pixel, blue is NaN in three, alpha is 1.
/// Depth runs from 10 to 30 along y; the first column misses.
fn known_image(gpu: &Gpu, kind: ImageKind) -> Image {
    let (width, height) = (37_u32, 21_u32);
    let pixels = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let color = pixels().map(|(x, y)| {
        let green = if (x, y) == (5, 7) { 2.0 } else { 0.25 };
        let blue = if x == 9 && y < 3 { f32::NAN } else { 0.5 };
        [x as f32 / 36.0, green, blue, 1.0]
    });
    let depth = pixels().map(|(x, y)| if x == 0 { MISS } else { 10.0 + y as f32 });
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC;
    let texture = |format, bytes: &[u8]| {
        let texture = gpu.texture_2d("known", [width, height], format, usage).expect("a texture");
        gpu.upload(&texture, bytes).expect("uploaded");
        Arc::new(texture)
    };
    Image {
        color: texture(TextureFormat::Rgba32Float, bytemuck::cast_slice(&color.collect::<Vec<_>>())),
        depth: Some(texture(TextureFormat::R32Float, bytemuck::cast_slice(&depth.collect::<Vec<_>>()))),
        kind,
        view: None,
    }
}

fn of(kind: ImageKind) -> Statistics {
    let gpu = Gpu::new(&GpuOptions::default()).expect("a device");
    statistics(&gpu, &Mutex::new(PipelineCache::new()), &known_image(&gpu, kind)).expect("numbers")
}

#[test]
fn numbers_of_a_known_image_are_right() {
    let found = of(ImageKind::Color);
    let [red, green, blue, alpha] = found.channels.map(|channel| channel.expect("a channel"));
    assert_eq!((red.min, red.max, red.count), (0.0, 1.0, 37 * 21));
    assert!((red.mean - 0.5).abs() < 1e-6, "{red:?}");
    assert_eq!((green.min, green.max), (0.25, 2.0));
    assert!((green.mean - (0.25 + 1.75 / 777.0)).abs() < 1e-6, "{green:?}");
    assert_eq!((blue.min, blue.max, blue.count), (0.5, 0.5, 37 * 21 - 3));
    assert_eq!((alpha.min, alpha.max, alpha.mean), (1.0, 1.0, 1.0));
    let depth = found.depth.expect("depth");
    assert_eq!((depth.min, depth.max, depth.mean, depth.count), (10.0, 30.0, 20.0, 36 * 21));
    assert_eq!((found.not_finite, found.out_of_range), (3, 1));
    assert_eq!(of(ImageKind::Data).out_of_range, 0, "data has no range to be outside of");
}

#[test]
fn every_kind_of_data_is_shown_and_what_is_not_there_is_explained() {
    let cases = [
        ("proxy.geometry", "12 triangles"),
        ("view.entry", "entry points"),
        ("traversal.image", "depth, near is bright"),
        ("source.volume", "on the device"),
    ];
    for (outport, expected) in cases {
        let address: Address = outport.parse().expect("an address");
        let mut harness = window::harness("networks/brain.json", move |ui, session| hover(ui, session, &address));
        window::wait_for(&mut harness, expected);
        if outport.ends_with("image") {
            window::wait_for(&mut harness, "alpha");
            window::wait_for(&mut harness, "mean");
        }
        window::keep_picture(&mut harness, &format!("hover-{outport}"));
    }
    let mut harness = window::harness("networks/brain.json", |ui, session| {
        session.edit("cut", |network| {
            network.disconnect(("source", "volume"), ("proxy", "volume"));
            Ok::<(), std::convert::Infallible>(())
        });
        hover(ui, session, &("traversal", "image").into());
    });
    window::wait_for(&mut harness, "`volume` is not connected");
    assert!(harness.query_by_label_contains("being computed").is_none());
}

#[test]
fn a_pinned_inspector_reads_the_pixel_under_the_pointer() {
    let mut harness = window::studio(window::flagship());
    harness.state_mut().session.to_open.push(rayloom_studio::Pane::Inspector(("view", "entry").into()));
    harness.state_mut().session.to_open.push(rayloom_studio::Pane::Inspector(("traversal", "image").into()));
    window::wait_for(&mut harness, "Point at a pixel");
    window::keep_picture(&mut harness, "inspectors");
    let heading = harness.query_all_by_label_contains("Point at a pixel").last().expect("a hint").rect();
    harness.hover_at(heading.left_top() + egui::vec2(170.0, -100.0));
    window::wait_for(&mut harness, "depth ");
    harness.run_steps(3);
    window::keep_picture(&mut harness, "inspectors");
}

#[test]
fn pixels_that_do_not_fit_are_marked() {
    let mut harness = window::harness("networks/marschner_lobb.json", |ui, session| {
        // The network's own canvas is not in sight.
        session.shown.insert("nobody".into(), [1, 1]);
        let image = Arc::new(known_image(session.display.gpu(), ImageKind::Color));
        let range = Some([0.3, 1.0]);
        let look = Look { layer: Layer::Channel(1), range, sharp: true, mark: true, ..Look::default() };
        let picture = session.display.picture(&image, look).expect("a picture");
        let place = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(370.0, 210.0));
        let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        ui.painter().image(picture, place, whole, egui::Color32::WHITE);
    });
    harness.run_steps(2);
    let picture = harness.render().expect("a picture");
    let at = |x: u32, y: u32| picture.get_pixel(10 * x + 5, 10 * y + 5).0;
    let [below, above, not_a_number] = [at(20, 12), at(5, 7), at(9, 2)];
    assert!(below[2] > 200 && below[0] < 60, "0.25 is below 0.3: {below:?}");
    assert!(above[0] > 200 && above[2] < 60, "2 is above 1: {above:?}");
    assert!(not_a_number[0] > 200 && not_a_number[2] > 200 && not_a_number[1] < 60, "{not_a_number:?}");
}
