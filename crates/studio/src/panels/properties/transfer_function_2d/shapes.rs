//! What can be done to the shapes of a 2-D transfer function. Points are (value, gradient magnitude).

use rayloom_volume::{Primitive, Shape, TransferFunction2D};

/// A point of the plane.
pub(super) type Point = [f64; 2];

/// Standard deviations at which the outline of a Gaussian is drawn.
const REACH: f64 = 2.0;

/// The points by which a shape is dragged into another form.
pub(super) fn handles(shape: &Shape) -> Vec<Point> {
    match *shape {
        Shape::Rectangle { value: [a, b], gradient: [c, d] } => vec![[a, c], [b, c], [b, d], [a, d]],
        Shape::Triangle { apex, base: [a, b], base_gradient } => vec![apex, [a, base_gradient], [b, base_gradient]],
        Shape::Gaussian { center: [v, g], sigma: [s, t] } => vec![[v + REACH * s, g], [v, g + REACH * t]],
    }
}

/// The shape with one of its handles elsewhere, where that makes sense.
pub(super) fn reshaped(shape: &Shape, handle: usize, to: Point) -> Shape {
    let [value, gradient] = [to[0], to[1].max(0.0)];
    let mut after = *shape;
    match &mut after {
        Shape::Rectangle { value: v, gradient: g } => {
            v[usize::from(handle == 1 || handle == 2)] = value;
            g[usize::from(handle >= 2)] = gradient;
        }
        Shape::Triangle { apex, .. } if handle == 0 => *apex = [value, gradient],
        Shape::Triangle { base, base_gradient, .. } => {
            base[usize::from(handle == 2)] = value;
            *base_gradient = gradient;
        }
        Shape::Gaussian { center, sigma } if handle == 0 => sigma[0] = (value - center[0]) / REACH,
        Shape::Gaussian { center, sigma } => sigma[1] = (gradient - center[1]) / REACH,
    }
    if is_valid(after) { after } else { *shape }
}

/// The shape moved.
pub(super) fn moved(shape: &Shape, [dv, dg]: Point) -> Shape {
    let mut after = *shape;
    match &mut after {
        Shape::Rectangle { value, gradient } => {
            value.iter_mut().for_each(|v| *v += dv);
            gradient.iter_mut().for_each(|g| *g += dg);
        }
        Shape::Triangle { apex, base, base_gradient } => {
            *apex = [apex[0] + dv, apex[1] + dg];
            base.iter_mut().for_each(|v| *v += dv);
            *base_gradient += dg;
        }
        Shape::Gaussian { center, .. } => *center = [center[0] + dv, center[1] + dg],
    }
    if is_valid(after) { after } else { *shape }
}

fn is_valid(shape: Shape) -> bool {
    TransferFunction2D::new(vec![Primitive { shape, color: [0.0; 3], opacity: 0.0, softness: 0.0 }]).is_ok()
}

/// The outline, a convex polygon.
pub(super) fn outline(shape: &Shape) -> Vec<Point> {
    match *shape {
        Shape::Gaussian { center, sigma } => (0..40)
            .map(|corner| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(corner) / 40.0).sin_cos();
                [center[0] + REACH * sigma[0] * cos, center[1] + REACH * sigma[1] * sin]
            })
            .collect(),
        _ => handles(shape),
    }
}

/// Whether a point lies within a polygon.
pub(super) fn contains(polygon: &[Point], [x, y]: Point) -> bool {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    // The point is inside when a ray to the right crosses an odd number of edges.
    let crossings =
        edges.filter(|&(a, b)| (a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]);
    crossings.count() % 2 == 1
}

/// New shapes: name and where they stand, as shares of the plane.
pub(super) const NEW: [(&str, Shape); 3] = [
    ("Rectangle", Shape::Rectangle { value: [0.4, 0.6], gradient: [0.2, 0.5] }),
    ("Triangle", Shape::Triangle { apex: [0.5, 0.05], base: [0.35, 0.65], base_gradient: 0.6 }),
    ("Gaussian", Shape::Gaussian { center: [0.5, 0.3], sigma: [0.08, 0.1] }),
];

/// A shape of [`NEW`] in the plane that begins at `low` and spans `size`.
pub(super) fn placed(shape: &Shape, low: f64, size: Point) -> Shape {
    let (value, gradient) = (|share: f64| low + share * size[0], |share: f64| share * size[1]);
    match *shape {
        Shape::Rectangle { value: v, gradient: g } => {
            Shape::Rectangle { value: v.map(value), gradient: g.map(gradient) }
        }
        Shape::Triangle { apex, base, base_gradient } => Shape::Triangle {
            apex: [value(apex[0]), gradient(apex[1])],
            base: base.map(value),
            base_gradient: gradient(base_gradient),
        },
        Shape::Gaussian { center, sigma } => Shape::Gaussian {
            center: [value(center[0]), gradient(center[1])],
            sigma: [sigma[0] * size[0], sigma[1] * size[1]],
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_drag_leaves_a_shape_without_area() {
        for (name, shape) in NEW {
            let shape = placed(&shape, -100.0, [500.0, 40.0]);
            for handle in 0..handles(&shape).len() {
                for to in handles(&shape).into_iter().chain([[1e9, -5.0], [-1e9, 3.0], [f64::NAN, 0.0]]) {
                    assert!(is_valid(reshaped(&shape, handle, to)), "{name} {handle} {to:?}");
                }
            }
            assert!(is_valid(moved(&shape, [f64::INFINITY, 0.0])));
        }
    }

    #[test]
    fn a_handle_goes_where_it_is_dragged() {
        for (name, shape) in NEW {
            for (handle, at) in handles(&shape).into_iter().enumerate() {
                let to = [at[0] + 0.01, at[1] + 0.01];
                let there = handles(&reshaped(&shape, handle, to))[handle];
                assert!(there.iter().zip(to).any(|(a, b)| (a - b).abs() < 1e-9), "{name} {handle}");
            }
        }
    }

    #[test]
    fn points_are_inside_or_outside() {
        for (name, shape) in NEW {
            assert!(contains(&outline(&shape), [0.5, 0.3]), "{name}");
            assert!(!contains(&outline(&shape), [0.9, 0.3]), "{name}");
        }
    }
}
