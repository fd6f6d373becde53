//! The results.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value as Json;

use crate::run::budget::Budget;
use crate::run::pareto::{self, Point};
use crate::{Figures, Setting};

/// A setting and what it was found to cost and to give.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measured {
    /// The setting.
    pub setting: Setting,
    /// Costs and errors over all views.
    #[serde(flatten)]
    pub all: Figures,
    /// The same view by view.
    pub views: Vec<Figures>,
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
    /// Index of the setting to choose.
    pub chosen: Option<usize>,
    /// Why, and what it means for the network as saved.
    pub advice: String,
    /// The references, view by view; those of the network as saved, if every setting has its own.
    #[serde(skip)]
    pub pictures: Vec<Vec<[f64; 4]>>,
}

impl Measurements {
    /// Time and error of every setting; the time is not finite where it is not known.
    pub fn by_time(&self) -> Vec<Point> {
        let cost = |one: &Measured| one.all.time_ms.map_or(f64::INFINITY, |time| time.median);
        self.settings.iter().map(|one| Point { cost: cost(one), error: one.all.errors.rmse }).collect()
    }

    /// Samples and error of every setting.
    pub fn by_samples(&self) -> Vec<Point> {
        self.settings
            .iter()
            .map(|one| Point { cost: one.all.counts.samples as f64, error: one.all.errors.rmse })
            .collect()
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

    /// Whether any setting shows a surface that could be compared.
    pub(crate) fn has_surface(&self) -> bool {
        self.settings.iter().any(|one| one.all.surface.is_some())
    }

    /// Whether no other setting beats this one in time, or in samples.
    pub(crate) fn is_on_front(&self, index: usize) -> bool {
        self.front_time.contains(&index) || self.front_samples.contains(&index)
    }

    /// The network as saved, if it can be rendered.
    pub(crate) fn saved(&self) -> Option<usize> {
        self.settings.iter().position(|one| one.setting.assignments.is_empty())
    }
}
