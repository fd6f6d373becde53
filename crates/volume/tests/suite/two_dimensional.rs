//! Transfer functions of value and gradient magnitude.

use rayloom_volume::{MAX_EXTINCTION, Primitive, Rgba, Shape, TransferFunction2D, ValueRange, extinction};

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const SQUARE: Shape = Shape::Rectangle { value: [10.0, 20.0], gradient: [0.0, 4.0] };

fn one(shape: Shape, softness: f64) -> TransferFunction2D {
    TransferFunction2D::new(vec![Primitive { shape, color: RED, opacity: 0.8, softness }]).unwrap()
}

#[test]
fn shapes_cover_what_they_should() {
    let triangle = Shape::Triangle { apex: [10.0, 0.0], base: [0.0, 20.0], base_gradient: 8.0 };
    let bell = Shape::Gaussian { center: [10.0, 2.0], sigma: [1.0, 0.5] };
    let cases = [
        (SQUARE, 0.0, [15.0, 2.0], 0.8),
        (SQUARE, 0.0, [10.0, 4.0], 0.8),
        (SQUARE, 0.0, [9.99, 2.0], 0.0),
        (SQUARE, 0.0, [15.0, 4.01], 0.0),
        (SQUARE, 1.0, [12.5, 2.0], 0.4),
        (SQUARE, 0.5, [12.5, 2.0], 0.8),
        (SQUARE, 1.0, [10.0, 2.0], 0.0),
        (triangle, 0.0, [10.0, 0.1], 0.8),
        (triangle, 0.0, [1.0, 7.9], 0.8),
        (triangle, 0.0, [1.0, 4.0], 0.0),
        (triangle, 0.0, [10.0, 8.1], 0.0),
        (triangle, 1.0, [10.0, 16.0 / 3.0], 0.8),
        (bell, 0.0, [10.0, 2.0], 0.8),
        (bell, 0.0, [13.01, 2.0], 0.0),
    ];
    for (shape, softness, [value, gradient], expected) in cases {
        let found = one(shape, softness).evaluate(value, gradient).opacity;
        assert!((found - expected).abs() < 1e-9, "{shape:?} at {value}, {gradient}: {found} instead of {expected}");
    }
}

#[test]
fn overlapping_primitives_add_their_extinctions() {
    let primitives =
        [(RED, 0.5), (BLUE, 0.75)].map(|(color, opacity)| Primitive { shape: SQUARE, color, opacity, softness: 0.0 });
    let f = TransferFunction2D::new(primitives.to_vec()).unwrap();
    let Rgba { color, opacity } = f.evaluate(15.0, 1.0);
    assert!((opacity - 0.875).abs() < 1e-12);
    let red = extinction(0.5) / (extinction(0.5) + extinction(0.75));
    assert!((color[0] - red).abs() < 1e-12 && (color[2] - (1.0 - red)).abs() < 1e-12);

    let opaque = TransferFunction2D::new(vec![Primitive { opacity: 1.0, ..primitives[0] }; 3]).unwrap();
    assert_eq!(opaque.medium(15.0, 1.0).to_entry(), [MAX_EXTINCTION as f32, 0.0, 0.0, MAX_EXTINCTION as f32]);
}

#[test]
fn tables_run_over_values_then_gradients() {
    let f = one(SQUARE, 1.0);
    let table = f.table(ValueRange::new(0.0, 30.0), 6.0, 31, 7);
    for (i, j) in [(15, 2), (12, 1), (0, 0), (30, 6)] {
        assert_eq!(table[j * 31 + i], f.medium(i as f64, j as f64).to_entry());
    }
}

#[test]
fn transparency_ignores_invisible_primitives() {
    let f = one(SQUARE, 0.0);
    assert!(f.transparent_between(0.0, 9.9) && f.transparent_between(20.1, 99.0));
    assert!(!f.transparent_between(0.0, 10.0) && !f.transparent_between(12.0, 13.0));
    let mut hidden = f;
    hidden.primitives[0].opacity = 0.0;
    assert!(hidden.transparent_between(0.0, 99.0));
}

#[test]
fn json_is_read_checked_and_written_back() {
    let text = r#"{"primitives":[{"shape":{"rectangle":{"value":[10.0,20.0],"gradient":[0.0,4.0]}},"color":[1.0,0.0,0.0],"opacity":0.8,"softness":0.0}]}"#;
    let f: TransferFunction2D = serde_json::from_str(text).unwrap();
    assert_eq!(f, one(SQUARE, 0.0));
    assert_eq!(serde_json::to_string(&f).unwrap(), text);
    for (from, to, part) in [
        ("20.0", "10.0", "`value` of primitive 0"),
        ("0.8", "1.8", "opacity"),
        ("rectangle", "circle", "circle"),
        ("4.0]", "4.0, 5.0]", ""),
    ] {
        let message = serde_json::from_str::<TransferFunction2D>(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}
