//! Background, compositor, colour map, canvas, export and the image files, pixel by pixel.

use crate::common::{assert_close, failure, image, picture, run, text};
use rayloom_network::{ImageKind, Value};
use rayloom_processors::{MISS, Picture, read_picture, write_exr, write_npy, write_picture, write_png};

/// Half transparent red (premultiplied), opaque green, nothing.
const RED: [f32; 4] = [0.5, 0.0, 0.0, 0.5];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];
const NOTHING: [f32; 4] = [0.0; 4];

fn row(pixels: &[[f32; 4]], depth: Option<&[f32]>) -> Picture {
    Picture { size: [pixels.len() as u32, 1], pixels: pixels.to_vec(), depth: depth.map(<[f32]>::to_vec) }
}

#[test]
fn a_background_lies_under_premultiplied_colours_and_depth_passes() {
    let front = row(&[RED, GREEN, NOTHING], Some(&[1.0, 2.0, MISS]));
    let properties = [("mode", text("color")), ("first", Value::Color([0.2, 0.4, 0.8, 0.5]))];
    let inputs = [("front", image(ImageKind::Color, &front))];
    let result = picture(&run("background", &properties, &inputs, [99, 99]).expect("runs"));
    assert_eq!(result.size, [3, 1], "the size is the image's");
    assert_eq!(result.depth, front.depth);
    assert_close(result.pixels[0], [0.55, 0.1, 0.2, 0.75], 1e-6);
    assert_close(result.pixels[1], GREEN, 0.0);
    assert_close(result.pixels[2], [0.1, 0.2, 0.4, 0.5], 1e-6);
}

