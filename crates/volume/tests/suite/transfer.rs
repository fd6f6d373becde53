//! Transfer functions of one value, their tables and pre-integration.

use proptest::prelude::*;
use rayloom_volume::{
    Knot, Label, LabelTable, MAX_EXTINCTION, Medium, Rgba, SplitTable, TransferFunction, ValueRange, extinction,
    table_interval,
};

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const RANGE: ValueRange = ValueRange { min: -10.0, max: 30.0 };

fn function(knots: Vec<Knot>) -> TransferFunction {
    TransferFunction::new(knots).unwrap()
}

/// Ramps, a jump, a plateau and a gap, so that every branch is passed.
fn bumpy() -> TransferFunction {
    function(vec![
        Knot::new(-5.0, RED, 0.0),
        Knot::new(0.0, [1.0, 0.8, 0.2], 0.6),
        Knot::split(7.3, (BLUE, 0.1), (RED, 0.9)),
        Knot::new(12.0, BLUE, 0.9),
        Knot::new(15.0, [0.0, 1.0, 0.0], 0.0),
        Knot::new(20.0, BLUE, 0.0),
        Knot::new(28.0, RED, 0.3),
    ])
}

#[test]
fn evaluation_is_linear_constant_outside_and_continuous_from_the_right() {
    let f = function(vec![
        Knot::new(0.0, RED, 0.2),
        Knot::split(10.0, (BLUE, 0.4), (RED, 0.8)),
        Knot::new(20.0, BLUE, 1.0),
    ]);
    let cases = [
        (-1e300, RED, 0.2),
        (f64::NAN, RED, 0.2),
        (5.0, [0.5, 0.0, 0.5], 0.3),
        (10.0, RED, 0.8),
        (15.0, [0.5, 0.0, 0.5], 0.9),
        (20.0, BLUE, 1.0),
        (f64::INFINITY, BLUE, 1.0),
    ];
    for (value, color, opacity) in cases {
        let found = f.evaluate(value);
        let near = (0..3).all(|c| (found.color[c] - color[c]).abs() < 1e-12) && (found.opacity - opacity).abs() < 1e-12;
        assert!(near, "{found:?} at {value}");
    }
    assert!((f.evaluate(10.0_f64.next_down()).opacity - 0.4).abs() < 1e-12);
    assert_eq!(TransferFunction::default().evaluate(3.0), Rgba::default());

    let double = function(vec![Knot::new(1.0, RED, 0.1), Knot::new(1.0, RED, 0.5), Knot::new(1.0, BLUE, 0.9)]);
    assert_eq!((double.evaluate(0.9).opacity, double.evaluate(1.0).opacity), (0.1, 0.9));
}

#[test]
fn extinction_undoes_exponential_opacity() {
    assert_eq!((extinction(0.0), extinction(1.0)), (0.0, MAX_EXTINCTION));
    for opacity in [1e-12, 1e-3, 0.5, 0.999] {
        assert!((-(-extinction(opacity)).exp_m1() / opacity - 1.0).abs() < 1e-12);
    }
}

