//! Errors and times of settings, view by view.

use std::collections::BTreeMap;
use std::ops::{ControlFlow, Range};

use rayloom_gpu::Gpu;
use rayloom_network::{Camera, Network};
use rayloom_reference::Cache;
use rayloom_reference::metrics::Pixel;

use super::views::view;
use super::{Goal, Progress};
use crate::run::bench::Bench;
use crate::run::yardstick::{Standard, choose, finest};
use crate::subject::chain::Chain;
use crate::{Errors, MeasureError, Refusal, Setting, Summary};

/// Samples of the longest ray of the finest picture, for networks that the float64 reference cannot draw, at first.
const FINEST_SAMPLES: f64 = 8192.0;
/// Its samples a voxel: small volumes have few voxels, and their pictures are as coarse as the steps.
const FINEST_RATES: [f64; 2] = [64.0, 1024.0];
/// The finest picture gets so many times the samples where a quarter of its rate has not met the target.
const SHARPER: f64 = 4.0;
/// Samples of the longest ray that no finest picture exceeds.
const MOST_SAMPLES: f64 = 65536.0;

/// Share of a picture that must show something for it to count as a view.
const LEAST_SHOWN: f64 = 0.01;
/// Views that may be left out for showing nothing: a scene may be empty from everywhere.
const MOST_EMPTY: usize = 16;

/// How far a picture is from its reference: the error that 99 % of the pixels do not exceed. Of every pixel the largest error of
/// its four premultiplied channels counts, and only pixels in which the picture or its reference shows anything do: how much of
/// a picture is background says nothing about its accuracy. The remaining pixels are left out because whether a ray that
/// grazes a surface meets it is decided by rounding, whatever the setting, and one such pixel would outweigh all others.
///
/// # Errors
/// Pictures that differ in size.
pub fn picture_error<A: Pixel, B: Pixel>(picture: &[A], reference: &[B]) -> Result<f64, MeasureError> {
    Ok(quantiles(picture, reference, [PROMISED])?[0])
}

/// The share of pixels for which an error is promised.
const PROMISED: f64 = 0.99;
/// The share by which settings are chosen: where a surface is missed the error of a pixel jumps, and the share of such pixels
/// differs from view to view.
const CHOSEN: f64 = 0.997;

/// Errors that these shares of the pixels that show anything do not exceed.
fn quantiles<A: Pixel, B: Pixel, const N: usize>(
    picture: &[A],
    reference: &[B],
    shares: [f64; N],
) -> Result<[f64; N], MeasureError> {
    let shows = |pixel: [f64; 4]| pixel.iter().any(|&channel| channel != 0.0);
    let pairs = picture.iter().zip(reference).map(|(a, b)| (a.widen(), b.widen()));
    let (shown, expected): (Vec<_>, Vec<_>) = pairs.filter(|(a, b)| shows(*a) || shows(*b)).unzip();
    if shown.is_empty() && picture.len() == reference.len() {
        return Ok([0.0; N]);
    }
    let mut errors = match picture.len() == reference.len() {
        true => Errors::of(&shown, &expected)?.1,
        false => Errors::of(picture, reference)?.1,
    };
    errors.sort_unstable_by(f64::total_cmp);
    let rank = |share: f64| (share * errors.len() as f64).ceil() as usize;
    Ok(shares.map(|share| errors[rank(share).clamp(1, errors.len()) - 1]))
}

/// Which of the errors of a picture counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Share {
    /// That of [`picture_error`].
    Promised,
    /// A stricter one, to choose by.
    Chosen,
}

/// A network whose settings are judged.
pub(super) struct Judge<'a> {
    network: &'a Network,
    bench: Bench,
    goal: &'a Goal,
    cache: &'a Cache,
    progress: Progress<'a>,
    camera: Camera,
    pub standard: Standard,
    /// Why the exact picture is not what is compared with, if it is not.
    pub refusal: Option<Refusal>,
    finest: Setting,
    /// Its samples a voxel, and the most that it may have.
    pub finest_rate: f64,
    most_rate: f64,
    /// The views in use so far, and what they should show.
    references: Vec<(Camera, Vec<[f64; 4]>)>,
    /// How many views were looked at to find them.
    looked: usize,
    /// Errors by the values of a setting and the index of the view.
    known: BTreeMap<(String, usize), [f64; 2]>,
}

impl<'a> Judge<'a> {
    pub fn new(
        network: &'a Network,
        chain: Chain,
        goal: &'a Goal,
        gpu: Gpu,
        cache: &'a Cache,
        progress: Progress<'a>,
    ) -> Result<Self, MeasureError> {
        let mut bench = Bench::new(network, chain, gpu, goal.size)?;
        let camera = bench.camera()?;
        let (standard, refusal) = choose(goal.standard, &mut bench)?;
        if standard == Standard::SameSamples {
            return Err(MeasureError::Plan(
                "Tuning needs a reference that every setting is compared with: choose exact or finest.".into(),
            ));
        }
        let [least, most] = FINEST_RATES;
        let (mut finest_rate, mut most_rate) = (most, most);
        if standard == Standard::Finest {
            bench.set(&finest(network, &bench.chain, least), &camera)?;
            let (longest, allowed) = (bench.longest_ray()?, bench.most_samples()? as f64);
            most_rate = (MOST_SAMPLES.min(allowed) / longest).min(most);
            finest_rate = (FINEST_SAMPLES / longest).clamp(least, most).min(most_rate);
        }
        let finest = finest(network, &bench.chain, finest_rate);
        let (references, known) = (Vec::new(), BTreeMap::new());
        Ok(Self {
            network,
            bench,
            goal,
            cache,
            progress,
            camera,
            standard,
            refusal,
            finest,
            finest_rate,
            most_rate,
            references,
            looked: 0,
            known,
        })
    }

