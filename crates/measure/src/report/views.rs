//! What the pictures look like, what their surfaces are off by, and how the views differ.

use std::fmt::Write;

use super::picture;
use super::tables::by_error;
use crate::text::{decibels, escaped, milliseconds, number, percent};
use crate::{Displayed, Figures, MeasureError, Measured, Measurements, SurfaceErrors};

/// References of views that a page shows at most.
const MOST_VIEWS: usize = 8;

/// What a viewer has on the screen.
pub(super) fn displayed(measurements: &Measurements) -> String {
    let row = |measured: &Measured| Some(cells(&measured.all.displayed));
    let table = table(measurements, &["PSNR", "SSIM", "CIEDE2000<br>mean", "FLIP<br>mean"], row);
    format!(
        "<section><h2>As a display shows it</h2>{table}<p class=\"quiet\">Pictures over black in sRGB with 8 bits; means over all \
         views. PSNR: peak signal-to-noise ratio; from about 50 dB on errors are a code or less. SSIM: structural similarity, 1 for \
         equal pictures. CIEDE2000: colour difference; 1 can just be told apart side by side. FLIP: what is noticed when the two \
         are flipped back and forth, 0 to 1, on a display 0.7 m away and as wide with 3840 pixels.</p></section>"
    )
}

/// Where rays meet surfaces. Empty if no setting shows one.
pub(super) fn surfaces(measurements: &Measurements) -> String {
    if !measurements.has_surface() {
        return String::new();
    }
    let titles = [
        "Distance, voxels<br>RMS",
        "99 %<br>of pixels",
        "largest",
        "Normal, degrees<br>RMS",
        "99 %<br>of pixels",
        "largest",
        "Silhouette<br>missing",
        "extra",
    ];
    let row = |measured: &Measured| {
        let surface = measured.all.surface.as_ref()?;
        let spread = |spread: Option<crate::Spread>| match spread {
            Some(spread) => [spread.rmse, spread.p99, spread.max].map(number),
            None => [(); 3].map(|()| "\u{2013}".into()),
        };
        let silhouette = [surface.missing, surface.extra].map(|count| number(count as f64));
        Some([&spread(Some(surface.distance))[..], &spread(surface.normal), &silhouette].concat())
    };
    let table = table(measurements, &titles, row);
    let hits = measurements.settings.iter().filter_map(|one| one.all.surface).map(|surface| surface.common).max();
    format!(
        "<section><h2>Where rays meet the surface</h2>{table}<p class=\"quiet\">Of up to {} pixels in which both the picture and \
         its reference show the surface: how far apart the two are along the viewing direction, in mean voxel spacings, and how \
         far their normals (before they are turned to the viewer) are turned against each other. Silhouette: pixels that meet the \
         surface in the reference only, and in the picture only.</p></section>",
        number(hits.unwrap_or(0) as f64)
    )
}

/// Every setting in every view, folded up. Empty for one view.
pub(super) fn by_view(measurements: &Measurements) -> Result<String, MeasureError> {
    if measurements.views.len() < 2 {
        return Ok(String::new());
    }
    let mut figures = String::new();
    for (index, pixels) in measurements.pictures.iter().enumerate().take(MOST_VIEWS) {
        let picture = picture::picture(measurements.size, pixels)?;
        let number = index + 1;
        let _ = write!(
            figures,
            "<figure><img src=\"{picture}\" alt=\"Reference of view {number}\"><figcaption>View {number}</figcaption></figure>"
        );
    }
    let surface = match measurements.has_surface() {
        true => "<th>Distance<br>RMS</th><th>Normal<br>RMS</th><th>Silhouette</th>",
        false => "",
    };
    let rows: String = by_error(measurements).into_iter().map(|i| rows(measurements, i)).collect();
    Ok(format!(
        "<section><h2>View by view</h2><div class=\"maps small\">{figures}</div><details><summary>Every setting in every \
         view</summary><div class=\"scroll\"><table class=\"dense\"><thead><tr><th>Setting</th><th>View</th><th>Time<br>median</th>\
         <th>Samples</th><th>Error<br>RMS</th><th>99 %<br>of pixels</th><th>largest</th><th>Visibly<br>off</th><th>PSNR</th>\
         <th>SSIM</th><th>CIEDE2000</th><th>FLIP</th>{surface}</tr></thead><tbody>{rows}</tbody></table></div></details></section>"
    ))
}

