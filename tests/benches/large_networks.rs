//! What networks of many processors cost: loading, asking whether they are ready, saving, and an evaluation on the device.
//! Prints times, which should grow with the number of processors and no faster; asserts nothing.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_network::{Evaluator, Network, Request, not_ready};
use rayloom_processors::{Runner, registry};
use serde_json::json;

fn main() {
    println!("processors |  load | ready |  save | evaluate (16 x 16) | again, ms");
    for count in [1_000, 10_000] {
        measure(count);
    }
}

fn measure(count: usize) {
    let text = chain(count);
    let registry = Arc::new(registry());
    let (network, load) =
        timed(|| Network::from_text(&text, Path::new(""), &registry).expect("it is well formed").network);
    let (waiting, ready) = timed(|| not_ready(&network, &["canvas"]).len());
    assert_eq!(waiting, 0);
    let (_, save) = timed(|| network.to_text(None));
    let gpu = Gpu::new(&GpuOptions::default()).expect("a device");
    let (mut runner, mut evaluator) = (Runner::new(gpu).expect("a runner"), Evaluator::new());
    let mut evaluate = || timed(|| evaluator.evaluate(&network, &mut runner, &Request::default()).is_complete());
    let ((first, cold), (second, warm)) = (evaluate(), evaluate());
    assert!(first && second);
    println!("{count:>10} | {load:>5.0} | {ready:>5.0} | {save:>5.0} | {cold:>18.0} | {warm:.0}");
}

/// A background and compositors one after the other, in the least favourable order of the file: sinks first.
fn chain(count: usize) -> String {
    let mut processors = vec![json!({"id": "background", "type": "background"})];
    let mut connections = Vec::new();
    let mut last = "background".to_owned();
    for number in 0..count {
        let id = format!("c{number}");
        processors.push(json!({"id": id, "type": "compositor"}));
        connections.push(format!("{last}.image -> {id}.first"));
        connections.push(format!("background.image -> {id}.second"));
        last = id;
    }
    processors.push(json!({"id": "canvas", "type": "canvas", "properties": {"size": [16, 16]}}));
    connections.push(format!("{last}.image -> canvas.image"));
    processors.reverse();
    connections.reverse();
    json!({"rayloom": 1, "processors": processors, "connections": connections}).to_string()
}

/// A result, and the milliseconds that it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64() * 1e3)
}
