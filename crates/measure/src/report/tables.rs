//! The tables and lists of the page.

use std::fmt::Write;

use serde_json::Value as Json;

use crate::run::budget::GRADIENT;
use crate::text::{escaped, milliseconds, number, percent};
use crate::{Budget, Figures, Measured, Measurements};

/// The settings by rising error.
pub(super) fn by_error(measurements: &Measurements) -> Vec<usize> {
    let mut order: Vec<usize> = (0..measurements.settings.len()).collect();
    let rmse = |i: usize| measurements.settings[i].all.errors.rmse;
    order.sort_by(|&a, &b| rmse(a).total_cmp(&rmse(b)).then(a.cmp(&b)));
    order
}

/// Every setting, by rising error.
pub(super) fn settings(measurements: &Measurements) -> String {
    let rows: String = by_error(measurements).into_iter().map(|i| row(measurements, i)).collect();
    format!(
        "<section><h2>All settings, the most accurate first</h2><div class=\"scroll\"><table><thead><tr><th>Setting</th>\
         <th>Time<br>median</th><th>5 to 95 %<br>ms</th><th>Samples</th><th>of them<br>contributing</th><th>Error<br>RMS</th>\
         <th>99 %<br>of pixels</th><th>largest</th><th>Visibly<br>off</th><th>ln T<br>largest</th></tr></thead>\
         <tbody>{rows}</tbody></table></div><p class=\"quiet\">Errors of premultiplied colours and opacities from 0 to 1, over all \
         views; of each pixel the largest of its four channels. Visibly off: by more than 1/510, half a code of an 8-bit picture. \
         ln T: logarithm of the transmittance, which tells errors in deep and dark parts. Tinted: on the front of time and \
         error. \u{2260}: stands for another picture than the network as saved, so its error is a departure.</p></section>"
    )
}

fn row(measurements: &Measurements, index: usize) -> String {
    let Measured { setting, all, notes, departs, .. } = &measurements.settings[index];
    let Figures { time_ms, counts, errors, .. } = all;
    let class = if measurements.front_time.contains(&index) { " class=\"front\"" } else { "" };
    let departs = if *departs { " <small>\u{2260}</small>" } else { "" };
    let (time, spread) = match time_ms {
        Some(time) => (milliseconds(time.median), format!("{} \u{2013} {}", number(time.low), number(time.high))),
        None => ("\u{2013}".into(), "\u{2013}".into()),
    };
    let chosen = if measurements.chosen == Some(index) { " <span class=\"choice\">choose</span>" } else { "" };
    let contributing = counts.contributing as f64 / counts.samples.max(1) as f64;
    format!(
        "<tr{class} title=\"{}\"><td>{}{departs}{chosen}</td><td>{time}</td><td><small>{spread}</small></td><td>{}</td><td>{}</td><td>{}</td>\
         <td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
        escaped(&notes.join(" ")),
        escaped(&setting.name),
        number(counts.samples as f64),
        percent(contributing),
        number(errors.rmse),
        number(errors.p99),
        number(errors.max),
        percent(errors.visible),
        number(errors.transmittance)
    )
}

/// What not to choose, and what to take instead.
pub(super) fn dominated(measurements: &Measurements) -> String {
    if measurements.dominated.is_empty() {
        return String::new();
    }
    let numbers = |one: &Measured| {
        let time = one.all.time_ms.map_or_else(|| "\u{2013}".into(), |time| milliseconds(time.median));
        format!("<td>{time}</td><td>{}</td>", number(one.all.errors.rmse))
    };
    let time = |index: usize| measurements.settings[index].all.time_ms;
    let overlap = |(worse, better): (usize, usize)| match (time(worse), time(better)) {
        (Some(worse), Some(better)) => better.high >= worse.low,
        _ => true,
    };
    let mut pairs: Vec<(usize, usize)> =
        measurements.dominated.iter().map(|(&worse, &better)| (worse, better)).collect();
    // The clear cases first.
    pairs.sort_by_key(|pair| overlap(*pair));
    let line = |pair: (usize, usize)| {
        let (worse, better) = (&measurements.settings[pair.0], &measurements.settings[pair.1]);
        let clear = if overlap(pair) { "times overlap" } else { "" };
        format!(
            "<tr><td>{}</td>{}<td class=\"text\">{}</td>{}<td class=\"text\"><small>{clear}</small></td></tr>",
            escaped(&worse.setting.name),
            numbers(worse),
            escaped(&better.setting.name),
            numbers(better)
        )
    };
    let lines: String = pairs.into_iter().map(line).collect();
    format!(
        "<section><h2>Settings not worth choosing here</h2><p class=\"quiet\">For each there is one that is no slower and no less \
         accurate. Where times overlap it is a matter of accuracy alone.</p><div class=\"scroll\"><table><thead><tr><th>Instead \
         of</th><th>Time</th><th>Error RMS</th><th class=\"text\">take</th><th>Time</th><th>Error \
         RMS</th><th></th></tr></thead><tbody>{lines}</tbody></table></div></section>"
    )
}

