//! Projections without samples: one value per ray, classified once.

use super::Renderer;
use super::cells::{Cell, Cells, Cuts};
use crate::image::PixelResult;
use crate::prepared::Passage;
use crate::scene::Method;

impl Renderer<'_> {
    pub(super) fn project(&self, passage: &Passage) -> PixelResult {
        let field = &self.prepared.field;
        let cells = || Cells::new(field, &passage.segment, Cuts::Centers).filter(|cell| !cell.is_gap);
        let covered: f64 = cells().map(|cell| cell.to - cell.from).sum();
        if covered == 0.0 {
            return PixelResult::NOTHING;
        }
        // Over the part of the way that has values.
        let mean = || cells().map(|cell| (cell.to - cell.from) * cell.values.mean()).sum::<f64>() / covered;
        let (value, fraction) = match self.prepared.scene.method {
            Method::Mip => extreme(cells(), 1.0),
            Method::MinIp => extreme(cells(), -1.0),
            Method::Sum => {
                let share = field.range().normalise(mean()) * passage.length * covered;
                (field.range().denormalise(share), 0.0)
            }
            _ => (mean(), 0.0),
        };
        let material = self.prepared.functions.at(passage.segment.at(fraction)).evaluate(value);
        let [r, g, b] = material.color.map(|c| c * material.opacity);
        PixelResult { color: [r, g, b, material.opacity], depth: passage.segment.parameter_at(fraction) }
    }
}

/// The largest value times `sign`, without it, and where it first occurs, as a fraction of the way.
fn extreme(cells: impl Iterator<Item = Cell>, sign: f64) -> (f64, f64) {
    let mut best = (f64::NEG_INFINITY, 0.0);
    for cell in cells {
        let (low, high) = cell.values.bounds();
        if (sign * low).max(sign * high) <= best.0 {
            continue;
        }
        for &u in cell.values.monotone_places().as_slice() {
            let value = sign * cell.values.at(u);
            if value > best.0 {
                best = (value, cell.fraction(u));
            }
        }
    }
    (sign * best.0, best.1)
}
