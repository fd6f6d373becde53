//! How far it is to the next occupied brick.

use rayon::prelude::*;

/// The Chebyshev distance (the largest of the differences along x, y, z) from every brick to the nearest occupied one, in
/// bricks and at most 255: 0 for occupied bricks, 255 everywhere when none is. `occupied` has one byte a brick, x fastest;
/// anything but 0 is occupied.
///
/// A ray in a brick at distance `d > 0` passes nothing visible before it has left the cube of `2 d - 1` bricks around.
///
/// # Panics
/// When `occupied` has another length than the grid has bricks.
pub fn distance_map(occupied: &[u8], grid: [u32; 3]) -> Vec<u8> {
    let [nx, ny, nz] = grid.map(|n| n as usize);
    assert_eq!(occupied.len(), nx * ny * nz, "one byte for every brick");
    if occupied.is_empty() {
        return Vec::new();
    }
    // Along x the distance within the row; then, axis by axis, the nearest of the rows and of the layers around.
    let mut along_x = vec![0; occupied.len()];
    along_x.par_chunks_mut(nx).zip(occupied.par_chunks(nx)).for_each(|(to, from)| row_distance(from, to));
    let mut along_y = vec![0; occupied.len()];
    along_y.par_chunks_mut(nx * ny).zip(along_x.par_chunks(nx * ny)).for_each(|(to, from)| {
        to.chunks_mut(nx).enumerate().for_each(|(y, row)| nearest_row(from, nx, y, ny, row));
    });
    let layer = nx * ny;
    let mut distance = along_x;
    distance.par_chunks_mut(layer).enumerate().for_each(|(z, to)| nearest_row(&along_y, layer, z, nz, to));
    distance
}

fn row_distance(occupied: &[u8], distance: &mut [u8]) {
    let mut last = 255_u8;
    for (to, &from) in distance.iter_mut().zip(occupied) {
        last = if from != 0 { 0 } else { last.saturating_add(1) };
        *to = last;
    }
    last = 255;
    for to in distance.iter_mut().rev() {
        last = last.saturating_add(1).min(*to);
        *to = last;
    }
}

/// The smallest, over all `count` lines of `length` bytes, of the larger of the distance to that line and the distance
/// within it. Lines farther away than all distances found so far cannot help.
fn nearest_row(lines: &[u8], length: usize, at: usize, count: usize, result: &mut [u8]) {
    result.copy_from_slice(&lines[at * length..][..length]);
    for step in 1..count.min(255) {
        let worst = result.iter().copied().max().unwrap_or(0);
        if usize::from(worst) <= step {
            return;
        }
        let mut take = |line: usize| {
            let candidates = &lines[line * length..][..length];
            result.iter_mut().zip(candidates).for_each(|(to, &from)| *to = (*to).min(from.max(step as u8)));
        };
        if at >= step {
            take(at - step);
        }
        if at + step < count {
            take(at + step);
        }
    }
}