/// What could not be rendered.
pub(super) fn refused(measurements: &Measurements) -> String {
    if measurements.refused.is_empty() {
        return String::new();
    }
    let lines: String = measurements
        .refused
        .iter()
        .map(|one| {
            format!(
                "<li><b>{}</b>: <span class=\"reason\">{}</span></li>",
                escaped(&one.setting.name),
                escaped(&one.reason)
            )
        })
        .collect();
    format!("<section><h2>Settings that cannot be rendered</h2><ul>{lines}</ul></section>")
}

/// The causes of the error of the network as saved.
pub(super) fn budget(budget: &Budget, measurements: &Measurements) -> String {
    let largest = budget.rows.iter().filter_map(|row| row.change).map(|change| change.rmse).fold(0.0, f64::max);
    let mut rows = String::new();
    for row in &budget.rows {
        let _ = match row.change {
            Some(change) => write!(
                rows,
                "<tr><td>{}</td><td class=\"text\"><small>{}</small></td><td class=\"text\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
                row.cause,
                escaped(&row.switch),
                bar(change.rmse / largest.max(f64::MIN_POSITIVE), row.cause == GRADIENT),
                number(change.rmse),
                number(change.p99),
                number(change.max),
                percent(change.visible),
                row.left.map_or_else(|| "\u{2013}".into(), |left| number(left.rmse))
            ),
            None => write!(
                rows,
                "<tr><td>{}</td><td class=\"text\" colspan=\"7\"><small>{}</small></td></tr>",
                row.cause,
                escaped(&row.switch)
            ),
        };
    }
    if let Some(saved) = measurements.saved() {
        let errors = measurements.settings[saved].all.errors;
        let _ = write!(
            rows,
            "<tr class=\"front\"><td>all together</td><td class=\"text\"><small>as saved, against the reference</small></td><td></td>\
             <td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            number(errors.rmse),
            number(errors.p99),
            number(errors.max),
            percent(errors.visible),
            number(errors.rmse)
        );
    }
    let not: String = budget.not_separated.iter().map(|cause| format!("<li>{}</li>", escaped(cause))).collect();
    format!(
        "<section><h2>What the error is made of</h2><div class=\"scroll\"><table><thead><tr><th>Cause</th><th \
         class=\"text\">switched off by</th><th class=\"text\">change of the picture</th><th>RMS</th><th>99 %<br>of \
         pixels</th><th>largest</th><th>Visibly<br>off</th><th>RMS left<br>without it</th></tr></thead><tbody>{rows}</tbody></table></div><p class=\"quiet\">One \
         cause is switched off at a time in the network as saved; the numbers say how far that moves the picture, the last column how far \
         it is from the reference then. Causes may cancel, overlap or take the place of another, as the noise of jitter does of \
         rings, so they do not add up to the whole. Gradients differ in what they estimate: theirs is a departure from \
         fourth-order differences, not an error against the reference. Not separated:</p><ul class=\"quiet\">{not}</ul></section>"
    )
}

/// A bar as long as a share of the longest; nothing for nothing.
fn bar(share: f64, aside: bool) -> String {
    const LONGEST: f64 = 120.0;
    let class = if aside { "bar aside" } else { "bar" };
    match share > 0.0 {
        true => format!("<span class=\"{class}\" style=\"width:{:.0}px\"></span>", LONGEST * share),
        false => String::new(),
    }
}

/// How it was measured, to do it again.
pub(super) fn conditions(measurements: &Measurements) -> String {
    let [width, height] = measurements.size;
    let cameras: String = measurements.views.iter().map(|view| format!("<li>{}</li>", escaped(&short(view)))).collect();
    format!(
        "<section><h2>How it was measured</h2><p>{} of <code>{}</code>, {width} \u{d7} {height} pixels, {} view{}, {} timing{} of \
         each setting and view taken in turns, on {}; rayloom {}. Time is that of entry points and rays on the device, without \
         loading, compiling and reading back. On a software device it is read from the clock on the wall.</p><ul \
         class=\"quiet\">{cameras}</ul></section>",
        escaped(&measurements.image),
        escaped(&measurements.origin),
        measurements.views.len(),
        plural(measurements.views.len()),
        measurements.rounds,
        plural(measurements.rounds),
        escaped(&measurements.adapter),
        escaped(&measurements.rayloom)
    )
}

/// The fields of a camera with three digits behind the point.
fn short(camera: &Json) -> String {
    let number = |number: &Json| number.as_f64().map(|x| format!("{}", (1e3 * x).round() / 1e3)).unwrap_or_default();
    let value = |value: &Json| match value.as_array() {
        Some(numbers) => numbers.iter().map(number).collect::<Vec<_>>().join(", "),
        None => number(value),
    };
    let fields = camera
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, field)| format!("{} {}", name.replace('_', " "), value(field)));
    fields.collect::<Vec<_>>().join("; ")
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