#[test]
fn json_is_read_checked_and_written_back() {
    let text = r#"{"knots":[{"at":30.0,"color":[1.0,0.5,0.2],"opacity":0.1},{"at":60.0,"color":[1.0,0.5,0.2],"opacity":0.1,"right":{"color":[0.0,0.0,1.0],"opacity":0.7}}]}"#;
    let f: TransferFunction = serde_json::from_str(text).unwrap();
    assert_eq!(serde_json::to_string(&f).unwrap(), text);
    let refused = [
        (r#"{"knots":[{"at":1,"color":[1,0,0],"opacity":1.5}]}"#, "the opacity of knot 0 is 1.5"),
        (r#"{"knots":[{"at":1,"color":[1,-1,0],"opacity":1}]}"#, "green of knot 0 is -1"),
        (
            r#"{"knots":[{"at":1,"color":[1,0,0],"opacity":1,"right":{"color":[1,0,0],"opacity":2}}]}"#,
            "right side of knot 0 is 2",
        ),
        (
            r#"{"knots":[{"at":2,"color":[1,0,0],"opacity":1},{"at":1,"color":[1,0,0],"opacity":1}]}"#,
            "knot 1 lies at 1",
        ),
        (r#"{"knots":[{"at":2,"colour":[1,0,0],"opacity":1}]}"#, "colour"),
        (r#"{"nots":[]}"#, "nots"),
    ];
    for (text, part) in refused {
        let message = serde_json::from_str::<TransferFunction>(text).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
    assert!(TransferFunction::new(vec![Knot::new(f64::NAN, RED, 0.0)]).is_err());

    let labels = LabelTable { labels: [(7, Label { name: "liver".into(), transfer_function: f })].into() };
    let text = serde_json::to_string(&labels).unwrap();
    assert!(text.starts_with(r#"{"7":{"name":"liver""#), "{text}");
    assert_eq!(serde_json::from_str::<LabelTable>(&text).unwrap(), labels);
}

#[test]
fn tables_start_and_end_with_the_range() {
    let f = bumpy();
    let table = f.table(RANGE, 41);
    for (i, entry) in table.iter().enumerate() {
        assert_eq!(*entry, f.medium(f64::from(i as i32) - 10.0).to_entry(), "entry {i}");
    }
    assert_eq!(f.table(ValueRange::new(3.0, 3.0), 2), [f.medium(3.0).to_entry(); 2]);
    assert!(f.table(RANGE, 0).is_empty() && f.table(RANGE, 1).len() == 1);
}

/// The medium that the shader finds at a normalised value, in the shader's precision.
fn split_lookup(table: &SplitTable, u: f32) -> [f32; 4] {
    let last = table.width - 1;
    let entry = |i: usize, row: usize| table.entries[row * table.width + i];
    let x = u.clamp(0.0, 1.0) * last as f32;
    let i = (x as usize).min(last - 1);
    let [first, second, ..] = entry(i, 6);
    let piece = usize::from(x >= first) + usize::from(x >= second);
    let ends = [i as f32, first, second, (i + 1) as f32];
    let along = ((x - ends[piece]) / (ends[piece + 1] - ends[piece]).max(1e-9)).clamp(0.0, 1.0);
    let (start, end) = (entry(i, 2 * piece), entry(i, 2 * piece + 1));
    std::array::from_fn(|c| start[c] * (1.0 - along) + end[c] * along)
}

#[test]
fn steps_are_met_at_every_value_of_8_bits() {
    let range = ValueRange::new(0.0, 255.0);
    // A weighted mean of two equal numbers may be rounded.
    let same = |a: [f32; 4], b: Medium| a.iter().zip(b.to_entry()).all(|(a, b)| (a - b).abs() < 1e-6);
    for step in 0..=255u8 {
        let f = function(vec![Knot::split(f64::from(step), (RED, 0.25), (BLUE, 0.75))]);
        let table = f.split_table(range, f.table_entries(range, 1024, 8));
        assert_eq!((table.width, table.entries.len()), (1024, 1024 * SplitTable::ROWS));
        for value in 0..=255u8 {
            // As an unorm texel, and a little off.
            for u in
                [f32::from(value) / 255.0, f32::from(value) * (1.0 / 255.0), (f32::from(value) / 255.0).next_down()]
            {
                assert!(same(split_lookup(&table, u), f.medium(value.into())), "step {step}, value {value}");
            }
        }
        // Nothing is blended next to the step.
        for (off, side) in [(-1e-6, f.medium(-1.0)), (1e-6, f.medium(256.0))] {
            let u = (f64::from(step) / 255.0 + off) as f32;
            if (0.0..=1.0).contains(&u) {
                assert!(same(split_lookup(&table, u), side), "step {step} {off}");
            }
        }
    }
}

#[test]
fn steep_ramps_get_finer_tables() {
    let range = ValueRange::new(0.0, 1.0);
    for (width, opacity, entries, cut) in
        [(0.1, 0.6, 1024, false), (0.02, 0.8, 4093, false), (0.002, 0.8, 8185, true), (0.002, 0.02, 1024, false)]
    {
        let f = function(vec![Knot::new(0.3, RED, 0.0), Knot::new(0.3 + width, RED, opacity)]);
        assert_eq!((f.table_entries(range, 1024, 8), f.has_steps(range, 1024, 8)), (entries, cut), "{width} {opacity}");
        let (table, split) = (f.table(range, entries), f.split_table(range, entries));
        let plain = |value: f64| {
            let x = value * (entries - 1) as f64;
            let [a, b] = [0, 1].map(|next| table[(x as usize + next).min(entries - 1)][3]);
            a + (b - a) * x.fract() as f32
        };
        // But for the cells with the ends of the ramp, which a plain table blunts.
        let cell = 1.0 / (entries - 1) as f64;
        let inner = (0..=2000).map(|i| 0.3 + cell + (width - 2.0 * cell) * f64::from(i) / 2000.0);
        let worst = inner.map(|value| {
            let found = if cut { split_lookup(&split, value as f32)[3] } else { plain(value) };
            ((-f64::from(found)).exp() - (1.0 - f.evaluate(value).opacity)).abs()
        });
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < 2e-4, "{width} {opacity}: {worst}");
    }
}

#[test]
fn bands_of_any_width_keep_their_width() {
    let range = ValueRange::new(0.0, 1.0);
    for width in [1e-2, 1e-3, 1e-4, 1e-5] {
        for at in [0.1, 0.25, 0.500_001, 0.98] {
            let band =
                |at: f64| [Knot::split(at, (RED, 0.0), (RED, 0.05)), Knot::split(at + width, (RED, 0.05), (RED, 0.0))];
            let ramp = |at: f64| {
                [
                    Knot::new(at, RED, 0.0),
                    Knot::new(at + width, RED, 0.05),
                    Knot::split(at + 0.015, (RED, 0.05), (RED, 0.0)),
                ]
            };
            for f in [
                function(band(at).to_vec()),
                function([band(at), band(at + 3.0 * width)].concat()),
                function(ramp(at).to_vec()),
            ] {
                assert!(f.has_steps(range, 1024, 8));
                let table = f.split_table(range, f.table_entries(range, 1024, 8));
                for i in 0..=1000 {
                    let value = at + width * (f64::from(i) * 0.006 - 1.0);
                    let steps = [0.0, width, 3.0 * width, 4.0 * width, 0.015];
                    let near_step = value > 1.0 || steps.iter().any(|&step| (value - at - step).abs() < 1e-6);
                    let (found, expected) = (split_lookup(&table, value as f32), f.medium(value).to_entry());
                    // A ramp within a cell rises by the slack of `f32` over its width.
                    let tolerance = 1e-3 + 1e-6 / width as f32;
                    assert!(
                        near_step || (found[3] - expected[3]).abs() < tolerance,
                        "{width} at {at}: {found:?} {expected:?}"
                    );
                }
            }
        }
    }
    // Hundreds of breaks in a thousandth of the range: more cells, and no more than allowed.
    let comb = (0..400).map(|i| Knot::split(0.5 + f64::from(i) * 2.5e-6, (RED, 0.1), (RED, 0.9)));
    let comb = function(comb.collect());
    assert_eq!(comb.table_entries(range, 1024, 8), 8 * 1023 + 1);
    let table = comb.split_table(range, 1024);
    assert!(table.entries.iter().flatten().all(|number| number.is_finite()));
    // Jumps alone need no finer table, however they are written.
    let double = function(vec![Knot::new(0.3, RED, 0.0), Knot::new(0.3, RED, 0.8), Knot::new(0.9, RED, 0.8)]);
    assert!(double.has_steps(range, 1024, 8) && double.table_entries(range, 1024, 8) == 1024);
    assert_eq!(function(vec![]).split_table(ValueRange::new(2.0, 2.0), 2).entries.len(), 2 * SplitTable::ROWS);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn transparency_is_exact_and_holds_through_a_table(a in -15.0..35.0_f64, width in 0.0..20.0_f64) {
        let f = bumpy();
        let (min, max) = (a, a + width);
        let seen = (0..=4000).any(|i| f.evaluate(min + width * f64::from(i) / 4000.0).opacity > 0.0);
        prop_assert_eq!(f.transparent_between(min, max), !seen, "{} to {}", min, max);

        let n = 64;
        let (low, high) = table_interval(RANGE, n, min, max);
        prop_assert!(low <= min && max <= high);
        if f.transparent_between(low, high) {
            let table = f.table(RANGE, n);
            for i in 0..=100 {
                let at = RANGE.normalise(min + width * f64::from(i) / 100.0).clamp(0.0, 1.0) * (n - 1) as f64;
                prop_assert!(table[at.floor() as usize][3] == 0.0 && table[at.ceil() as usize][3] == 0.0);
            }
        }
    }
}

#[test]
fn transparency_at_points_and_jumps() {
    let f = bumpy();
    for (min, max, expected) in [
        (-9.0, -5.0, true),
        (15.0, 20.0, true),
        (17.0, 17.0, true),
        (14.9, 15.0, false),
        (15.0, 20.1, false),
        (-9.0, -4.9, false),
    ] {
        assert_eq!(f.transparent_between(min, max), expected, "{min} to {max}");
    }
    let step = function(vec![Knot::split(5.0, (RED, 0.0), (RED, 1.0))]);
    assert!(step.transparent_between(0.0, 5.0_f64.next_down()) && !step.transparent_between(0.0, 5.0));
    assert!(TransferFunction::default().transparent_between(f64::MIN, f64::MAX));
}

/// Opacity and premultiplied colour of a segment by brute force: many homogeneous parts from front to back.
fn composite(f: &TransferFunction, front: f64, back: f64, length: f64) -> ([f64; 3], f64) {
    let parts = 20_000;
    let (mut color, mut depth) = ([0.0; 3], 0.0_f64);
    for i in 0..parts {
        let t = (f64::from(i) + 0.5) / f64::from(parts);
        let medium = f.medium(front * (1.0 - t) + back * t);
        let tau = medium.extinction * length / f64::from(parts);
        let reaching = (-depth).exp();
        if tau > 0.0 {
            (0..3).for_each(|c| color[c] += reaching * medium.emission[c] / medium.extinction * -(-tau).exp_m1());
        }
        depth += tau;
    }
    (color, -(-depth).exp_m1())
}

/// What a renderer makes of an entry of a table.
fn looked_up(entry: [f32; 4], length: f64) -> ([f64; 3], f64) {
    let [r, g, b, extinction] = entry.map(f64::from);
    let alpha = -(-extinction * length).exp_m1();
    ([r, g, b].map(|e| if extinction > 0.0 { e / extinction * alpha } else { 0.0 }), alpha)
}

#[test]
fn preintegrated_segments_match_numeric_integration() {
    let (f, n) = (bumpy(), 41);
    for length in [0.05, 1.0, 6.0] {
        let (full, fast) = (f.preintegration_full(RANGE, n, length), f.preintegration_fast(RANGE, n));
        for (front, back) in [(0, 40), (40, 0), (12, 19), (19, 12), (17, 18), (5, 9), (25, 33), (20, 20), (30, 2)] {
            let at = back * n + front;
            let (color, alpha) = composite(&f, RANGE.min + front as f64, RANGE.min + back as f64, length);
            let (full_color, full_alpha) = looked_up(full[at], length);
            let (fast_color, fast_alpha) = looked_up(fast[at], length);
            assert!(
                (full_alpha - alpha).abs() < 2e-4 && (fast_alpha - alpha).abs() < 2e-4,
                "{front} -> {back}: {full_alpha} {fast_alpha} {alpha}"
            );
            for c in 0..3 {
                assert!(
                    (full_color[c] - color[c]).abs() < 2e-3,
                    "{front} -> {back}, length {length}: {full_color:?} instead of {color:?}"
                );
                // Without self-attenuation the error grows with the opacity of the segment.
                assert!(
                    (fast_color[c] - color[c]).abs() < 2e-3 + 0.5 * alpha * alpha,
                    "{front} -> {back}: {fast_color:?} instead of {color:?}"
                );
            }
        }
    }
}

#[test]
fn preintegration_keeps_front_and_back_apart() {
    let f = function(vec![Knot::new(0.0, RED, 0.9), Knot::new(1.0, BLUE, 0.9)]);
    let table = f.preintegration_full(ValueRange::new(0.0, 1.0), 16, 4.0);
    // Column: front. Red in front and blue behind looks red.
    let red_in_front = table[15 * 16];
    let blue_in_front = table[15];
    assert!(red_in_front[0] > 2.0 * red_in_front[2] && blue_in_front[2] > 2.0 * blue_in_front[0]);
}

#[test]
fn preintegration_of_steps_is_exact_and_of_homogeneous_media_the_medium() {
    let step = function(vec![Knot::split(0.5, (RED, 0.0), (RED, 0.7))]);
    let unit = ValueRange::new(0.0, 1.0);
    let (n, sigma) = (11, extinction(0.7));
    for table in [step.preintegration_fast(unit, n), step.preintegration_full(unit, n, 2.0)] {
        for (front, back) in [(0, 10), (10, 0), (3, 9), (6, 2), (4, 5), (0, 4)] {
            let (low, high) = (front.min(back) as f64 / 10.0, front.max(back) as f64 / 10.0);
            let expected = sigma * (high - low.max(0.5)).max(0.0) / (high - low);
            let found = table[back * n + front];
            assert!(
                (f64::from(found[3]) - expected).abs() < 1e-6 * sigma,
                "{front} -> {back}: {found:?} instead of {expected}"
            );
            assert!((found[0] - found[3]).abs() <= 1e-5 * found[3], "red stays red");
        }
    }
    let opaque = function(vec![Knot::new(0.0, BLUE, 1.0)]);
    let expected = Medium { emission: [0.0, 0.0, MAX_EXTINCTION], extinction: MAX_EXTINCTION }.to_entry();
    for table in [opaque.preintegration_fast(unit, 9), opaque.preintegration_full(unit, 9, 1.0)] {
        assert!(table.iter().all(|entry| (0..4).all(|c| (entry[c] - expected[c]).abs() <= 1e-6 * expected[3])));
    }
    assert!(bumpy().preintegration_fast(RANGE, 0).is_empty() && bumpy().preintegration_full(RANGE, 1, 1.0).len() == 1);
    assert_eq!(bumpy().preintegration_full(RANGE, 8, f64::NAN), bumpy().preintegration_fast(RANGE, 8));
}

#[test]
fn what_is_transparent_is_exactly_so_in_every_table() {
    let f = bumpy();
    let n = 41;
    for table in [f.preintegration_fast(RANGE, n), f.preintegration_full(RANGE, n, 1.0)] {
        for (front, back) in [(25, 30), (30, 25), (0, 5), (27, 27)] {
            assert_eq!(table[back * n + front], [0.0; 4], "{front} -> {back}");
        }
    }
}
