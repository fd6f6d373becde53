//! How a ray traversal lights what it shows, in the words of the reference.

use rayloom_network::{self as network, Light, Network, Properties, Value};
use rayloom_reference::Method;
use rayloom_reference::gradient::GradientOperator;
use rayloom_reference::shading::{Diffuse, Highlight, LightSpace, Shading};

use crate::subject::chain::Chain;
use crate::subject::{Refusable, refuse};

/// Whether a ray traversal lights or classifies by the gradient.
pub(crate) fn reads_gradient(network: &Network, traversal: &str) -> bool {
    let is = |property: &str, id: &str| matches!(network.value(traversal, property), Some(Value::Text(found)) if found == id);
    !is("shading", "none") || is("classification", "transfer_function_2d")
}

/// The shading of a ray traversal; `None` for none.
pub(crate) fn shading(properties: &Properties, method: Method) -> Refusable<Option<Shading>> {
    let id = properties.text("shading")?;
    if id == "none" || matches!(method, Method::Mean | Method::Sum | Method::FirstHit(_)) {
        return Ok(None);
    }
    if matches!(method, Method::Mip | Method::MinIp) {
        return refuse(format!("it does not light the extremes of rays, and the shading is `{id}`; choose none"));
    }
    let parameter = |name: &str| properties.f64(&format!("shading.{name}"));
    let diffuse_term = match id {
        "oren_nayar" => Diffuse::OrenNayar { roughness: parameter("roughness")? },
        "toon" => Diffuse::Toon { steps: properties.int("shading.steps")?.clamp(1, 64) as u32 },
        _ => Diffuse::Lambert,
    };
    let highlight = match id {
        "diffuse" | "oren_nayar" | "toon" => None,
        "specular" | "blinn_phong" => Some(Highlight::BlinnPhong { shininess: parameter("shininess")? }),
        "phong" => Some(Highlight::Phong { shininess: parameter("shininess")? }),
        "cook_torrance" => {
            Some(Highlight::CookTorrance { roughness: parameter("roughness")?, reflectance: parameter("reflectance")? })
        }
        "ward" => Some(Highlight::Ward { along: parameter("along")?, across: parameter("across")? }),
        other => return refuse(format!("the shading `{other}` has no counterpart there; choose one of Rayloom's own")),
    };
    let Light { space, direction, color } = properties.light("light")?;
    Ok(Some(Shading {
        ambient: parameter("ambient")?,
        diffuse: if id == "specular" { 0.0 } else { parameter("diffuse")? },
        diffuse_term,
        specular: if highlight.is_some() { parameter("specular")? } else { 0.0 },
        highlight: highlight.unwrap_or(Highlight::BlinnPhong { shininess: 1.0 }),
        light_direction: direction.into(),
        light_space: match space {
            network::LightSpace::Camera => LightSpace::Camera,
            network::LightSpace::World => LightSpace::World,
        },
        light_color: color,
        two_sided: properties.bool("two_sided")?,
        gradient_fade: properties.f64("gradient_fade")?,
    }))
}

/// How a ray traversal takes gradients.
pub(crate) fn gradient(properties: &Properties, network: &Network, chain: &Chain) -> Refusable<GradientOperator> {
    Ok(match properties.text("gradient")? {
        "central" => GradientOperator::Central,
        "forward" => GradientOperator::Forward,
        "backward" => GradientOperator::Backward,
        "central4" => GradientOperator::CentralFourth,
        "sobel" => GradientOperator::Sobel,
        "precomputed" => return precomputed(properties, network, chain),
        other => {
            return refuse(format!(
                "the gradient `{other}` has no counterpart there; it knows central, forward, backward, central4 and sobel"
            ));
        }
    })
}

/// Central differences of a field that is linear between voxels are those at the voxels, interpolated.
fn precomputed(properties: &Properties, network: &Network, chain: &Chain) -> Refusable<GradientOperator> {
    let operator = network.value(&chain.volume.processor, "operator");
    let central = matches!(operator, Some(network::Value::Text(id)) if id == "central");
    let linear = matches!(properties.text("sampling")?, "filtered" | "trilinear");
    match central && linear {
        true => Ok(GradientOperator::Central),
        false => refuse(
            "precomputed gradients have a counterpart there only if they are central differences of a linearly \
             interpolated volume",
        ),
    }
}
