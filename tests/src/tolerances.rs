//! Every tolerance of the accuracy tests, with its reason. A test that fails calls for its cause, not for a larger number.
//!
//! Colours and opacities run from 0 to 1. `EPSILON` of f32 is 1.2e-7, half of which is what one operation rounds.

/// Agreement with the float64 renderer: largest mean difference of a channel. A fifth of a code of an 8-bit image, so that
/// rounded pictures are the same but for a few pixels.
pub const AGREEMENT_MEAN: f64 = 0.2 / 255.0;
/// Agreement: two codes of an 8-bit image, what a pixel may differ by unseen.
pub const AGREEMENT_PIXEL: f64 = 2.0 / 255.0;
/// Agreement: share of the pixels that hold [`AGREEMENT_PIXEL`]. The rest are rays that graze a surface: f32 and f64 may
/// disagree on whether they cross it.
pub const AGREEMENT_SHARE: f64 = 0.999;
