//! The first crossing of a value.

use super::{Path, Renderer, SurfaceHit};
use crate::image::PixelResult;
use crate::scene::Refinement;

/// A position on a ray, in steps, and how far the value there lies above the isovalue.
#[derive(Debug, Clone, Copy)]
struct Point {
    position: f64,
    excess: f64,
}

impl Point {
    fn is_inside(self) -> bool {
        self.excess >= 0.0
    }
}

impl Renderer<'_> {
    pub(super) fn isosurface(&self, path: &Path, isovalue: f64, refinement: Refinement) -> PixelResult {
        let Some(position) = self.crossing(path, isovalue, refinement) else { return PixelResult::NOTHING };
        let texture = path.texture(position);
        let color = self.prepared.functions.at(texture).evaluate(isovalue).color;
        let [r, g, b] = self.prepared.lit(color, texture, &path.ray);
        PixelResult { color: [r, g, b, 1.0], depth: path.depth(position) }
    }

    pub(super) fn surface_hit(&self, path: &Path, isovalue: f64, refinement: Refinement) -> Option<SurfaceHit> {
        let position = self.crossing(path, isovalue, refinement)?;
        Some(self.prepared.surface_at(path.texture(position), path.depth(position)))
    }

    /// Position of the first crossing between entry, samples and exit, in steps. A ray that enters inside is not cut there: it
    /// crosses where it comes out; nothing is crossed where the field has no value.
    fn crossing(&self, path: &Path, isovalue: f64, refinement: Refinement) -> Option<f64> {
        let at = |position: f64| Point { position, excess: self.value(path, position) - isovalue };
        let mut previous = Some(at(0.0)).filter(|_| !self.in_gap(path, 0.0));
        let samples = path.lattice.samples().map(|sample| sample.position);
        for position in samples.chain(std::iter::once(path.lattice.length)) {
            if self.in_gap(path, position) {
                previous = None;
                continue;
            }
            let current = at(position);
            if let Some(previous) = previous.filter(|previous| current.is_inside() != previous.is_inside()) {
                return Some(refine(at, previous, current, refinement));
            }
            previous = Some(current);
        }
        None
    }
}

/// Locates the crossing between `before` and `after`, which lie on different sides.
fn refine(at: impl Fn(f64) -> Point, mut before: Point, mut after: Point, refinement: Refinement) -> f64 {
    let middle = |before: Point, after: Point| 0.5 * (before.position + after.position);
    let chord = |before: Point, after: Point| {
        before.position + (after.position - before.position) * before.excess / (before.excess - after.excess)
    };
    let (steps, guess): (u32, &dyn Fn(Point, Point) -> f64) = match refinement {
        Refinement::None => return after.position,
        Refinement::Linear => (0, &chord),
        Refinement::Bisection(halvings) => (halvings, &middle),
        Refinement::Secant(steps) => (steps.saturating_sub(1), &chord),
    };
    let mut replaced = None;
    for _ in 0..steps {
        let point = at(guess(before, after));
        let is_before = point.is_inside() == before.is_inside();
        let kept = if is_before { &mut after } else { &mut before };
        // Halvings of an interval do not look at the excess.
        if replaced.replace(is_before) == Some(is_before) {
            kept.excess *= 0.5;
        }
        if is_before {
            before = point;
        } else {
            after = point;
        }
    }
    guess(before, after)
}