    /// Gives the finest picture more samples, where it is what settings are compared with and may have them. What was known is
    /// forgotten.
    pub fn sharpen(&mut self) -> bool {
        let rate = (SHARPER * self.finest_rate).min(self.most_rate);
        if self.standard != Standard::Finest || rate < 1.5 * self.finest_rate {
            return false;
        }
        self.finest_rate = rate;
        self.finest = finest(self.network, &self.bench.chain, rate);
        self.references.clear();
        self.known.clear();
        self.looked = 0;
        true
    }

    /// The errors of a setting in some views, up to the first that is not `enough`; `None` if it cannot be rendered.
    pub fn errors(
        &mut self,
        setting: &Setting,
        views: Range<usize>,
        enough: f64,
        share: Share,
    ) -> Result<Option<Vec<f64>>, MeasureError> {
        let key = format!("{:?}", setting.assignments);
        let mut errors = Vec::new();
        for index in views {
            let both = match self.known.get(&(key.clone(), index)) {
                Some(&both) => both,
                None => match self.error(setting, index) {
                    Err(MeasureError::Evaluation(_) | MeasureError::Edit(_)) => return Ok(None),
                    found => found?,
                },
            };
            self.known.insert((key.clone(), index), both);
            let error = both[usize::from(share == Share::Chosen)];
            errors.push(error);
            if error > enough {
                break;
            }
        }
        Ok(Some(errors))
    }

    /// Errors by [`Share`].
    fn error(&mut self, setting: &Setting, index: usize) -> Result<[f64; 2], MeasureError> {
        while self.references.len() <= index {
            let camera = view(&self.camera, self.looked);
            let reference = self.reference(&camera)?;
            self.looked += 1;
            // A view that shows next to nothing says nothing about others.
            let shown = reference.iter().filter(|pixel| pixel[3] > 0.0).count() as f64 / reference.len() as f64;
            if shown >= LEAST_SHOWN || self.looked > index + MOST_EMPTY {
                self.references.push((camera, reference));
            }
        }
        self.tell(&setting.name, 0.0)?;
        let (camera, reference) = &self.references[index];
        self.bench.set(setting, camera)?;
        quantiles(&self.bench.picture()?, reference, [PROMISED, CHOSEN])
    }

    /// What a view should show.
    fn reference(&mut self, camera: &Camera) -> Result<Vec<[f64; 4]>, MeasureError> {
        let what = format!("drawing what view {} should show", self.references.len() + 1);
        self.tell(&what, 0.0)?;
        match self.standard {
            Standard::Finest => {
                self.bench.set(&self.finest, camera)?;
                Ok(self.bench.picture()?.into_iter().map(|pixel| pixel.map(f64::from)).collect())
            }
            Standard::Exact | Standard::SameSamples => {
                self.bench.set(&Setting::saved(), camera)?;
                let subject = self.bench.subject()?;
                let progress = |share| (self.progress)(&what, share);
                let reference = rayloom_reference::Reference::Exact;
                Ok(self.cache.render(reference, &subject.scene(), None, &progress)?.image.color)
            }
        }
    }

    /// Milliseconds a picture of `size` takes with each setting, taking turns over two views and some rounds; `None` where the
    /// device does not tell. The settings have been rendered before, so that nothing is made for the first time.
    pub fn times(
        &mut self,
        settings: &[&Setting],
        size: [u32; 2],
        rounds: usize,
    ) -> Result<Vec<Option<Summary>>, MeasureError> {
        self.bench.size = size;
        let mut timings = vec![Vec::new(); settings.len()];
        for round in 0..rounds {
            self.tell("timing", round as f64 / rounds as f64)?;
            for index in 0..self.goal.views.min(2) {
                for (setting, timings) in settings.iter().zip(&mut timings) {
                    self.bench.set(setting, &view(&self.camera, index))?;
                    timings.extend(self.bench.time_of_one()?);
                }
            }
        }
        self.bench.size = self.goal.size;
        Ok(timings.iter().map(|timings| Summary::of(timings)).collect())
    }

    /// Says what is being done, and stops where that is asked for.
    fn tell(&self, what: &str, share: f64) -> Result<(), MeasureError> {
        match (self.progress)(what, share) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(MeasureError::Render(rayloom_reference::RenderError::Cancelled)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn background_does_not_count() {
        let mut reference = vec![[0.5, 0.5, 0.5, 1.0]; 50];
        let mut picture: Vec<[f32; 4]> = vec![[0.5, 0.5, 0.5, 1.0]; 50];
        picture[0][0] = 0.7;
        let all = picture_error(&picture, &reference).expect("pictures of one size");
        assert!((all - 0.2).abs() < 1e-6, "one of fifty pixels is more than 1 %: {all}");
        reference.extend(vec![[0.0; 4]; 950]);
        picture.extend(vec![[0.0; 4]; 950]);
        assert_eq!(picture_error(&picture, &reference).expect("pictures of one size"), all);
        assert_eq!(picture_error(&picture[50..], &reference[50..]).expect("pictures of one size"), 0.0);
        assert!(picture_error(&picture[1..], &reference).is_err());
    }
}
