//! Errors of surfaces where rays meet them, for networks that show one.

use glam::DVec3;
use rayloom_network::{Network, Value};
use rayloom_processors::{MISS, Picture};
use rayloom_reference::metrics::ErrorStatistics;
use rayloom_reference::{SurfaceComparison, SurfacePoint};
use serde::Serialize;

use crate::MeasureError;
use crate::subject::chain::Chain;
use crate::subject::compositing_of;
use crate::subject::lighting::reads_gradient;

/// How far the surfaces in pictures are from those of their reference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SurfaceErrors {
    /// Pixels that meet the surface in both.
    pub common: usize,
    /// Pixels of the silhouette that meet it only in the reference.
    pub missing: usize,
    /// Pixels of the silhouette that meet it only in the picture.
    pub extra: usize,
    /// Errors of the distance of the hit along the viewing direction, in mean voxel spacings.
    pub distance: Spread,
    /// Angles between the normals in degrees; `None` where the network has no normals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<Spread>,
}

/// Statistics of an error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Root of the mean square.
    pub rmse: f64,
    /// What 99 % of the pixels do not exceed.
    pub p99: f64,
    /// The largest.
    pub max: f64,
}

impl From<ErrorStatistics> for Spread {
    fn from(ErrorStatistics { rmse, p99, max, .. }: ErrorStatistics) -> Self {
        Self { rmse, p99, max }
    }
}

/// The surface in a picture, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Surface {
    pub points: Vec<Option<SurfacePoint>>,
    /// Whether the points have normals.
    pub normals: bool,
}

impl SurfaceErrors {
    /// Of surfaces of the same pixels; `voxel` is the mean spacing in world units.
    pub(crate) fn of(found: &Surface, expected: &Surface, voxel: f64) -> Result<Self, MeasureError> {
        let compared = SurfaceComparison::new(&found.points, &expected.points, voxel)?;
        Ok(Self {
            common: compared.common,
            missing: compared.missing,
            extra: compared.extra,
            distance: compared.distance.into(),
            normal: (found.normals && expected.normals).then(|| compared.normal.into()),
        })
    }

    /// Pixels in which only one of the surfaces is met.
    pub fn silhouette(&self) -> usize {
        self.missing + self.extra
    }
}

/// What of a picture tells its surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Layers {
    /// The depth.
    Depth,
    /// The depth, and colours that are normals.
    Normals,
    /// The depth; normals are read by [`NORMAL`] on another outport.
    ProbedNormals,
}

impl Layers {
    /// Those of the picture of a ray traversal; `None` if it shows no surface, or not only one.
    pub fn of(network: &Network, chain: &Chain) -> Option<Self> {
        let (id, slot) = (chain.traversal(), compositing_of(&chain.image.item));
        let text = |property: &str| match network.value(id, property) {
            Some(Value::Text(text)) => text,
            _ => String::new(),
        };
        if !text(&format!("{slot}.text")).trim().is_empty() {
            return None;
        }
        match text(&slot).as_str() {
            "isosurface" if reads_gradient(network, id) => Some(Self::ProbedNormals),
            "first_hit_normal" => Some(Self::Normals),
            "isosurface" | "first_hit_point" | "first_hit_depth" => Some(Self::Depth),
            _ => None,
        }
    }
}

/// The surface of a picture, with normals as its colours or those of a picture that holds them.
pub(crate) fn surface(picture: &Picture, normals: Option<&[[f32; 4]]>) -> Option<Surface> {
    let depth = picture.depth.as_ref()?;
    let normal = |i: usize| normals.and_then(|pixels| pixels.get(i)).map_or(DVec3::ZERO, |pixel| decoded(*pixel));
    let point = |(i, &depth): (usize, &f32)| {
        (depth < MISS).then(|| SurfacePoint { distance: f64::from(depth), normal: normal(i) })
    };
    Some(Surface { points: depth.iter().enumerate().map(point).collect(), normals: normals.is_some() })
}

/// The direction in a premultiplied pixel that holds `n / 2 + 1 / 2`; zero for an empty one.
fn decoded(pixel: [f32; 4]) -> DVec3 {
    let [x, y, z, alpha] = pixel.map(f64::from);
    if alpha > 0.0 { 2.0 * DVec3::new(x, y, z) / alpha - DVec3::ONE } else { DVec3::ZERO }
}

/// Text of a compositing snippet that finds an isosurface as the shipped one does, and shows its normal.
pub(crate) const NORMAL: &str = "//! slot: compositing
//! help: Unit normal (against the gradient, world space) of the first isosurface, each component n stored as n / 2 + 1 / 2.
//! reads: previous, refinement, gradient
//! terminates: hit
//! empty: no_crossing isovalue
//! param isovalue: f32 = 0.5 [-1e30, 1e30] unit data -- value of the surface

struct State { found: bool, a: f32, b: f32, fa: f32, fb: f32 }
fn begin() -> State { return State(false, 0.0, 0.0, 0.0, 0.0); }
fn add(state: ptr<function, State>, ray: Ray, s: Sample) {
    let fa = s.previous - params.isovalue;
    let fb = s.value - params.isovalue;
    if !(*state).found && (fa >= 0.0) != (fb >= 0.0) { *state = State(true, s.previous_distance, s.distance, fa, fb); }
}
fn done(state: State) -> bool { return state.found; }
fn finish(state: State, ray: Ray) -> Result {
    var last = state;
    if !last.found { add(&last, ray, last_stretch(ray)); }
    if !last.found { return Result(vec4f(0.0), -1.0); }
    let distance = refine(ray, last.a, last.b, last.fa, last.fb, params.isovalue);
    let p = position_along(ray, distance);
    let gradient = world_gradient(p, voxel_at(p));
    return Result(vec4f(0.5 - 0.5 * gradient / max(length(gradient), 1e-20), 1.0), distance);
}
";
