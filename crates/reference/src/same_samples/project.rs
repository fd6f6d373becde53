//! Projections: one value per ray, classified once.

use super::{Path, Renderer};
use crate::image::PixelResult;
use crate::scene::Method;

impl Renderer<'_> {
    /// Reduces the samples of a ray to one value and classifies it over one reference length.
    pub(super) fn project(&self, path: &Path) -> PixelResult {
        let covered: f64 = self.samples(path).map(|sample| sample.length).sum();
        if covered == 0.0 {
            return PixelResult::NOTHING;
        }
        let entry = path.lattice.from;
        let (value, position) = match self.prepared.scene.method {
            Method::Mip => self.extreme(path, |value, best| value > best),
            Method::MinIp => self.extreme(path, |value, best| value < best),
            Method::Sum => {
                let share = self.integral(path, |value| self.prepared.field.range().normalise(value));
                (self.prepared.field.range().denormalise(share), entry)
            }
            _ => (self.integral(path, |value| value) / covered, entry),
        };
        let material = self.prepared.functions.at(path.texture(position)).evaluate(value);
        let [r, g, b] = material.color.map(|c| c * material.opacity);
        PixelResult { color: [r, g, b, material.opacity], depth: path.depth(position) }
    }

    /// The sample that none other is `better` than, the first of such, and its position.
    fn extreme(&self, path: &Path, better: fn(f64, f64) -> bool) -> (f64, f64) {
        let samples = self.samples(path).map(|sample| (self.value(path, sample.position), sample.position));
        samples.reduce(|best, next| if better(next.0, best.0) { next } else { best }).unwrap_or((0.0, 0.0))
    }

    /// The integral of a function of the value along the ray, over reference lengths.
    fn integral(&self, path: &Path, of: impl Fn(f64) -> f64) -> f64 {
        self.samples(path).map(|sample| of(self.value(path, sample.position)) * sample.length).sum()
    }
}
