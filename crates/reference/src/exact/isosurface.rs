//! Crossings of values, from the roots of the field.

use super::Renderer;
use super::bernstein::Bernstein;
use super::cells::{Cells, Cuts};
use crate::image::PixelResult;
use crate::prepared::{Passage, SurfaceHit};
use crate::scene::Layer;

/// Shortfall, relative to the values around, at which a value still counts as the isovalue: interpolating equal values rounds,
/// and a plateau on the isovalue shall be one surface.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Renderer<'_> {
    pub(super) fn isosurface(&self, passage: &Passage, isovalue: f64) -> PixelResult {
        let Some(crossing) = self.crossings(passage, isovalue).next() else { return PixelResult::NOTHING };
        let fraction = crossing.fraction;
        let texture = passage.segment.at(fraction);
        let color = self.prepared.functions.at(texture).evaluate(isovalue).color;
        let [r, g, b] = self.prepared.lit(color, texture, &passage.ray);
        PixelResult { color: [r, g, b, 1.0], depth: passage.segment.parameter_at(fraction) }
    }

    pub(super) fn surface_hit(&self, passage: &Passage, isovalue: f64) -> Option<SurfaceHit> {
        let fraction = self.crossings(passage, isovalue).next()?.fraction;
        Some(self.prepared.surface_at(passage.segment.at(fraction), passage.segment.parameter_at(fraction)))
    }

    /// Layers of surfaces, front to back.
    pub(super) fn isosurfaces(&self, passage: &Passage, layers: [Layer; 3]) -> PixelResult {
        let visible = layers.into_iter().filter(|layer| layer.opacity > 0.0);
        let crossed = |layer: Layer| self.crossings(passage, layer.value).map(move |crossing| (crossing, layer));
        let mut met: Vec<_> = visible.flat_map(crossed).collect();
        let met_first = |(crossing, layer): &(Crossing, Layer)| if crossing.rises { layer.value } else { -layer.value };
        met.sort_by(|a, b| a.0.fraction.total_cmp(&b.0.fraction).then(met_first(a).total_cmp(&met_first(b))));
        let mut result = PixelResult::NOTHING;
        for (Crossing { fraction, .. }, layer) in met {
            let color = self.prepared.lit(layer.color, passage.segment.at(fraction), &passage.ray);
            result.put_behind(color, layer.opacity, passage.segment.parameter_at(fraction));
        }
        result
    }

    /// Where the ray passes from one side of the surface to the other. Values not below the isovalue are inside; a ray that
    /// begins inside crosses where it comes out.
    fn crossings(&self, passage: &Passage, isovalue: f64) -> impl Iterator<Item = Crossing> {
        let mut inside = None;
        Cells::new(&self.prepared.field, &passage.segment, Cuts::Centers).flat_map(move |cell| {
            if cell.is_gap {
                inside = None;
                return vec![];
            }
            let side = Sides::new(&cell.values, isovalue);
            let began = *inside.get_or_insert_with(|| side.is_inside(0.0));
            let changes = side.changes(began);
            inside = Some(began ^ (changes.len() % 2 == 1));
            let crossing = |(i, u)| Crossing { fraction: cell.fraction(u), rises: began ^ (i % 2 == 0) };
            changes.into_iter().enumerate().map(crossing).collect()
        })
    }
}

/// A place where a ray crosses an isosurface.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    /// As a fraction of the way.
    fraction: f64,
    /// Whether the ray comes in.
    rises: bool,
}

/// The two sides of an isovalue on a cell.
struct Sides<'a> {
    values: &'a Bernstein,
    isovalue: f64,
    /// What counts as the isovalue lies above this.
    threshold: f64,
}

impl<'a> Sides<'a> {
    fn new(values: &'a Bernstein, isovalue: f64) -> Self {
        let (low, high) = values.bounds();
        let size = isovalue.abs().max(low.abs()).max(high.abs());
        Self { values, isovalue, threshold: isovalue - ROUNDING * size }
    }

    fn is_inside(&self, u: f64) -> bool {
        self.values.at(u) >= self.threshold
    }

    /// Where the ray changes sides on the cell, if it comes from `inside` or not.
    fn changes(&self, mut inside: bool) -> Vec<f64> {
        let mut changes = vec![];
        let (low, high) = self.values.bounds();
        if (inside && low >= self.threshold) || (!inside && high < self.threshold) {
            return changes;
        }
        if self.is_inside(0.0) != inside {
            // A jump between cells: the field of closest voxels, or rounding at a plateau.
            changes.push(0.0);
            inside = !inside;
        }
        for (from, to) in self.values.monotone_places().intervals() {
            if self.is_inside(to) != inside {
                // The crossing proper; where the field only touches the isovalue, its turning point.
                let touched = if inside { from } else { to };
                changes.push(self.values.crossing(self.isovalue, from, to).unwrap_or(touched));
                inside = !inside;
            }
        }
        changes
    }
}
