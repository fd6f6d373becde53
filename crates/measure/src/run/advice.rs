//! What a measurement says a user should choose.

use rayloom_reference::metrics::VISIBLE_ERROR;

use crate::text::{milliseconds, number, percent};
use crate::{Measured, Measurements, pareto::Point};

/// The setting to choose: the cheapest whose error cannot be seen, else the most accurate.
pub(crate) fn choice(measurements: &Measurements) -> Option<usize> {
    let front = Front::of(measurements)?;
    Some(front.unseen().unwrap_or_else(|| front.most_accurate()))
}

/// A sentence or a few: why [`choice`] is to be chosen, and what that means for the network as saved.
pub(crate) fn advice(measurements: &Measurements) -> String {
    let Some(front) = Front::of(measurements) else {
        return "No setting was measured.".into();
    };
    let mut sentences = vec![match front.unseen() {
        Some(index) => format!(
            "Choose {}: it is the cheapest setting whose error stays below half a code of an 8-bit picture (1/510) in 99 % \
             of the pixels{}.",
            quoted(&front.settings[index]),
            front.costs(index)
        ),
        None => format!(
            "No setting keeps the error of 99 % of the pixels below half a code of an 8-bit picture. The most accurate is {} \
             ({} of the pixels are visibly off){}.",
            quoted(&front.settings[front.most_accurate()]),
            percent(front.settings[front.most_accurate()].all.errors.visible),
            front.costs(front.most_accurate())
        ),
    }];
    sentences.extend(choice(measurements).and_then(|index| surface(&front.settings[index])));
    sentences.extend(saved(measurements, &front));
    sentences.extend(cause(measurements));
    sentences.join(" ")
}

/// What there is to choose from, by time where it is known, by samples elsewhere.
struct Front<'a> {
    settings: &'a [Measured],
    order: &'a [usize],
    points: Vec<Point>,
    timed: bool,
}

impl<'a> Front<'a> {
    fn of(measurements: &'a Measurements) -> Option<Self> {
        let timed = !measurements.front_time.is_empty();
        let (order, points) = match timed {
            true => (&measurements.front_time, measurements.by_time()),
            false => (&measurements.front_samples, measurements.by_samples()),
        };
        (!order.is_empty()).then_some(Self { settings: &measurements.settings, order, points, timed })
    }

    /// The cheapest whose errors are not seen; the network as saved rather than one whose times overlap with its.
    fn unseen(&self) -> Option<usize> {
        let unseen = |index: &usize| self.settings[*index].all.errors.p99 <= VISIBLE_ERROR;
        let cheapest = self.order.iter().copied().find(unseen)?;
        let saved = self.settings.iter().position(|one| one.setting.assignments.is_empty());
        Some(saved.filter(unseen).filter(|&saved| !self.clearly_cheaper(cheapest, saved)).unwrap_or(cheapest))
    }

    /// Whether one setting costs less than another beyond the noise of timings.
    fn clearly_cheaper(&self, one: usize, other: usize) -> bool {
        match (self.timed, self.settings[one].all.time_ms, self.settings[other].all.time_ms) {
            (true, Some(one), Some(other)) => one.high < other.low,
            _ => self.points[one].cost < self.points[other].cost,
        }
    }

    /// Whether one setting beats another in a way that measuring again would confirm.
    fn clearly_beats(&self, one: usize, other: usize) -> bool {
        /// Errors within this of each other count as the same.
        const SAME: f64 = 0.95;
        let more_accurate = self.points[one].error < SAME * self.points[other].error;
        self.points[one].dominates(&self.points[other]) && (more_accurate || self.clearly_cheaper(one, other))
    }

    fn most_accurate(&self) -> usize {
        self.order[self.order.len() - 1]
    }

    /// ", at 1.2 ms a picture".
    fn costs(&self, index: usize) -> String {
        match (self.timed, self.settings[index].all.time_ms) {
            (true, Some(time)) => format!(", at {} a picture", milliseconds(time.median)),
            _ => format!(", with {} samples", number(self.settings[index].all.counts.samples as f64)),
        }
    }
}

/// How well a setting meets the surface that it shows.
fn surface(measured: &Measured) -> Option<String> {
    let surface = measured.all.surface.as_ref()?;
    let normals =
        surface.normal.map(|normal| format!(", normals by {}\u{b0}", number(normal.rmse))).unwrap_or_default();
    let silhouette = match surface.silhouette() {
        0 => "no silhouette pixel is wrong".to_owned(),
        1 => "one silhouette pixel is wrong".to_owned(),
        more => format!("{more} silhouette pixels are wrong"),
    };
    Some(format!(
        "Its surface is off by {} voxels along the rays{normals} (RMS); {silhouette}, {} pixels show it.",
        number(surface.distance.rmse),
        number(surface.common as f64)
    ))
}

