//! The way to a setting: the lowest sampling rate of each integrator, the cheapest of those, a look at views not used so far.

use std::ops::Range;

use super::judge::{Judge, Share};
use super::knobs::{Candidate, Knobs, ONE, RATES};
use super::spread;
use super::{Goal, Tried};
use crate::{MeasureError, Setting, Standard};

/// Timings of each setting and view where several are compared.
const ROUNDS: usize = 2;
/// A saving must cost less than this share of the time: less is noise.
const WORTHWHILE: f64 = 0.95;
/// A doubled sampling rate that leaves more than this share of the error has met another error, which it cannot lower.
const FLOOR: f64 = 0.85;
/// An integrator may take at most this many rungs more than another that has met the target: its samples are not that cheap.
const BEYOND: usize = 4;
/// How often views that a setting did not meet the target on are added to those it is chosen by.
const ATTEMPTS: usize = 4;

/// What a setting was found to be.
pub(super) struct Found {
    pub candidate: Candidate,
    /// Errors on the views it was chosen by.
    pub seen: Vec<f64>,
    /// Errors on views that were not used to choose it.
    pub unseen: Vec<f64>,
    pub met: bool,
}

pub(super) struct Search<'a> {
    pub judge: Judge<'a>,
    pub knobs: Knobs<'a>,
    pub goal: &'a Goal,
    /// Views that settings are chosen by.
    pub views: usize,
    pub tried: Vec<Tried>,
    /// Whether a higher sampling rate than the highest might have met the target.
    pub wants_more: bool,
}

