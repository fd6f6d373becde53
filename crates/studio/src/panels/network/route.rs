//! The way of a wire around the nodes between its ends: behind them it would seem to come out of them.

use egui::{Pos2, Rect, Vec2};

use super::geometry::Geometry;

/// Space between a wire and the nodes that it goes around, points of the canvas.
const CLEAR: f32 = 16.0;
/// Spacing of the points that are looked at.
const STEP: f32 = 6.0;

/// The points by which a wire goes past the nodes in its way, from left to right; none where nothing is. Wires that run backwards
/// go as they do.
pub fn around(from: Pos2, to: Pos2, nodes: impl Iterator<Item = Rect>) -> Vec<Pos2> {
    let between = |node: &Rect| node.left() > from.x && node.right() < to.x;
    let mut nodes: Vec<Rect> = nodes.filter(between).collect();
    let mut way: Vec<Pos2> = Vec::new();
    // Every turn takes one node out of the list.
    while let Some((index, at)) = first_hit(from, &way, to, &nodes) {
        let node = nodes.swap_remove(index);
        let above = at.y < node.center().y;
        let y = if above { node.top() - CLEAR } else { node.bottom() + CLEAR };
        way.extend([Pos2::new(node.left() - CLEAR, y), Pos2::new(node.right() + CLEAR, y)]);
        way.sort_by(|a, b| a.x.total_cmp(&b.x));
    }
    way
}

/// The first node that the wire runs behind, and where it does.
fn first_hit(from: Pos2, way: &[Pos2], to: Pos2, nodes: &[Rect]) -> Option<(usize, Pos2)> {
    if nodes.is_empty() {
        return None;
    }
    let path = Geometry::path(from, way, to);
    path.flatten(STEP).find_map(|at| {
        let hit = nodes.iter().position(|node| node.expand2(Vec2::splat(0.25 * CLEAR)).contains(at));
        hit.map(|index| (index, at))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wires_go_around_the_nodes_between_their_ends() {
        let node = |x: f32, y: f32| Rect::from_min_size(Pos2::new(x, y), Vec2::new(150.0, 80.0));
        let (from, to) = (Pos2::new(0.0, 40.0), Pos2::new(900.0, 60.0));
        let others = [node(200.0, 10.0), node(500.0, 20.0), node(300.0, 500.0)];
        let way = around(from, to, others.into_iter());
        assert_eq!(way.len(), 4, "{way:?}");
        for at in Geometry::path(from, &way, to).flatten(2.0) {
            assert!(!others.iter().any(|node| node.contains(at)), "behind a node at {at:?} by {way:?}");
        }
        assert!(around(from, to, [others[2]].into_iter()).is_empty(), "nothing is in the way");
        assert!(around(to, from, others.into_iter()).is_empty(), "it runs backwards");
    }
}
