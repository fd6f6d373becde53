//! How far a picture may be from its golden image.
//!
//! On one machine and driver pictures are the same to the last bit. Elsewhere texture units interpolate with weights of
//! about 8 bits, which displaces samples by up to 1/512 voxel. Moving the camera by 0.002 along each axis, 1/512 of a voxel
//! of one millimetre, changes the shares of pixels that the reasons name; the tolerances leave a third more.

/// The largest difference of a channel that nobody sees: two codes of an 8-bit image, and half a code for the rounding of the
/// golden image.
pub const PIXEL: f64 = 2.5 / 255.0;

/// How much of a picture may differ by more than [`PIXEL`].
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// File name of the network, without extension.
    pub network: &'static str,
    /// Share of the pixels, 0 to 1.
    pub share: f64,
    /// Why so much.
    pub reason: &'static str,
}

const fn tolerance(network: &'static str, share: f64, reason: &'static str) -> Tolerance {
    Tolerance { network, share, reason }
}

/// For every network that is not among the exceptions.
pub const DEFAULT: Tolerance = tolerance(
    "",
    0.0025,
    "rays that graze a surface meet it or miss it: at most 0.18 % of the pixels when the camera moves",
);

/// Networks that need more.
pub const EXCEPTIONS: &[Tolerance] = &[
    tolerance(
        "brain",
        0.004,
        "voxels of half a millimetre and a steep transfer function: silhouettes of all gyri, 0.29 %",
    ),
    tolerance(
        "difference",
        0.0065,
        "shows the small difference of two pictures, and so magnifies its own errors: 0.47 %",
    ),
    tolerance("first_hit", 0.0085, "the first visible sample jumps by half a voxel, and with it the normal: 0.63 %"),
];