impl Search<'_> {
    /// The cheapest setting that keeps all errors within `allowed`, or the most accurate.
    pub fn cheapest(&mut self, allowed: f64) -> Result<Found, MeasureError> {
        loop {
            self.wants_more = false;
            let found = self.cheapest_yet(allowed)?;
            if found.met {
                return self.saved_instead(found, allowed);
            }
            if !self.wants_more || !self.judge.sharpen() {
                return Ok(found);
            }
            self.tried.clear();
        }
    }

    /// The network as saved, if that meets the target as surely and is faster.
    fn saved_instead(&mut self, found: Found, allowed: f64) -> Result<Found, MeasureError> {
        let saved = self.knobs.saved(&found.candidate);
        // How surely rays meet surfaces is not seen in the errors of few views.
        if self.knobs.shows_surfaces() || saved == found.candidate || !self.meets(&saved, allowed)? {
            return Ok(found);
        }
        let pair = [self.knobs.setting(&saved), self.knobs.setting(&found.candidate)];
        let times = self.judge.times(&[&pair[0], &pair[1]], self.goal.size, ROUNDS)?;
        if !matches!(times[..], [Some(saved), Some(own)] if saved.median < own.median) {
            return Ok(found);
        }
        let looked = self.look(saved, Some(allowed))?;
        Ok(if looked.met { looked } else { found })
    }

    /// The same, with the reference as it is.
    fn cheapest_yet(&mut self, allowed: f64) -> Result<Found, MeasureError> {
        let start = self.knobs.start(allowed);
        let mut fitting = self.fitting(&start, allowed)?;
        if let (true, Some(finer)) = (fitting.is_empty(), self.knobs.finer(&start)) {
            fitting = self.fitting(&finer, allowed)?;
        }
        let Some(mut candidate) = self.fastest(fitting)? else { return self.most_accurate(Some(allowed)) };
        candidate = self.saved_on(candidate, allowed)?;
        for _ in 0..ATTEMPTS {
            let found = self.look(candidate.clone(), Some(allowed))?;
            if found.met {
                return Ok(found);
            }
            // What was unseen takes part in choosing from here on.
            self.views += self.goal.unseen;
            loop {
                if candidate.rung + 1 >= self.rates() {
                    self.wants_more = true;
                    return self.most_accurate(Some(allowed));
                }
                candidate = self.knobs.at(&candidate, candidate.rung + 1);
                if self.meets(&candidate, allowed)? {
                    candidate = self.knobs.secured(&candidate, self.rates());
                    break;
                }
            }
        }
        self.most_accurate(Some(allowed))
    }

    /// The most accurate setting whose pictures take no longer than `budget` milliseconds; `None` where the device tells no times.
    /// The fastest, if all of them take longer.
    pub fn within(&mut self, budget: f64) -> Result<Option<Found>, MeasureError> {
        let mut best: Option<(f64, Candidate)> = None;
        let start = self.knobs.start(self.goal.max_error.unwrap_or(TIDY));
        for integrator in self.knobs.integrators(&start) {
            let Some(candidate) = self.finest_within(&integrator, budget)? else { continue };
            let Timed::Took(candidate) = candidate else { return Ok(None) };
            if let Some(errors) = self.score(&candidate, f64::INFINITY)? {
                let worst = largest(&errors);
                if best.as_ref().is_none_or(|(least, _)| worst < *least) {
                    best = Some((worst, candidate));
                }
            }
        }
        let Some((_, candidate)) = best else { return self.most_accurate(self.goal.max_error).map(Some) };
        self.look(candidate, self.goal.max_error).map(Some)
    }

    /// The highest sampling rate of an integrator whose pictures take no longer than `budget` milliseconds, the lowest of all if
    /// none does; `None` if it cannot be rendered. Time grows with the samples at most, so that it is looked for where it must be.
    fn finest_within(&mut self, integrator: &Candidate, budget: f64) -> Result<Option<Timed>, MeasureError> {
        let top = self.rates() - 1;
        let Some(first) = self.time_at(integrator, ONE)? else { return Ok(None) };
        let Some(first) = first else { return Ok(Some(Timed::Untold)) };
        // Two rungs are a factor of two.
        let reach = ONE as f64 + 2.0 * (budget / first).log2().floor();
        let mut rung = (reach.max(0.0) as usize).min(top);
        let mut fits = |rung: usize| -> Result<bool, MeasureError> {
            Ok(self.time_at(integrator, rung)?.flatten().is_some_and(|time| time <= budget))
        };
        match fits(rung)? {
            true => {
                while rung < top && fits(rung + 1)? {
                    rung += 1;
                }
            }
            false => {
                while rung > 0 {
                    rung -= 1;
                    if fits(rung)? {
                        break;
                    }
                }
            }
        }
        Ok(Some(Timed::Took(self.knobs.at(integrator, rung))))
    }

    /// Milliseconds of a picture with the sampling rate of a rung, where they are told; `None` if it cannot be rendered.
    fn time_at(&mut self, integrator: &Candidate, rung: usize) -> Result<Option<Option<f64>>, MeasureError> {
        let setting = self.knobs.setting(&self.knobs.at(integrator, rung));
        if self.judge.errors(&setting, 0..1, f64::INFINITY, Share::Chosen)?.is_none() {
            return Ok(None);
        }
        let time = self.judge.times(&[&setting], self.goal.picture, 1)?.remove(0);
        Ok(Some(time.map(|time| time.median)))
    }

    /// The errors of a setting on the views it was chosen by, and on new ones.
    fn look(&mut self, candidate: Candidate, allowed: Option<f64>) -> Result<Found, MeasureError> {
        let setting = self.knobs.setting(&candidate);
        let (views, unseen) = (self.views, self.goal.unseen.max(1));
        let seen = self.judge.errors(&setting, 0..views, f64::INFINITY, Share::Promised)?.unwrap_or_default();
        let unseen =
            self.judge.errors(&setting, views..views + unseen, f64::INFINITY, Share::Promised)?.unwrap_or_default();
        let met = allowed.is_some_and(|allowed| seen.iter().chain(&unseen).all(|&error| error <= allowed));
        Ok(Found { candidate, met: met && !unseen.is_empty(), seen, unseen })
    }

    /// The most accurate of all that were tried. With the new views it may have earned its trust after all.
    fn most_accurate(&mut self, allowed: Option<f64>) -> Result<Found, MeasureError> {
        let best = self.tried.iter().min_by(|a, b| a.error.total_cmp(&b.error)).map(|tried| tried.candidate.clone());
        let candidate = best.ok_or_else(|| {
            MeasureError::AllRefused("Not even one sample a voxel with a transfer function works.".into())
        })?;
        let mut found = self.look(candidate, allowed)?;
        let errors = [&found.seen[..], &found.unseen].concat();
        found.met &= allowed.is_some_and(|allowed| spread::limit(&errors) <= allowed);
        Ok(found)
    }

    /// Sampling rates that make sense: well below that of the finest picture where that is what is compared with.
    fn rates(&self) -> usize {
        match self.judge.standard {
            Standard::Finest => RATES.iter().filter(|rate| **rate <= self.judge.finest_rate / 4.0).count(),
            _ => RATES.len(),
        }
    }

    /// For each integrator the lowest sampling rate that meets the target, if any does.
    fn fitting(&mut self, start: &Candidate, allowed: f64) -> Result<Vec<Candidate>, MeasureError> {
        let mut found: Vec<Candidate> = Vec::new();
        for integrator in self.knobs.integrators(start) {
            let least = found.iter().map(|candidate| candidate.rung + BEYOND + 1).min();
            let rungs = self.rates().min(least.unwrap_or(usize::MAX));
            // The error of the saved view, and how often doubling the rate has left it about the same.
            let (mut floor, mut stopped) = ((f64::INFINITY, 0), false);
            let rung = lowest(self.knobs.lowest()..rungs, |rung| {
                let candidate = self.knobs.at(&integrator, rung);
                let Some(errors) = self.score(&candidate, allowed)? else {
                    stopped = true;
                    return Ok(Answer::Stop);
                };
                if self.meets(&candidate, allowed)? {
                    return Ok(Answer::Yes);
                }
                floor = (errors[0], if errors[0] > FLOOR * floor.0 { floor.1 + 1 } else { 0 });
                stopped = errors[0] > allowed && floor.1 >= 3;
                Ok(if stopped { Answer::Stop } else { Answer::No })
            })?;
            self.wants_more |= rung.is_none() && !stopped;
            let secured = |rung| self.knobs.secured(&self.knobs.at(&integrator, rung), self.rates());
            found.extend(rung.map(secured));
        }
        Ok(found)
    }

    /// The fastest of some candidates, by samples taken where times are not known: the lowest sampling rate.
    fn fastest(&mut self, candidates: Vec<Candidate>) -> Result<Option<Candidate>, MeasureError> {
        let settings: Vec<Setting> = candidates.iter().map(|candidate| self.knobs.setting(candidate)).collect();
        if settings.len() < 2 {
            return Ok(candidates.into_iter().next());
        }
        let times = self.judge.times(&settings.iter().collect::<Vec<_>>(), self.goal.size, ROUNDS)?;
        let cost = |i: usize| times[i].map_or(RATES[candidates[i].rung], |time| time.median);
        let best = (0..candidates.len()).min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
        Ok(best.map(|best| candidates[best].clone()))
    }

    /// The candidate with whatever makes it clearly faster and leaves it within the target.
    fn saved_on(&mut self, candidate: Candidate, allowed: f64) -> Result<Candidate, MeasureError> {
        let mut best = candidate;
        for saving in self.knobs.savings() {
            let saving = self.knobs.changed(&best, saving);
            if saving == best || !self.meets(&saving, allowed)? {
                continue;
            }
            let pair = [self.knobs.setting(&best), self.knobs.setting(&saving)];
            let times = self.judge.times(&[&pair[0], &pair[1]], self.goal.size, ROUNDS)?;
            if let [Some(now), Some(then)] = times[..]
                && then.median < WORTHWHILE * now.median
            {
                best = saving;
            }
        }
        Ok(best)
    }

    /// The errors of a candidate on the views that settings are chosen by, up to the first that is not `enough`; `None` if it
    /// cannot be rendered.
    fn score(&mut self, candidate: &Candidate, enough: f64) -> Result<Option<Vec<f64>>, MeasureError> {
        let setting = self.knobs.setting(candidate);
        let Some(errors) = self.judge.errors(&setting, 0..self.views, enough, Share::Chosen)? else { return Ok(None) };
        self.tried.retain(|tried| tried.candidate != *candidate);
        self.tried.push(Tried { candidate: candidate.clone(), setting, error: errors[0] });
        Ok(Some(errors))
    }

    /// Whether unseen views can be trusted to stay within the target, too. Where it is close, more views decide.
    fn meets(&mut self, candidate: &Candidate, allowed: f64) -> Result<bool, MeasureError> {
        let Some(errors) = self.score(candidate, allowed)? else { return Ok(false) };
        if spread::limit(&errors) <= allowed || largest(&errors) > allowed {
            return Ok(largest(&errors) <= allowed);
        }
        let most = self.goal.views + self.goal.views / 2;
        if self.views >= most {
            return Ok(false);
        }
        self.views = most;
        self.meets(candidate, allowed)
    }
}

