//! What a property is: its kind, range, unit, default, help, and the level of work a change of it needs.

use std::fmt;

use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D};

use crate::camera::Camera;
use crate::light::Light;
use crate::value::Value;

/// How much of a processor a change makes stale; the highest of several wins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Only the result: run again.
    #[default]
    Result,
    /// Tables and other things computed from parameters, too.
    Parameters,
    /// The shader must be assembled again.
    Shader,
    /// What goes in or out changed.
    Ports,
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Result => "result",
            Self::Parameters => "parameters",
            Self::Shader => "shader",
            Self::Ports => "ports",
        })
    }
}

/// One possibility of a choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Stable id, the stored value.
    pub id: String,
    /// What the user reads.
    pub label: String,
    /// One line of help.
    pub help: String,
}

impl Choice {
    /// A choice with its label and help.
    pub fn new(id: impl Into<String>, label: impl Into<String>, help: impl Into<String>) -> Self {
        Self { id: id.into(), label: label.into(), help: help.into() }
    }
}

/// The kind of a property and what its values must satisfy. Ranges are inclusive; units are for people ("mm", "degrees").
#[derive(Clone, Debug, PartialEq)]
pub enum PropertyKind {
    /// `Value::Bool`.
    Bool,
    /// `Value::Int`.
    Int {
        /// Smallest and largest value.
        range: [i64; 2],
        /// Unit, may be empty.
        unit: String,
    },
    /// `Value::Float`.
    Float {
        /// Smallest and largest value; may be infinite, values may not.
        range: [f64; 2],
        /// Unit, may be empty.
        unit: String,
        /// Whether a slider should be logarithmic.
        logarithmic: bool,
    },
    /// `Value::Vector`.
    Vector {
        /// Number of components.
        len: usize,
        /// Smallest and largest component; may be infinite, components may not.
        range: [f64; 2],
        /// Unit, may be empty.
        unit: String,
        /// Whether the components must be whole numbers.
        whole: bool,
    },
    /// `Value::Color`.
    Color,
    /// `Value::Text` with the id of one of the choices.
    Choice {
        /// What can be chosen.
        choices: Vec<Choice>,
    },
    /// `Value::Text`.
    Text {
        /// Whether an editor should offer several lines.
        multiline: bool,
    },
    /// `Value::Text` with a path; empty when none is chosen. Stored relative to the network file when it can be.
    File {
        /// Extensions without the dot, lower case; empty for any.
        extensions: Vec<String>,
        /// Whether the file is written (else read).
        save: bool,
        /// Whether the processor is not ready until a file is chosen.
        required: bool,
    },
    /// `Value::TransferFunction`.
    TransferFunction,
    /// `Value::TransferFunction2D`.
    TransferFunction2D,
    /// `Value::Labels`.
    Labels,
    /// `Value::Camera`.
    Camera,
    /// `Value::Light`.
    Light,
    /// `Value::Text` with the id of the snippet that fills the slot.
    Snippet {
        /// The slot.
        slot: String,
    },
    /// `Value::Text` with the user's own source for the slot; empty: the chosen snippet as it is.
    ShaderText {
        /// The slot.
        slot: String,
    },
}

/// The declaration of a property. Build one with a constructor per kind and the chained setters:
/// `PropertyDecl::float("rate", "Sampling rate", 1.0).range(0.1, 16.0).unit("samples per voxel").help("...")`.
#[derive(Clone, Debug, PartialEq)]
pub struct PropertyDecl {
    /// Stable id: `[A-Za-z0-9_-]`, parts separated by dots.
    pub id: String,
    /// What the user reads.
    pub label: String,
    /// Help, one sentence or more.
    pub help: String,
    /// Kind, range and unit.
    pub kind: PropertyKind,
    /// Default; satisfies the kind.
    pub default: Value,
    /// What a change of the value makes stale.
    pub level: Level,
}

impl PropertyDecl {
    /// A property of the given kind and default, level [`Level::Result`], no help.
    pub fn new(id: impl Into<String>, label: impl Into<String>, kind: PropertyKind, default: Value) -> Self {
        Self { id: id.into(), label: label.into(), help: String::new(), kind, default, level: Level::Result }
    }

    /// A yes/no property.
    pub fn bool(id: impl Into<String>, label: impl Into<String>, default: bool) -> Self {
        Self::new(id, label, PropertyKind::Bool, Value::Bool(default))
    }

    /// A whole number of any size; narrow it with [`PropertyDecl::int_range`].
    pub fn int(id: impl Into<String>, label: impl Into<String>, default: i64) -> Self {
        let kind = PropertyKind::Int { range: [i64::MIN, i64::MAX], unit: String::new() };
        Self::new(id, label, kind, Value::Int(default))
    }

    /// A finite number; narrow it with [`PropertyDecl::range`].
    pub fn float(id: impl Into<String>, label: impl Into<String>, default: f64) -> Self {
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let kind = PropertyKind::Float { range, unit: String::new(), logarithmic: false };
        Self::new(id, label, kind, Value::Float(default))
    }

    /// As many finite numbers as the default has; narrow them with [`PropertyDecl::range`] and [`PropertyDecl::whole`].
    pub fn vector(id: impl Into<String>, label: impl Into<String>, default: &[f64]) -> Self {
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let kind = PropertyKind::Vector { len: default.len(), range, unit: String::new(), whole: false };
        Self::new(id, label, kind, Value::Vector(default.to_vec()))
    }

