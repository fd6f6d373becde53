//! Cutting a closed mesh along a plane, and closing the cut.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DAffine3, DVec2, DVec3};

use crate::Mesh;

/// A plane; what lies where `normal . p > distance` is cut away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Points to the side that is cut away. Of any length.
    pub normal: DVec3,
    /// Where the plane lies along the normal.
    pub distance: f64,
}

impl Plane {
    /// The plane in the coordinates that `map` leads out of: `n . (M t + o) > d` is `(M^T n) . t > d - n . o`.
    pub fn seen_through(&self, map: &DAffine3) -> Self {
        Self {
            normal: map.matrix3.transpose() * self.normal,
            distance: self.distance - self.normal.dot(map.translation),
        }
    }

    /// Positive on the side that is cut away, 0 on the plane and within rounding of it: so a cut repeated at the same
    /// place changes nothing.
    fn side(&self, p: DVec3) -> f64 {
        let side = self.normal.dot(p) - self.distance;
        let rounding = 4.0 * f64::from(f32::EPSILON) * (self.normal.abs().element_sum() + self.distance.abs());
        if side.abs() <= rounding { 0.0 } else { side }
    }
}

/// What remains of a closed mesh below the plane, closed again by a cap in the plane. The plane is given in the
/// coordinates of the mesh.
///
/// A convex cut is filled without new vertices. Any other (several pieces, holes, dents) is filled by trapezoids, whose
/// corners lie on the edges of the cut.
pub fn clip(mesh: &Mesh, plane: &Plane) -> Mesh {
    let corners: Vec<Corner> = mesh.positions.iter().map(|&p| Corner::new(p, plane)).collect();
    let mut result = Builder::default();
    let mut cut = BTreeSet::new();
    for triangle in &mesh.indices {
        let triangle = triangle.map(|i| corners[i as usize]);
        // A triangle within the plane is left to the cap.
        if triangle.iter().all(|corner| corner.side >= 0.0) {
            continue;
        }
        let polygon = below(&triangle);
        let ids: Vec<u32> = polygon.iter().map(|corner| result.vertex(corner.position)).collect();
        for i in 2..ids.len() {
            result.triangle([ids[0], ids[i - 1], ids[i]]);
        }
        for (i, corner) in polygon.iter().enumerate() {
            let j = (i + 1) % polygon.len();
            if corner.side == 0.0 && polygon[j].side == 0.0 && ids[i] != ids[j] {
                // The cap runs along the edge the other way round. Two kept neighbours need no cap between them.
                if !cut.remove(&[ids[i], ids[j]]) {
                    cut.insert([ids[j], ids[i]]);
                }
            }
        }
    }
    result.close(&cut, plane.normal);
    Mesh { positions: result.positions, indices: result.indices, volume: mesh.volume.clone(), closed: mesh.closed }
}

/// A corner of a polygon with its signed distance (in no particular unit) from the plane.
#[derive(Debug, Clone, Copy)]
struct Corner {
    position: [f32; 3],
    side: f64,
}

impl Corner {
    fn new(position: [f32; 3], plane: &Plane) -> Self {
        Self { position, side: plane.side(as_f64(position)) }
    }

    /// Where the edge to `other`, on the other side, meets the plane. The same whichever end is asked, so that neighbours
    /// stay joined.
    fn meet(&self, other: &Self) -> Self {
        let (a, b) = if self.side < other.side { (self, other) } else { (other, self) };
        let position = as_f64(a.position).lerp(as_f64(b.position), a.side / (a.side - b.side));
        Self { position: position.as_vec3().to_array(), side: 0.0 }
    }
}

/// The part of a triangle that is not above the plane, in the same sense of rotation.
fn below(triangle: &[Corner; 3]) -> Vec<Corner> {
    let mut polygon = Vec::with_capacity(4);
    for (i, corner) in triangle.iter().enumerate() {
        let next = &triangle[(i + 1) % 3];
        if corner.side <= 0.0 {
            polygon.push(*corner);
        }
        if corner.side * next.side < 0.0 {
            polygon.push(corner.meet(next));
        }
    }
    polygon
}

/// A mesh under construction that joins equal positions.
#[derive(Default)]
struct Builder {
    positions: Vec<[f32; 3]>,
    indices: Vec<[u32; 3]>,
    known: BTreeMap<[u32; 3], u32>,
}

