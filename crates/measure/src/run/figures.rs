//! What a setting costs and gives, in one view or over several.

use rayloom_reference::{DisplayComparison, DisplayPicture};
use serde::Serialize;

use crate::errors::surface::Surface;
use crate::{Errors, MeasureError, SurfaceErrors};

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
        let median = 0.5 * (sorted[last / 2] + sorted[last.div_ceil(2)]);
        Some(Self { median, low: at(0.05), high: at(0.95) })
    }
}

/// What a ray traversal counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Rays that met the volume.
    pub rays: u64,
    /// Samples that were taken.
    pub samples: u64,
    /// Samples that changed the picture.
    pub contributing: u64,
}

/// How far pictures are from their reference as a display shows them over black: sRGB in 8 bits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Displayed {
    /// Peak signal-to-noise ratio, decibels; infinite (null in JSON) for equal pictures. Over several views that of their mean
    /// square error.
    pub psnr: f64,
    /// Mean structural similarity; 1 for equal pictures.
    pub ssim: f64,
    /// Mean colour difference CIEDE2000; 1 is about what can be told apart side by side.
    pub ciede2000: f64,
    /// Mean of FLIP, 0 to 1: what is noticed when pictures are flipped back and forth.
    pub flip: f64,
}

impl Displayed {
    fn of(size: [u32; 2], picture: &[[f32; 4]], reference: &[[f64; 4]]) -> Result<Self, MeasureError> {
        const BLACK: [f64; 3] = [0.0; 3];
        let shown = DisplayPicture::of(size, picture, BLACK)?;
        let found = DisplayComparison::new(&shown, &DisplayPicture::of(size, reference, BLACK)?)?;
        Ok(Self { psnr: found.psnr, ssim: found.ssim, ciede2000: found.ciede2000_mean, flip: found.flip_mean })
    }

    /// Of pictures of the same size.
    fn mean(views: &[Self]) -> Self {
        let mean = |of: fn(&Self) -> f64| views.iter().map(of).sum::<f64>() / views.len() as f64;
        Self {
            psnr: -10.0 * mean(|view| 10f64.powf(-0.1 * view.psnr)).log10(),
            ssim: mean(|view| view.ssim),
            ciede2000: mean(|view| view.ciede2000),
            flip: mean(|view| view.flip),
        }
    }
}

/// What a setting was found to cost and to give.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Time on the device for entry points and rays of one picture, over all rounds; `None` where it cannot be told.
    pub time_ms: Option<Summary>,
    /// Samples of all views.
    pub counts: Counts,
    /// Errors of linear premultiplied colours.
    pub errors: Errors,
    /// Errors of the displayed picture.
    pub displayed: Displayed,
    /// Errors of the surface, where the picture and its reference show one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceErrors>,
}

/// A view as a setting shows it.
pub(crate) struct Shot {
    pub pixels: Vec<[f32; 4]>,
    pub surface: Option<Surface>,
    pub counts: Counts,
}

/// A view as it should be.
pub(crate) struct Expected {
    pub pixels: Vec<[f64; 4]>,
    pub surface: Option<Surface>,
}

impl Figures {
    /// Of every view on its own, with the error of each of its pixels. No times yet.
    pub(crate) fn of_views(
        shots: &[Shot],
        expected: &[Expected],
        size: [u32; 2],
        voxel: f64,
    ) -> Result<Vec<(Self, Vec<f64>)>, MeasureError> {
        let view = |(shot, expected): (&Shot, &Expected)| {
            let (errors, each) = Errors::of(&shot.pixels, &expected.pixels)?;
            let displayed = Displayed::of(size, &shot.pixels, &expected.pixels)?;
            let surface = surface_errors(&[shot], &[expected], voxel)?;
            Ok((Self { time_ms: None, counts: shot.counts, errors, displayed, surface }, each))
        };
        shots.iter().zip(expected).map(view).collect()
    }

