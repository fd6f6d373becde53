//! Emission and absorption, and where they begin, without samples.

use super::Renderer;
use super::cells::{Cell, Cells, Cuts};
use super::medium::Medium;
use super::quadrature::{LIT_TOLERANCE, Quadrature, Stretch, TOLERANCE};
use crate::gradient::GradientOperator;
use crate::image::PixelResult;
use crate::prepared::Passage;
use crate::scene::FirstHit;
use rayloom_volume::{Knot, TransferFunction};

/// Optical depth at which a ray ends: from here on the opacity `1 - exp(-depth)` is 1 in float64.
const OPAQUE: f64 = 37.5;

/// A piece of a cell on which the transfer function is straight.
#[derive(Debug, Clone, Copy)]
struct Piece {
    from: f64,
    to: f64,
    medium: Medium,
}

impl Renderer<'_> {
    pub(super) fn emission(&self, passage: &Passage) -> PixelResult {
        let mut total = Stretch::default();
        let mut first = None;
        let mut pieces = Vec::new();
        for cell in self.cells(passage) {
            self.split(passage, &cell, &mut pieces);
            for piece in &pieces {
                first.get_or_insert_with(|| cell.fraction(piece.from));
                total = total.then(&self.stretch(passage, &cell, piece, total.transmittance()));
            }
            if total.depth > OPAQUE {
                break;
            }
        }
        let Some(first) = first else { return PixelResult::NOTHING };
        let [r, g, b] = total.color;
        PixelResult { color: [r, g, b, total.opacity()], depth: passage.segment.parameter_at(first) }
    }

    /// Where the first piece begins that can be seen.
    pub(super) fn first_hit(&self, passage: &Passage, told: FirstHit) -> PixelResult {
        let mut pieces = Vec::new();
        let hit = self.cells(passage).find_map(|cell| {
            self.split(passage, &cell, &mut pieces);
            pieces.first().map(|piece| cell.fraction(piece.from))
        });
        let told =
            |fraction| self.prepared.told(told, passage.segment.at(fraction), passage.segment.parameter_at(fraction));
        hit.map_or(PixelResult::NOTHING, told)
    }

    /// The cells of a ray that have values, of one transfer function each.
    fn cells(&self, passage: &Passage) -> impl Iterator<Item = Cell> {
        let scene = self.prepared.scene;
        // Light bends where gradients do: one-sided differences turn to the other side half a voxel before the edge.
        let turns = matches!(scene.gradient, GradientOperator::Forward | GradientOperator::Backward);
        let cuts = if scene.shading.is_some() && turns { Cuts::HalfVoxels } else { Cuts::Centers };
        let cells = Cells::new(&self.prepared.field, &passage.segment, cuts);
        cells.cut_at_faces(self.prepared.functions.faces()).filter(|cell| !cell.is_gap)
    }

    /// The pieces of a cell of which something can be seen, into `pieces`.
    fn split(&self, passage: &Passage, cell: &Cell, pieces: &mut Vec<Piece>) {
        pieces.clear();
        split(cell, self.prepared.functions.at(passage.segment.at(cell.fraction(0.5))), pieces);
    }

    /// What a piece does to the ray, a share of `transmittance` of which reaches the eye.
    fn stretch(&self, passage: &Passage, cell: &Cell, piece: &Piece, transmittance: f64) -> Stretch {
        let scale = passage.length * (cell.to - cell.from);
        let medium = |u: f64| piece.medium.at(cell.values.at(u));
        if self.prepared.scene.shading.is_some() {
            let lit = |u: f64| {
                let (extinction, color) = medium(u);
                let texture = passage.segment.at(cell.fraction(u));
                (extinction, self.prepared.lit(color, texture, &passage.ray))
            };
            let quadrature = Quadrature { medium: lit, scale, tolerance: LIT_TOLERANCE };
            return quadrature.stretch(piece.from, piece.to, transmittance);
        }
        match (piece.medium.constant_extinction(), piece.medium.constant_color()) {
            (Some(extinction), Some(color)) => {
                Stretch::homogeneous(extinction * scale * (piece.to - piece.from), color)
            }
            _ => Quadrature { medium, scale, tolerance: TOLERANCE }.stretch(piece.from, piece.to, transmittance),
        }
    }
}

/// Splits a cell where the field passes a knot of the transfer function; pieces of which nothing can be seen are left out.
fn split(cell: &Cell, function: &TransferFunction, pieces: &mut Vec<Piece>) {
    let values = &cell.values;
    let mut add = |from: f64, to: f64, medium: Medium| {
        if to > from && !medium.is_transparent() {
            pieces.push(Piece { from, to, medium });
        }
    };
    let (low, high) = values.bounds();
    if values.is_constant() {
        return add(0.0, 1.0, Medium::uniform(function.evaluate(low)));
    }
    if knots_between(function, low, high).is_empty() {
        return add(0.0, 1.0, Medium::around(function, 0.5 * (low + high)));
    }
    for (start, end) in values.monotone_places().intervals() {
        let (first, last) = (values.at(start), values.at(end));
        let knots = knots_between(function, first.min(last), first.max(last));
        let rising = first < last;
        let mut from = start;
        for i in 0..knots.len() {
            let knot = &knots[if rising { i } else { knots.len() - 1 - i }];
            let to = values.crossing(knot.at, from, end).unwrap_or(from);
            add(from, to, Medium::around(function, values.at(0.5 * (from + to))));
            from = to;
        }
        add(from, end, Medium::around(function, values.at(0.5 * (from + end))));
    }
}

/// The knots strictly between two values.
fn knots_between(function: &TransferFunction, low: f64, high: f64) -> &[Knot] {
    let first = function.knots.partition_point(|knot| knot.at <= low);
    let behind = function.knots.partition_point(|knot| knot.at < high);
    &function.knots[first.min(behind)..behind]
}
