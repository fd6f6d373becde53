//! Where new panes go.

use egui_tiles::{Container, LinearDir, Tile, TileId, Tiles, Tree};

use crate::pane::Pane;

/// Opens a pane, or brings it to the front if it is open. Pictures lie side by side, beside the canvas, shaders in tabs
/// with the network, everything else in tabs with the properties.
pub fn open(tree: &mut Tree<Pane>, pane: Pane) {
    if let Some(known) = tree.tiles.find_pane(&pane) {
        tree.set_visible(known, true);
        tree.make_active(|tile, _| tile == known);
        return;
    }
    let first = |wanted: fn(&Pane) -> bool| find(tree, wanted);
    let place = match pane {
        Pane::Inspector(_) | Pane::Accuracy | Pane::RayProbe => {
            first(|pane| matches!(pane, Pane::Inspector(_) | Pane::Accuracy | Pane::RayProbe))
                .map(|inspector| (inspector, Some(LinearDir::Horizontal)))
                .or_else(|| {
                    first(|pane| matches!(pane, Pane::Canvas)).map(|canvas| (canvas, Some(LinearDir::Horizontal)))
                })
        }
        Pane::Shader(_) => first(|pane| matches!(pane, Pane::Network)).map(|network| (network, None)),
        _ => first(|pane| matches!(pane, Pane::Properties)).map(|properties| (properties, None)),
    };
    let new = tree.tiles.insert_pane(pane);
    match place.or(tree.root().map(|root| (root, Some(LinearDir::Horizontal)))) {
        None => *tree = Tree::new(tree.id(), new, std::mem::take(&mut tree.tiles)),
        Some((neighbour, Some(dir))) => place_beside(tree, neighbour, new, dir),
        Some((neighbour, None)) => place_in_tabs(tree, neighbour, new),
    }
    tree.make_active(|tile, _| tile == new);
}

/// The newest pane of a kind.
fn find(tree: &Tree<Pane>, wanted: fn(&Pane) -> bool) -> Option<TileId> {
    let panes = tree.tiles.iter().filter_map(|(id, tile)| match tile {
        Tile::Pane(pane) if wanted(pane) => Some(*id),
        _ => None,
    });
    panes.max_by_key(|id| id.0)
}

/// The tabs that hold a tile, or itself.
fn tabs_of(tiles: &Tiles<Pane>, tile: TileId) -> TileId {
    let parent = tiles.parent_of(tile);
    parent.filter(|&parent| matches!(tiles.get_container(parent), Some(Container::Tabs(_)))).unwrap_or(tile)
}

fn place_in_tabs(tree: &mut Tree<Pane>, neighbour: TileId, new: TileId) {
    let tabs = tabs_of(&tree.tiles, neighbour);
    match tree.tiles.get_mut(tabs) {
        Some(Tile::Container(container @ Container::Tabs(_))) => container.add_child(new),
        _ => place_beside(tree, neighbour, new, LinearDir::Horizontal),
    }
}

/// To the right of a pane, or below it, half of its room.
fn place_beside(tree: &mut Tree<Pane>, neighbour: TileId, new: TileId, dir: LinearDir) {
    let neighbour = tabs_of(&tree.tiles, neighbour);
    let parent = tree.tiles.parent_of(neighbour);
    if let Some(Tile::Container(Container::Linear(linear))) = parent.and_then(|parent| tree.tiles.get_mut(parent))
        && linear.dir == dir
        && dir == LinearDir::Horizontal
    {
        linear.add_child(new);
        return;
    }
    let row = tree.tiles.insert_container(egui_tiles::Linear::new(dir, vec![neighbour, new]));
    match parent.and_then(|parent| tree.tiles.get_mut(parent)) {
        Some(Tile::Container(container)) => {
            // The parent has this child: it was found by it.
            let _ = container.replace_child(neighbour, row);
        }
        _ => *tree = Tree::new(tree.id(), row, std::mem::take(&mut tree.tiles)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels::default_layout;

    #[test]
    fn every_opened_pane_can_be_reached_and_only_once() {
        let mut tree = default_layout();
        let panes =
            ["a.image", "b.image", "c.image"].map(|address| Pane::Inspector(address.parse().expect("an address")));
        for pane in panes.iter().chain(&panes).cloned().chain([Pane::Messages]) {
            open(&mut tree, pane);
            tree.simplify(&egui_tiles::SimplificationOptions { all_panes_must_have_tabs: true, ..Default::default() });
        }
        let mut reached = Vec::new();
        let mut queue = vec![tree.root().expect("a root")];
        while let Some(id) = queue.pop() {
            match tree.tiles.get(id) {
                Some(Tile::Pane(pane)) => reached.push(pane.clone()),
                Some(Tile::Container(container)) => queue.extend(container.children()),
                None => panic!("a tile that is nowhere"),
            }
        }
        for pane in panes.iter().chain([&Pane::Canvas, &Pane::Messages]) {
            assert_eq!(reached.iter().filter(|found| *found == pane).count(), 1, "{pane:?}");
        }
    }
}
