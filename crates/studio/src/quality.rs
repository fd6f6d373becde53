//! How large pictures are while something moves: as large as they can be at twenty of them a second.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use rayloom_network::{Level, Reason, Report, Request};

/// Longest that a picture may take while something moves.
pub const TARGET: Duration = Duration::from_millis(50);
/// What is aimed at, so that a picture that takes a little longer than the others is in time too.
const AIM: f64 = 0.036;
/// Pictures that took longer than this are made smaller.
const LIMIT: f64 = 0.044;
/// Coarsest resolution, as a part of the full one.
const COARSEST: u32 = 8;
/// The first resolution while nothing is known about the time that pictures take.
const GUESS: u32 = 3;
/// How long after the last turn of the wheel or step something still counts as moving.
const LINGER: Duration = Duration::from_millis(250);

/// Chooses the resolution while something moves.
///
/// What an evaluation took for its pixels says with which part of the resolution to begin. While things move, the resolution is
/// only lowered, so that it does not swing between two values.
#[derive(Debug, Default)]
pub struct Quality {
    /// Seconds for a pixel, in the last evaluation that tells.
    cost: Option<f64>,
    moving: Option<Moving>,
}

#[derive(Debug)]
struct Moving {
    /// Pictures have the full resolution divided by this in both directions.
    divisor: u32,
    /// Time of pictures at this resolution, smoothed, seconds.
    time: Option<f64>,
    until: Instant,
}

impl Quality {
    /// Full resolution is divided by this in both directions; 1 at rest.
    pub fn divisor(&self) -> u32 {
        self.moving.as_ref().map_or(1, |moving| moving.divisor)
    }

    /// To be told every frame whether the user moves something in this one, whether the pointer was let go, and the sizes of the
    /// canvases that show it. The frame to come when movement ends by itself, if any.
    pub fn notice(
        &mut self,
        moves: bool,
        released: bool,
        shown: &BTreeMap<String, [u32; 2]>,
        now: Instant,
    ) -> Option<Duration> {
        if moves {
            let (divisor, until) = (self.first_divisor(pixels(shown)), now + LINGER);
            self.moving.get_or_insert(Moving { divisor, time: None, until }).until = until;
        }
        let until = self.moving.as_ref()?.until;
        if released || until <= now {
            self.moving = None;
            return None;
        }
        Some(until - now)
    }

    fn first_divisor(&self, pixels: f64) -> u32 {
        self.cost.map_or(GUESS, |cost| coarser(1, cost * pixels))
    }

    /// The sizes of pictures for canvases of these sizes.
    pub fn sizes(&self, shown: &BTreeMap<String, [u32; 2]>) -> BTreeMap<String, [u32; 2]> {
        let divisor = self.divisor();
        shown.iter().map(|(id, size)| (id.clone(), size.map(|pixels| pixels.div_ceil(divisor)))).collect()
    }

    /// Learns from an evaluation for canvases of these sizes. One that loaded data or compiled shaders tells nothing about those
    /// to come, and one that was asked for before the resolution changed nothing about this resolution.
    pub fn learn(&mut self, request: &Request, report: &Report, shown: &BTreeMap<String, [u32; 2]>) {
        let extraordinary = report.runs.iter().any(|run| run.level > Level::Parameters);
        if report.runs.is_empty()
            || extraordinary
            || !self.sizes(shown).iter().all(|(id, size)| request.sizes.get(id) == Some(size))
        {
            return;
        }
        let took = report.elapsed.as_secs_f64();
        match &mut self.moving {
            Some(moving) => moving.learn(took),
            // Only where the size changed did all that depends on it run.
            None if report.runs.iter().flat_map(|run| &run.reasons).any(|reason| matches!(reason, Reason::Size(_))) => {
                self.cost = Some(took / pixels(shown));
            }
            None => {}
        }
    }
}

impl Moving {
    fn learn(&mut self, took: f64) {
        let time = self.time.map_or(took, |before| 0.5 * (before + took));
        self.time = Some(time);
        if time > LIMIT && self.divisor < COARSEST {
            self.divisor = coarser(self.divisor, time).max(self.divisor + 1).min(COARSEST);
            self.time = None;
        }
    }
}

/// The divisor at which a picture that takes `time` seconds at `divisor` takes what is aimed at.
fn coarser(divisor: u32, time: f64) -> u32 {
    let needed = (f64::from(divisor) * (time / AIM).sqrt()).ceil();
    // The cast saturates.
    (needed as u32).clamp(1, COARSEST)
}

fn pixels(sizes: &BTreeMap<String, [u32; 2]>) -> f64 {
    sizes.values().map(|[width, height]| f64::from(*width) * f64::from(*height)).sum()
}

#[cfg(test)]
mod tests {
    use rayloom_network::{Outcome, Run};

    use super::*;

    /// An evaluation of canvases whose every pixel takes so long, on top of 5 ms.
    fn draw(quality: &mut Quality, shown: &BTreeMap<String, [u32; 2]>, each: f64, reason: Reason) -> f64 {
        let sizes = quality.sizes(shown);
        let took = 0.005 + each * pixels(&sizes);
        let run = Run {
            processor: "traversal".into(),
            reasons: vec![reason],
            level: Level::Result,
            cpu: Duration::ZERO,
            gpu: None,
            outcome: Outcome::Done,
            notes: Vec::new(),
            statistics: Default::default(),
        };
        let report = Report { runs: vec![run], elapsed: Duration::from_secs_f64(took), ..Report::default() };
        quality.learn(&Request { sizes, ..Request::default() }, &report, shown);
        took
    }

    #[test]
    fn pictures_are_in_time_from_the_third_on_and_of_full_size_at_rest() {
        let shown = BTreeMap::from([("canvas".to_owned(), [1280, 800])]);
        let now = Instant::now();
        for full in [0.01, 0.1, 0.4, 2.0] {
            let mut quality = Quality::default();
            let each = full / pixels(&shown);
            quality.notice(true, false, &shown, now);
            let times: Vec<f64> =
                (0..10).map(|_| draw(&mut quality, &shown, each, Reason::Asked("turned".into()))).collect();
            assert!(times[2..].iter().all(|time| *time <= TARGET.as_secs_f64()), "{full}: {times:?}");
            quality.notice(false, true, &shown, now);
            assert_eq!(quality.sizes(&shown), shown);
            // The next time it begins with what it learnt.
            draw(&mut quality, &shown, each, Reason::Size([1280, 800]));
            quality.notice(true, false, &shown, now);
            let divisor = quality.divisor();
            assert!((divisor == 1) == (full < 0.03), "{full}: {divisor}");
            let time = draw(&mut quality, &shown, each, Reason::Asked("turned".into()));
            assert!(time <= TARGET.as_secs_f64(), "{full}: {time}");
        }
    }

    #[test]
    fn what_was_turned_by_the_wheel_comes_to_rest_by_itself() {
        let shown = BTreeMap::from([("canvas".to_owned(), [640, 480])]);
        let (mut quality, now) = (Quality::default(), Instant::now());
        assert_eq!(quality.notice(true, false, &shown, now), Some(LINGER));
        assert_eq!(quality.divisor(), GUESS);
        assert_eq!(quality.notice(false, false, &shown, now + LINGER / 2), Some(LINGER / 2));
        assert_eq!(quality.notice(false, false, &shown, now + LINGER), None);
        assert_eq!(quality.divisor(), 1);
    }
}
