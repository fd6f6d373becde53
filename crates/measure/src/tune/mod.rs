//! Picks the cheapest setting of a network that keeps its pictures within an error, or the most accurate within a time.
//!
//! Settings are judged by [`picture_error`] against the exact picture of what the network stands for (against the device's
//! finest picture where the float64 reference cannot draw it). One is chosen by the errors of some views, with room for the
//! spread between views; then it is looked at from views that took no part in the choice, and what fails there is chosen
//! anew with those views among the others. So that the choice holds for pictures of any size, pixel rates stay as they are.

mod judge;
mod knobs;
mod search;
mod spread;
mod views;

use std::ops::ControlFlow;

use rayloom_gpu::Gpu;
use rayloom_network::{Address, Network, Preset};
use rayloom_reference::Cache;

use crate::subject::chain::Chain;
use crate::text::{milliseconds, number};
use crate::{MeasureError, Setting, Standard, Summary};
pub use judge::picture_error;
use judge::{Judge, Share};
use knobs::{Candidate, Knobs};
use search::{Found, Search};

/// Told what is being done and which share of it is finished, 0 to 1, from any thread. [`ControlFlow::Break`] ends the tuning
/// with [`rayloom_reference::RenderError::Cancelled`].
pub type Progress<'a> = &'a (dyn Fn(&str, f64) -> ControlFlow<()> + Sync);

/// What is wanted. One of `max_error` and `budget_ms` at least.
#[derive(Debug, Clone)]
pub struct Goal {
    /// The image to tune; the only ray traversal's if not given.
    pub port: Option<Address>,
    /// The largest [`picture_error`] that is allowed.
    pub max_error: Option<f64>,
    /// The longest time that entry points and rays of a picture may take, milliseconds.
    pub budget_ms: Option<f64>,
    /// Size of the pictures that errors are measured on.
    pub size: [u32; 2],
    /// Size of the pictures that the time is that of.
    pub picture: [u32; 2],
    /// Number of views to choose by; half as many join them where it is close.
    pub views: usize,
    /// Number of views that the choice is looked at from afterwards.
    pub unseen: usize,
    /// What pictures are compared with; the exact picture where the reference can draw it, else the finest, if not given.
    pub standard: Option<Standard>,
}

/// How the tuning came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The error is met on all views, seen and unseen, and within the budget if there is one.
    Met,
    /// No setting meets the error; the most accurate that was found stands in.
    Missed,
    /// The most accurate setting within the budget, where no error was asked for or none within the budget meets it.
    InTime,
    /// Even the fastest setting takes longer than the budget.
    TooSlow,
}

/// A setting that was looked at.
#[derive(Debug, Clone)]
pub struct Tried {
    /// The setting.
    pub setting: Setting,
    /// Its error in the saved view.
    pub error: f64,
    candidate: Candidate,
}

/// What tuning found.
#[derive(Debug, Clone)]
pub struct Tuned {
    /// How it came out.
    pub verdict: Verdict,
    /// The setting with every knob that tuning turns, as a preset.
    pub preset: Preset,
    /// The same, named by what differs from the network as saved.
    pub setting: Setting,
    /// Errors on the views that it was chosen by.
    pub seen: Vec<f64>,
    /// Errors on views that took no part in the choice.
    pub unseen: Vec<f64>,
    /// Time of a picture, where the device tells it.
    pub time_ms: Option<Summary>,
    /// Largest error of the network as saved on all those views; `None` if it cannot be rendered.
    pub saved_error: Option<f64>,
    /// Its time.
    pub saved_time_ms: Option<Summary>,
    /// What pictures were compared with, and why not with the exact one if so.
    pub reference: (Standard, Option<String>),
    /// All settings that were looked at.
    pub tried: Vec<Tried>,
    /// Whether it has twice the samples that met the target, for the sake of surfaces.
    secured: bool,
    goal: Goal,
}

/// Tunes a network.
///
/// # Errors
/// Nothing or nonsense is asked for, the network has no ray traversal to tune or cannot be rendered, the reference that was
/// asked for cannot draw it, a budget is asked for on a device that tells no times, or `progress` said to stop.
pub fn tune(
    network: &Network,
    goal: &Goal,
    gpu: Gpu,
    cache: &Cache,
    progress: Progress<'_>,
) -> Result<Tuned, MeasureError> {
    check(goal)?;
    let chain = Chain::find(network, goal.port.as_ref())?;
    let judge = Judge::new(network, chain.clone(), goal, gpu, cache, progress)?;
    let knobs = Knobs::new(network, &chain);
    let mut search = Search { judge, knobs, goal, views: goal.views.max(2), tried: Vec::new(), wants_more: false };
    let cheapest = goal.max_error.map(|allowed| search.cheapest(allowed)).transpose()?;
    match (cheapest, goal.budget_ms) {
        (Some(found), None) => {
            let verdict = if found.met { Verdict::Met } else { Verdict::Missed };
            finish(search, found, verdict)
        }
        (Some(found), Some(budget)) if found.met && time(&mut search, &found)? <= budget => {
            finish(search, found, Verdict::Met)
        }
        (_, budget) => {
            let Some(found) = search.within(budget.unwrap_or(f64::INFINITY))? else { return Err(no_times()) };
            let fits = time(&mut search, &found)? <= SLACK * budget.unwrap_or(f64::INFINITY);
            finish(search, found, if fits { Verdict::InTime } else { Verdict::TooSlow })
        }
    }
}

/// A time within a budget is measured again at the end, and no two timings are the same.
const SLACK: f64 = 1.2;

