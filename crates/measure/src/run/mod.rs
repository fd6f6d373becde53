//! A measurement from beginning to end.

mod advice;
pub(crate) mod bench;
pub(crate) mod budget;
pub(crate) mod draw;
pub(crate) mod figures;
pub(crate) mod ladder;
pub(crate) mod measurements;
pub mod pareto;
pub(crate) mod plan;
pub(crate) mod refine;
pub(crate) mod setting;
pub(crate) mod views;
pub(crate) mod yardstick;

use rayloom_gpu::Gpu;
use rayloom_network::{Camera, Network};
use rayloom_reference::Cache;

use crate::run::bench::Bench;
use crate::run::figures::{Expected, row};
use crate::run::views::views;
use crate::run::yardstick::{Standard, Yardstick, choose, finest};
use crate::subject::chain::Chain;
use crate::{Figures, Listener, MeasureError, Measured, Measurements, Plan, Refused, Setting, Subject, Summary};

/// Lowest sampling rate of the finest setting.
const FINEST_RATE: f64 = 16.0;
/// How many times finer than any measured setting the finest is.
const FINER: f64 = 4.0;
/// The highest sampling rate there is.
const MOST_RATE: f64 = 4096.0;

/// Measures a network.
///
/// Every setting is rendered from every view, counted and compared with the reference, then all of them are timed in turn,
/// round by round, so that whatever else the machine does hits all alike. A setting that cannot be rendered is listed with
/// the reason.
///
/// # Errors
/// The network has no ray traversal to measure, the plan makes no sense, the reference that was asked for cannot draw it, or
/// no setting at all can be rendered.
pub fn measure(
    network: &Network,
    plan: &Plan,
    gpu: Gpu,
    cache: &Cache,
    listener: Listener<'_>,
) -> Result<Measurements, MeasureError> {
    let chain = Chain::find(network, plan.port.as_ref())?;
    let settings = plan.settings(network, &chain)?;
    let adapter = gpu.describe();
    let finest = finest(network, &chain, finest_rate(network, &chain, &settings));
    let mut bench = Bench::new(network, chain, gpu, plan.size)?;
    let views = views(&bench.camera()?, plan.views);
    let (standard, refusal) = choose(plan.standard, &mut bench)?;
    let yardstick = Yardstick { standard, cache, listener, finest };
    let compared = compare(&mut bench, &yardstick, settings, &views)?;
    let Compared { mut settings, refused, own, expected } = compared;
    time(&mut bench, &mut settings, &views, plan.rounds, listener)?;
    let budget = match plan.budget && !own.is_empty() {
        true => {
            // Of the same samples every setting has its own reference.
            let reference = (standard != Standard::SameSamples).then(|| row(&expected, |view| &view.pixels));
            let saved = budget::Saved { pictures: &own, reference: reference.as_deref() };
            Some(budget::budget(network, &mut bench, &views, saved, cache, listener)?)
        }
        false => None,
    };
    let note = refusal.map(|refusal| format!(" Not with the exact picture: {refusal}")).unwrap_or_default();
    let mut measurements = Measurements {
        network: network.name.clone(),
        origin: plan.origin.clone(),
        image: bench.chain.image.to_string(),
        adapter,
        rayloom: env!("CARGO_PKG_VERSION").into(),
        size: plan.size,
        views: views.iter().map(Camera::to_json).collect(),
        rounds: plan.rounds.max(1),
        reference: standard.id(),
        reference_note: format!("{}{note}", standard.meaning()),
        settings,
        front_time: Vec::new(),
        front_samples: Vec::new(),
        dominated: Default::default(),
        refused,
        budget,
        chosen: None,
        advice: String::new(),
        pictures: expected.into_iter().map(|view| view.pixels).collect(),
    };
    measurements.compare();
    measurements.chosen = advice::choice(&measurements);
    measurements.advice = advice::advice(&measurements);
    Ok(measurements)
}

/// Finer than every setting that is measured.
fn finest_rate(network: &Network, chain: &Chain, settings: &[Setting]) -> f64 {
    let rate = |network: &Network| match network.value(chain.traversal(), "sampling_rate") {
        Some(rayloom_network::Value::Float(rate)) => rate,
        _ => 1.0,
    };
    let rates = settings.iter().filter_map(|setting| setting.applied(network).ok()).map(|network| rate(&network));
    (FINER * rates.fold(0.0, f64::max)).clamp(FINEST_RATE, MOST_RATE)
}

/// What comparing pictures gives.
struct Compared {
    settings: Vec<Measured>,
    refused: Vec<Refused>,
    /// Pictures of the network as saved, view by view; empty if it cannot be rendered.
    own: Vec<[f32; 4]>,
    /// The references.
    expected: Vec<Expected>,
}

