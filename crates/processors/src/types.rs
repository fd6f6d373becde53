//! Ids of the processor types that other crates look for. They are in saved networks, so none ever changes.

/// Sink that shows a picture.
pub const CANVAS: &str = "canvas";
/// Proxy geometry: the box of a volume.
pub const CUBE_PROXY: &str = "cube_proxy";
/// Gives rays their camera, and the points where they enter and leave.
pub const ENTRY_EXIT_POINTS: &str = "entry_exit_points";
/// Walks the rays.
pub const RAY_TRAVERSAL: &str = "ray_traversal";
/// Shows a slice of a volume.
pub const SLICE_VIEW: &str = "slice_view";
/// Computes a volume.
pub const VOLUME_GENERATOR: &str = "volume_generator";
/// Reads a volume from a file.
pub const VOLUME_SOURCE: &str = "volume_source";
