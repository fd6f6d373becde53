//! Clipped proxy: cuts proxy geometry along a plane in the world.

use glam::DVec3;
use rayloom_network::{Declaration, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl};

use crate::clip::{Plane, clip};
use crate::{Context, Data, JobData};

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let geometry = InportDecl::new("geometry", "Geometry", &[PortType::Geometry]).help("A closed mesh.");
    let result = OutportDecl::new("clipped", "Clipped", PortType::Geometry)
        .help("What lies on the kept side, closed again along the cut; perhaps nothing.");
    Declaration::new("clipped_proxy", "Clipped proxy", "Geometry")
        .help(
            "Cuts proxy geometry along a plane given in world coordinates and closes the cut. Several of these in a row cut \
             along several planes.",
        )
        .input(geometry)
        .output(result)
        .property(PropertyDecl::bool("enabled", "Enabled", true).help("Off: the geometry passes uncut."))
        .property(
            PropertyDecl::vector("normal", "Normal", &[1.0, 0.0, 0.0])
                .help("The direction, in the world, of the side that is cut away; its length does not matter."),
        )
        .property(
            PropertyDecl::float("distance", "Distance", 0.0)
                .unit("world units")
                .help("Where the plane lies along the normal, measured from the origin of the world."),
        )
        .property(PropertyDecl::bool("invert", "Invert", false).help("Cuts away the other side."))
}

/// Cuts the mesh.
pub fn process(_: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let mesh = job.geometry("geometry")?;
    if !job.properties.bool("enabled")? {
        return Ok(Outputs::new().with("clipped", Data::Geometry(mesh.clone())));
    }
    let normal = DVec3::from_array(job.properties.array("normal")?);
    let unit = normal.try_normalize().ok_or_else(|| {
        ProcessError::new(format!("the normal of the plane is {normal}, which has no direction; give it a length"))
    })?;
    let sign = if job.properties.bool("invert")? { -1.0 } else { 1.0 };
    let world = Plane { normal: unit * sign, distance: job.properties.f64("distance")? * sign };
    let plane = world.seen_through(&mesh.volume.volume.texture_to_world());
    Ok(Outputs::new().with("clipped", clip(mesh, &plane).into()))
}
