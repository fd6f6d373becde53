//! What a measurement says a user should choose.

use rayloom_reference::metrics::VISIBLE_ERROR;

use crate::budget::GRADIENT;
use crate::report::text::{milliseconds, number, percent};
use crate::{Measured, Measurements, pareto::Point};

/// A sentence or a few: the cheapest setting whose error cannot be seen, and what that means for the network as saved.
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
            percent(front.settings[front.most_accurate()].errors.visible),
            front.costs(front.most_accurate())
        ),
    }];
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

    /// The cheapest whose errors are not seen.
    fn unseen(&self) -> Option<usize> {
        self.order.iter().copied().find(|&index| self.settings[index].errors.p99 <= VISIBLE_ERROR)
    }

    fn most_accurate(&self) -> usize {
        self.order[self.order.len() - 1]
    }

    /// ", at 1.2 ms a picture".
    fn costs(&self, index: usize) -> String {
        match (self.timed, self.settings[index].time_ms) {
            (true, Some(time)) => format!(", at {} a picture", milliseconds(time.median)),
            _ => format!(", with {} samples", number(self.settings[index].counts.samples as f64)),
        }
    }
}

/// How the network as saved does.
fn saved(measurements: &Measurements, front: &Front<'_>) -> Option<String> {
    let index = measurements.saved()?;
    if front.unseen() == Some(index) {
        return Some("That is how the network is saved.".into());
    }
    let seen =
        if front.settings[index].errors.p99 <= VISIBLE_ERROR { "errors that are not seen" } else { "visible errors" };
    let found = format!("As saved it has {seen} ({} RMS)", number(front.settings[index].errors.rmse));
    let by = front
        .order
        .iter()
        .rev()
        .copied()
        .find(|&other| front.points[other].dominates(&front.points[index]) && other != index);
    Some(match by {
        Some(by) => format!(
            "{found}{}, and {} is at once cheaper and no less accurate.",
            front.costs(index),
            quoted(&front.settings[by])
        ),
        None => format!("{found}{}; no setting is better in both.", front.costs(index)),
    })
}

/// What most of the error of the network as saved comes from. How gradients are estimated is a choice, not an error.
fn cause(measurements: &Measurements) -> Option<String> {
    let rows = measurements.budget.as_ref()?.rows.iter().filter(|row| row.cause != GRADIENT);
    let sized = rows.filter_map(|row| Some((row.cause, row.change?.rmse)));
    let (cause, rmse) = sized.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (rmse > 0.0).then(|| format!("Most of its error comes from the {cause}."))
}

fn quoted(measured: &Measured) -> String {
    format!("\u{201c}{}\u{201d}", measured.setting.name)
}
