//! Emission and absorption.

use super::{Path, Renderer};
use crate::image::PixelResult;
use rayloom_volume::extinction;

impl Renderer<'_> {
    /// Composites the samples of a ray front to back.
    pub(super) fn composite(&self, path: &Path) -> PixelResult {
        let mut result = PixelResult::NOTHING;
        for sample in self.samples(path) {
            let texture = path.texture(sample.position);
            let function = self.prepared.functions.at(texture);
            let material = function.evaluate(self.prepared.field.at_texture(texture));
            if material.opacity <= 0.0 {
                continue;
            }
            if result.color[3] == 0.0 {
                result.depth = path.depth(sample.position);
            }
            let opacity = -(-extinction(material.opacity) * sample.length * path.step).exp_m1();
            let color = self.prepared.lit(material.color, texture, &path.ray);
            let weight = (1.0 - result.color[3]) * opacity;
            for (sum, c) in result.color.iter_mut().zip([color[0], color[1], color[2], 1.0]) {
                *sum += weight * c;
            }
            if self.prepared.scene.early_termination.is_some_and(|threshold| result.color[3] >= threshold) {
                break;
            }
        }
        result
    }
}
