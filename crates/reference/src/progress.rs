//! Pictures pixel by pixel, in parallel, with a word on how far they are.

use crate::image::{Image, PixelResult, Rectangle};
use crate::scene::SceneError;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Called with the finished share of a picture, 0 to 1, after each of its rows, from any thread; rows finish in any order, so
/// shares may arrive slightly out of order. [`ControlFlow::Break`] cancels the picture.
pub type Progress<'a> = &'a (dyn Fn(f64) -> ControlFlow<()> + Sync);

/// Listens to nothing and never cancels.
pub fn unattended(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The progress callback said so.
    #[error("The picture was cancelled before it was finished.")]
    Cancelled,
}

/// The pixels of `part` of a picture of `size`, of all of it for `None`.
pub(crate) fn picture(
    size: [u32; 2],
    part: Option<Rectangle>,
    progress: Progress<'_>,
    pixel: impl Fn(u32, u32) -> PixelResult + Sync,
) -> Result<Image, RenderError> {
    let part = part.unwrap_or(Rectangle { x: 0, y: 0, width: size[0], height: size[1] });
    part.check_within(size)?;
    let finished = AtomicU32::new(0);
    let cancelled = AtomicBool::new(false);
    let row = |y: u32| -> Vec<PixelResult> {
        let of_row = |x: u32| {
            if cancelled.load(Ordering::Relaxed) { PixelResult::NOTHING } else { pixel(part.x + x, part.y + y) }
        };
        let pixels = (0..part.width).into_par_iter().map(of_row).collect();
        let share = f64::from(finished.fetch_add(1, Ordering::Relaxed) + 1) / f64::from(part.height);
        if !cancelled.load(Ordering::Relaxed) && progress(share).is_break() {
            cancelled.store(true, Ordering::Relaxed);
        }
        pixels
    };
    let rows: Vec<Vec<PixelResult>> = (0..part.height).into_par_iter().map(row).collect();
    if cancelled.into_inner() {
        return Err(RenderError::Cancelled);
    }
    let (color, depth) = rows.into_iter().flatten().map(|result| (result.color, result.depth)).unzip();
    Ok(Image { size: [part.width, part.height], color, depth })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    fn gradient(x: u32, y: u32) -> PixelResult {
        PixelResult { color: [f64::from(x), f64::from(y), 0.0, 1.0], depth: 1.0 }
    }

    #[test]
    fn rectangles_are_parts_of_the_whole() -> Result<(), RenderError> {
        let whole = picture([5, 4], None, &unattended, gradient)?;
        let part = picture([5, 4], Some(Rectangle { x: 2, y: 1, width: 3, height: 2 }), &unattended, gradient)?;
        assert_eq!((part.size, part.pixel(0, 1)), ([3, 2], whole.pixel(2, 2)));
        for bad in [Rectangle { x: 3, y: 0, width: 3, height: 1 }, Rectangle { x: 0, y: 0, width: 0, height: 1 }] {
            let refused = picture([5, 4], Some(bad), &unattended, gradient);
            assert!(matches!(refused, Err(RenderError::Scene(SceneError::Rectangle { .. }))));
        }
        Ok(())
    }

    #[test]
    fn progress_ends_at_one_and_cancels() {
        let shares = Mutex::new(vec![]);
        let listen = |share| {
            shares.lock().expect("no thread panics").push(share);
            ControlFlow::Continue(())
        };
        assert!(picture([3, 8], None, &listen, gradient).is_ok());
        let mut shares = shares.into_inner().expect("no thread panics");
        shares.sort_by(f64::total_cmp);
        assert_eq!((shares.len(), shares[0], shares[7]), (8, 0.125, 1.0));
        assert_eq!(picture([3, 8], None, &|_| ControlFlow::Break(()), gradient), Err(RenderError::Cancelled));
    }
}