/// What the times of an integrator have shown.
enum Timed {
    /// A setting that keeps within them, or the fastest.
    Took(Candidate),
    /// The device does not tell.
    Untold,
}

/// What early termination goes by where only time counts: one code of an 8-bit picture.
const TIDY: f64 = 1.0 / 255.0;

fn largest(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

/// Whether a rung is high enough.
enum Answer {
    Yes,
    No,
    /// No, and no higher one is.
    Stop,
}

/// The lowest rung that is high enough, if one is: all above one that is are taken to be so, too. Begins at one sample a voxel,
/// goes by factors of two, and then tries the rung between.
fn lowest(
    rungs: Range<usize>,
    mut holds: impl FnMut(usize) -> Result<Answer, MeasureError>,
) -> Result<Option<usize>, MeasureError> {
    let mut rung = ONE.max(rungs.start).min(rungs.end.saturating_sub(1));
    match holds(rung)? {
        Answer::Yes => {
            while rung >= rungs.start + 2 && matches!(holds(rung - 2)?, Answer::Yes) {
                rung -= 2;
            }
        }
        Answer::Stop => return Ok(None),
        Answer::No => loop {
            rung += 2;
            if rung >= rungs.end {
                // The last rung of all, if the steps have left it out.
                let last = rung - 1;
                return Ok((last < rungs.end && matches!(holds(last)?, Answer::Yes)).then_some(last));
            }
            match holds(rung)? {
                Answer::Yes => break,
                Answer::No => {}
                Answer::Stop => return Ok(None),
            }
        },
    }
    match rung > rungs.start && matches!(holds(rung - 1)?, Answer::Yes) {
        true => Ok(Some(rung - 1)),
        false => Ok(Some(rung)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_rung_is_found() {
        for (rungs, threshold) in (1..20).flat_map(|rungs| (0..=rungs).map(move |threshold| (rungs, threshold))) {
            let found = lowest(0..rungs, |rung| {
                assert!(rung < rungs);
                Ok(if rung >= threshold { Answer::Yes } else { Answer::No })
            });
            assert_eq!(found.expect("no error"), (threshold < rungs).then_some(threshold), "{rungs} {threshold}");
        }
        assert_eq!(lowest(ONE..9, |_| Ok(Answer::Yes)).expect("no error"), Some(ONE));
        assert!(lowest(0..9, |_| Ok(Answer::Stop)).expect("no error").is_none());
    }
}
