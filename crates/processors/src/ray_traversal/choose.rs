//! From properties and inputs to a choice of snippets that fits the data and the device.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayloom_network::{Job, ProcessError};
use rayloom_volume::VolumeRole;
use rayloom_wgsl::{Choice, Library, MAX_OUTPUTS, Slot};

use super::long_rays;
use super::memory::Memory;
use super::skipping::{Question, WORTHWHILE};
use super::snippets::PLACES;
use super::tables::has_steps;
use super::{Inputs, OUTPORTS, SAMPLES};
use crate::{Context, Data};

/// What will be assembled.
pub(super) struct Plan<'a> {
    /// The snippets, with the edited texts of this processor.
    pub library: Library,
    pub choice: Choice,
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
    library: &Library,
    context: &Context,
    job: &Job<'_, Data>,
    inputs: &Inputs<'a>,
    memory: &mut Memory,
    notes: &mut Vec<String>,
) -> Result<Plan<'a>, ProcessError> {
    let mut library = library.clone();
    let volume = &inputs.volume.volume;
    let channel = channel(job, inputs)?;
    let steps = long_rays::most_steps(volume, job.properties)?;
    let mut snippets = BTreeMap::new();
    let mut outputs: [Option<Arc<str>>; MAX_OUTPUTS] = Default::default();
    // Samples are those that the first image takes where no other is wanted.
    let only_samples = !OUTPORTS.iter().any(|outport| job.wants(outport));
    for place in PLACES {
        match place.output {
            Some(output) if !(job.wants(OUTPORTS[output]) || only_samples && output == 0) => {}
            Some(output) => outputs[output] = place.path(&mut library, job.properties)?,
            None => {
                snippets.extend(place.path(&mut library, job.properties)?.map(|path| (place.slot, path)));
            }
        }
    }
    let mut choice = Choice {
        snippets,
        outputs,
        early_termination: job.properties.f64("termination_error")? > 0.0,
        statistics: context.count_samples,
        sample_map: job.wants(SAMPLES),
        jitter: job.properties.bool("jitter")?,
        trace: false,
        half_targets: job.properties.text("target")? == "16-bit",
        gaps: memory.gaps.of(volume, channel).is_some(),
        long_rays: steps > long_rays::LONG,
        search: context.gpu.loop_rounds().is_none_or(|rounds| long_rays::may_search(rounds, steps)),
        steps: false,
        channel,
        channels: volume.channels,
    };
    fit_sampling(&library, context, inputs, &mut choice, notes)?;
    let (skipping, skipping_why) = fit_skipping(&library, job, inputs, memory, &mut choice, channel)?;
    let features = choice.check(&library).map_err(|problems| {
        ProcessError::new(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
    })?;
    if features.has("gradient_volume") && volume.role != VolumeRole::GradientAndValue {
        return Err(ProcessError::new(format!(
            "the gradient is to be read from the volume, but `{}` holds none; insert a gradient volume processor or choose another gradient",
            volume.name
        )));
    }
    if features.has("transfer_function") {
        choice.steps =
            has_steps(job.properties.transfer_function("transfer_function")?, volume.ranges()[channel as usize]);
    }
    let rounds = context.gpu.loop_rounds();
    let most_samples = rounds.map(|rounds| long_rays::most_samples(rounds, &library, &choice));
    if let Some(most) = most_samples.filter(|most| steps > f64::from(*most)) {
        notes.push(format!(
            "This device's driver ends long loops, so a ray takes at most {most} samples; longer rays take longer steps."
        ));
    }
    Ok(Plan { library, choice, channel, most_samples, skipping, skipping_why })
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
    choice: &mut Choice,
    notes: &mut Vec<String>,
) -> Result<(), ProcessError> {
    let Some(declaration) = choice.snippets.get(&Slot::Sampling).and_then(|path| library.declaration(path)) else {
        return Ok(());
    };
    if declaration.reads.contains("prefiltered") {
        (choice.channel, choice.channels) = (0, 1);
    } else if declaration.reads.contains("filtering") && !inputs.volume.on_gpu(&context.gpu)?.filterable {
        let path = library.path(Slot::Sampling, "trilinear");
        choice.snippets.extend(path.map(|path| (Slot::Sampling, path)));
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
    if choice.snippets.contains_key(&Slot::Skipping) {
        // `none` asks nothing; an illegal choice is refused by the check that follows.
        let question = Question::of(library, choice, job.properties, volume, channel)?;
        let absent =
            choice.snippets.get(&Slot::Skipping).and_then(|path| library.declaration(path)).is_some_and(|d| d.absent);
        let why = if absent { "`none` is chosen" } else { "chosen" };
        return Ok((question.filter(|_| !absent), why.into()));
    }
    let nothing = |why: String| Ok((None, why));
    let Some(path) = library.path(Slot::Skipping, "distance") else { return nothing("there is no snippet".into()) };
    let mut trial = choice.clone();
    trial.snippets.insert(Slot::Skipping, path);
    if let Err(problems) = trial.check(library) {
        return nothing(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "));
    }
    let Some(question) = Question::of(library, &trial, job.properties, volume, channel)? else {
        return nothing("nothing tells which values show".into());
    };
    let occupied = question.map(&mut memory.skipping, &mut memory.splines)?.occupied;
    let (share, most) = (100.0 * occupied, 100.0 * WORTHWHILE);
    if occupied > WORTHWHILE {
        return nothing(format!(
            "{share:.0} % of the bricks may show something, more than {most:.0} %: leaping costs more"
        ));
    }
    *choice = trial;
    Ok((Some(question), format!("{share:.0} % of the bricks may show something, no more than {most:.0} %")))
}
