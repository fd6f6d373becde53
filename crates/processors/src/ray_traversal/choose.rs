//! From properties and inputs to a choice of snippets that fits the data and the device.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayloom_network::{Job, ProcessError};
use rayloom_volume::VolumeRole;
use rayloom_wgsl::{Checked, Choice, Library, MAX_OUTPUTS, Slot, Snippet, SourceChoice};

use super::long_rays;
use super::memory::Memory;
use super::skipping::{Question, WORTHWHILE};
use super::snippets::PLACES;
use super::tables::has_steps;
use super::{Inputs, OUTPORTS, SAMPLES};
use crate::{Context, Data};

/// What will be assembled.
pub(super) struct Plan<'a> {
    /// Where snippets and what they include come from.
    pub library: Arc<Library>,
    /// What was chosen.
    pub choice: Choice,
    /// The same, checked, with what the program puts in.
    pub checked: Checked,
    /// The channel of the volume that is classified.
    pub channel: u32,
    /// Samples that the device lets one ray take, where it has a limit.
    pub most_samples: Option<u32>,
    /// What the skipping map depends on, when there is skipping.
    pub skipping: Option<Question<'a>>,
    /// Why there is skipping, or not.
    pub skipping_why: String,
}

pub(super) fn plan<'a>(
    library: Arc<Library>,
    context: &Context,
    job: &Job<'_, Data>,
    inputs: &Inputs<'a>,
    memory: &mut Memory,
    notes: &mut Vec<String>,
) -> Result<Plan<'a>, ProcessError> {
    let volume = &inputs.volume.volume;
    let channel = channel(job, inputs)?;
    let steps = long_rays::most_steps(inputs.view, volume, job.properties)?;
    let (snippets, outputs) = chosen(&library, job)?;
    let mut choice = Choice {
        early_termination: job.properties.f64("termination_error")? > 0.0,
        statistics: context.count_samples,
        sample_map: job.wants(SAMPLES),
        jitter: job.properties.bool("jitter")?,
        half_targets: job.properties.text("target")? == "16-bit",
        long_rays: steps > long_rays::LONG,
        search: context.gpu.loop_rounds().is_none_or(|rounds| long_rays::may_search(rounds, steps)),
        ..Choice::of(snippets, outputs)
    };
    if let Some(source) = choice.sources.first_mut() {
        source.gaps = memory.gaps.of(volume, channel).is_some();
        (source.channel, source.channels) = (channel, volume.channels);
        fit_sampling(&library, context, inputs, source, notes)?;
        let classification = source.snippets.get(&Slot::Classification);
        if classification.is_some_and(|snippet| snippet.reads("transfer_function")) {
            let function = job.properties.transfer_function("transfer_function")?;
            source.steps = has_steps(function, volume.ranges()[channel as usize]);
        }
    }
    let (skipping, skipping_why) = fit_skipping(&library, job, inputs, memory, &mut choice, channel)?;
    let checked = choice.check(&library).map_err(|problems| {
        ProcessError::new(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
    })?;
    if checked.features.has("gradient_volume") && volume.role != VolumeRole::GradientAndValue {
        return Err(ProcessError::new(format!(
            "the gradient is to be read from the volume, but `{}` holds none; insert a gradient volume processor or choose another gradient",
            volume.name
        )));
    }
    let most_samples = context.gpu.loop_rounds().map(|rounds| long_rays::most_samples(rounds, &checked));
    if let Some(most) = most_samples.filter(|most| steps > f64::from(*most)) {
        notes.push(format!(
            "This device's driver ends long loops, so a ray takes at most {most} samples; longer rays take longer steps."
        ));
    }
    Ok(Plan { library, choice, checked, channel, most_samples, skipping, skipping_why })
}

/// The snippets by slot, and those of the outputs.
type Chosen = (BTreeMap<Slot, Snippet>, [Option<Snippet>; MAX_OUTPUTS]);

