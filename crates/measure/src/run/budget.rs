//! The error of a network by its causes: one of them is switched off at a time.

use rayloom_network::{Camera, Network, Value};
use rayloom_reference::Cache;
use serde::Serialize;
use serde_json::{Value as Json, json};

use crate::run::bench::Bench;
use crate::run::yardstick::{Standard, Yardstick, assignment, storage};
use crate::{Errors, Listener, MeasureError, Setting};

/// How many times finer the samples are when the quadrature is switched off.
const FINER: f64 = 16.0;
/// The cause that is a departure from another estimate, not an error.
pub(crate) const GRADIENT: &str = "gradient estimate";
/// The highest sampling rate there is.
const MOST: f64 = 4096.0;

/// A table of causes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Budget {
    /// One cause each.
    pub rows: Vec<Row>,
    /// Causes that cannot be switched on their own yet, a phrase each.
    pub not_separated: Vec<String>,
}

/// A cause of error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// What it is called.
    pub cause: &'static str,
    /// How it was switched: "sampling_rate 1 -> 16", or why it was not.
    pub switch: String,
    /// How much the picture changes with the switch; `None` where there is nothing to switch.
    pub change: Option<Errors>,
    /// The error that is left with the switch, against the reference; `None` where that stands for something else.
    pub left: Option<Errors>,
}

impl Row {
    fn unswitched(cause: &'static str, why: String) -> Self {
        Self { cause, switch: why, change: None, left: None }
    }
}

/// A switch: what it is called, on which processor, which property, and the value without that error.
struct Switch<'a> {
    cause: &'static str,
    processor: Option<&'a str>,
    property: &'static str,
    best: Json,
}

/// The network as saved, all views in a row.
#[derive(Clone, Copy)]
pub(crate) struct Saved<'a> {
    pub pictures: &'a [[f32; 4]],
    /// What its pictures, and those of all settings, are compared with.
    pub reference: Option<&'a [[f64; 4]]>,
}

/// Measures the causes of the saved network's error over the views.
pub(crate) fn budget(
    network: &Network,
    bench: &mut Bench,
    views: &[Camera],
    saved: Saved<'_>,
    cache: &Cache,
    listener: Listener<'_>,
) -> Result<Budget, MeasureError> {
    let chain = bench.chain.clone();
    let traversal = Some(chain.traversal());
    let rate = match network.value(chain.traversal(), "sampling_rate") {
        Some(Value::Float(rate)) => (FINER * rate).min(MOST),
        _ => FINER,
    };
    let switch = |cause, processor, property, best| Switch { cause, processor, property, best };
    let mut switches = vec![
        switch("quadrature along the ray", traversal, "sampling_rate", json!(rate)),
        switch("weights of interpolation", traversal, "sampling", json!("trilinear")),
        switch(GRADIENT, traversal, "gradient", json!("central4")),
        switch("storage of the volume", chain.source.as_deref(), "precision", json!("32-bit")),
        switch("storage of the gradients", chain.gradients(network), "storage", json!("32-bit")),
        switch("storage of entry and exit points", Some(&chain.view), "format", json!("32-bit")),
        switch("storage of the picture", traversal, "target", json!("32-bit")),
        switch("jitter", traversal, "jitter", json!(false)),
        switch("early ray termination", traversal, "termination_error", json!(0.0)),
        switch("empty-space skipping", traversal, "skipping", json!("none")),
    ];
    switches.retain(|switch| applies(network, switch));
    let mut rows = Vec::new();
    for (index, switch) in switches.iter().enumerate() {
        listener(&format!("error budget: {}", switch.cause), index as f64 / switches.len() as f64);
        rows.push(row(network, bench, views, saved, switch)?);
    }
    rows.push(round_off(network, bench, views, cache, listener)?);
    let not_separated = vec![
        "the table of the transfer function (1024 entries, more for steep ramps, cut at steps; 256 x 256 for pre-integration), \
         which is part of the last row or of the quadrature"
            .to_owned(),
        "the form of the opacity: opacities are always 1 - exp(-x), which adds no error"
            .to_owned(),
        "pixels: every pixel is one ray, here and in the reference".to_owned(),
    ];
    Ok(Budget { rows, not_separated })
}

/// Whether a switch means anything in this network: weights only where they are the sampler's, gradients only where they
/// are read.
fn applies(network: &Network, switch: &Switch<'_>) -> bool {
    let text = |property| match switch.processor.and_then(|id| network.value(id, property)) {
        Some(Value::Text(text)) => text,
        _ => String::new(),
    };
    match switch.property {
        "sampling" => text("sampling") == "filtered",
        "gradient" => text("shading") != "none",
        _ => switch.processor.is_some(),
    }
}

fn row(
    network: &Network,
    bench: &mut Bench,
    views: &[Camera],
    saved: Saved<'_>,
    switch: &Switch<'_>,
) -> Result<Row, MeasureError> {
    let Switch { cause, processor: Some(processor), property, best } = switch else {
        return Ok(Row::unswitched(switch.cause, "nothing to switch".into()));
    };
    let found = network.value(processor, property).map(|value| value.to_json()).unwrap_or_default();
    let plain = crate::run::setting::plain;
    if found == *best {
        let switch = format!("{property} is {} already", plain(&found));
        return Ok(Row::unswitched(cause, switch));
    }
    let setting = Setting { name: (*cause).into(), assignments: vec![assignment(processor, property, best.clone())] };
    let switch = format!("{property} {} \u{2192} {}", plain(&found), plain(best));
    match pictures(bench, &setting, views) {
        Ok(switched) => {
            let change = Some(Errors::of(saved.pictures, &widened(&switched))?.0);
            let left = match saved.reference {
                Some(reference) if *cause != GRADIENT => Some(Errors::of(&switched, reference)?.0),
                _ => None,
            };
            Ok(Row { cause, switch, change, left })
        }
        Err(MeasureError::Evaluation(reason)) => Ok(Row::unswitched(cause, format!("{switch}: {reason}"))),
        Err(other) => Err(other),
    }
}

/// The arithmetic of the device: its picture, all storage in 32 bits, against the same samples in float64.
fn round_off(
    network: &Network,
    bench: &mut Bench,
    views: &[Camera],
    cache: &Cache,
    listener: Listener<'_>,
) -> Result<Row, MeasureError> {
    let cause = "round-off and tables";
    let setting = storage(network, &bench.chain);
    let yardstick = Yardstick { standard: Standard::SameSamples, cache, listener, finest: setting.clone() };
    match yardstick.draw(bench, &setting, views) {
        Ok(reference) => {
            let found = pictures(bench, &setting, views)?;
            let switch = "32-bit storage \u{2192} the same samples in float64".to_owned();
            let reference = crate::run::figures::row(&reference, |view| &view.pixels);
            Ok(Row { cause, switch, change: Some(Errors::of(&found, &reference)?.0), left: None })
        }
        Err(MeasureError::Refusal(refusal)) => Ok(Row::unswitched(cause, refusal.to_string())),
        Err(other) => Err(other),
    }
}

fn pictures(bench: &mut Bench, setting: &Setting, views: &[Camera]) -> Result<Vec<[f32; 4]>, MeasureError> {
    let mut pixels = Vec::new();
    for view in views {
        bench.set(setting, view)?;
        pixels.extend(bench.picture()?);
    }
    Ok(pixels)
}

fn widened(pixels: &[[f32; 4]]) -> Vec<[f64; 4]> {
    pixels.iter().map(|pixel| pixel.map(f64::from)).collect()
}
