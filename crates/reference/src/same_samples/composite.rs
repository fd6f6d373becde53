//! Emission and absorption, and where they begin.

use super::{Path, Renderer};
use crate::image::PixelResult;
use crate::scene::FirstHit;
use glam::DVec3;
use rayloom_volume::{Rgba, extinction};

impl Renderer<'_> {
    /// Composites the samples of a ray front to back.
    pub(super) fn composite(&self, path: &Path) -> PixelResult {
        let mut result = PixelResult::NOTHING;
        for sample in self.samples(path) {
            let texture = path.texture(sample.position);
            let material = self.material(texture);
            if material.opacity <= 0.0 {
                continue;
            }
            let opacity = -(-extinction(material.opacity) * sample.length).exp_m1();
            let color = self.prepared.lit(material.color, texture, &path.ray);
            result.put_behind(color, opacity, path.depth(sample.position));
            if self.prepared.scene.early_termination.is_some_and(|threshold| result.color[3] >= threshold) {
                break;
            }
        }
        result
    }

    /// The first sample that is not transparent.
    pub(super) fn first_hit(&self, path: &Path, told: FirstHit) -> PixelResult {
        let visible = |position: &f64| self.material(path.texture(*position)).opacity > 0.0;
        let hit = self.samples(path).map(|sample| sample.position).find(visible);
        let told = |position| self.prepared.told(told, path.texture(position), path.depth(position));
        hit.map_or(PixelResult::NOTHING, told)
    }

    fn material(&self, texture: DVec3) -> Rgba {
        self.prepared.functions.at(texture).evaluate(self.prepared.field.at_texture(texture))
    }
}
