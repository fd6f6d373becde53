//! Volumes made by a test, and the files through which sources read them.

use std::path::{Path, PathBuf};

use glam::{DAffine3, DVec3};
use serde_json::json;
use tempfile::TempDir;

/// Voxels of 32-bit floats, x fastest, and where they lie.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Voxels along x, y, z.
    pub dims: [u32; 3],
    /// The values.
    pub values: Vec<f32>,
    /// Voxel index, centres at integers, to world.
    pub index_to_world: DAffine3,
}

impl Grid {
    /// Samples a function of the voxel index.
    pub fn of_index(dims: [u32; 3], index_to_world: DAffine3, value: impl Fn([u32; 3]) -> f64) -> Self {
        let [nx, ny, nz] = dims;
        let indices = (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])));
        Self { dims, values: indices.map(|index| value(index) as f32).collect(), index_to_world }
    }

    /// Samples a function of the world position.
    pub fn of_world(dims: [u32; 3], index_to_world: DAffine3, value: impl Fn(DVec3) -> f64) -> Self {
        let world = |index: [u32; 3]| index_to_world.transform_point3(DVec3::from_array(index.map(f64::from)));
        Self::of_index(dims, index_to_world, |index| value(world(index)))
    }

    /// The transformation of a box of `extent`, centred at the origin.
    pub fn centered(dims: [u32; 3], extent: DVec3) -> DAffine3 {
        let spacing = extent / DVec3::from_array(dims.map(f64::from));
        DAffine3::from_translation(0.5 * (spacing - extent)) * DAffine3::from_scale(spacing)
    }

    /// The value of a voxel.
    pub fn at(&self, [i, j, k]: [u32; 3]) -> f32 {
        let [i, j, k] = [i, j, k].map(|n| n as usize);
        self.values[(k * self.dims[1] as usize + j) * self.dims[0] as usize + i]
    }

    /// Writes the volume to a folder of its own.
    pub fn save(&self) -> VolumeFile {
        let bytes: Vec<u8> = self.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let m = self.index_to_world;
        VolumeFile::described(
            Some(&bytes),
            &json!({
                "raw": "voxels.raw", "dims": self.dims, "type": "f32", "origin": m.translation.to_array(),
                "directions": [m.matrix3.x_axis.to_array(), m.matrix3.y_axis.to_array(), m.matrix3.z_axis.to_array()],
            }),
        )
    }
}

/// A described raw volume in a temporary folder, which goes with it.
pub struct VolumeFile {
    path: PathBuf,
    _folder: TempDir,
}

impl VolumeFile {
    /// Writes a description and, if there are any, the bytes of `voxels.raw`.
    pub fn described(bytes: Option<&[u8]>, description: &serde_json::Value) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("test.volume.json");
        std::fs::write(&path, description.to_string()).expect("a writable temporary folder");
        if let Some(bytes) = bytes {
            std::fs::write(folder.path().join("voxels.raw"), bytes).expect("a writable temporary folder");
        }
        Self { path, _folder: folder }
    }

    /// Where the description is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}
