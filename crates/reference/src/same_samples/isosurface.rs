//! Crossings of values.

use super::{Path, Renderer, SurfaceHit};
use crate::image::PixelResult;
use crate::scene::{Layer, Refinement};

/// A position on a ray, and how far the value there lies above the isovalue.
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
        let Some(position) = self.first_crossing(path, isovalue, refinement) else { return PixelResult::NOTHING };
        let texture = path.texture(position);
        let color = self.prepared.functions.at(texture).evaluate(isovalue).color;
        let [r, g, b] = self.prepared.lit(color, texture, &path.ray);
        PixelResult { color: [r, g, b, 1.0], depth: path.depth(position) }
    }

    pub(super) fn surface_hit(&self, path: &Path, isovalue: f64, refinement: Refinement) -> Option<SurfaceHit> {
        let position = self.first_crossing(path, isovalue, refinement)?;
        Some(self.prepared.surface_at(path.texture(position), path.depth(position)))
    }

    /// Layers of surfaces, front to back.
    pub(super) fn isosurfaces(&self, path: &Path, mut layers: [Layer; 3], refinement: Refinement) -> PixelResult {
        layers.sort_by(|a, b| a.value.total_cmp(&b.value));
        let mut falling = layers;
        falling.sort_by(|a, b| b.value.total_cmp(&a.value));
        let mut result = PixelResult::NOTHING;
        for stretch in self.stretches(path) {
            for layer in if stretch[1].1 >= stretch[0].1 { layers } else { falling } {
                let crossing = self.crossing(path, stretch, layer.value, refinement);
                if let Some(position) = crossing.filter(|_| layer.opacity > 0.0) {
                    let color = self.prepared.lit(layer.color, path.texture(position), &path.ray);
                    result.put_behind(color, layer.opacity, path.depth(position));
                }
            }
            if self.prepared.scene.early_termination.is_some_and(|threshold| result.color[3] >= threshold) {
                break;
            }
        }
        result
    }

    /// Position of the first crossing between entry, samples and exit. A ray that enters inside is not cut there: it
    /// crosses where it comes out; nothing is crossed where the field has no value.
    fn first_crossing(&self, path: &Path, isovalue: f64, refinement: Refinement) -> Option<f64> {
        self.stretches(path).find_map(|stretch| self.crossing(path, stretch, isovalue, refinement))
    }

    /// Position and value of the ends of the stretches between entry, samples and exit; those in gaps are left out.
    fn stretches<'p>(&'p self, path: &'p Path) -> impl Iterator<Item = [(f64, f64); 2]> + 'p {
        let samples = path.lattice.samples().map(|sample| sample.position);
        let places = std::iter::once(path.lattice.from).chain(samples).chain(std::iter::once(path.lattice.to));
        let ends = places.map(|place| (!self.in_gap(path, place)).then(|| (place, self.value(path, place))));
        let pairs = ends.scan(None, |previous, end| Some((std::mem::replace(previous, end), end)));
        pairs.filter_map(|(from, to)| Some([from?, to?]))
    }

    /// Position of the crossing on a stretch, if its ends lie on different sides.
    fn crossing(&self, path: &Path, stretch: [(f64, f64); 2], isovalue: f64, refinement: Refinement) -> Option<f64> {
        let [before, after] = stretch.map(|(position, value)| Point { position, excess: value - isovalue });
        let at = |position: f64| Point { position, excess: self.value(path, position) - isovalue };
        (before.is_inside() != after.is_inside()).then(|| refine(at, before, after, refinement))
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
