//! The first crossing of a value, from the roots of the field.

use super::Renderer;
use super::bernstein::Bernstein;
use super::cells::{Cells, Cuts};
use crate::image::PixelResult;
use crate::prepared::{Passage, SurfaceHit};

/// Shortfall, relative to the values around, at which a value still counts as the isovalue: interpolating equal values rounds,
/// and a plateau on the isovalue shall be one surface.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Renderer<'_> {
    pub(super) fn isosurface(&self, passage: &Passage, isovalue: f64) -> PixelResult {
        let Some(fraction) = self.crossing(passage, isovalue) else { return PixelResult::NOTHING };
        let texture = passage.segment.at(fraction);
        let color = self.prepared.functions.at(texture).evaluate(isovalue).color;
        let [r, g, b] = self.prepared.lit(color, texture, &passage.ray);
        PixelResult { color: [r, g, b, 1.0], depth: passage.segment.parameter_at(fraction) }
    }

    pub(super) fn surface_hit(&self, passage: &Passage, isovalue: f64) -> Option<SurfaceHit> {
        let fraction = self.crossing(passage, isovalue)?;
        Some(self.prepared.surface_at(passage.segment.at(fraction), passage.segment.parameter_at(fraction)))
    }

    /// Where the ray first passes from one side of the surface to the other, as a fraction of the way. Values not below the
    /// isovalue are inside; a ray that begins inside crosses where it comes out.
    fn crossing(&self, passage: &Passage, isovalue: f64) -> Option<f64> {
        let mut inside = None;
        for cell in Cells::new(&self.prepared.field, &passage.segment, Cuts::Centers) {
            if cell.is_gap {
                inside = None;
                continue;
            }
            let side = Sides::new(&cell.values, isovalue);
            let began = *inside.get_or_insert(side.is_inside(0.0));
            if let Some(u) = side.first_change(began) {
                return Some(cell.fraction(u));
            }
        }
        None
    }
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

    /// The first place of the cell that is not on the side where the ray is.
    fn first_change(&self, inside: bool) -> Option<f64> {
        let (low, high) = self.values.bounds();
        if (inside && low >= self.threshold) || (!inside && high < self.threshold) {
            return None;
        }
        if self.is_inside(0.0) != inside {
            // A jump between cells: the field of closest voxels, or rounding at a plateau.
            return Some(0.0);
        }
        let places = self.values.monotone_places();
        let (from, to) = places.intervals().find(|&(_, to)| self.is_inside(to) != inside)?;
        // The crossing proper; where the field only touches the isovalue, its turning point.
        Some(self.values.crossing(self.isovalue, from, to).unwrap_or(if inside { from } else { to }))
    }
}
