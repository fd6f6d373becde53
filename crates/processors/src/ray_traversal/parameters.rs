//! The parameters of the chosen snippets: as properties, and as bytes of the shader's uniform.

use rayloom_network::{ProcessError, Properties, PropertyDecl};
use rayloom_volume::ValueRange;
use rayloom_wgsl::{Library, Parameter, ParameterType, Validated};

use super::snippets::{PLACES, Place};

/// Properties for the parameters of the snippets that `current` chooses. Places whose choice is broken have none;
/// running the processor says why.
pub(super) fn declarations(library: &Library, current: &Properties) -> Vec<PropertyDecl> {
    let chosen = PLACES.iter().filter_map(|place| Some((place, place.snippet(library, current).ok()??)));
    let properties = chosen.flat_map(|(place, snippet)| {
        let parameters = snippet.declaration().parameters.iter();
        parameters.map(|parameter| property(place, parameter)).collect::<Vec<_>>()
    });
    properties.collect()
}

fn id(place: &Place, parameter: &Parameter) -> String {
    format!("{}.{}", place.id, parameter.name)
}

fn property(place: &Place, parameter: &Parameter) -> PropertyDecl {
    let id = id(place, parameter);
    let mut label = parameter.name.replace('_', " ");
    label[..1].make_ascii_uppercase();
    let [low, high] = parameter.range;
    let unit = if parameter.unit == "data" { "value" } else { &parameter.unit };
    let declared = match (parameter.ty, &parameter.default[..]) {
        (ParameterType::Float, [default, ..]) => PropertyDecl::float(id, label, *default).range(low, high).unit(unit),
        (ParameterType::Integer, [default, ..]) => {
            PropertyDecl::int(id, label, *default as i64).int_range(low as i64, high as i64).unit(unit)
        }
        (ParameterType::Color, [r, g, b, ..]) => PropertyDecl::color(id, label, [*r, *g, *b, 1.0]),
        (_, _) => PropertyDecl::float(id, label, 0.0),
    };
    declared.help(parameter.help.clone())
}

/// The bytes of the uniform `params`. Parameters in the volume's unit are normalised over `range`.
///
/// # Errors
/// A parameter without a value.
pub(super) fn bytes(shader: &Validated, properties: &Properties, range: ValueRange) -> Result<Vec<u8>, ProcessError> {
    let layout = &shader.interface.parameters;
    let mut bytes = vec![0; layout.size as usize];
    for (field, at, slot, parameter) in &shader.assembled.parameters {
        let place = PLACES.iter().find(|place| place.is_at(*slot, *at));
        let offset = layout.offsets.iter().find(|(name, _)| name == field);
        let (Some(place), Some((_, offset))) = (place, offset) else { continue };
        let id = id(place, parameter);
        let value: Vec<u8> = match parameter.ty {
            ParameterType::Float if parameter.unit == "data" => {
                normalised(properties.f64(&id)?, range).to_le_bytes().to_vec()
            }
            ParameterType::Float => (properties.f64(&id)? as f32).to_le_bytes().to_vec(),
            ParameterType::Integer => {
                (properties.int(&id)?.clamp(0, i64::from(u32::MAX)) as u32).to_le_bytes().to_vec()
            }
            ParameterType::Color => {
                properties.color(&id)?[..3].iter().flat_map(|c| (*c as f32).to_le_bytes()).collect()
            }
        };
        bytes[*offset as usize..][..value.len()].copy_from_slice(&value);
    }
    Ok(bytes)
}

/// A value as the shader compares it, kept finite.
fn normalised(value: f64, range: ValueRange) -> f32 {
    let width = if range.width() > 0.0 { range.width() } else { 1.0 };
    ((value - range.min) / width).clamp(-1e30, 1e30) as f32
}
