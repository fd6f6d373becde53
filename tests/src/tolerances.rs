//! Every tolerance of the accuracy tests, with its reason. A test that fails calls for its cause, not for a larger number.
//!
//! Colours and opacities run from 0 to 1. `EPSILON` of f32 is 1.2e-7, half of which is what one operation rounds.

pub mod golden;

/// Agreement with the float64 renderer: largest mean difference of a channel. A fifth of a code of an 8-bit image, so that
/// rounded pictures are the same but for a few pixels.
pub const AGREEMENT_MEAN: f64 = 0.2 / 255.0;
/// Agreement: two codes of an 8-bit image, what a pixel may differ by unseen.
pub const AGREEMENT_PIXEL: f64 = 2.0 / 255.0;
/// Agreement: share of the pixels that hold [`AGREEMENT_PIXEL`]. The rest are rays that graze a surface: f32 and f64 may
/// disagree on whether they cross it.
pub const AGREEMENT_SHARE: f64 = 0.999;

/// T1, T4: opacity of a medium that the midpoint rule integrates exactly. Rounding of entry and exit points (6e-8 of the box
/// each), of the table and of up to 1000 composited samples, whose errors mostly cancel.
pub const OPACITY: f64 = 2e-6;
/// Length of a ray that enters and leaves askew, in edges of the box: entry and exit are points of a ray through a scene a few
/// boxes deep, so each coordinate is rounded a few times by 1.2e-7, and more shows where the ray grazes a face.
pub const CHORD: f64 = 6e-7;
/// T1, E34 with opacity 1e-8 a sample: relative error after 1e4 to 1e5 samples, or as many as the driver allows. Long rays add up
/// faint samples on their own until they are a 64th of the whole, to which they are added 64 ln 1e5 = 740 times: 2e-5 off if each
/// addition were rounded by 2^-25 and all to the same side, half of which is allowed.
pub const FAINT: f64 = 1e-5;
/// T2: two units in the last place of 1.
pub const FURNACE: f64 = 2.4e-7;
/// T3: emission and extinction are rounded on their own, in the table and at each of a few operations.
pub const ONE_COLOR: f64 = 1e-6;
/// T5, T6: error of the colour at 32 samples.
pub const RAMP_AT_32: f64 = 3e-4;
/// T6: the same at 256 samples, by its order.
pub const RAMP_AT_256: f64 = RAMP_AT_32 / 64.0;
/// Observed orders of convergence of second order methods.
pub const SECOND_ORDER: std::ops::RangeInclusive<f64> = 1.9..=2.1;
/// Smaller errors of ramps show no order: that of f32 and of the 1024 entries of the table, between which emission runs
/// linearly and not as a square (5e-7), is a tenth of this.
pub const ORDER_ABOVE: f64 = 5e-6;
/// T8, T11: mean observed order where single errors are irregular.
pub const FIRST_ORDER: std::ops::RangeInclusive<f64> = 0.8..=1.2;
/// T8: how far a step of a transfer function may lie from its place, as a share of the value range: what a table cut at its steps
/// leaves to rounding, and the rounding of values in f32.
pub const STEP_PLACE: f64 = 1e-6;
/// Cells of pre-integrated tables along either value: within one, a step is a ramp.
pub const STEP_TABLE_2D: f64 = 255.0;
/// T10: the grid's own error of the opacity, `h^2 / 12` of the integrated Laplacian, on a grid of 144.
pub const BLOB: f64 = 2e-3;
/// T12: place of a plane, voxels, with linear weights of 8 bits: half a weight.
pub const PLANE_FILTERED: f64 = 1.0 / 512.0;
/// T12 with float weights: values near 1 are rounded by 6e-8 of the range of 26 voxels, positions by 2e-6 voxels.
pub const PLANE: f64 = 1e-5;
/// T12: unit normals. Values are rounded by 6e-8 of the range, and a voxel's difference is a thirtieth of it.
pub const PLANE_NORMAL: f64 = 1e-5;
/// T13: share of the bound of the grid's error that is allowed; more than all of it for the rounding of depths.
pub const SPHERE: f64 = 1.02;
/// T18: a value after the table, rounded a few times.
pub const PROJECTION: f64 = 1e-6;
/// T18: orders of second order methods where samples fall irregularly about a maximum.
pub const SECOND_ORDER_IRREGULAR: std::ops::RangeInclusive<f64> = 1.8..=2.2;
/// Camera: opacity of a homogeneous box, beside what the rounding of its chord by [`CHORD`] allows.
pub const VIEW_OPACITY: f64 = 2e-6;
/// Camera: share of the pixels that the rasteriser may give to the wrong side of the box's outline. It places corners on a
/// grid of 1/256 pixel, so one pixel in about a hundred of those that an outline passes through.
pub const OUTLINE: f64 = 1e-3;
/// I5, I6: mean difference of two pictures whose voxels are stored along other axes: interpolation and positions round otherwise.
pub const AXES_MEAN: f64 = 5e-7;
/// The same, largest difference without shading.
pub const AXES_UNSHADED: f64 = 5e-6;
/// The same with shading: normals are differences of close values.
pub const AXES_SHADED: f64 = 1e-5;
/// The same with surfaces: where a ray grazes one, its place along the ray is rounding divided by the sine of the angle.
pub const AXES_SURFACE: f64 = 5e-4;
/// I8: two halves, composited.
pub const HALVES: f64 = 1e-6;
/// I12: a coordinate of a ray is rounded three times by 6e-8 of a box of up to 34 voxels, otherwise in a larger volume; some ten
/// samples of a ray along an axis are off alike by those few 1e-6 voxels and change the opacity by up to 1 a voxel each.
pub const PADDED: f64 = 5e-6;
/// The same with shading, and where the place of a surface counts: that is a distance on the ray, rounded twice more by 1e-6 voxels
/// where it is counted from another box.
pub const PADDED_SHADED: f64 = 8e-5;
/// E24, E28, E31: values in another unit are rounded to f64 (the largest offset leaves 1e-7 of the range) and normalised to f32.
pub const UNITS: f64 = 1e-5;
/// I7: largest difference of worlds of another size or place. Matrices are built in f64 and round to f32 otherwise; where rays
/// graze a surface or a normal is seen edge-on, more shows.
pub const WORLDS: f64 = 1e-5;
/// E48: unit normals on stretched grids, where a voxel's difference is a hundredth of the value range.
pub const STRETCHED_NORMAL: f64 = 1e-4;
/// E41: opacity of a spike between entries of a pre-integrated table of 256, whose means are interpolated.
pub const SPIKE: f64 = 1e-3;
/// T14, T15: gradients, normalised values a voxel. The two values of a difference are rounded by 6e-8 each, and places by
/// 1e-6 voxels of which a tenth shows.
pub const DIFFERENCE: f64 = 5e-7;
/// T16: what linear interpolation loses of the signal at least, rms.
pub const MARSCHNER_LOBB_LINEAR: f64 = 0.02;
/// T16: values interpolated in f32 from places that are rounded by 1e-6 voxels, in a field with slopes of 0.2 a voxel.
pub const INTERPOLATED: f64 = 2e-6;
/// I4: rounding of what is left of a ray, beside the error that was asked for.
pub const TERMINATION: f64 = 5e-7;
/// Agreement: depth of a refined surface, world units. The last of eight halvings, which rounding may decide, is a step of up to
/// 2.5 divided by 2^8.
pub const REFINED: f64 = 1e-2;
/// Agreement: any pixel with any gradient operator, borders included. A quarter of a code is found where the surface is grazed.
pub const AGREEMENT_GRADIENT: f64 = 0.5 / 255.0;
/// Ray probe: a value interpolated with float weights, as a share of the range. Positions are rounded by [`CHORD`] of a box of
/// up to 60 voxels, along which the value changes by up to a third of the range a voxel.
pub const PROBED_VALUE: f64 = 1.2e-5;
/// Estimated over true error of smooth scenes: this at most, or its reciprocal at least.
pub const ESTIMATE: f64 = 1.5;
/// Estimated over true error of any scene: half at least, so that nobody trusts a picture too much.
pub const ESTIMATE_LEAST: f64 = 0.5;
