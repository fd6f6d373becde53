//! Pictures and surfaces whose exact value is known.
//!
//! Opacities and colours are those of one ray under emission and absorption: `A = 1 - exp(-∫τ)` and `C = ∫ c τ T dt`,
//! `C` premultiplied. Lengths are in any one unit, extinctions `τ` in its reciprocal. The classic cases:
//!
//! | case | function |
//! |---|---|
//! | T1 homogeneous slab | [`homogeneous_opacity`] |
//! | T2, T3 identities that hold for every volume | [`furnace_residual`], [`constant_color_residual`] |
//! | T4, T5, T6 linear field and linear extinction | [`LinearRamp`] |
//! | T7 exponential atmosphere | [`atmosphere_opacity`] |
//! | T8 step, T9 spike in the transfer function | [`step_opacity`], [`spike_opacity`] |
//! | opacity linear in the value, as transfer functions are drawn | [`linear_opacity_depth`] |
//! | T10 Gaussian blob, T11 homogeneous ball | [`gaussian_blob_opacity`], [`ball_opacity`] |
//! | T12 plane, T13 sphere | [`plane_hit`], [`sphere_hit`], [`sphere_normal`] |
//! | T17 hydrogen orbitals | [`hydrogen_1s_projection`], [`hydrogen_2pz_projection`] |
//! | T18 extreme and mean projections | [`linear_projection`], [`gaussian_blob_maximum`] |

mod absorption;
mod blobs;
mod projections;
mod surfaces;

pub use absorption::{
    LinearRamp, atmosphere_opacity, constant_color_residual, furnace_residual, homogeneous_opacity,
    linear_opacity_depth, spike_opacity, step_opacity,
};
pub use blobs::{ball_opacity, gaussian_blob_maximum, gaussian_blob_opacity};
pub use projections::{
    Projections, hydrogen_1s, hydrogen_1s_projection, hydrogen_2pz, hydrogen_2pz_projection, linear_projection,
};
pub use surfaces::{plane_hit, sphere_hit, sphere_normal};
