//! What can be done to the knots of a transfer function. Everything keeps them sorted and within bounds.

use rayloom_volume::{Knot, Rgba, RightSide, TransferFunction, ValueRange};

/// A side of a knot; a knot that is not split has only the left one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Side {
    /// What holds below the knot.
    Left,
    /// What holds from the knot on.
    Right,
}

/// Colour and opacity of a side.
pub(super) fn side(knot: &Knot, side: Side) -> Rgba {
    match side {
        Side::Left => knot.left_side(),
        Side::Right => knot.right_side(),
    }
}

/// Changes colour and opacity of a side.
pub(super) fn set_side(knot: &mut Knot, side: Side, color: [f64; 3], opacity: f64) {
    let opacity = opacity.clamp(0.0, 1.0);
    match (side, &mut knot.right) {
        (Side::Right, Some(right)) => (right.color, right.opacity) = (color, opacity),
        _ => (knot.color, knot.opacity) = (color, opacity),
    }
}

/// Moves a knot between its neighbours.
pub(super) fn move_to(function: &mut TransferFunction, index: usize, at: f64) {
    let low = index.checked_sub(1).and_then(|below| function.knots.get(below)).map_or(f64::MIN, |knot| knot.at);
    let high = function.knots.get(index + 1).map_or(f64::MAX, |knot| knot.at);
    if let Some(knot) = function.knots.get_mut(index).filter(|_| !at.is_nan()) {
        knot.at = at.max(low).min(high);
    }
}

/// Adds a knot with the colour that the function has there; its number.
pub(super) fn insert(function: &mut TransferFunction, at: f64, opacity: f64) -> usize {
    let color = match function.knots.is_empty() {
        true => [1.0; 3],
        false => function.evaluate(at).color,
    };
    let index = function.knots.partition_point(|knot| knot.at <= at);
    function.knots.insert(index, Knot::new(at, color, opacity.clamp(0.0, 1.0)));
    index
}

/// Splits a knot into two equal sides, or lets the left side count on both.
pub(super) fn toggle_split(knot: &mut Knot) {
    knot.right = match knot.right {
        Some(_) => None,
        None => Some(RightSide { color: knot.color, opacity: knot.opacity }),
    };
}

/// Maps the knots so that `from` becomes `to`.
fn remap(function: &TransferFunction, from: ValueRange, to: ValueRange) -> TransferFunction {
    let mut mapped = function.clone();
    for knot in &mut mapped.knots {
        let at = to.denormalise(from.normalise(knot.at));
        knot.at = at.clamp(f64::MIN, f64::MAX);
    }
    mapped
}

/// From the first knot to the last.
pub(super) fn extent(function: &TransferFunction) -> Option<ValueRange> {
    Some(ValueRange::new(function.knots.first()?.at, function.knots.last()?.at))
}

/// Stretches the function so that its first and last knot lie at the ends of a range.
pub(super) fn fit(function: &TransferFunction, range: ValueRange) -> TransferFunction {
    match extent(function) {
        Some(extent) if extent.max > extent.min => remap(function, extent, range),
        _ => function.clone(),
    }
}

/// Moves all knots (level) and stretches them about their middle (window).
pub(super) fn window_level(function: &TransferFunction, shift: f64, stretch: f64) -> TransferFunction {
    let Some(extent) = extent(function) else { return function.clone() };
    let (middle, half) = (0.5 * extent.min + 0.5 * extent.max, 0.5 * extent.width() * stretch);
    if extent.width() > 0.0 {
        return remap(function, extent, ValueRange::new(middle + shift - half, middle + shift + half));
    }
    let mut moved = function.clone();
    moved.knots.iter_mut().for_each(|knot| knot.at += shift);
    moved
}

/// Mirrors the function within a range.
pub(super) fn mirror(function: &TransferFunction, range: ValueRange) -> TransferFunction {
    let mut mirrored = function.clone();
    mirrored.knots.reverse();
    for knot in &mut mirrored.knots {
        knot.at = range.min + range.max - knot.at;
        if let Some(right) = &mut knot.right {
            std::mem::swap(&mut right.color, &mut knot.color);
            std::mem::swap(&mut right.opacity, &mut knot.opacity);
        }
    }
    mirrored
}

/// A function to begin with: name, and knots as share of the range, colour, opacity.
type Preset = (&'static str, &'static [(f64, [f64; 3], f64)]);

