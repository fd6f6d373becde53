//! A hash of everything a picture depends on.

use crate::camera::{Camera, Projection};
use crate::classification::{Classification, Labels};
use crate::field::Sampling;
use crate::gradient::GradientOperator;
use crate::image::Rectangle;
use crate::ray::AxisBox;
use crate::reference::Reference;
use crate::scene::{FirstHit, Layer, Method, Refinement, Scene};
use crate::shading::{Diffuse, Highlight, LightSpace, Shading};
use glam::DVec3;
use rayloom_volume::{Knot, Label, LabelTable, TransferFunction, Volume};

/// Raised whenever the same scene may come to another picture.
const VERSION: u64 = 5;

/// The key of a picture of `scene`: equal for equal pictures, different for different ones but for chances of 2^-128.
///
/// Only what the renderer looks at counts: the exact picture has one key at all lengths of steps.
pub(super) fn key(reference: Reference, scene: &Scene<'_>, part: Option<Rectangle>) -> u128 {
    // Without `..`, so that a new field cannot be forgotten here.
    let Scene {
        volume,
        channel,
        sampling,
        clip: AxisBox { min, max },
        camera,
        size,
        step,
        reference_length,
        method,
        classification,
        shading,
        gradient,
        jitter,
        early_termination,
    } = scene;
    let sampled = reference == Reference::SameSamples;
    let mut digest = Digest::new();
    digest.words([VERSION, sampled.into(), sampling_id(*sampling), gradient_id(*gradient)]);
    digest.words(size.map(u64::from));
    digest.vectors(&[*min, *max]);
    digest.number(*reference_length);
    if sampled {
        digest.number(*step);
        digest.optional(*early_termination);
        digest.optional(jitter.map(f64::from));
    }
    digest.camera(camera);
    digest.method(*method, sampled);
    digest.classification(classification);
    if let Some(shading) = shading {
        digest.shading(shading);
    }
    let part = part.unwrap_or(Rectangle { x: 0, y: 0, width: size[0], height: size[1] });
    digest.words([part.x, part.y, part.width, part.height].map(u64::from));
    digest.volume(volume, *channel);
    digest.state
}

fn sampling_id(sampling: Sampling) -> u64 {
    match sampling {
        Sampling::Nearest => 0,
        Sampling::Trilinear => 1,
        Sampling::CatmullRom => 2,
        Sampling::BSplinePrefiltered => 3,
    }
}

fn gradient_id(gradient: GradientOperator) -> u64 {
    match gradient {
        GradientOperator::Central => 0,
        GradientOperator::Forward => 1,
        GradientOperator::Backward => 2,
        GradientOperator::CentralFourth => 3,
        GradientOperator::Sobel => 4,
    }
}

/// The 128-bit hash of Fowler, Noll and Vo over words of 64 bits, with a rotation that carries high bits back down. Every step
/// is a bijection of the state, so that streams that differ in one word never meet.
pub(super) struct Digest {
    pub(super) state: u128,
}

impl Digest {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

    pub(super) fn new() -> Self {
        Self { state: Self::OFFSET }
    }

    pub(super) fn word(&mut self, word: u64) {
        self.state = (self.state ^ u128::from(word)).wrapping_mul(Self::PRIME).rotate_left(41);
    }

    fn words(&mut self, words: impl IntoIterator<Item = u64>) {
        words.into_iter().for_each(|word| self.word(word));
    }

    /// By its bits: the two zeros differ, as they may in a picture.
    pub(super) fn number(&mut self, number: f64) {
        self.word(number.to_bits());
    }

    fn numbers(&mut self, numbers: impl IntoIterator<Item = f64>) {
        numbers.into_iter().for_each(|number| self.number(number));
    }

    fn vectors(&mut self, vectors: &[DVec3]) {
        vectors.iter().for_each(|vector| self.numbers(vector.to_array()));
    }

    fn optional(&mut self, number: Option<f64>) {
        self.word(number.is_some().into());
        self.number(number.unwrap_or(0.0));
    }

    fn camera(&mut self, camera: &Camera) {
        let Camera { eye, focus, up, projection, near } = camera;
        self.vectors(&[*eye, *focus, *up]);
        self.optional(*near);
        match *projection {
            Projection::Perspective { fov_degrees } => self.words([0, fov_degrees.to_bits()]),
            Projection::Orthographic { height } => self.words([1, height.to_bits()]),
        }
    }

