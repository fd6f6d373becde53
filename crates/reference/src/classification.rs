//! How values look, everywhere or by labels.

use glam::{DVec3, UVec3};
use rayloom_volume::{LabelTable, TransferFunction, Volume};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Where colours and opacities come from.
#[derive(Debug, Clone)]
pub enum Classification {
    /// One transfer function for all places, over data units.
    Function(TransferFunction),
    /// A transfer function for each label.
    Labels(Labels),
}

/// A segmentation and what its labels look like.
///
/// The label of a place is that of the voxel it lies in, so labels change at the faces of their own voxels, of which there may
/// be another number than of the values; the value is reconstructed as everywhere else. Places with a label that is not in
/// the table are transparent.
#[derive(Debug, Clone)]
pub struct Labels {
    /// The labels, in its first channel, in texture coordinates of the volume that is shown; numbers between labels count as
    /// the closest.
    pub volume: Arc<Volume>,
    /// The transfer functions.
    pub table: LabelTable,
}

impl From<TransferFunction> for Classification {
    fn from(function: TransferFunction) -> Self {
        Self::Function(function)
    }
}

/// The transfer function of every place.
#[derive(Debug)]
pub(crate) struct Functions {
    functions: Vec<TransferFunction>,
    labels: Option<Voxels>,
}

/// The number of its function for every voxel of a label volume.
#[derive(Debug)]
struct Voxels {
    dims: UVec3,
    functions: Vec<u32>,
}

impl Functions {
    pub(crate) fn new(classification: &Classification) -> Self {
        match classification {
            Classification::Function(function) => Self { functions: vec![function.clone()], labels: None },
            Classification::Labels(labels) => Self::by_label(labels),
        }
    }

    /// The first is that of all labels without one: without knots, so transparent.
    fn by_label(Labels { volume, table }: &Labels) -> Self {
        let numbers: BTreeMap<u32, u32> = table.labels.keys().copied().zip(1..).collect();
        let known = table.labels.values().map(|label| label.transfer_function.clone());
        let [nx, ny, nz] = volume.dims;
        let mut of_voxels = Vec::with_capacity(UVec3::from_array(volume.dims).as_usizevec3().element_product());
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let label = volume.finite_value([i, j, k], 0).round_ties_even();
                    let is_label = (0.0..=f64::from(u32::MAX)).contains(&label);
                    let number = is_label.then(|| numbers.get(&(label as u32))).flatten();
                    of_voxels.push(number.copied().unwrap_or(0));
                }
            }
        }
        let labels = Voxels { dims: UVec3::from_array(volume.dims), functions: of_voxels };
        Self { functions: std::iter::once(TransferFunction::default()).chain(known).collect(), labels: Some(labels) }
    }

    /// Number of voxels along each axis at whose faces another function may begin.
    pub(crate) fn faces(&self) -> Option<UVec3> {
        self.labels.as_ref().map(|labels| labels.dims)
    }

    /// The transfer function at texture coordinates within the volume.
    pub(crate) fn at(&self, texture: DVec3) -> &TransferFunction {
        let number = self.labels.as_ref().map_or(0, |labels| labels.functions[labels.voxel(texture)]);
        &self.functions[number as usize]
    }
}

impl Voxels {
    fn voxel(&self, texture: DVec3) -> usize {
        // Truncated: places before the first voxel belong to it.
        let place = (texture * self.dims.as_dvec3()).as_uvec3().min(self.dims - 1).as_usizevec3();
        let dims = self.dims.as_usizevec3();
        (place.z * dims.y + place.y) * dims.x + place.x
    }
}