/// How the network as saved does.
fn saved(measurements: &Measurements, front: &Front<'_>) -> Option<String> {
    let index = measurements.saved()?;
    if choice(measurements) == Some(index) {
        return Some("The network is saved that way.".into());
    }
    let seen = if front.settings[index].all.errors.p99 <= VISIBLE_ERROR {
        "errors that are not seen"
    } else {
        "visible errors"
    };
    let found = format!("As saved it has {seen} ({} RMS)", number(front.settings[index].all.errors.rmse));
    let by = front.order.iter().rev().copied().find(|&other| front.clearly_beats(other, index));
    Some(match by {
        Some(by) => format!(
            "{found}{}, and {} is no dearer and no less accurate.",
            front.costs(index),
            quoted(&front.settings[by])
        ),
        None => format!("{found}{}; no setting is clearly better in both.", front.costs(index)),
    })
}

/// What most of the error of the network as saved comes from: the cause without which the least of it is left. How gradients
/// are estimated is a choice, not an error.
fn cause(measurements: &Measurements) -> Option<String> {
    /// A cause that explains less of the error than this is not the one.
    const MOST: f64 = 0.7;
    let whole = measurements.settings[measurements.saved()?].all.errors.rmse;
    let rows = measurements.budget.as_ref()?.rows.iter();
    let (cause, left) = rows.filter_map(|row| Some((row.cause, row.left?.rmse))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    (left < MOST * whole)
        .then(|| format!("Most of its error comes from the {cause}: without it {} would be left.", number(left)))
}

fn quoted(measured: &Measured) -> String {
    format!("\u{201c}{}\u{201d}", measured.setting.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Counts, Displayed, Errors, Figures, Setting, Summary, run::setting::combinations};

    /// A setting with this error and times from `low` to `high`; the first one stands for the network as saved.
    fn measured(index: usize, error: f64, [low, high]: [f64; 2]) -> Measured {
        let setting = match index {
            0 => Setting::saved(),
            _ => combinations(&[format!("a.x={index}").parse().expect("well formed")]).remove(0),
        };
        let errors =
            Errors { max: error, mean: error, rmse: error, p99: error, visible: 0.1, transmittance: error, worst: 0 };
        let time_ms = Some(Summary { median: 0.5 * (low + high), low, high });
        let displayed = Displayed { psnr: 40.0, ssim: 1.0, ciede2000: 0.0, flip: 0.0 };
        let all = Figures { time_ms, counts: Counts::default(), errors, displayed, surface: None };
        Measured { setting, all, views: vec![], departs: false, notes: vec![], map: vec![] }
    }

    fn advice_on(settings: &[(f64, [f64; 2])]) -> String {
        let settings = settings.iter().enumerate().map(|(i, &(error, time))| measured(i, error, time)).collect();
        let mut measurements = Measurements {
            network: String::new(),
            origin: String::new(),
            image: String::new(),
            adapter: String::new(),
            rayloom: String::new(),
            size: [1, 1],
            views: vec![],
            rounds: 1,
            reference: "exact",
            reference_note: String::new(),
            settings,
            front_time: vec![],
            front_samples: vec![],
            dominated: Default::default(),
            refused: vec![],
            budget: None,
            chosen: None,
            advice: String::new(),
            pictures: vec![],
        };
        measurements.compare();
        advice(&measurements)
    }

    #[test]
    fn the_cheapest_unseen_error_is_chosen_and_noise_is_no_reason() {
        assert_eq!(surface(&measured(0, 1e-4, [1.0, 2.0])), None);
        let cheaper = advice_on(&[(1e-4, [10.0, 12.0]), (1e-3, [4.0, 5.0]), (0.1, [1.0, 2.0])]);
        assert!(cheaper.starts_with("Choose \u{201c}x 1\u{201d}") && cheaper.contains("4.50 ms"), "{cheaper}");
        let noise = advice_on(&[(1e-3, [4.0, 6.0]), (1e-3, [3.0, 5.0])]);
        assert!(noise.starts_with("Choose \u{201c}as saved\u{201d}"), "{noise}");
        let visible = advice_on(&[(0.02, [4.0, 6.0]), (0.01, [2.0, 3.0])]);
        assert!(visible.starts_with("No setting keeps the error"), "{visible}");
        assert!(visible.ends_with("\u{201c}x 1\u{201d} is no dearer and no less accurate."), "{visible}");
    }
}
