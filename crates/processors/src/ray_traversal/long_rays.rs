//! Rays of very many samples: when sums need care, and how many samples a driver lets a ray take.

use rayloom_network::{ProcessError, Properties};
use rayloom_volume::Volume;
use rayloom_wgsl::{Checked, Slot, Snippet, Termination, has_loops};

use super::frame::diagonal;
use crate::{View, step_length};

/// Steps of a ray beyond which the rounding of sums of faint samples shows: 8192 additions of equal numbers are off by 8192 / 2^25,
/// a sixteenth of a grey level in the worst case.
pub(super) const LONG: f64 = 8192.0;
/// Rays that Mesa's software driver walks at once.
const LANES: f64 = 8.0;
/// Surfaces that a compositing snippet looks for at a sample, at most.
const SURFACES: u32 = 3;

/// Steps of the longest ray: along the diagonal of the volume.
pub(super) fn most_steps(view: &View, volume: &Volume, properties: &Properties) -> Result<f64, ProcessError> {
    Ok(diagonal(volume) / step_length(view, volume, properties.f64("sampling_rate")?))
}

/// Whether rays of so many steps may look for visible samples in a loop of its own where a driver ends all loops after `rounds`.
/// Rays that are walked at once wait for each other there: at worst each in turn is the only one to go on, and takes a round of
/// the outer loop and the last check of the inner one besides.
pub(super) fn may_search(rounds: u32, steps: f64) -> bool {
    (LANES + 2.0) * steps <= f64::from(rounds)
}

/// The samples that a ray may take where a driver ends all loops of a ray, without a word, after `rounds`.
pub(super) fn most_samples(rounds: u32, checked: &Checked) -> u32 {
    let loops = checked.snippet(Slot::Refinement).is_some_and(|snippet| has_loops(snippet.text()));
    let refined: Vec<&Snippet> =
        checked.output_snippets().filter(|output| loops && output.reads("refinement")).collect();
    // The loop in a branch not taken is entered, too, for a round without effect.
    let a_sample = 1 + SURFACES * refined.len() as u32;
    // Four rounds for each of four thousand surfaces: a ray meets three in a cell at most, and hardly ever one in each.
    let many = refined.iter().any(|output| output.declaration().termination != Termination::Hit);
    let spare = if many { rounds / 4 } else { 256 };
    (rounds - spare) / a_sample
}