/// The rows of a setting, a view each.
fn rows(measurements: &Measurements, index: usize) -> String {
    let measured = &measurements.settings[index];
    let count = measured.views.len();
    let row = |(view, figures): (usize, &Figures)| {
        let name = match view {
            0 => format!("<td rowspan=\"{count}\">{}</td>", escaped(&measured.setting.name)),
            _ => String::new(),
        };
        let time = figures.time_ms.map_or("\u{2013}".into(), |time| milliseconds(time.median));
        let errors = &figures.errors;
        let numbers = [
            time,
            number(figures.counts.samples as f64),
            number(errors.rmse),
            number(errors.p99),
            number(errors.max),
            percent(errors.visible),
        ];
        let surface = match measurements.has_surface() {
            true => met(figures.surface.as_ref()).to_vec(),
            false => Vec::new(),
        };
        let class = if view == 0 { " class=\"group\"" } else { "" };
        let cells = [&numbers[..], &cells(&figures.displayed), &surface].concat();
        format!("<tr{class}>{name}<td class=\"view\">{}</td>{}</tr>", view + 1, tds(&cells))
    };
    measured.views.iter().enumerate().map(row).collect()
}

fn met(surface: Option<&SurfaceErrors>) -> [String; 3] {
    let none = || "\u{2013}".to_owned();
    [
        surface.map_or_else(none, |surface| number(surface.distance.rmse)),
        surface.and_then(|surface| surface.normal).map_or_else(none, |normal| number(normal.rmse)),
        surface.map_or_else(none, |surface| number(surface.silhouette() as f64)),
    ]
}

fn cells(displayed: &Displayed) -> [String; 4] {
    let Displayed { psnr, ssim, ciede2000, flip } = *displayed;
    [decibels(psnr), format!("{ssim:.5}"), number(ciede2000), number(flip)]
}

/// A row for every setting that has one, by rising error; of many settings those that are not on a front are folded up.
fn table<C: AsRef<[String]>>(
    measurements: &Measurements,
    titles: &[&str],
    row: impl Fn(&Measured) -> Option<C>,
) -> String {
    /// More settings than this are many.
    const MANY: usize = 12;
    let titles: String = titles.iter().map(|title| format!("<th>{title}</th>")).collect();
    let table = |settings: &[usize]| {
        let row = |&i: &usize| {
            let measured = &measurements.settings[i];
            let class = if measurements.front_time.contains(&i) { " class=\"front\"" } else { "" };
            let cells = tds(row(measured)?.as_ref());
            Some(format!("<tr{class}><td>{}</td>{cells}</tr>", escaped(&measured.setting.name)))
        };
        let rows: String = settings.iter().filter_map(row).collect();
        format!(
            "<div class=\"scroll\"><table><thead><tr><th>Setting</th>{titles}</tr></thead><tbody>{rows}</tbody></table></div>"
        )
    };
    let all = by_error(measurements);
    if all.len() <= MANY {
        return table(&all);
    }
    let shown = |i: &usize| measurements.is_on_front(*i) || measurements.saved() == Some(*i);
    let few: Vec<usize> = all.iter().copied().filter(shown).collect();
    format!("{}<details><summary>All {} settings</summary>{}</details>", table(&few), all.len(), table(&all))
}

fn tds(cells: &[String]) -> String {
    cells.iter().map(|cell| format!("<td>{cell}</td>")).collect()
}