#[test]
fn gradients_reach_both_colours_in_opposite_corners() {
    let colors = |angle: f64| {
        let (black, white) = ([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
        let properties =
            [("angle", Value::Float(angle)), ("first", Value::Color(black)), ("second", Value::Color(white))];
        picture(&run("background", &properties, &[], [20, 10]).expect("runs")).pixels
    };
    let (right, up, diagonal) = (colors(0.0), colors(90.0), colors(45.0));
    for (x, y) in [(0, 0), (7, 3), (19, 9), (19, 0)] {
        let (u, v) = ((x as f32 + 0.5) / 20.0, 1.0 - (y as f32 + 0.5) / 10.0);
        let gray = |share: f32| [share, share, share, 1.0];
        assert_close(right[y * 20 + x], gray(u), 1e-5);
        assert_close(up[y * 20 + x], gray(v), 1e-5);
        assert_close(diagonal[y * 20 + x], gray((u * 20.0 + v * 10.0) / 30.0), 1e-5);
    }
}

#[test]
fn checkerboards_alternate_and_pictures_fit() {
    let colors = [("first", Value::Color([1.0, 0.0, 0.0, 1.0])), ("second", Value::Color([0.0, 0.0, 1.0, 1.0]))];
    let board = [colors[0].clone(), colors[1].clone(), ("mode", text("checkerboard")), ("square", Value::Float(2.0))];
    let pixels = picture(&run("background", &board, &[], [8, 8]).expect("runs")).pixels;
    for (i, pixel) in pixels.iter().enumerate() {
        let second = (i % 8 / 2 + i / 8 / 2) % 2 == 1;
        assert_close(*pixel, if second { [0.0, 0.0, 1.0, 1.0] } else { [1.0, 0.0, 0.0, 1.0] }, 0.0);
    }

    let folder = tempfile::tempdir().expect("folder");
    let file = folder.path().join("two.png");
    write_png(&file, &row(&[GREEN, NOTHING], None)).expect("written");
    let fitted = |fit: &str| {
        let file = ("file", text(&file.to_string_lossy()));
        let properties = [colors[0].clone(), ("mode", text("picture")), file, ("fit", text(fit))];
        picture(&run("background", &properties, &[], [8, 8]).expect("runs")).pixels
    };
    let red = [1.0, 0.0, 0.0, 1.0];
    // Contained: 8 x 4 pixels in the middle; stretched and covering fill the height.
    assert_close(fitted("contain")[0], red, 0.0);
    assert_close(fitted("contain")[3 * 8], GREEN, 0.0);
    assert_close(fitted("contain")[3 * 8 + 7], red, 0.0);
    assert_close(fitted("stretch")[0], GREEN, 0.0);
    // Covering shows the middle half: a quarter in, the left texel's centre has just been left behind.
    assert_close(fitted("cover")[0], [0.0625, 0.9375, 0.0, 1.0], 1e-6);

    let missing = run("background", &[("mode", text("picture"))], &[], [8, 8]);
    assert!(failure(missing).contains("no file is chosen"));
}

#[test]
fn the_compositor_keeps_its_promises_about_colour_and_depth() {
    let first = row(&[RED, RED, RED, NOTHING], Some(&[1.0, 5.0, MISS, MISS]));
    let second = row(&[GREEN, GREEN, NOTHING, GREEN], Some(&[2.0, 2.0, MISS, 3.0]));
    let composite = |mode: &str| {
        let inputs = [("first", image(ImageKind::Color, &first)), ("second", image(ImageKind::Color, &second))];
        let properties = [("mode", text(mode)), ("weight", Value::Float(0.25)), ("gain", Value::Float(2.0))];
        picture(&run("compositor", &properties, &inputs, [4, 1]).expect("runs"))
    };
    let mixed = [0.5, 0.5, 0.0, 1.0];
    for (mode, colors, depth) in [
        ("depth_test", [RED, GREEN, RED, GREEN], Some([1.0, 2.0, MISS, 3.0])),
        ("depth_over", [mixed, GREEN, RED, GREEN], Some([1.0, 2.0, MISS, 3.0])),
        ("over", [mixed, mixed, RED, GREEN], Some([1.0, 5.0, MISS, 3.0])),
        (
            "weighted",
            [[0.375, 0.25, 0.0, 0.625], [0.375, 0.25, 0.0, 0.625], [0.375, 0.0, 0.0, 0.375], [0.0, 0.25, 0.0, 0.25]],
            Some([1.0, 2.0, MISS, 3.0]),
        ),
        ("difference", [[1.0, 2.0, 0.0, 1.0], [1.0, 2.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [0.0, 2.0, 0.0, 1.0]], None),
        ("maximum", [[0.5, 1.0, 0.0, 1.0], [0.5, 1.0, 0.0, 1.0], RED, GREEN], Some([2.0, 2.0, MISS, 3.0])),
    ] {
        let result = composite(mode);
        for (found, expected) in result.pixels.iter().zip(colors) {
            assert_close(*found, expected, 1e-6);
        }
        assert_eq!(result.depth, depth.map(Vec::from), "{mode}");
    }
}

#[test]
fn the_compositor_refuses_what_makes_no_sense() {
    let (one, two) = (row(&[RED], None), row(&[RED, RED], None));
    let [one, two] = [one, two].map(|picture| image(ImageKind::Color, &picture));
    let sizes = run("compositor", &[], &[("first", one.clone()), ("second", two)], [1, 1]);
    let text = failure(sizes);
    assert!(text.contains("1 x 1") && text.contains("2 x 1"), "{text}");
    let depth = run("compositor", &[], &[("first", one.clone()), ("second", one)], [1, 1]);
    assert!(failure(depth).contains("needs depth"));
}

#[test]
fn the_colour_map_shows_channels_and_depth_over_their_range() {
    let entries = row(&[[0.2, 0.6, 1.0, 1.0], [0.4, 0.2, 1.0, 1.0], NOTHING], Some(&[10.0, 30.0, MISS]));
    let show = |what: &str, kind: ImageKind| {
        let properties = [("show", text(what)), ("map", text("gray"))];
        let outputs = run("color_map", &properties, &[("source", image(kind, &entries))], [3, 1]).expect("runs");
        let range = ["minimum", "maximum"].map(|key| outputs.statistics[key].as_f64().expect("a number") as f32);
        (picture(&outputs).pixels, range)
    };
    let (black, white) = ([0.0, 0.0, 0.0, 1.0], [1.0; 4]);
    assert_eq!(show("depth", ImageKind::EntryPoints), (vec![black, white, NOTHING], [10.0, 30.0]));
    assert_eq!(show("green", ImageKind::EntryPoints), (vec![white, black, NOTHING], [0.2, 0.6]));
    assert_eq!(show("color", ImageKind::EntryPoints).0, entries.pixels);
    // In a colour image, 0 is a number like any other.
    assert_eq!(show("alpha", ImageKind::Color).0, [white, white, black]);

    let fixed = [
        ("show", text("red")),
        ("map", text("heat")),
        ("automatic", Value::Bool(false)),
        ("range", Value::Vector(vec![0.4, 0.0])),
    ];
    let outputs = run("color_map", &fixed, &[("source", image(ImageKind::Normals, &entries))], [3, 1]).expect("runs");
    // Halfway through a reversed range: between red and yellow.
    assert_close(picture(&outputs).pixels[0], [1.0, 0.5, 0.0, 1.0], 1e-5);
    assert_close(picture(&outputs).pixels[1], black, 1e-5);
}

#[test]
fn image_files_say_what_the_image_says() {
    let folder = tempfile::tempdir().expect("folder");
    let path = |name: &str| folder.path().join(name);
    let wild = [1.5, -2.0e-7, 1.0e9, 0.25];
    let image =
        Picture { size: [2, 2], pixels: vec![RED, GREEN, NOTHING, wild], depth: Some(vec![1.5, 2.5, MISS, 0.1]) };

    write_picture(&path("a.png"), &image).expect("png");
    let png = image::open(path("a.png")).expect("a PNG").into_rgba8();
    assert_eq!(&png.as_raw()[..12], [255, 0, 0, 128, 0, 255, 0, 255, 0, 0, 0, 0], "straight alpha");
    let back = read_picture(&path("a.png")).expect("png");
    assert_close(back.pixels[0], [128.0 / 255.0, 0.0, 0.0, 128.0 / 255.0], 1e-6);

    write_exr(&path("a.exr"), &image).expect("exr");
    let file = exr::prelude::read_all_data_from_file(path("a.exr")).expect("an EXR");
    let channels = &file.layer_data[0].channel_data.list;
    let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["A", "B", "G", "R", "Z"]);
    let samples = |levels: &exr::image::Levels<exr::image::FlatSamples>| match levels {
        exr::image::Levels::Singular(flat) => flat.values_as_f32().collect::<Vec<_>>(),
        _ => panic!("no levels were written"),
    };
    assert_eq!(samples(&channels[3].sample_data), [0.5, 0.0, 0.0, 1.5]);
    assert_eq!(samples(&channels[4].sample_data), [1.5, 2.5, MISS, 0.1]);
    assert_eq!(read_picture(&path("a.exr")).expect("exr").pixels, image.pixels);

    write_npy(&path("a.npy"), &image).expect("npy");
    let bytes = std::fs::read(path("a.npy")).expect("a file");
    let array = npyz::NpyFile::new(&bytes[..]).expect("an array");
    assert_eq!(array.shape(), [2, 2, 4]);
    let numbers: Vec<f32> = array.into_vec().expect("floats");
    assert_eq!(numbers, image.pixels.concat());

    let error = write_picture(&path("a.jpg"), &image).expect_err("no such format").to_string();
    assert!(error.contains("a.jpg") && error.contains(".png"), "{error}");
    let error = write_picture(&path("none/a.png"), &image).expect_err("no such folder").to_string();
    assert!(error.contains("none"), "{error}");
}

#[test]
fn export_writes_what_flows_in() {
    let folder = tempfile::tempdir().expect("folder");
    let file = folder.path().join("out.exr");
    let inputs = [("image", image(ImageKind::Color, &row(&[RED, GREEN], Some(&[1.0, 2.0]))))];
    let path = ("file", text(&file.to_string_lossy()));
    let disabled = [path.clone(), ("enabled", Value::Bool(false))];
    run("image_export", &disabled, &inputs, [2, 1]).expect("runs");
    assert!(!file.exists());
    let outputs = run("image_export", &[path], &inputs, [2, 1]).expect("runs");
    assert!(outputs.notes[0].contains("out.exr"));
    assert_eq!(read_picture(&file).expect("written").pixels, [RED, GREEN]);
    let shown = run("canvas", &[], &inputs, [2, 1]).expect("runs");
    assert_eq!(shown.data["shown"].facts(), inputs[0].1.facts());
}