impl Builder {
    fn vertex(&mut self, position: [f32; 3]) -> u32 {
        // Adding zero makes -0 and 0 the same.
        let key = position.map(|x| (x + 0.0).to_bits());
        *self.known.entry(key).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }

    fn triangle(&mut self, [a, b, c]: [u32; 3]) {
        if a != b && b != c && c != a {
            self.indices.push([a, b, c]);
        }
    }

    fn position(&self, vertex: u32) -> DVec3 {
        as_f64(self.positions[vertex as usize])
    }

    /// Fills the loops that these directed edges form; seen against `normal` they run counter-clockwise.
    fn close(&mut self, edges: &BTreeSet<[u32; 2]>, normal: DVec3) {
        let Some(&[apex, _]) = edges.first() else {
            return;
        };
        let (u, v) = normal.normalize_or(DVec3::Z).any_orthonormal_pair();
        let flat = |vertex: u32| {
            let p = self.position(vertex);
            DVec2::new(u.dot(p), v.dot(p))
        };
        let flat: BTreeMap<u32, DVec2> = edges.iter().flatten().map(|&vertex| (vertex, flat(vertex))).collect();
        if is_convex(edges, &flat) {
            edges.iter().for_each(|&[a, b]| self.triangle([apex, a, b]));
        } else {
            self.close_by_trapezoids(edges, &flat);
        }
    }

    /// Slices the loops at the height of every corner; between two heights the inside lies between every other pair of
    /// edges.
    fn close_by_trapezoids(&mut self, edges: &BTreeSet<[u32; 2]>, flat: &BTreeMap<u32, DVec2>) {
        let mut heights: Vec<f64> = flat.values().map(|p| p.y).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        for slab in heights.windows(2) {
            let middle = 0.5 * (slab[0] + slab[1]);
            let mut crossing: Vec<(f64, [u32; 2])> = edges
                .iter()
                .map(|&[a, b]| if flat[&a].y < flat[&b].y { [a, b] } else { [b, a] })
                .filter(|[low, high]| flat[low].y <= slab[0] && flat[high].y >= slab[1])
                .map(|[low, high]| (flat[&low].lerp(flat[&high], share(flat, low, high, middle)).x, [low, high]))
                .collect();
            crossing.sort_by(|a, b| a.0.total_cmp(&b.0));
            for pair in crossing.chunks_exact(2) {
                let [left, right] = [pair[0].1, pair[1].1];
                let quad =
                    [(left, slab[0]), (right, slab[0]), (right, slab[1]), (left, slab[1])].map(|([low, high], y)| {
                        let position = self.position(low).lerp(self.position(high), share(flat, low, high, y));
                        self.vertex(position.as_vec3().to_array())
                    });
                self.triangle([quad[0], quad[1], quad[2]]);
                self.triangle([quad[0], quad[2], quad[3]]);
            }
        }
    }
}

/// How far along an edge a height lies, 0 to 1.
fn share(flat: &BTreeMap<u32, DVec2>, low: u32, high: u32, height: f64) -> f64 {
    ((height - flat[&low].y) / (flat[&high].y - flat[&low].y)).clamp(0.0, 1.0)
}

/// Whether all corners lie to the left of every edge, but for rounding.
fn is_convex(edges: &BTreeSet<[u32; 2]>, flat: &BTreeMap<u32, DVec2>) -> bool {
    const ROUNDING: f64 = 1e-6;
    edges.iter().all(|[a, b]| {
        let along = flat[b] - flat[a];
        flat.values().all(|p| along.perp_dot(*p - flat[a]) >= -ROUNDING * along.length())
    })
}

