//! The results.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value as Json;

use crate::budget::Budget;
use crate::pareto::{self, Point};
use crate::{Errors, Setting};

/// Median and spread of some timings, milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Summary {
    /// Middle value.
    pub median: f64,
    /// 5 % lie below.
    pub low: f64,
    /// 5 % lie above.
    pub high: f64,
}

impl Summary {
    /// Of some timings; `None` for none.
    pub fn of(timings: &[f64]) -> Option<Self> {
        let mut sorted = timings.to_vec();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len().checked_sub(1)?;
        let at = |share: f64| sorted[(last as f64 * share).round() as usize];
        Some(Self { median: at(0.5), low: at(0.05), high: at(0.95) })
    }
}

/// What a ray traversal counted, over all views.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rays that met the volume.
    pub rays: u64,
    /// Samples that were taken.
    pub samples: u64,
    /// Samples that changed the picture.
    pub contributing: u64,
}

/// A setting and what it was found to cost and to give.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measured {
    /// The setting.
    pub setting: Setting,
    /// Time on the device for entry points and rays of one picture, over all views and rounds; `None` where it cannot be told.
    pub time_ms: Option<Summary>,
    /// Samples of all views.
    pub counts: Counts,
    /// Errors over all views.
    pub errors: Errors,
    /// Whether the setting stands for another picture than the network as saved (another interpolation, another gradient), so
    /// that its errors are a departure and not a price. Only the exact reference can tell.
    pub departs: bool,
    /// What the processors had to say.
    pub notes: Vec<String>,
    /// Error of every pixel of the first view, row by row.
    #[serde(skip)]
    pub map: Vec<f32>,
}

/// A setting that cannot be rendered.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Refused {
    /// The setting.
    pub setting: Setting,
    /// Why.
    pub reason: String,
}

/// All that was measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measurements {
    /// Name of the network.
    pub network: String,
    /// Where the network comes from.
    pub origin: String,
    /// The image that was measured, `PROCESSOR.PORT`.
    pub image: String,
    /// The graphics adapter.
    pub adapter: String,
    /// Version of the program.
    pub rayloom: String,
    /// Width and height of the pictures in pixels.
    pub size: [u32; 2],
    /// The cameras.
    pub views: Vec<Json>,
    /// Timings of every setting and view.
    pub rounds: usize,
    /// Id of what the pictures were compared with.
    pub reference: &'static str,
    /// What that stands for, a sentence or more.
    pub reference_note: String,
    /// The settings, the network as saved first.
    pub settings: Vec<Measured>,
    /// Indices of the settings that no other beats in time and error, by rising time.
    pub front_time: Vec<usize>,
    /// The same for samples and error.
    pub front_samples: Vec<usize>,
    /// For every setting off the front of time the one to take instead.
    pub dominated: BTreeMap<usize, usize>,
    /// What could not be rendered.
    pub refused: Vec<Refused>,
    /// The error of the network as saved, by causes.
    pub budget: Option<Budget>,
    /// What to choose.
    pub advice: String,
    /// The reference of the first view.
    #[serde(skip)]
    pub picture: Vec<[f64; 4]>,
}

impl Measurements {
    /// Time and error of every setting; the time is not finite where it is not known.
    pub fn by_time(&self) -> Vec<Point> {
        let cost = |one: &Measured| one.time_ms.map_or(f64::INFINITY, |time| time.median);
        self.settings.iter().map(|one| Point { cost: cost(one), error: one.errors.rmse }).collect()
    }

    /// Samples and error of every setting.
    pub fn by_samples(&self) -> Vec<Point> {
        self.settings.iter().map(|one| Point { cost: one.counts.samples as f64, error: one.errors.rmse }).collect()
    }

    /// Fills in the fronts and what is dominated. Settings that depart from what the network stands for take no part.
    pub(crate) fn compare(&mut self) {
        let taking_part = |mut points: Vec<Point>| {
            let departing = points.iter_mut().zip(&self.settings).filter(|(_, one)| one.departs);
            departing.for_each(|(point, _)| point.cost = f64::NAN);
            points
        };
        let (time, samples) = (taking_part(self.by_time()), taking_part(self.by_samples()));
        let dominator = |i| pareto::dominator(&time, i).map(|by| (i, by));
        let dominated = (0..time.len()).filter_map(dominator).collect();
        (self.front_time, self.front_samples, self.dominated) =
            (pareto::front(&time), pareto::front(&samples), dominated);
    }

    /// The network as saved, if it can be rendered.
    pub(crate) fn saved(&self) -> Option<usize> {
        self.settings.iter().position(|one| one.setting.assignments.is_empty())
    }
}
