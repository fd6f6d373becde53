//! Observed orders of convergence: by what power errors fall as steps, voxels and pixels get smaller, on this device.
//!
//! Each [`Case`] refines one thing and compares with an answer that has no error of that kind: a formula, or the float64
//! picture without samples. Its observed order is the slope of a straight line through the logarithms of the errors.

mod gradients;
mod grid;
mod lab;
mod page;
mod pixels;
mod plot;
pub mod probe;
mod quadrature;
pub mod rays;

use std::path::{Path, PathBuf};

use rayloom_gpu::Gpu;
use serde::Serialize;

use crate::{Listener, MeasureError};

/// What is refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// Steps along the ray.
    Quadrature,
    /// Voxels, for values and whole pictures.
    Grid,
    /// Voxels, for gradients.
    Gradients,
    /// Pixels.
    Pixels,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Quadrature, Self::Grid, Self::Gradients, Self::Pixels];

    /// A short name, for files.
    pub fn id(self) -> &'static str {
        match self {
            Self::Quadrature => "quadrature",
            Self::Grid => "grid",
            Self::Gradients => "gradients",
            Self::Pixels => "pixels",
        }
    }

    /// What the horizontal axis of its plot counts.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Quadrature => "samples a voxel",
            Self::Grid | Self::Gradients => "voxels along an edge",
            Self::Pixels => "pixels along an edge",
        }
    }
}

/// How much is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Enough for an order: a few seconds.
    Quick,
    /// To where arithmetic takes over.
    Full,
}

impl Extent {
    /// All of a list, or the first `few` of it.
    fn of<T: Copy>(self, all: &[T], few: usize) -> Vec<T> {
        match self {
            Self::Quick => all[..few.min(all.len())].to_vec(),
            Self::Full => all.to_vec(),
        }
    }
}

/// What order a method has.
#[derive(Debug, Clone, Copy)]
struct Expectation {
    order: f64,
    /// How far the observed order may be from it: 0.1 for errors that fall regularly, 0.2 where they depend on where samples
    /// happen to fall, or where terms of higher order fade late.
    within: f64,
    /// Smaller errors are those of arithmetic and not judged.
    floor: f64,
}

/// One method, refined.
#[derive(Debug, Clone, Serialize)]
pub struct Case {
    /// What is refined.
    pub axis: Axis,
    /// The method and the scene.
    pub name: String,
    /// The order that theory gives.
    pub expected: f64,
    /// The orders that pass, both included.
    pub allowed: [f64; 2],
    /// How often the axis' unit occurs, and the error (root mean square) there.
    pub errors: Vec<(f64, f64)>,
    /// How many of the first errors the order is taken from; the others are those of arithmetic.
    pub judged: usize,
    /// The observed order; not finite when too few errors stand out from arithmetic.
    pub order: f64,
}

impl Case {
    fn new(axis: Axis, name: impl Into<String>, expectation: Expectation, errors: Vec<(f64, f64)>) -> Self {
        let judged = errors.iter().take_while(|(_, error)| *error > expectation.floor).count();
        let order = order(&errors[..judged]);
        let Expectation { order: expected, within, .. } = expectation;
        let allowed = [expected - within, expected + within];
        Self { axis, name: name.into(), expected, allowed, errors, judged, order }
    }

    /// Whether the observed order is one of those that pass.
    pub fn passed(&self) -> bool {
        (self.allowed[0]..=self.allowed[1]).contains(&self.order)
    }
}

/// The slope by which errors fall: least squares on logarithms. Not a number for fewer than three.
fn order(errors: &[(f64, f64)]) -> f64 {
    if errors.len() < 3 {
        return f64::NAN;
    }
    let logs: Vec<[f64; 2]> = errors.iter().map(|(fineness, error)| [fineness.ln(), error.ln()]).collect();
    let mean = |i: usize| logs.iter().map(|log| log[i]).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let products = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum::<f64>();
    -products / logs.iter().map(|log| (log[0] - x).powi(2)).sum::<f64>()
}

/// What was found on one device.
#[derive(Debug, Clone, Serialize)]
pub struct Study {
    /// The version of this program.
    pub rayloom: &'static str,
    /// The device.
    pub adapter: String,
    /// The cases, by axis.
    pub cases: Vec<Case>,
}

impl Study {
    /// Whether all cases passed.
    pub fn passed(&self) -> bool {
        self.cases.iter().all(Case::passed)
    }

    /// Writes `convergence.html`, a page that needs nothing else, its plots as SVG files and `convergence.json` into a
    /// folder, which is made if it is not there, and returns their paths.
    ///
    /// # Errors
    /// The folder cannot be made or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, MeasureError> {
        let plots = Axis::ALL.map(|axis| (format!("convergence_{}.svg", axis.id()), plot::svg(self, axis)));
        let mut files = vec![
            ("convergence.html".to_owned(), page::page(self)),
            ("convergence.json".to_owned(), serde_json::to_string_pretty(self)? + "\n"),
        ];
        files.extend(plots);
        crate::report::output::write_files(folder, files)
    }
}

/// Refines everything.
///
/// # Errors
/// The device fails.
pub fn study(gpu: &Gpu, extent: Extent, listener: Listener<'_>) -> Result<Study, MeasureError> {
    type Part = fn(&Gpu, Extent) -> Result<Vec<Case>, MeasureError>;
    let parts: [(Axis, Part); 4] = [
        (Axis::Quadrature, quadrature::cases),
        (Axis::Grid, grid::cases),
        (Axis::Gradients, gradients::cases),
        (Axis::Pixels, pixels::cases),
    ];
    let mut cases = Vec::new();
    for (done, (axis, part)) in (0..).zip(parts) {
        listener(axis.id(), f64::from(done) / parts.len() as f64);
        cases.extend(part(gpu, extent)?);
    }
    Ok(Study { rayloom: env!("CARGO_PKG_VERSION"), adapter: gpu.describe(), cases })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_slopes() {
        let cube = [(1.0, 8.0), (2.0, 1.0), (4.0, 0.125)];
        assert!((order(&cube) - 3.0).abs() < 1e-12);
        assert!(order(&cube[..2]).is_nan());
        let case = Case::new(Axis::Grid, "cube", Expectation { order: 2.0, within: 0.1, floor: 1e-6 }, cube.to_vec());
        assert!(!case.passed() && case.judged == 3);
        let stuck = Case::new(Axis::Grid, "floor", Expectation { order: 3.0, within: 0.1, floor: 0.5 }, cube.to_vec());
        assert!(!stuck.passed() && stuck.judged == 2);
    }
}
