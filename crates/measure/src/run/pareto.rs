//! Which of several compromises are worth a choice.

/// What a setting costs and how wrong it is; smaller is better for both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Time or samples.
    pub cost: f64,
    /// Error.
    pub error: f64,
}

impl Point {
    /// Whether this point is at least as good in both respects and better in one.
    pub fn dominates(&self, other: &Self) -> bool {
        self.cost <= other.cost && self.error <= other.error && (self.cost < other.cost || self.error < other.error)
    }
}

/// The points that no other dominates, by rising cost. Points that are not finite are never among them; of equal points the
/// first one is.
pub fn front(points: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).filter(|&i| is_finite(&points[i])).collect();
    order.sort_by(|&a, &b| {
        let by = |key: fn(&Point) -> f64| key(&points[a]).total_cmp(&key(&points[b]));
        by(|p| p.cost).then(by(|p| p.error)).then(a.cmp(&b))
    });
    let mut best = f64::INFINITY;
    order.retain(|&i| {
        let on_front = points[i].error < best;
        best = best.min(points[i].error);
        on_front
    });
    order
}

/// The point of the front that dominates the point `index` and is the most accurate of those; `None` on the front.
pub fn dominator(points: &[Point], index: usize) -> Option<usize> {
    front(points).into_iter().rev().find(|&i| points[i].dominates(&points[index]))
}

fn is_finite(point: &Point) -> bool {
    point.cost.is_finite() && point.error.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(of: &[(f64, f64)]) -> Vec<Point> {
        of.iter().map(|&(cost, error)| Point { cost, error }).collect()
    }

    #[test]
    fn the_front_of_known_points() {
        let points = points(&[(1.0, 9.0), (2.0, 4.0), (3.0, 5.0), (4.0, 1.0), (4.0, 2.0), (9.0, 1.0), (1.0, 9.5)]);
        assert_eq!(front(&points), [0, 1, 3]);
        let dominators: Vec<Option<usize>> = (0..points.len()).map(|i| dominator(&points, i)).collect();
        assert_eq!(dominators, [None, None, Some(1), None, Some(3), Some(3), Some(0)]);
    }

    #[test]
    fn equal_points_are_on_the_front_once_and_broken_ones_never() {
        let points = points(&[(1.0, 1.0), (1.0, 1.0), (f64::NAN, 0.0), (0.5, f64::INFINITY)]);
        assert_eq!(front(&points), [0]);
        assert_eq!(dominator(&points, 1), None);
        assert!(front(&[]).is_empty());
    }
}
