//! A picture is traversed in bands of rows, one submission each and the next when the one before is done: so a window that shares
//! the device draws in between, and no watchdog of a driver ends a long picture. What takes a moment is one band.

use std::ops::Range;
use std::time::{Duration, Instant};

/// How long a band should take: a frame of a window. Half of that costs three times as much (docs/PERFORMANCE.md).
const BAND: Duration = Duration::from_millis(16);
/// Pixels of the first band while nothing is known of the speed.
const FIRST: f64 = 16_384.0;
/// How much larger than the last a band may be: the next rows may be slower.
const GROWTH: f64 = 2.0;

/// How fast a ray traversal was.
#[derive(Debug, Default)]
pub(super) struct Pace {
    /// Mean of the last run.
    pixels_a_second: Option<f64>,
}

impl Pace {
    /// Runs `band` on one range of rows after another, from the top, until `size` pixels are done. Bands start at multiples of
    /// `multiple` rows. `band` returns when its rows are done.
    ///
    /// # Errors
    /// The first error of `band`.
    pub fn in_bands<E>(
        &mut self,
        size: [u32; 2],
        multiple: u32,
        mut band: impl FnMut(Range<u32>) -> Result<(), E>,
    ) -> Result<(), E> {
        let [width, height] = size.map(f64::from);
        let start = Instant::now();
        let mut pixels = self.pixels_a_second.map_or(FIRST, |pace| pace * BAND.as_secs_f64());
        let mut first = 0;
        while first < size[1] {
            let groups = (pixels / width / f64::from(multiple)).clamp(1.0, height) as u32;
            let rows = first..size[1].min(first.saturating_add(groups.saturating_mul(multiple)));
            first = rows.end;
            let done = f64::from(rows.len() as u32) * width;
            let began = Instant::now();
            band(rows)?;
            let pace = done / began.elapsed().as_secs_f64().max(1e-6);
            pixels = (pace * BAND.as_secs_f64()).min(GROWTH * pixels.max(done));
        }
        self.pixels_a_second = Some(width * height / start.elapsed().as_secs_f64().max(1e-6));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bands of a picture whose pixels take so long each, in seconds.
    fn bands(pace: &mut Pace, size: [u32; 2], pixel: f64) -> Vec<Range<u32>> {
        let mut bands = Vec::new();
        let result = pace.in_bands(size, 8, |rows| {
            std::thread::sleep(Duration::from_secs_f64(rows.len() as f64 * f64::from(size[0]) * pixel));
            bands.push(rows);
            Ok::<(), ()>(())
        });
        assert_eq!(result, Ok(()));
        bands
    }

    #[test]
    fn bands_cover_every_row_once() {
        for size in [[1, 1], [7, 8], [3, 1000], [1280, 801], [8192, 64]] {
            let mut pace = Pace::default();
            for _ in 0..2 {
                let bands = bands(&mut pace, size, 0.0);
                assert_eq!(bands.first().map(|rows| rows.start), Some(0));
                assert_eq!(bands.last().map(|rows| rows.end), Some(size[1]));
                assert!(bands.windows(2).all(|pair| pair[0].end == pair[1].start && pair[0].end % 8 == 0), "{bands:?}");
            }
        }
    }

    #[test]
    fn what_is_quick_is_one_band_and_what_is_slow_is_many() {
        let mut pace = Pace::default();
        // A picture of 0.3 s: about 20 bands.
        bands(&mut pace, [256, 256], 5e-6);
        let slow = bands(&mut pace, [256, 256], 5e-6);
        assert!(slow.len() > 6, "{slow:?}");
        bands(&mut pace, [256, 256], 0.0);
        assert_eq!(bands(&mut pace, [256, 256], 0.0).len(), 1);
    }

    #[test]
    fn a_band_that_fails_is_the_last() {
        let mut tried = 0;
        let result = Pace::default().in_bands([1024, 1024], 8, |_| {
            tried += 1;
            Err("lost")
        });
        assert_eq!((result, tried), (Err("lost"), 1));
    }
}