fn as_f64(p: [f32; 3]) -> DVec3 {
    DVec3::from_array(p.map(f64::from))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DMat3;
    use rayloom_volume::{Volume, Voxels};

    use super::*;
    use crate::{Precision, VolumeData, cube_proxy};

    fn cube() -> Mesh {
        let voxel = Voxels::U8(vec![0]);
        let volume = Volume::new("voxel", [1; 3], 1, voxel, DAffine3::IDENTITY).expect("valid");
        let volume = Arc::new(VolumeData::new(Arc::new(volume), Precision::Auto));
        cube_proxy::whole_box(&volume)
    }

    /// Volume by the divergence theorem: right only for closed meshes that are wound outwards.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |i: u32| as_f64(mesh.positions[i as usize]);
        let signed = |t: &[u32; 3]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0;
        mesh.indices.iter().map(signed).sum()
    }

    /// Every directed edge must be met by its reverse.
    fn assert_watertight(mesh: &Mesh) {
        let mut open: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for t in &mesh.indices {
            for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
                *open.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
            }
        }
        assert!(open.values().all(|&n| n == 0), "{open:?}");
    }

    #[test]
    fn planes_cut_exact_parts_off_a_cube_and_leave_it_closed() {
        // Fraction of the unit cube with x + y + z <= d: d^3 / 6 for d <= 1, 1/2 at d = 3/2.
        let diagonal = DVec3::ONE;
        for (normal, distance, expected) in [
            (DVec3::X, 0.25, 0.25),
            (DVec3::NEG_Y, -0.75, 0.25),
            (diagonal, 0.5, 0.125 / 6.0),
            (diagonal, 1.0, 1.0 / 6.0),
            (diagonal, 1.5, 0.5),
            (DVec3::new(1.0, 1.0, 0.0), 1.0, 0.5),
            (DVec3::X, 1.0, 1.0),
            (DVec3::X, 0.0, 0.0),
            (DVec3::X, -1.0, 0.0),
            (DVec3::X, 2.0, 1.0),
        ] {
            let part = clip(&cube(), &Plane { normal, distance });
            assert_watertight(&part);
            assert!((volume(&part) - expected).abs() < 1e-6, "{normal} {distance}: {} {expected}", volume(&part));
        }
    }

    #[test]
    fn cuts_in_a_row_commute_and_repeating_one_changes_nothing() {
        let planes = [
            Plane { normal: DVec3::new(1.0, 2.0, -0.5), distance: 1.0 },
            Plane { normal: DVec3::new(-1.0, 0.3, 0.7), distance: 0.1 },
            Plane { normal: DVec3::new(0.2, -1.0, 0.4), distance: 0.0 },
        ];
        let forwards = planes.iter().fold(cube(), |mesh, plane| clip(&mesh, plane));
        let backwards = planes.iter().rev().fold(cube(), |mesh, plane| clip(&mesh, plane));
        assert_watertight(&forwards);
        let both = [volume(&forwards), volume(&backwards)];
        assert!((both[0] - both[1]).abs() < 1e-6 && both[0] > 0.01, "{both:?}");
        let again = planes.iter().fold(forwards.clone(), |mesh, plane| clip(&mesh, plane));
        assert_watertight(&again);
        assert!((volume(&again) - volume(&forwards)).abs() < 1e-6);
    }

    #[test]
    fn a_cut_through_several_pieces_fills_each() {
        let mut two = cube();
        let count = two.positions.len() as u32;
        let shrunk: Vec<_> = two.positions.iter().map(|p| p.map(|x| 0.25 + 0.5 * x)).collect();
        two.positions.extend(shrunk);
        // The inner cube is a cavity: wound the other way round.
        let inner: Vec<_> = two.indices.iter().map(|t| [t[0] + count, t[2] + count, t[1] + count]).collect();
        two.indices.extend(inner);
        let part = clip(&two, &Plane { normal: DVec3::Z, distance: 0.5 });
        assert!((volume(&part) - (0.5 - 0.0625)).abs() < 1e-6, "{}", volume(&part));
    }

    #[test]
    fn a_plane_in_the_world_is_the_same_plane_in_the_volume() {
        let map = DAffine3::from_mat3_translation(
            DMat3::from_cols(DVec3::new(-2.0, 0.0, 0.1), DVec3::new(0.5, 3.0, 0.0), DVec3::new(0.0, 0.0, 7.0)),
            DVec3::new(10.0, -5.0, 3.0),
        );
        let world = Plane { normal: DVec3::new(0.3, -0.8, 0.5), distance: 7.0 };
        let local = world.seen_through(&map);
        let p = DVec3::new(0.2, 0.9, 0.4);
        let direct = world.normal.dot(map.transform_point3(p)) - world.distance;
        assert!((local.normal.dot(p) - local.distance - direct).abs() < 1e-12);
    }
}
