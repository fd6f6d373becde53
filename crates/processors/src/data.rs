//! What flows through connections.

use std::sync::{Arc, OnceLock};

use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_network::{Choice, Facts, ImageKind, Job, ProcessError, PropertyDecl};
use rayloom_volume::Volume;

use crate::{GpuVolume, View};

/// The depth of a pixel that nothing was hit in: larger than every real one, and finite, since shaders may assume that
/// infinities do not occur.
pub const MISS: f32 = 3.0e38;

/// Data on a port; a handle, cheap to clone.
#[derive(Debug, Clone)]
pub enum Data {
    /// A volume.
    Volume(Arc<VolumeData>),
    /// An image, with or without depth.
    Image(Arc<Image>),
    /// A mesh in volume coordinates.
    Geometry(Arc<Mesh>),
}

impl Data {
    /// What conditions and hints may know about the data.
    pub fn facts(&self) -> Facts {
        match self {
            Self::Volume(data) => {
                Facts::Volume { dims: data.volume.dims, channels: data.volume.channels, role: data.volume.role }
            }
            Self::Image(image) => {
                Facts::Image { kind: image.kind, size: image.size(), has_depth: image.depth.is_some() }
            }
            Self::Geometry(mesh) => Facts::Geometry { triangles: mesh.indices.len() },
        }
    }
}

impl From<VolumeData> for Data {
    fn from(volume: VolumeData) -> Self {
        Self::Volume(Arc::new(volume))
    }
}

impl From<Image> for Data {
    fn from(image: Image) -> Self {
        Self::Image(Arc::new(image))
    }
}

impl From<Mesh> for Data {
    fn from(mesh: Mesh) -> Self {
        Self::Geometry(Arc::new(mesh))
    }
}

/// How precisely a volume is held on the device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// The cheapest format that loses nothing.
    #[default]
    Auto,
    /// 256 codes over the value range.
    Bits8,
    /// 16 bits a value.
    Bits16,
    /// 32-bit floats.
    Bits32,
}

impl Precision {
    /// The property by which sources let the user choose, with the id `precision`.
    pub fn property() -> PropertyDecl {
        let choices = vec![
            Choice::new(
                "auto",
                "Lossless",
                "The cheapest format that holds every value exactly (32-bit floats for floats).",
            ),
            Choice::new("8-bit", "8 bits", "256 codes over the value range: a quarter of the memory, visible steps."),
            Choice::new(
                "16-bit",
                "16 bits",
                "65536 codes over the value range, or half floats where the device has no such format.",
            ),
            Choice::new("32-bit", "32 bits", "32-bit floats."),
        ];
        PropertyDecl::choice("precision", "Precision", "auto", choices)
            .help("How the voxels are held on the graphics device. What is lost is reported.")
    }

    /// The precision with the given id of [`Precision::property`]; unknown ids mean lossless.
    pub fn from_id(id: &str) -> Self {
        match id {
            "8-bit" => Self::Bits8,
            "16-bit" => Self::Bits16,
            "32-bit" => Self::Bits32,
            _ => Self::Auto,
        }
    }
}

/// A volume and, once something has rendered it, its texture.
#[derive(Debug)]
pub struct VolumeData {
    /// The voxels.
    pub volume: Arc<Volume>,
    /// How precisely to hold them on the device.
    pub precision: Precision,
    gpu: OnceLock<GpuVolume>,
}

impl VolumeData {
    /// A volume that is not on the device yet.
    pub fn new(volume: Arc<Volume>, precision: Precision) -> Self {
        Self { volume, precision, gpu: OnceLock::new() }
    }

    /// The volume's texture; uploaded at the first call. Fails when the device's limits or memory do not suffice.
    pub fn on_gpu(&self, gpu: &Gpu) -> Result<&GpuVolume, GpuError> {
        if let Some(uploaded) = self.gpu.get() {
            return Ok(uploaded);
        }
        let uploaded = GpuVolume::upload(gpu, &self.volume, self.precision)?;
        Ok(self.gpu.get_or_init(|| uploaded))
    }

    /// Whether the volume has been uploaded.
    pub fn is_on_gpu(&self) -> bool {
        self.gpu.get().is_some()
    }
}

/// An image on the device, row 0 at the top.
#[derive(Debug)]
pub struct Image {
    /// Per pixel four floats; their meaning is `kind`. Colours are premultiplied. Entry and exit points are volume
    /// coordinates (`0 ..= 1` in the box) in xyz and 1 (hit) or 0 (miss) in w.
    pub color: Arc<Texture>,
    /// Distance along the viewing direction in world units, r32float; [`MISS`] where nothing was hit.
    pub depth: Option<Arc<Texture>>,
    /// What `color` holds.
    pub kind: ImageKind,
    /// The view that the image was rendered from, if any.
    pub view: Option<View>,
}

impl Image {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.color.size_2d()
    }
}

/// A triangle mesh in the coordinates of a volume.
#[derive(Debug, Clone)]
pub struct Mesh {
    /// Volume (texture) coordinates, `0 ..= 1` in the volume's box.
    pub positions: Vec<[f32; 3]>,
    /// Triangles; seen from outside their corners run counter-clockwise in volume coordinates.
    pub indices: Vec<[u32; 3]>,
    /// The volume whose coordinates these are.
    pub volume: Arc<VolumeData>,
    /// Whether the mesh bounds a solid, without holes.
    pub closed: bool,
}

/// Typed access to the inputs of a job. The evaluator has checked types and required inports already; the errors are
/// for slips in a processor.
pub trait JobData {
    /// The volume at an inport.
    fn volume(&self, inport: &str) -> Result<&Arc<VolumeData>, ProcessError>;
    /// The image at an inport.
    fn image(&self, inport: &str) -> Result<&Arc<Image>, ProcessError>;
    /// The image at an optional inport, if it is connected.
    fn optional_image(&self, inport: &str) -> Option<&Arc<Image>>;
    /// The mesh at an inport.
    fn geometry(&self, inport: &str) -> Result<&Arc<Mesh>, ProcessError>;
}

impl JobData for Job<'_, Data> {
    fn volume(&self, inport: &str) -> Result<&Arc<VolumeData>, ProcessError> {
        match self.input(inport) {
            Some(Data::Volume(volume)) => Ok(volume),
            _ => Err(missing(inport, "volume")),
        }
    }

    fn image(&self, inport: &str) -> Result<&Arc<Image>, ProcessError> {
        self.optional_image(inport).ok_or_else(|| missing(inport, "image"))
    }

    fn optional_image(&self, inport: &str) -> Option<&Arc<Image>> {
        match self.input(inport) {
            Some(Data::Image(image)) => Some(image),
            _ => None,
        }
    }

    fn geometry(&self, inport: &str) -> Result<&Arc<Mesh>, ProcessError> {
        match self.input(inport) {
            Some(Data::Geometry(mesh)) => Ok(mesh),
            _ => Err(missing(inport, "mesh")),
        }
    }
}

fn missing(inport: &str, what: &str) -> ProcessError {
    ProcessError::new(format!("there is no {what} at the inport `{inport}`; connect one"))
}
