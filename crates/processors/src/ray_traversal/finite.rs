//! Tells of pixels that are not finite numbers, where a user's own snippets may have made them.

use rayloom_gpu::{Gpu, GpuError, Texture};
use rayloom_wgsl::At;

use super::OUTPORTS;
use super::choose::Plan;
use super::dispatch::Targets;

/// A note for every output that holds such pixels, with the snippets that are suspect. They are counted here and not on the
/// device, whose compilers may take for granted that there are none. Reads pictures back, though only of own snippets.
pub(super) fn notes(gpu: &Gpu, plan: &Plan, targets: &Targets) -> Result<Vec<String>, GpuError> {
    let mut notes = Vec::new();
    for (index, target) in targets.outputs.iter().enumerate() {
        let suspects = suspects(plan, index);
        let Some(target) = target.as_ref().filter(|_| !suspects.is_empty()) else { continue };
        let (color, depth) = (pixels(gpu, &target.color)?, pixels(gpu, &target.depth)?);
        let bad = color.iter().zip(&depth).filter(|(color, depth)| **color || **depth).count();
        if bad > 0 {
            notes.push(format!(
                "{bad} of {} pixels of `{}` are not finite numbers; suspect is {}: look for divisions by zero, and for roots, \
                 logarithms and powers of negative numbers",
                color.len(),
                OUTPORTS[index],
                suspects.join(" or ")
            ));
        }
    }
    Ok(notes)
}

/// Which pixels have a channel that is not finite.
fn pixels(gpu: &Gpu, texture: &Texture) -> Result<Vec<bool>, GpuError> {
    let texels = gpu.read_rgba_f32(texture)?;
    Ok(texels.iter().map(|texel| texel.iter().any(|channel| !channel.is_finite())).collect())
}

/// The user's own snippets that take part in an output, as they are called.
fn suspects(plan: &Plan, output: usize) -> Vec<String> {
    let of_others = |at: At| matches!(at, At::Output(other) if other != output);
    let own = plan.checked.own_snippets().filter(|(at, _)| !of_others(*at));
    own.map(|(_, snippet)| format!("your snippet `{}`", snippet.path())).collect()
}
