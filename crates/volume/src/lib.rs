//! Volumes, transfer functions, readers, generators, histograms and min-max bricks. No GPU.
//!
//! Three kinds of coordinates occur:
//! * *index*: voxel centres at integers, the box of the volume is `-0.5 ..= dims - 0.5`;
//! * *texture*: `(index + 0.5) / dims`, the box is `0 ..= 1`;
//! * *world*: physical coordinates, right-anterior-superior millimetres where the format defines a patient space.
//!
//! Values are *data units* (`stored * slope + intercept`) unless a function says *normalised*, which maps the
//! finite range of a channel to `0 ..= 1`.

mod bricks;
mod bspline;
mod distance;
mod gaps;
mod generate;
mod gradient;
mod histogram;
mod range;
mod read;
mod transfer;
mod volume;
mod voxels;

pub use bricks::MinMaxBricks;
pub use bspline::bspline_coefficients;
pub use distance::distance_map;
pub use gaps::Gaps;
pub use generate::{Field, generate};
pub use gradient::{Operator, gradient_volume};
pub use histogram::{Histogram, Histogram2D, histogram, histogram_2d};
pub use range::{ValueRange, fraction};
pub use read::{Format, Progress, ReadError, format_of, formats, read};
pub use transfer::{
    Knot, Label, LabelTable, MAX_EXTINCTION, Medium, Primitive, Rgba, RightSide, Shape, SplitTable, TransferFunction,
    TransferFunction2D, TransferFunctionError, extinction, table_interval,
};
pub use volume::{Volume, VolumeError, VolumeRole};
pub use voxels::{Element, ElementType, Voxels};
