//! The page of a measurement: one file, nothing from the network.

pub(crate) mod axis;
mod csv;
pub(crate) mod output;
mod picture;
mod plot;
pub(crate) mod style;
mod tables;
mod views;

use std::fmt::Write;

use crate::text::{self, escaped};
use crate::{MeasureError, Measurements};
use plot::Plot;

/// Error maps that a page shows at most.
const MOST_MAPS: usize = 8;

/// The whole page.
///
/// # Errors
/// A picture cannot be coded.
pub(crate) fn page(measurements: &Measurements) -> Result<String, MeasureError> {
    let name = escaped(if measurements.network.is_empty() { &measurements.origin } else { &measurements.network });
    let parts = [
        head(&name, measurements)?,
        plots(measurements),
        measurements.budget.as_ref().map(|budget| tables::budget(budget, measurements)).unwrap_or_default(),
        maps(measurements)?,
        tables::settings(measurements),
        tables::dominated(measurements),
        views::displayed(measurements),
        views::surfaces(measurements),
        views::by_view(measurements)?,
        tables::refused(measurements),
        tables::conditions(measurements),
    ];
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" \
         content=\"width=device-width\"><title>{name}: speed and accuracy</title><style>{}</style></head><body><main>{}</main>\
         </body></html>\n",
        style::STYLE,
        parts.join("\n")
    ))
}

fn head(name: &str, measurements: &Measurements) -> Result<String, MeasureError> {
    let first = measurements.pictures.first().map(Vec::as_slice).unwrap_or_default();
    let picture = picture::picture(measurements.size, first)?;
    Ok(format!(
        "<header><div><p class=\"over\">Speed and accuracy</p><h1>{name}</h1><p class=\"advice\">{}</p><p class=\"quiet\">{}</p>\
         </div><figure><img src=\"{picture}\" alt=\"The reference picture of the first view\"><figcaption>The reference, first \
         view</figcaption></figure></header>",
        escaped(&measurements.advice),
        escaped(&measurements.reference_note)
    ))
}

fn plots(measurements: &Measurements) -> String {
    let by_time = Plot {
        measurements,
        points: measurements.by_time(),
        front: &measurements.front_time,
        cost: "milliseconds a picture",
        spread: true,
    };
    let by_samples = Plot {
        measurements,
        points: measurements.by_samples(),
        front: &measurements.front_samples,
        cost: "samples",
        spread: false,
    };
    let time = match by_time.svg() {
        svg if svg.is_empty() => "<p class=\"quiet\">This device does not tell how long its work takes.</p>".into(),
        svg => svg,
    };
    format!(
        "<section><h2>What accuracy costs</h2><div class=\"pair\"><figure>{time}<figcaption>Error against time. Bars: 5 to \
         95 % of the timings.</figcaption></figure><figure>{}<figcaption>Error against samples, whatever the \
         machine.</figcaption></figure></div><p class=\"legend\"><span><i class=\"dot halo\"></i>choose this</span><span><i class=\"dot best\"></i>on the front: nothing else is both \
         cheaper and more accurate</span><span><i class=\"dot other\"></i>beaten by the front</span><span><i class=\"dot \
         departing\"></i>stands for another picture</span><span><i class=\"dot ring\"></i>as saved</span></p></section>",
        by_samples.svg()
    )
}

/// Where the errors are, along the front.
fn maps(measurements: &Measurements) -> Result<String, MeasureError> {
    let saved = measurements.saved();
    let front = if measurements.front_time.is_empty() { &measurements.front_samples } else { &measurements.front_time };
    let mut shown: Vec<usize> = saved.into_iter().collect();
    shown.extend(front.iter().copied().filter(|i| Some(*i) != saved));
    shown.truncate(MOST_MAPS);
    let mut figures = String::new();
    for i in shown {
        let measured = &measurements.settings[i];
        let _ = write!(
            figures,
            "<figure><img src=\"{}\" alt=\"Error map\"><figcaption>{}<br><span class=\"quiet\">largest error \
             {}</span></figcaption></figure>",
            picture::map(measurements.size, &measured.map)?,
            escaped(&measured.setting.name),
            text::number(measured.map.iter().copied().fold(0.0, f32::max).into())
        );
    }
    Ok(format!(
        "<section><h2>Where the errors are</h2><p class=\"quiet\">First view: as saved, then along the front. Of each pixel the \
         largest error of its four channels.</p><div class=\"scale\"><span>1e-5</span><i style=\"background:{}\"></i><span>1</span>\
         </div><div class=\"maps\">{figures}</div></section>",
        picture::scale()
    ))
}