    /// Over all views, of which `each` are the figures. No times yet.
    pub(crate) fn over(shots: &[Shot], expected: &[Expected], each: &[Self], voxel: f64) -> Result<Self, MeasureError> {
        let (found, wanted) = (row(shots, |shot| &shot.pixels), row(expected, |one| &one.pixels));
        let sum = |of: fn(&Counts) -> u64| each.iter().map(|one| of(&one.counts)).sum();
        let displayed: Vec<Displayed> = each.iter().map(|one| one.displayed).collect();
        let (shots, expected): (Vec<&Shot>, Vec<&Expected>) = (shots.iter().collect(), expected.iter().collect());
        Ok(Self {
            time_ms: None,
            counts: Counts {
                rays: sum(|counts| counts.rays),
                samples: sum(|counts| counts.samples),
                contributing: sum(|counts| counts.contributing),
            },
            errors: Errors::of(&found, &wanted)?.0,
            displayed: Displayed::mean(&displayed),
            surface: surface_errors(&shots, &expected, voxel)?,
        })
    }
}

/// What all views hold, one after the other.
pub(crate) fn row<V, P: Clone>(views: &[V], pixels: impl Fn(&V) -> &Vec<P>) -> Vec<P> {
    views.iter().flat_map(|view| pixels(view).iter().cloned()).collect()
}

/// Over all views; `None` if one of them has no surface.
fn surface_errors(shots: &[&Shot], expected: &[&Expected], voxel: f64) -> Result<Option<SurfaceErrors>, MeasureError> {
    let found: Option<Vec<&Surface>> = shots.iter().map(|shot| shot.surface.as_ref()).collect();
    let wanted: Option<Vec<&Surface>> = expected.iter().map(|one| one.surface.as_ref()).collect();
    let whole = |views: Vec<&Surface>| Surface {
        points: row(&views, |view| &view.points),
        normals: views.iter().all(|view| view.normals),
    };
    match (found, wanted) {
        (Some(found), Some(wanted)) => Ok(Some(SurfaceErrors::of(&whole(found), &whole(wanted), voxel)?)),
        _ => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timings_have_a_middle() {
        let median = |timings: &[f64]| Summary::of(timings).map(|summary| summary.median);
        assert_eq!([median(&[3.0, 1.0, 2.0]), median(&[4.0, 1.0]), median(&[])], [Some(2.0), Some(2.5), None]);
    }

    #[test]
    fn views_are_taken_together() {
        let shown = |psnr, ssim| Displayed { psnr, ssim, ciede2000: 1.0, flip: 0.5 };
        // Mean square errors of 1e-2 and 1e-4 of the peak.
        let mean = Displayed::mean(&[shown(20.0, 0.5), shown(40.0, 0.7)]);
        assert!((mean.psnr - -10.0 * 5.05e-3_f64.log10()).abs() < 1e-12, "{mean:?}");
        assert!((mean.ssim - 0.6).abs() < 1e-15 && mean.ciede2000 == 1.0);
        let equal = Displayed::mean(&[shown(f64::INFINITY, 1.0); 2]);
        assert_eq!(equal.psnr, f64::INFINITY);
    }

    #[test]
    fn surfaces_of_several_views_count_together() {
        let points = |distances: &[Option<f64>]| Surface {
            points: distances
                .iter()
                .map(|distance| {
                    distance.map(|distance| rayloom_reference::SurfacePoint { distance, normal: glam::DVec3::X })
                })
                .collect(),
            normals: true,
        };
        let shot = |distances: &[Option<f64>]| Shot {
            pixels: vec![[0.0; 4]; distances.len()],
            surface: Some(points(distances)),
            counts: Counts { rays: 1, samples: 2, contributing: 1 },
        };
        let expected = |distances: &[Option<f64>]| Expected {
            pixels: vec![[0.0; 4]; distances.len()],
            surface: Some(points(distances)),
        };
        let shots = [shot(&[Some(1.0), None]), shot(&[Some(2.0), Some(5.0)])];
        let expected = [expected(&[Some(2.0), Some(1.0)]), expected(&[Some(2.0), None])];
        let views = Figures::of_views(&shots, &expected, [2, 1], 0.5).expect("figures");
        let each: Vec<Figures> = views.into_iter().map(|(figures, _)| figures).collect();
        let all = Figures::over(&shots, &expected, &each, 0.5).expect("figures");
        let surface = all.surface.expect("surfaces");
        assert_eq!((surface.common, surface.missing, surface.extra, surface.distance.max), (2, 1, 1, 2.0));
        assert_eq!(each[1].surface.map(|one| (one.common, one.missing, one.extra)), Some((1, 0, 1)));
        assert_eq!((all.counts.rays, all.counts.samples), (2, 4));
        assert_eq!(all.displayed.psnr, f64::INFINITY);
    }
}