    fn method(&mut self, method: Method, sampled: bool) {
        match method {
            Method::Dvr => self.word(0),
            Method::Mip => self.word(1),
            Method::MinIp => self.word(2),
            Method::Mean => self.word(3),
            Method::Sum => self.word(4),
            Method::FirstHit(told) => {
                let told = match told {
                    FirstHit::Depth => 0,
                    FirstHit::Point => 1,
                    FirstHit::Normal => 2,
                };
                self.words([6, told]);
            }
            Method::Isosurface { value, refinement } => {
                self.words([5, value.to_bits()]);
                self.refinement(refinement, sampled);
            }
            Method::Isosurfaces { layers, refinement } => {
                self.word(7);
                for Layer { value, color, opacity } in layers {
                    self.numbers([value, opacity]);
                    self.numbers(color);
                }
                self.refinement(refinement, sampled);
            }
        }
    }

    fn refinement(&mut self, refinement: Refinement, sampled: bool) {
        let [kind, steps] = match refinement {
            _ if !sampled => [0, 0],
            Refinement::None => [1, 0],
            Refinement::Linear => [2, 0],
            Refinement::Bisection(halvings) => [3, halvings],
            Refinement::Secant(steps) => [4, steps],
        };
        self.words([kind, steps].map(u64::from));
    }

    fn classification(&mut self, classification: &Classification) {
        match classification {
            Classification::Function(function) => {
                self.word(0);
                self.function(function);
            }
            Classification::Labels(Labels { volume, table: LabelTable { labels } }) => {
                self.words([1, labels.len() as u64]);
                for (label, Label { name: _, transfer_function }) in labels {
                    self.word(u64::from(*label));
                    self.function(transfer_function);
                }
                self.volume(volume, 0);
            }
        }
    }

    fn function(&mut self, function: &TransferFunction) {
        self.word(function.knots.len() as u64);
        for knot in &function.knots {
            let Knot { at, color: _, opacity: _, right: _ } = knot;
            self.number(*at);
            for side in [knot.left_side(), knot.right_side()] {
                self.numbers(side.color);
                self.number(side.opacity);
            }
        }
    }

    fn shading(&mut self, shading: &Shading) {
        let Shading {
            ambient,
            diffuse,
            diffuse_term,
            specular,
            highlight,
            light_direction,
            light_space,
            light_color,
            two_sided,
            gradient_fade,
        } = shading;
        self.numbers([*ambient, *diffuse, *specular, *gradient_fade]);
        match *diffuse_term {
            Diffuse::Lambert => self.word(0),
            Diffuse::OrenNayar { roughness } => self.words([1, roughness.to_bits()]),
            Diffuse::Toon { steps } => self.words([2, u64::from(steps)]),
        }
        match *highlight {
            Highlight::BlinnPhong { shininess } => self.words([0, shininess.to_bits()]),
            Highlight::Phong { shininess } => self.words([1, shininess.to_bits()]),
            Highlight::CookTorrance { roughness, reflectance } => {
                self.words([2, roughness.to_bits(), reflectance.to_bits()]);
            }
            Highlight::Ward { along, across } => self.words([3, along.to_bits(), across.to_bits()]),
        }
        self.vectors(&[*light_direction]);
        self.numbers(*light_color);
        self.words([u64::from(*light_space == LightSpace::World), u64::from(*two_sided)]);
    }

    /// The values of one channel and where they lie; neither names nor
    /// the type in which values are stored.
    fn volume(&mut self, volume: &Volume, channel: u32) {
        let [nx, ny, nz] = volume.dims;
        self.words(volume.dims.map(u64::from));
        self.numbers(volume.index_to_world.to_cols_array());
        // A scene without such a channel is refused before it is rendered.
        if channel >= volume.channels {
            return;
        }
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    self.number(volume.finite_value([i, j, k], channel));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_matter_in_number_and_order() {
        let of = |words: &[u64]| {
            let mut digest = Digest::new();
            digest.words(words.iter().copied());
            digest.state
        };
        let streams: [&[u64]; 8] = [&[], &[0], &[0, 0], &[1], &[1 << 63], &[1, 2], &[2, 1], &[1 << 63, 1 << 63]];
        for (i, a) in streams.iter().enumerate() {
            assert!(streams[..i].iter().all(|b| of(a) != of(b)));
        }
    }
}
