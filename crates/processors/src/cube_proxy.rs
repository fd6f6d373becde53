//! Cube proxy: the box of a volume, or a part of it, as proxy geometry.

use std::sync::Arc;

use rayloom_network::{Declaration, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl};

use crate::{Context, Data, JobData, Mesh, VolumeData};

/// More than the voxels of any volume along an axis: the default end of a clip range.
const UNLIMITED: f64 = 65536.0;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The twelve triangles of a box whose corner `c` lies at the upper end along the axes whose bits are set in `c`.
const TRIANGLES: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5], // x
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3], // y
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6], // z
];

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let volume = InportDecl::new("volume", "Volume", &[PortType::Volume]).help("The volume to be bounded.");
    let geometry = OutportDecl::new("geometry", "Geometry", PortType::Geometry)
        .help("A closed box in the coordinates of the volume.");
    let mut declaration = Declaration::new(crate::types::CUBE_PROXY, "Cube proxy", "Geometry")
        .help("The box of a volume as proxy geometry: rays are cast within it. The clip ranges cut it down along the voxel axes.")
        .input(volume)
        .output(geometry);
    for axis in AXES {
        let help = format!(
            "The part of the volume to keep along {axis}, in voxels: from the first edge to the second. Voxel i reaches from \
             edge i to edge i + 1, so [3, 5] keeps the whole of the voxels 3 and 4. Ends beyond the volume mean its end."
        );
        let clip = PropertyDecl::vector(format!("clip_{axis}"), format!("Clip {axis}"), &[0.0, UNLIMITED])
            .range(0.0, UNLIMITED)
            .unit("voxels")
            .help(help);
        declaration = declaration.property(clip);
    }
    declaration
}

/// Builds the box.
pub fn process(_: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let volume = job.volume("volume")?;
    let mut ends = [[0.0_f32; 3]; 2];
    for (axis, name) in AXES.iter().enumerate() {
        let [first, last] = job.properties.array(&format!("clip_{name}"))?;
        let voxels = f64::from(volume.volume.dims[axis]);
        if first >= last || first >= voxels {
            return Err(ProcessError::new(format!(
                "the clip range along {name} keeps nothing: found [{first}, {last}], expected a first edge below the second \
                 and below {voxels}, the voxels along {name}"
            )));
        }
        ends[0][axis] = (first / voxels) as f32;
        ends[1][axis] = (last.min(voxels) / voxels) as f32;
    }
    Ok(Outputs::new().with("geometry", box_between(volume, ends).into()))
}

/// The box between two corners, volume coordinates.
fn box_between(volume: &Arc<VolumeData>, ends: [[f32; 3]; 2]) -> Mesh {
    let corner = |c: usize| [ends[c & 1][0], ends[c >> 1 & 1][1], ends[c >> 2 & 1][2]];
    Mesh { positions: (0..8).map(corner).collect(), indices: TRIANGLES.to_vec(), volume: volume.clone(), closed: true }
}

/// The whole box of a volume.
#[cfg(test)]
pub(crate) fn whole_box(volume: &Arc<VolumeData>) -> Mesh {
    box_between(volume, [[0.0; 3], [1.0; 3]])
}
