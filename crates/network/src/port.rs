//! Ports: what flows through a connection, what an inport accepts, and conditions on the data itself.

use std::fmt;

use rayloom_volume::VolumeRole;

/// What an image holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ImageKind {
    /// Premultiplied colour.
    Color,
    /// Volume coordinates where each pixel's ray enters.
    EntryPoints,
    /// Volume coordinates where each pixel's ray leaves.
    ExitPoints,
    /// Distance along the viewing direction, world units.
    Depth,
    /// World-space normals.
    Normals,
    /// Numbers without a meaning as a picture.
    Data,
}

impl fmt::Display for ImageKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Color => "colour",
            Self::EntryPoints => "entry points",
            Self::ExitPoints => "exit points",
            Self::Depth => "depth",
            Self::Normals => "normals",
            Self::Data => "data",
        })
    }
}

/// The type of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PortType {
    /// A volume.
    Volume,
    /// An image of some kind.
    Image(ImageKind),
    /// Proxy geometry.
    Geometry,
}

impl fmt::Display for PortType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Volume => f.write_str("a volume"),
            Self::Image(kind) => write!(f, "an image of {kind}"),
            Self::Geometry => f.write_str("a geometry"),
        }
    }
}

/// What can be said about data on a port without looking at its contents.
#[derive(Clone, Debug, PartialEq)]
pub enum Facts {
    /// A volume.
    Volume {
        /// Voxels along each axis.
        dims: [u32; 3],
        /// Channels, 1 to 4.
        channels: u32,
        /// What the channels mean.
        role: VolumeRole,
    },
    /// An image.
    Image {
        /// What it holds.
        kind: ImageKind,
        /// Width and height, pixels.
        size: [u32; 2],
        /// Whether a depth image comes with it.
        has_depth: bool,
    },
    /// A geometry.
    Geometry {
        /// Number of triangles.
        triangles: usize,
    },
}

impl Facts {
    /// The port type that carries such data.
    pub fn port_type(&self) -> PortType {
        match self {
            Self::Volume { .. } => PortType::Volume,
            Self::Image { kind, .. } => PortType::Image(*kind),
            Self::Geometry { .. } => PortType::Geometry,
        }
    }
}

/// Something that data on an inport must satisfy beyond its type. The connection stays, the processor is not ready.
#[derive(Clone, Copy, Debug)]
pub struct Condition {
    /// What is needed, ends the sentence "inport `volume` needs ...": "a volume with one channel".
    pub message: &'static str,
    /// Whether the data satisfies it.
    pub holds: fn(&Facts) -> bool,
}

/// The declaration of an inport.
#[derive(Clone, Debug)]
pub struct InportDecl {
    /// Stable id.
    pub id: String,
    /// What the user reads.
    pub label: String,
    /// Help.
    pub help: String,
    /// Types that may be connected.
    pub accepts: Vec<PortType>,
    /// Whether several connections may end here. The processor sees them sorted by what they come from
    /// ([`crate::Network::inputs_in_order`]), so the order in which they were made does not matter.
    pub several: bool,
    /// Whether the processor is ready without a connection.
    pub optional: bool,
    /// What the data must satisfy.
    pub conditions: Vec<Condition>,
}

impl InportDecl {
    /// A required inport for one connection.
    pub fn new(id: impl Into<String>, label: impl Into<String>, accepts: &[PortType]) -> Self {
        Self {
            id: id.into(),
            label: label.into(),
            help: String::new(),
            accepts: accepts.to_vec(),
            several: false,
            optional: false,
            conditions: Vec::new(),
        }
    }

    /// Sets the help.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }

    /// Lets several connections end here.
    #[must_use]
    pub fn several(mut self) -> Self {
        self.several = true;
        self
    }

    /// Lets the processor be ready without a connection.
    #[must_use]
    pub fn optional(mut self) -> Self {
        self.optional = true;
        self
    }

    /// Adds a condition on the data.
    #[must_use]
    pub fn condition(mut self, message: &'static str, holds: fn(&Facts) -> bool) -> Self {
        self.conditions.push(Condition { message, holds });
        self
    }
}

/// The declaration of an outport.
#[derive(Clone, Debug)]
pub struct OutportDecl {
    /// Stable id.
    pub id: String,
    /// What the user reads.
    pub label: String,
    /// Help.
    pub help: String,
    /// What comes out.
    pub port_type: PortType,
}

impl OutportDecl {
    /// An outport.
    pub fn new(id: impl Into<String>, label: impl Into<String>, port_type: PortType) -> Self {
        Self { id: id.into(), label: label.into(), help: String::new(), port_type }
    }

    /// Sets the help.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}