fn compare(
    bench: &mut Bench,
    yardstick: &Yardstick<'_>,
    settings: Vec<Setting>,
    views: &[Camera],
) -> Result<Compared, MeasureError> {
    let own_samples = yardstick.standard == Standard::SameSamples;
    let mut common = match own_samples {
        true => Vec::new(),
        false => yardstick.draw(bench, &Setting::saved(), views)?,
    };
    let mut result = Compared { settings: Vec::new(), refused: Vec::new(), own: Vec::new(), expected: Vec::new() };
    let meant = match yardstick.standard == Standard::Exact {
        true => Some(meaning(bench, &Setting::saved(), views)?),
        false => None,
    };
    let (count, voxel) = (settings.len(), bench.voxel()?);
    for (index, setting) in settings.into_iter().enumerate() {
        (yardstick.listener)(&format!("comparing: {}", setting.name), index as f64 / count as f64);
        if own_samples {
            match yardstick.draw(bench, &setting, views) {
                Ok(reference) => common = reference,
                Err(error) => {
                    result.refused.push(Refused { setting, reason: refusable(error)? });
                    continue;
                }
            }
        }
        match compare_one(bench, &setting, views, &common, voxel) {
            Ok((mut measured, pixels)) => {
                measured.departs = match &meant {
                    Some(meant) => departs(bench, &setting, views, meant)?,
                    None => false,
                };
                if setting.assignments.is_empty() {
                    result.own = pixels;
                }
                result.settings.push(measured);
                if own_samples && result.expected.is_empty() {
                    result.expected = std::mem::take(&mut common);
                }
            }
            Err(error) => result.refused.push(Refused { setting, reason: refusable(error)? }),
        }
    }
    if !own_samples {
        result.expected = common;
    }
    match result.settings.is_empty() {
        true => Err(MeasureError::AllRefused(
            result
                .refused
                .iter()
                .map(|one| format!("{}: {}", one.setting.name, one.reason))
                .collect::<Vec<_>>()
                .join("\n"),
        )),
        false => Ok(result),
    }
}

/// What the first view shows with a setting.
fn meaning(bench: &mut Bench, setting: &Setting, views: &[Camera]) -> Result<Subject, MeasureError> {
    bench.set(setting, &views[0])?;
    bench.subject()
}

/// Whether a setting stands for something else than what is meant.
fn departs(bench: &mut Bench, setting: &Setting, views: &[Camera], meant: &Subject) -> Result<bool, MeasureError> {
    match meaning(bench, setting, views) {
        Ok(shown) => Ok(!shown.stands_for(meant)),
        Err(MeasureError::Refusal(_)) => Ok(true),
        Err(other) => Err(other),
    }
}

/// The reason, where one setting is to blame; anything else ends the measurement.
fn refusable(error: MeasureError) -> Result<String, MeasureError> {
    match error {
        MeasureError::Evaluation(_) | MeasureError::Edit(_) | MeasureError::Refusal(_) => Ok(error.to_string()),
        other => Err(other),
    }
}

fn compare_one(
    bench: &mut Bench,
    setting: &Setting,
    views: &[Camera],
    expected: &[Expected],
    voxel: f64,
) -> Result<(Measured, Vec<[f32; 4]>), MeasureError> {
    let (mut shots, mut notes) = (Vec::new(), Vec::new());
    for view in views {
        bench.set(setting, view)?;
        let (shot, noted) = bench.shot()?;
        shots.push(shot);
        notes.extend(noted);
    }
    notes.sort();
    notes.dedup();
    let (views, maps): (Vec<Figures>, Vec<Vec<f64>>) =
        Figures::of_views(&shots, expected, bench.size, voxel)?.into_iter().unzip();
    let all = Figures::over(&shots, expected, &views, voxel)?;
    let map = maps.into_iter().next().unwrap_or_default().into_iter().map(|error| error as f32).collect();
    let measured = Measured { setting: setting.clone(), all, views, departs: false, notes, map };
    Ok((measured, row(&shots, |shot| &shot.pixels)))
}

/// Times all settings, taking turns.
fn time(
    bench: &mut Bench,
    settings: &mut [Measured],
    views: &[Camera],
    rounds: usize,
    listener: Listener<'_>,
) -> Result<(), MeasureError> {
    let rounds = rounds.max(1);
    let mut timings = vec![vec![Vec::new(); views.len()]; settings.len()];
    for round in 0..rounds {
        for (number, view) in views.iter().enumerate() {
            let share = (round * views.len() + number) as f64 / (rounds * views.len()) as f64;
            listener(&format!("timing: round {} of {rounds}", round + 1), share);
            for (measured, timings) in settings.iter().zip(&mut timings) {
                bench.set(&measured.setting, view)?;
                timings[number].extend(bench.time()?);
            }
        }
    }
    for (measured, timings) in settings.iter_mut().zip(&timings) {
        measured.all.time_ms = Summary::of(&timings.concat());
        for (figures, timings) in measured.views.iter_mut().zip(timings) {
            figures.time_ms = Summary::of(timings);
        }
    }
    Ok(())
}