    /// A picture size in pixels, width and height from 1 to 16384; a sink's render size has the id `size`.
    pub fn size(id: impl Into<String>, label: impl Into<String>, default: [u32; 2]) -> Self {
        Self::vector(id, label, &default.map(f64::from)).range(1.0, 16384.0).unit("pixels").whole()
    }

    /// A colour with straight alpha.
    pub fn color(id: impl Into<String>, label: impl Into<String>, default: [f64; 4]) -> Self {
        Self::new(id, label, PropertyKind::Color, Value::Color(default))
    }

    /// One of several choices; the default is the id of one.
    pub fn choice(id: impl Into<String>, label: impl Into<String>, default: &str, choices: Vec<Choice>) -> Self {
        Self::new(id, label, PropertyKind::Choice { choices }, Value::Text(default.to_owned()))
    }

    /// A line of text.
    pub fn text(id: impl Into<String>, label: impl Into<String>, default: &str) -> Self {
        Self::new(id, label, PropertyKind::Text { multiline: false }, Value::Text(default.to_owned()))
    }

    /// A file to read, none chosen; the processor is not ready before one is. See [`PropertyDecl::saved`] and
    /// [`PropertyDecl::optional`].
    pub fn file(id: impl Into<String>, label: impl Into<String>, extensions: &[&str]) -> Self {
        let extensions = extensions.iter().map(|&e| e.to_owned()).collect();
        let kind = PropertyKind::File { extensions, save: false, required: true };
        Self::new(id, label, kind, Value::Text(String::new()))
    }

    /// A transfer function over data values.
    pub fn transfer_function(id: impl Into<String>, label: impl Into<String>, default: TransferFunction) -> Self {
        Self::new(id, label, PropertyKind::TransferFunction, Value::TransferFunction(default))
    }

    /// A transfer function over data values and gradient magnitudes.
    pub fn transfer_function_2d(id: impl Into<String>, label: impl Into<String>, default: TransferFunction2D) -> Self {
        Self::new(id, label, PropertyKind::TransferFunction2D, Value::TransferFunction2D(default))
    }

    /// A transfer function for each label.
    pub fn labels(id: impl Into<String>, label: impl Into<String>, default: LabelTable) -> Self {
        Self::new(id, label, PropertyKind::Labels, Value::Labels(default))
    }

    /// A camera.
    pub fn camera(id: impl Into<String>, label: impl Into<String>, default: Camera) -> Self {
        Self::new(id, label, PropertyKind::Camera, Value::Camera(default))
    }

    /// A light.
    pub fn light(id: impl Into<String>, label: impl Into<String>, default: Light) -> Self {
        Self::new(id, label, PropertyKind::Light, Value::Light(default))
    }

    /// The snippet that fills a slot; level [`Level::Shader`].
    pub fn snippet(id: impl Into<String>, label: impl Into<String>, slot: &str, default: &str) -> Self {
        let kind = PropertyKind::Snippet { slot: slot.to_owned() };
        Self::new(id, label, kind, Value::Text(default.to_owned())).level(Level::Shader)
    }

    /// The user's own source for a slot, empty by default; level [`Level::Shader`].
    pub fn shader_text(id: impl Into<String>, label: impl Into<String>, slot: &str) -> Self {
        let kind = PropertyKind::ShaderText { slot: slot.to_owned() };
        Self::new(id, label, kind, Value::Text(String::new())).level(Level::Shader)
    }

    /// Sets the help.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }

    /// Sets what a change makes stale.
    #[must_use]
    pub fn level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }

    /// Sets the inclusive range of a float or of a vector's components; nothing for other kinds.
    #[must_use]
    pub fn range(mut self, min: f64, max: f64) -> Self {
        if let PropertyKind::Float { range, .. } | PropertyKind::Vector { range, .. } = &mut self.kind {
            *range = [min, max];
        }
        self
    }

    /// Sets the inclusive range of a whole number; nothing for other kinds.
    #[must_use]
    pub fn int_range(mut self, min: i64, max: i64) -> Self {
        if let PropertyKind::Int { range, .. } = &mut self.kind {
            *range = [min, max];
        }
        self
    }

    /// Sets the unit of a number or vector; nothing for other kinds.
    #[must_use]
    pub fn unit(mut self, name: impl Into<String>) -> Self {
        if let PropertyKind::Int { unit, .. } | PropertyKind::Float { unit, .. } | PropertyKind::Vector { unit, .. } =
            &mut self.kind
        {
            *unit = name.into();
        }
        self
    }

    /// Lets a float's slider be logarithmic; nothing for other kinds.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        if let PropertyKind::Float { logarithmic, .. } = &mut self.kind {
            *logarithmic = true;
        }
        self
    }

    /// Restricts a vector to whole numbers; nothing for other kinds.
    #[must_use]
    pub fn whole(mut self) -> Self {
        if let PropertyKind::Vector { whole, .. } = &mut self.kind {
            *whole = true;
        }
        self
    }

    /// Lets a text have several lines; nothing for other kinds.
    #[must_use]
    pub fn multiline(mut self) -> Self {
        if let PropertyKind::Text { multiline } = &mut self.kind {
            *multiline = true;
        }
        self
    }

    /// Makes a file one that is written; nothing for other kinds.
    #[must_use]
    pub fn saved(mut self) -> Self {
        if let PropertyKind::File { save, .. } = &mut self.kind {
            *save = true;
        }
        self
    }

    /// Lets the processor be ready without a file; nothing for other kinds.
    #[must_use]
    pub fn optional(mut self) -> Self {
        if let PropertyKind::File { required, .. } = &mut self.kind {
            *required = false;
        }
        self
    }
}
