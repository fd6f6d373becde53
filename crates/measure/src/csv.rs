//! The measurements as a table for other programs.

use std::collections::BTreeSet;

use crate::setting::plain;
use crate::{Assignment, Measured, Measurements, Setting};

/// The columns behind those of the varied properties.
const COLUMNS: [&str; 18] = [
    "time_ms",
    "time_low_ms",
    "time_high_ms",
    "rays",
    "samples",
    "contributing",
    "error_max",
    "error_mean",
    "error_rmse",
    "error_p99",
    "error_visible_share",
    "transmittance_max",
    "on_front_time",
    "on_front_samples",
    "dominated_by",
    "departs",
    "notes",
    "refused",
];

/// A row a setting, refused ones last; empty fields where a setting does not say or a time is not known.
pub(crate) fn csv(measurements: &Measurements) -> String {
    let refused = measurements.refused.iter().map(|one| &one.setting);
    let settings = || measurements.settings.iter().map(|one| &one.setting).chain(refused.clone());
    let varied: BTreeSet<String> =
        settings().flat_map(|setting| setting.assignments.iter().map(|one| one.property.to_string())).collect();
    let header = ["setting".to_owned()].into_iter().chain(varied.iter().cloned());
    let mut text = line(header.chain(COLUMNS.map(str::to_owned)));
    for (index, measured) in measurements.settings.iter().enumerate() {
        text += &line(named(&measured.setting, &varied).chain(fields(measurements, index, measured)));
    }
    for one in &measurements.refused {
        let empty = std::iter::repeat_n(String::new(), COLUMNS.len() - 1);
        text += &line(named(&one.setting, &varied).chain(empty).chain([one.reason.clone()]));
    }
    text
}

fn named(setting: &Setting, varied: &BTreeSet<String>) -> impl Iterator<Item = String> {
    let value = |property: &String| {
        let found = setting.assignments.iter().find(|one| one.property.to_string() == *property);
        found.map(|Assignment { value, .. }| plain(value)).unwrap_or_default()
    };
    let values: Vec<String> = varied.iter().map(value).collect();
    [setting.name.clone()].into_iter().chain(values)
}

fn fields(measurements: &Measurements, index: usize, measured: &Measured) -> [String; COLUMNS.len()] {
    let Measured { counts, errors, .. } = measured;
    let time = |of: fn(&crate::Summary) -> f64| measured.time_ms.as_ref().map(|time| of(time).to_string());
    let by = measurements.dominated.get(&index).map(|&by| measurements.settings[by].setting.name.clone());
    [
        time(|time| time.median).unwrap_or_default(),
        time(|time| time.low).unwrap_or_default(),
        time(|time| time.high).unwrap_or_default(),
        counts.rays.to_string(),
        counts.samples.to_string(),
        counts.contributing.to_string(),
        errors.max.to_string(),
        errors.mean.to_string(),
        errors.rmse.to_string(),
        errors.p99.to_string(),
        errors.visible.to_string(),
        errors.transmittance.to_string(),
        measurements.front_time.contains(&index).to_string(),
        measurements.front_samples.contains(&index).to_string(),
        by.unwrap_or_default(),
        measured.departs.to_string(),
        measured.notes.join(" "),
        String::new(),
    ]
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
