//! `rayloom info`: what is in a volume file.

use std::path::Path;

use glam::DVec3;
use rayloom_volume::{Volume, format_of, histogram, read};

use crate::failure::Failure;
use crate::progress::Line;

/// Bars of the histogram.
const BINS: usize = 16;
/// Length of the longest bar, characters.
const BAR: usize = 40;

/// Reads a volume and describes it.
///
/// # Errors
/// The file cannot be read as a volume.
pub fn run(file: &Path) -> Result<String, Failure> {
    let line = Line::new("reading");
    let name = file.display().to_string();
    let volume = read(file, &mut |progress| line.reading(&name, progress))?;
    drop(line);
    let format = format_of(file).map_or("", |format| format.label);
    let mut text = format!("{name}\n");
    let facts = facts(&volume).into_iter();
    for (label, value) in std::iter::once(("format", format.to_owned())).chain(facts) {
        text += &format!("  {label:<12}{value}\n");
    }
    for channel in 0..volume.channels {
        text += &channel_text(&volume, channel);
    }
    Ok(text)
}

fn facts(volume: &Volume) -> Vec<(&'static str, String)> {
    let [nx, ny, nz] = volume.dims;
    let elements = volume.voxel_count() * volume.channels as usize;
    let bytes = elements * volume.voxels.element_type().size();
    let spacing = volume.spacing();
    let extent = spacing * volume.dims_f64();
    let center = volume.texture_to_world().transform_point3(DVec3::splat(0.5));
    // What is left of a centre at the origin is rounding.
    let center = DVec3::select(center.abs().cmplt(DVec3::splat(1e-12 * extent.length())), DVec3::ZERO, center);
    let axes = volume.index_to_world.matrix3;
    let axes = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| vector(axis.normalize_or_zero().into()));
    let mut facts = vec![
        (
            "size",
            format!("{nx} x {ny} x {nz} voxels, {} channel(s) of {}", volume.channels, volume.voxels.element_type()),
        ),
        ("memory", format!("{:.1} MiB", bytes as f64 / (1 << 20) as f64)),
        ("spacing", vector(spacing.into())),
        ("extent", vector(extent.into())),
        ("centre", vector(center.into())),
        ("axes", axes.map(|axis| format!("({axis})")).join(" ")),
    ];
    if (volume.slope, volume.intercept) != (1.0, 0.0) {
        facts.push(("rescale", format!("value = stored * {} + {}", volume.slope, volume.intercept)));
    }
    if volume.non_finite() > 0 {
        facts.push(("not finite", format!("{} values are NaN or infinite", volume.non_finite())));
    }
    facts
}

/// The range of a channel and how its values are spread.
fn channel_text(volume: &Volume, channel: u32) -> String {
    let range = volume.ranges()[channel as usize];
    let mut text = format!("  channel {channel}   {} .. {}\n", number(range.min), number(range.max));
    if range.width() <= 0.0 {
        return text;
    }
    let histogram = histogram(volume, channel, BINS);
    let total = histogram.counts.iter().sum::<u64>().max(1);
    // Air outnumbers everything: bars are logarithmic in the number of voxels.
    let longest = histogram.counts.iter().copied().max().unwrap_or(0).max(1);
    for (bin, &count) in histogram.counts.iter().enumerate() {
        let start = histogram.range.denormalise(bin as f64 / BINS as f64);
        let bar = (BAR as f64 * ((1 + count) as f64).ln() / ((1 + longest) as f64).ln()).round() as usize;
        let share = 100.0 * count as f64 / total as f64;
        text += &format!("  {:>12} {:<BAR$} {share:6.2} %\n", number(start), "#".repeat(bar));
    }
    text + "  (bars grow with the logarithm of the number of voxels)\n"
}

fn vector(components: [f64; 3]) -> String {
    components.map(number).join(", ")
}

/// At most six significant digits, without trailing zeros.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = 5 - value.abs().log10().floor() as i32;
    if (-4..=12).contains(&digits) {
        let text = format!("{value:.*}", digits.max(0) as usize);
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        return if text == "-0" { "0".to_owned() } else { text.to_owned() };
    }
    format!("{value:e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1.0, -0.5, 255.0, 1234567.0, 0.1 + 0.2, 1e-30, -3.0e38];
        assert_eq!(numbers.map(number), ["0", "1", "-0.5", "255", "1234567", "0.3", "1e-30", "-3e38"]);
    }
}
