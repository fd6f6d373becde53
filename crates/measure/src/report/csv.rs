//! The measurements as tables for other programs.

use std::collections::BTreeSet;

use crate::run::setting::plain;
use crate::{Assignment, Figures, Measurements, Setting, SurfaceErrors};

/// A column: its name, and the number, if there is one.
type Column<T> = (&'static str, fn(&T) -> Option<f64>);

/// What is known of every setting.
const FIGURES: [Column<Figures>; 16] = [
    ("time_ms", |of| of.time_ms.map(|time| time.median)),
    ("time_low_ms", |of| of.time_ms.map(|time| time.low)),
    ("time_high_ms", |of| of.time_ms.map(|time| time.high)),
    ("rays", |of| Some(of.counts.rays as f64)),
    ("samples", |of| Some(of.counts.samples as f64)),
    ("contributing", |of| Some(of.counts.contributing as f64)),
    ("error_max", |of| Some(of.errors.max)),
    ("error_mean", |of| Some(of.errors.mean)),
    ("error_rmse", |of| Some(of.errors.rmse)),
    ("error_p99", |of| Some(of.errors.p99)),
    ("error_visible_share", |of| Some(of.errors.visible)),
    ("transmittance_max", |of| Some(of.errors.transmittance)),
    ("psnr_db", |of| Some(of.displayed.psnr)),
    ("ssim", |of| Some(of.displayed.ssim)),
    ("ciede2000_mean", |of| Some(of.displayed.ciede2000)),
    ("flip_mean", |of| Some(of.displayed.flip)),
];

/// What is known of those that show a surface.
const SURFACE: [Column<SurfaceErrors>; 9] = [
    ("distance_rmse_voxels", |of| Some(of.distance.rmse)),
    ("distance_p99_voxels", |of| Some(of.distance.p99)),
    ("distance_max_voxels", |of| Some(of.distance.max)),
    ("normal_rmse_degrees", |of| of.normal.map(|normal| normal.rmse)),
    ("normal_p99_degrees", |of| of.normal.map(|normal| normal.p99)),
    ("normal_max_degrees", |of| of.normal.map(|normal| normal.max)),
    ("surface_pixels", |of| Some(of.common as f64)),
    ("silhouette_missing_pixels", |of| Some(of.missing as f64)),
    ("silhouette_extra_pixels", |of| Some(of.extra as f64)),
];

/// What is said of every setting behind its numbers.
const REMARKS: [&str; 6] = ["on_front_time", "on_front_samples", "dominated_by", "departs", "notes", "refused"];

/// A row a setting, refused ones last; empty fields where a setting does not say or a time is not known.
pub(crate) fn settings(measurements: &Measurements) -> String {
    let table = Table::of(measurements);
    let mut text = table.header([], REMARKS);
    for (index, measured) in measurements.settings.iter().enumerate() {
        let by = measurements.dominated.get(&index).map(|&by| measurements.settings[by].setting.name.clone());
        let remarks = [
            measurements.front_time.contains(&index).to_string(),
            measurements.front_samples.contains(&index).to_string(),
            by.unwrap_or_default(),
            measured.departs.to_string(),
            measured.notes.join(" "),
            String::new(),
        ];
        text += &line(table.named(&measured.setting).chain(table.numbers(&measured.all)).chain(remarks));
    }
    for one in &measurements.refused {
        let empty = std::iter::repeat_n(String::new(), table.width() + REMARKS.len() - 1);
        text += &line(table.named(&one.setting).chain(empty).chain([one.reason.clone()]));
    }
    text
}

/// A row a setting and view, views counted from 1.
pub(crate) fn views(measurements: &Measurements) -> String {
    let table = Table::of(measurements);
    let mut text = table.header(["view"], []);
    for measured in &measurements.settings {
        for (index, figures) in measured.views.iter().enumerate() {
            let view = [(index + 1).to_string()];
            text += &line(table.named(&measured.setting).chain(view).chain(table.numbers(figures)));
        }
    }
    text
}

/// The columns that apply.
struct Table {
    /// The properties that some setting sets.
    varied: BTreeSet<String>,
    surface: &'static [Column<SurfaceErrors>],
}

impl Table {
    fn of(measurements: &Measurements) -> Self {
        let refused = measurements.refused.iter().map(|one| &one.setting);
        let settings = measurements.settings.iter().map(|one| &one.setting).chain(refused);
        let property = |one: &Assignment| one.property.to_string();
        Self {
            varied: settings.flat_map(|setting| setting.assignments.iter().map(property)).collect(),
            surface: if measurements.has_surface() { &SURFACE } else { &[] },
        }
    }

    fn header<const A: usize, const B: usize>(&self, before: [&str; A], behind: [&str; B]) -> String {
        let varied = self.varied.iter().map(String::as_str);
        let numbers = FIGURES.iter().map(|column| column.0).chain(self.surface.iter().map(|column| column.0));
        line(["setting"].into_iter().chain(varied).chain(before).chain(numbers).chain(behind).map(str::to_owned))
    }

    fn width(&self) -> usize {
        FIGURES.len() + self.surface.len()
    }

    fn named(&self, setting: &Setting) -> impl Iterator<Item = String> {
        let value = |property: &String| {
            let found = setting.assignments.iter().find(|one| one.property.to_string() == *property);
            found.map(|Assignment { value, .. }| plain(value)).unwrap_or_default()
        };
        [setting.name.clone()].into_iter().chain(self.varied.iter().map(value).collect::<Vec<_>>())
    }

    fn numbers(&self, figures: &Figures) -> impl Iterator<Item = String> {
        let text = |number: Option<f64>| number.map(|number| number.to_string()).unwrap_or_default();
        let surface = |column: &Column<SurfaceErrors>| figures.surface.as_ref().and_then(column.1);
        let numbers = FIGURES.iter().map(|column| (column.1)(figures)).chain(self.surface.iter().map(surface));
        numbers.map(text).collect::<Vec<_>>().into_iter()
    }
}

/// Fields as RFC 4180 has them.
fn line(fields: impl Iterator<Item = String>) -> String {
    let quoted = |field: String| match field.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field,
    };
    fields.map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_that_need_it_are_quoted() {
        let fields = ["a", "b,c", "say \"d\"", ""].map(str::to_owned);
        assert_eq!(line(fields.into_iter()), "a,\"b,c\",\"say \"\"d\"\"\",\n");
    }
}