/// The snippets that the properties choose, for the outputs that something wants.
fn chosen(library: &Library, job: &Job<'_, Data>) -> Result<Chosen, ProcessError> {
    let mut snippets = BTreeMap::new();
    let mut outputs: [Option<Snippet>; MAX_OUTPUTS] = Default::default();
    // Samples are those that the first image takes where no other is wanted.
    let only_samples = !OUTPORTS.iter().any(|outport| job.wants(outport));
    for place in PLACES {
        match place.output {
            Some(output) if !(job.wants(OUTPORTS[output]) || only_samples && output == 0) => {}
            Some(output) => outputs[output] = place.snippet(library, job.properties)?,
            None => {
                snippets.extend(place.snippet(library, job.properties)?.map(|snippet| (place.slot, snippet)));
            }
        }
    }
    Ok((snippets, outputs))
}

/// The channel to classify: that of the property, or the value beside a gradient.
fn channel(job: &Job<'_, Data>, inputs: &Inputs<'_>) -> Result<u32, ProcessError> {
    let volume = &inputs.volume.volume;
    if volume.role == VolumeRole::GradientAndValue {
        return Ok(3);
    }
    let channel = job.properties.int("channel")?;
    u32::try_from(channel).ok().filter(|&channel| channel < volume.channels).ok_or_else(|| {
        ProcessError::new(format!(
            "channel {channel} was chosen, but the volume `{}` has {}; choose a smaller one",
            volume.name, volume.channels
        ))
    })
}

/// Where the device cannot filter the volume's format, floats are interpolated in the shader instead. A volume of spline
/// coefficients has one channel, whatever it was made from.
fn fit_sampling(
    library: &Library,
    context: &Context,
    inputs: &Inputs<'_>,
    source: &mut SourceChoice,
    notes: &mut Vec<String>,
) -> Result<(), ProcessError> {
    let Some(sampling) = source.snippets.get(&Slot::Sampling) else { return Ok(()) };
    if sampling.reads("prefiltered") {
        (source.channel, source.channels) = (0, 1);
    } else if sampling.reads("filtering") && !inputs.volume.on_gpu(&context.gpu)?.filterable {
        let floats = library.snippet(Slot::Sampling, "trilinear").cloned();
        source.snippets.extend(floats.map(|snippet| (Slot::Sampling, snippet)));
        notes.push("This device cannot filter the volume's format; it is interpolated in the shader.".into());
    }
    Ok(())
}

/// Chooses skipping when that is left to the program: where it is legal and little enough of the volume is visible. With the
/// reason.
fn fit_skipping<'a>(
    library: &Library,
    job: &Job<'_, Data>,
    inputs: &Inputs<'a>,
    memory: &mut Memory,
    choice: &mut Choice,
    channel: u32,
) -> Result<(Option<Question<'a>>, String), ProcessError> {
    let volume = &inputs.volume.volume;
    if let Some(skipping) = choice.snippet(Slot::Skipping) {
        if skipping.declaration().absent {
            return Ok((None, "`none` is chosen".into()));
        }
        // An illegal choice is refused by the check that follows.
        return Ok((Question::of(choice, job.properties, volume, channel)?, "chosen".into()));
    }
    let nothing = |why: String| Ok((None, why));
    let Some(distance) = library.snippet(Slot::Skipping, "distance") else {
        return nothing("there is no snippet".into());
    };
    let mut skipped = choice.clone();
    skipped.put(distance.clone());
    if let Err(problems) = skipped.check(library) {
        return nothing(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "));
    }
    let Some(question) = Question::of(&skipped, job.properties, volume, channel)? else {
        return nothing("nothing tells which values show".into());
    };
    let occupied = question.map(&mut memory.skipping, &mut memory.splines)?.occupied;
    let (share, most) = (100.0 * occupied, 100.0 * WORTHWHILE);
    if occupied > WORTHWHILE {
        return nothing(format!(
            "{share:.0} % of the bricks may show something, more than {most:.0} %: leaping costs more"
        ));
    }
    *choice = skipped;
    Ok((Some(question), format!("{share:.0} % of the bricks may show something, no more than {most:.0} %")))
}