/// Functions to begin with.
pub(super) const PRESETS: [Preset; 6] = [
    ("Ramp", &[(0.0, [0.0, 0.0, 0.0], 0.0), (1.0, [1.0, 1.0, 1.0], 0.5)]),
    (
        "Soft tissue",
        &[
            (0.10, [0.48, 0.18, 0.15], 0.0),
            (0.28, [0.85, 0.54, 0.46], 0.35),
            (0.42, [0.97, 0.80, 0.71], 0.8),
            (0.65, [1.0, 0.95, 0.89], 0.95),
        ],
    ),
    (
        "Bone",
        &[
            (0.40, [0.55, 0.35, 0.22], 0.0),
            (0.50, [0.84, 0.69, 0.50], 0.45),
            (0.70, [0.96, 0.91, 0.80], 0.85),
            (1.0, [1.0, 1.0, 0.97], 0.95),
        ],
    ),
    (
        "Skin over bone",
        &[
            (0.08, [0.90, 0.66, 0.54], 0.0),
            (0.14, [0.93, 0.70, 0.58], 0.06),
            (0.22, [0.90, 0.62, 0.50], 0.0),
            (0.45, [0.84, 0.69, 0.50], 0.0),
            (0.60, [0.96, 0.91, 0.80], 0.8),
            (1.0, [1.0, 1.0, 0.97], 0.95),
        ],
    ),
    (
        "Warm and cold",
        &[(0.0, [0.23, 0.30, 0.75], 0.6), (0.5, [0.86, 0.86, 0.86], 0.0), (1.0, [0.71, 0.02, 0.15], 0.6)],
    ),
    (
        "Heat",
        &[
            (0.0, [0.0, 0.0, 0.0], 0.0),
            (0.35, [0.75, 0.10, 0.05], 0.15),
            (0.70, [1.0, 0.75, 0.15], 0.4),
            (1.0, [1.0, 1.0, 0.85], 0.8),
        ],
    ),
];

/// A preset over a range.
pub(super) fn preset(shape: &[(f64, [f64; 3], f64)], range: ValueRange) -> TransferFunction {
    let knots = shape.iter().map(|(share, color, opacity)| Knot::new(range.denormalise(*share), *color, *opacity));
    TransferFunction { knots: knots.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brain() -> TransferFunction {
        let mut function = preset(PRESETS[3].1, ValueRange::new(-100.0, 400.0));
        toggle_split(&mut function.knots[2]);
        set_side(&mut function.knots[2], Side::Right, [0.2, 0.4, 0.6], 0.7);
        function
    }

    #[test]
    fn nothing_leaves_knots_unsorted_or_out_of_bounds() {
        let range = ValueRange::new(0.0, 1.0);
        for function in PRESETS.map(|(_, shape)| preset(shape, range)).into_iter().chain([brain()]) {
            let mut moved = function.clone();
            move_to(&mut moved, 1, 1e9);
            insert(&mut moved, -5.0, 2.0);
            let results =
                [fit(&function, range), window_level(&function, 3.0, 2.0), mirror(&function, range), moved, function];
            assert!(results.iter().all(|result| result.check().is_ok()), "{results:?}");
        }
    }

    #[test]
    fn mirroring_twice_and_windows_there_and_back_change_nothing() {
        let (function, range) = (brain(), ValueRange::new(-100.0, 400.0));
        let mirrored = mirror(&mirror(&function, range), range);
        let moved = window_level(&window_level(&function, 8.0, 2.0), -8.0, 0.5);
        for back in [mirrored, moved] {
            for (knot, original) in back.knots.iter().zip(&function.knots) {
                assert!((knot.at - original.at).abs() < 1e-9);
                assert_eq!(Knot { at: original.at, ..*knot }, *original);
            }
        }
    }

    #[test]
    fn a_knot_stays_between_its_neighbours_and_a_new_one_has_the_colour_there() {
        let mut function = preset(PRESETS[0].1, ValueRange::new(0.0, 10.0));
        let index = insert(&mut function, 5.0, 0.9);
        assert_eq!((index, function.knots[1].color), (1, [0.5; 3]));
        move_to(&mut function, 1, 20.0);
        assert_eq!(function.knots[1].at, 10.0);
    }
}
