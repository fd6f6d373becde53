//! Where samples and rays lie: jitter, pixel rate, and the map of samples.

use glam::DVec3;
use rayloom_processors::Data;
use rayloom_reference::Camera;
use rayloom_tests::{Picture, Workbench};
use rayloom_volume::{Knot, TransferFunction};
use serde_json::json;

const SIZE: [u32; 2] = [48, 40];

/// A small ball of shells, seen whole, with a jump in its transfer function that undersampling shows.
fn ball() -> Workbench {
    let mut bench =
        Workbench::of_generator(&json!({"field": "bucky_ball", "dims": [32, 32, 32], "extent": [3.0, 3.0, 3.0]}));
    let knots = [(0.3, 0.0), (0.301, 0.3), (0.6, 0.1), (1.0, 0.9)];
    let function = TransferFunction::new(knots.map(|(at, opacity)| Knot::new(at, [0.9, 0.5, 0.2], opacity)).to_vec());
    bench.classify(&function.expect("sorted knots"));
    bench.look(&Camera::perspective(DVec3::new(-4.0, 5.0, 6.0), DVec3::ZERO, 40.0));
    bench
}

fn rmse(a: &Picture, b: &Picture) -> f64 {
    assert_eq!(a.size, b.size);
    let squares = a.color.iter().flatten().zip(b.color.iter().flatten()).map(|(a, b)| f64::from(a - b).powi(2));
    (squares.sum::<f64>() / (4 * a.color.len()) as f64).sqrt()
}

/// The mean over blocks of 2 x 2 pixels.
fn halved(picture: &Picture, size: [u32; 2]) -> Vec<[f32; 4]> {
    let pixel = |x: u32, y: u32| {
        let block = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| picture.at(2 * x + dx, 2 * y + dy));
        [0, 1, 2, 3].map(|c| block.iter().map(|pixel| pixel[c]).sum::<f32>() / 4.0)
    };
    (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
}

#[test]
fn jitter_repeats_itself_and_averages_out() {
    let mut bench = ball();
    bench.put("traversal.sampling_rate", json!(16));
    let fine = bench.render(SIZE);
    bench.put("traversal.sampling_rate", json!(0.5));
    let plain = bench.render(SIZE);
    bench.put("traversal.jitter", json!(true));
    let mut seeded = |seed: u32| bench.put("traversal.jitter_seed", json!(seed)).render(SIZE);
    let pictures: Vec<Picture> = (0..16).map(&mut seeded).collect();
    assert_eq!(rmse(&pictures[3], &seeded(3)), 0.0);
    assert!(rmse(&pictures[0], &pictures[1]) > 1e-3 && rmse(&pictures[0], &plain) > 1e-3);
    let mut mean = pictures[0].clone();
    for (i, pixel) in mean.color.iter_mut().enumerate() {
        *pixel = [0, 1, 2, 3].map(|c| pictures.iter().map(|p| p.color[i][c]).sum::<f32>() / pictures.len() as f32);
    }
    let (one, all) = (rmse(&pictures[0], &fine), rmse(&mean, &fine));
    println!("jitter: error {one:.4} with one seed, {all:.4} with the mean of 16, {:.4} without", rmse(&plain, &fine));
    assert!(all < 0.5 * one, "{all} {one}");
}

#[test]
fn twice_the_pixel_rate_is_the_mean_of_four_rays() {
    for target in ["32-bit", "16-bit"] {
        let mut bench = ball();
        bench.put("traversal.target", json!(target));
        let large = bench.render(SIZE.map(|side| 2 * side));
        let found = bench.put("traversal.pixel_rate", json!(2)).render(SIZE);
        let expected = Picture { size: SIZE, color: halved(&large, SIZE), depth: Vec::new() };
        // Rounding of the mean, and of its storage.
        let rounding = if target == "32-bit" { 1e-7 } else { 3e-4 };
        assert!(rmse(&found, &expected) <= rounding, "{target}: {}", rmse(&found, &expected));
        let nearest = |x: u32, y: u32| {
            let at = |dx, dy| large.depth[((2 * y + dy) * large.size[0] + 2 * x + dx) as usize];
            at(0, 0).min(at(1, 0)).min(at(0, 1)).min(at(1, 1))
        };
        for (x, y) in [(0, 0), (24, 20), (10, 31), (47, 39)] {
            assert_eq!(found.depth[(y * SIZE[0] + x) as usize], nearest(x, y));
        }
    }
}

#[test]
fn half_the_pixel_rate_takes_a_quarter_of_the_rays_and_keeps_the_size() {
    let mut bench = ball();
    bench.runner.count_samples(true);
    let mut at = |rate: f64| {
        let picture = bench.put("traversal.pixel_rate", json!(rate)).render(SIZE);
        let run = bench.evaluator.last_run("traversal").expect("it ran");
        (picture, run.statistics["rays"].as_u64().expect("a count"))
    };
    let ((full, rays), (half, fewer)) = (at(1.0), at(0.5));
    assert!((3.8..4.2).contains(&(rays as f64 / fewer as f64)), "{rays} {fewer}");
    let error = rmse(&half, &full);
    println!("half the pixel rate: error {error:.4}");
    assert!(error > 1e-4 && error < 0.05, "{error}");
}

#[test]
fn the_map_of_samples_adds_up_to_what_is_counted() {
    let mut bench = ball();
    bench.put("traversal.termination_error", json!(0.05)).put("traversal.skipping", json!("distance"));
    for alone in [true, false] {
        bench.runner.count_samples(true);
        let mut watch = vec![("traversal", "samples").into()];
        watch.extend((!alone).then(|| ("traversal", "image").into()));
        let request = rayloom_network::Request { watch, size: Some(SIZE), ..Default::default() };
        let report = bench.evaluate(&request);
        assert!(report.is_complete(), "{report:?}");
        let Some(Data::Image(image)) = bench.evaluator.output("traversal", "samples") else { panic!("no map") };
        let map = Picture::of(image, &bench.runner.context.gpu);
        let sum = |channel: usize| map.color.iter().map(|pixel| pixel[channel] as u64).sum::<u64>();
        let run = bench.evaluator.last_run("traversal").expect("it ran");
        let counted = ["samples", "contributing", "rays"].map(|name| run.statistics[name].as_u64().expect("a count"));
        assert_eq!([sum(0), sum(1), sum(3)], counted);
        assert!(counted[1] > 0 && counted[1] < counted[0], "{counted:?}");
    }
}