fn check(goal: &Goal) -> Result<(), MeasureError> {
    let wrong = |message: &str| Err(MeasureError::Plan(message.into()));
    match (goal.max_error, goal.budget_ms) {
        (None, None) => wrong("Say how large the error may be, how long a picture may take, or both."),
        (Some(error), _) if !(error > 0.0 && error <= 1.0) => wrong(
            "The largest error must lie above 0 and at most at 1, as colours and opacities do: 0.004 is one code of 8 bits.",
        ),
        (_, Some(budget)) if budget.is_nan() || budget <= 0.0 => {
            wrong("The budget must be some milliseconds, more than 0.")
        }
        _ => Ok(()),
    }
}

fn no_times() -> MeasureError {
    MeasureError::Plan(
        "This device does not tell how long its work takes, so a budget cannot be kept: give an error only.".into(),
    )
}

/// Milliseconds a picture takes.
fn time(search: &mut Search<'_>, found: &Found) -> Result<f64, MeasureError> {
    let setting = search.knobs.setting(&found.candidate);
    let time = search.judge.times(&[&setting], search.goal.picture, 1)?.remove(0);
    time.map(|time| time.median).ok_or_else(no_times)
}

fn finish(mut search: Search<'_>, found: Found, verdict: Verdict) -> Result<Tuned, MeasureError> {
    let Found { candidate, seen, unseen, .. } = found;
    let (setting, saved) = (search.knobs.setting(&candidate), Setting::saved());
    let views = seen.len() + unseen.len();
    let saved_errors = search.judge.errors(&saved, 0..views, f64::INFINITY, Share::Promised)?;
    let times = match saved_errors.is_some() {
        true => search.judge.times(&[&setting, &saved], search.goal.picture, 1)?,
        false => search.judge.times(&[&setting], search.goal.picture, 1)?,
    };
    let goal = search.goal.clone();
    let name = match (verdict, goal.max_error, goal.budget_ms) {
        (Verdict::Met, Some(error), _) => format!("Error at most {}", number(error)),
        (Verdict::InTime, _, Some(budget)) => format!("At most {}", milliseconds(budget)),
        (Verdict::TooSlow, ..) => "Fastest".into(),
        _ => "Most accurate".into(),
    };
    let values = setting.assignments.iter().map(|one| (one.property.clone(), one.value.clone())).collect();
    Ok(Tuned {
        verdict,
        preset: Preset { name, values },
        time_ms: times[0],
        saved_error: saved_errors.map(|errors| largest(&errors)),
        saved_time_ms: times.get(1).copied().flatten(),
        reference: (search.judge.standard, search.judge.refusal.as_ref().map(ToString::to_string)),
        secured: candidate.secured,
        tried: search.tried,
        setting,
        seen,
        unseen,
        goal,
    })
}

fn largest(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

impl Tuned {
    /// The largest error over all views.
    pub fn worst(&self) -> f64 {
        largest(&self.seen).max(largest(&self.unseen))
    }

    /// What was found, some sentences.
    pub fn message(&self) -> String {
        let name = format!("\u{201c}{}\u{201d}", self.setting.name);
        let error = self.goal.max_error.map(number).unwrap_or_default();
        let missed = match self.goal.max_error {
            Some(_) => format!(" It does not keep the error within {error}."),
            None => String::new(),
        };
        let budget = self.goal.budget_ms.map(milliseconds).unwrap_or_default();
        let mut sentences = match self.verdict {
            Verdict::Met => format!("{name} is the cheapest setting that keeps the error within {error}."),
            Verdict::Missed => {
                format!(
                    "No setting keeps the error within {error} on every view. {name} is the most accurate that was found."
                )
            }
            Verdict::InTime => {
                format!("{name} is the most accurate setting that takes at most {budget} a picture.{missed}")
            }
            Verdict::TooSlow => format!("No setting takes at most {budget} a picture. {name} is the fastest.{missed}"),
        };
        let share = |error: f64| match self.goal.max_error.map(|allowed| error / allowed) {
            None => String::new(),
            Some(share) if share < 0.01 => ", less than 1 % of what is allowed".into(),
            Some(share) if share > 1.0 => format!(", {} times what is allowed", number(share)),
            Some(share) => format!(", {:.0} % of what is allowed", 100.0 * share),
        };
        let unseen = largest(&self.unseen);
        sentences += &format!(
            " Its error is {} at worst on the {} views that it was chosen by, and {} on {} others{}.",
            number(largest(&self.seen)),
            self.seen.len(),
            number(unseen),
            self.unseen.len(),
            share(unseen)
        );
        if self.secured && self.verdict == Verdict::Met {
            sentences += " It has twice the samples that kept the error within the target on these views: rays that miss a \
                          thin part of a surface are few, and quite wrong.";
        }
        sentences += &self.costs();
        if let (standard, Some(why)) = &self.reference {
            sentences += &format!(" Compared with the {} picture: {why}", standard.id());
        }
        sentences
    }

    fn costs(&self) -> String {
        let [width, height] = self.goal.picture;
        let time = |time: Option<Summary>| time.map(|time| milliseconds(time.median));
        let Some(own) = time(self.time_ms) else { return String::new() };
        let saved = match (time(self.saved_time_ms), self.saved_error) {
            (Some(time), Some(error)) => format!("; as saved {time}, with an error of {}", number(error)),
            _ => String::new(),
        };
        format!(" A picture of {width} x {height} pixels takes {own}{saved}.")
    }
}
