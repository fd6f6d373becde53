//! Volume generator: volumes made of formulas.

use std::sync::Arc;

use glam::DVec3;
use rayloom_network::{
    Choice, Declaration, Job, Level, OutportDecl, Outputs, PortType, ProcessError, ProcessorType, Properties,
    PropertyDecl, PropertyError,
};
use rayloom_volume::{Field, generate};

use crate::volume_source::outputs_of;
use crate::{Context, Data, Precision, Process};

/// The processor type; its properties depend on the chosen field.
pub struct VolumeGenerator {
    declaration: Declaration,
}

impl VolumeGenerator {
    /// The processor type.
    pub fn new() -> Self {
        Self { declaration: declaration() }
    }
}

fn declaration() -> Declaration {
    let fields = Field::EXAMPLES.iter().map(|field| {
        let (label, help) = field.help();
        Choice::new(field.id(), label, help)
    });
    Declaration::new(crate::types::VOLUME_GENERATOR, "Volume generator", "Source")
        .help(
            "Samples a formula at voxel centres. The domain, -1 to 1 along each axis, is the box of the volume, which is \
             centred at the origin of the world.",
        )
        .output(OutportDecl::new("volume", "Volume", PortType::Volume).help("One channel of 32-bit floats."))
        .property(
            PropertyDecl::choice("field", "Field", "marschner_lobb", fields.collect())
                .level(Level::Parameters)
                .help("The formula."),
        )
        .property(
            PropertyDecl::vector("dims", "Voxels", &[64.0; 3])
                .range(1.0, 2048.0)
                .unit("voxels")
                .whole()
                .help("Voxels along x, y and z."),
        )
        .property(
            PropertyDecl::vector("extent", "Extent", &[64.0; 3])
                .unit("world units")
                .help("Length of the box along x, y and z. A negative one mirrors the volume."),
        )
        .property(Precision::property())
}

impl ProcessorType for VolumeGenerator {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn snippet_properties(&self, current: &Properties) -> Vec<PropertyDecl> {
        chosen_field(current)
            .map(|mut field| parameters(&mut field).into_iter().map(|p| p.declare()).collect())
            .unwrap_or_default()
    }
}

impl Process for VolumeGenerator {
    fn process(&self, context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
        let properties = job.properties;
        let mut field = chosen_field(properties)?;
        for parameter in parameters(&mut field) {
            parameter.read(properties)?;
        }
        let dims = properties.array("dims")?.map(|n: f64| n as u32);
        let extent = DVec3::from_array(properties.array("extent")?);
        let volume = generate(&field, dims, extent)?;
        Ok(outputs_of(context, "volume", Arc::new(volume), Precision::from_id(properties.text("precision")?)))
    }
}

/// The chosen field with its usual parameters.
fn chosen_field(properties: &Properties) -> Result<Field, PropertyError> {
    let id = properties.text("field")?;
    let field = Field::EXAMPLES.into_iter().find(|field| field.id() == id);
    field.ok_or_else(|| PropertyError::Missing(format!("field = {id}")))
}

/// A parameter of a field: how it is declared, and where it goes.
struct Parameter<'a> {
    id: &'static str,
    label: &'static str,
    unit: &'static str,
    help: &'static str,
    range: [f64; 2],
    place: Place<'a>,
}

enum Place<'a> {
    Float(&'a mut f64),
    Count(&'a mut u32),
    Axis(&'a mut usize),
}

impl Parameter<'_> {
    /// The property, whose default is the current value.
    fn declare(&self) -> PropertyDecl {
        let int = |value: i64| {
            PropertyDecl::int(self.id, self.label, value).int_range(self.range[0] as i64, self.range[1] as i64)
        };
        let declared = match &self.place {
            Place::Float(value) => {
                PropertyDecl::float(self.id, self.label, **value).range(self.range[0], self.range[1])
            }
            Place::Count(value) => int(i64::from(**value)),
            Place::Axis(value) => int(**value as i64),
        };
        declared.unit(self.unit).help(self.help)
    }

    /// Takes the value over from the properties, which have been checked against the range.
    fn read(self, properties: &Properties) -> Result<(), PropertyError> {
        match self.place {
            Place::Float(value) => *value = properties.f64(self.id)?,
            Place::Count(value) => *value = properties.int(self.id)?.clamp(1, i64::from(u32::MAX)) as u32,
            Place::Axis(value) => *value = properties.int(self.id)?.clamp(0, 2) as usize,
        }
        Ok(())
    }
}

const DOMAIN: &str = "half box lengths";

fn length<'a>(id: &'static str, label: &'static str, help: &'static str, value: &'a mut f64) -> Parameter<'a> {
    Parameter { id, label, unit: DOMAIN, help, range: [1e-3, 10.0], place: Place::Float(value) }
}

/// The parameters of a field.
fn parameters(field: &mut Field) -> Vec<Parameter<'_>> {
    match field {
        Field::Constant { value } => vec![Parameter {
            id: "value",
            label: "Value",
            unit: "",
            help: "The value everywhere, data units.",
            range: [-1e30, 1e30],
            place: Place::Float(value),
        }],
        Field::Ramp { axis } => vec![Parameter {
            id: "axis",
            label: "Axis",
            unit: "",
            help: "The axis along which values grow: 0, 1 or 2 for x, y or z.",
            range: [0.0, 2.0],
            place: Place::Axis(axis),
        }],
        Field::SphereDistance { radius } => {
            vec![length("radius", "Radius", "Radius of the sphere.", radius)]
        }
        Field::GaussianBlob { sigma } => {
            vec![length("sigma", "Width", "Standard deviation.", sigma)]
        }
        Field::MarschnerLobb { frequency, alpha } => vec![
            Parameter {
                id: "frequency",
                label: "Frequency",
                unit: "",
                help: "Waves; 6 in the paper.",
                range: [0.0, 100.0],
                place: Place::Float(frequency),
            },
            Parameter {
                id: "alpha",
                label: "Strength",
                unit: "",
                help: "How strong the waves are; 0.25 in the paper.",
                range: [0.0, 10.0],
                place: Place::Float(alpha),
            },
        ],
        Field::Hydrogen1s { bohr } | Field::Hydrogen2p { bohr } | Field::Hydrogen3d { bohr } => {
            vec![length("bohr", "Bohr radius", "Size of the atom.", bohr)]
        }
        Field::BuckyBall { radius, sigma } => vec![
            length("radius", "Radius", "Distance of the atoms from the centre.", radius),
            length("sigma", "Atom size", "Standard deviation of an atom.", sigma),
        ],
        Field::Checkerboard { cells } => vec![Parameter {
            id: "cells",
            label: "Cubes",
            unit: "",
            help: "Cubes along each side.",
            range: [1.0, 1024.0],
            place: Place::Count(cells),
        }],
        Field::Shells { count } => vec![Parameter {
            id: "count",
            label: "Shells",
            unit: "",
            help: "Shells from the centre to the side of the box.",
            range: [0.0, 1000.0],
            place: Place::Float(count),
        }],
    }
}
