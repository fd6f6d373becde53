//! Work in the background that tells how far it is and can be cancelled.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread::JoinHandle;

#[derive(Default)]
struct Signals {
    /// Bits of the finished share.
    share: AtomicU32,
    cancelled: AtomicBool,
}

/// The task as its own thread sees it.
pub(crate) struct Control {
    signals: Arc<Signals>,
    context: egui::Context,
}

impl Control {
    /// Tells the finished share, 0 to 1; breaks when the task is to end.
    pub(crate) fn tell(&self, share: f64) -> ControlFlow<()> {
        self.signals.share.store((share as f32).to_bits(), Ordering::Relaxed);
        self.context.request_repaint();
        if self.signals.cancelled.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The task as the window sees it. Dropping it cancels it and waits for its next word.
pub(crate) struct Task<T> {
    signals: Arc<Signals>,
    thread: Option<JoinHandle<T>>,
}

impl<T: Send + 'static> Task<T> {
    /// Starts the work on a thread of its own; the window is painted anew when it gets further.
    pub(crate) fn start(context: &egui::Context, work: impl FnOnce(&Control) -> T + Send + 'static) -> Self {
        let signals = Arc::<Signals>::default();
        let control = Control { signals: signals.clone(), context: context.clone() };
        let thread = std::thread::spawn(move || {
            let result = work(&control);
            control.context.request_repaint();
            result
        });
        Self { signals, thread: Some(thread) }
    }
}

impl<T> Task<T> {
    /// The finished share, 0 to 1.
    pub(crate) fn share(&self) -> f32 {
        f32::from_bits(self.signals.share.load(Ordering::Relaxed))
    }

    /// Asks the task to end; what it returns then is up to it.
    pub(crate) fn cancel(&self) {
        self.signals.cancelled.store(true, Ordering::Relaxed);
    }

    /// The result, once: when the work is finished and did not panic.
    pub(crate) fn take(&mut self) -> Option<T> {
        // A panic was printed when it happened.
        self.thread.take_if(|thread| thread.is_finished())?.join().ok()
    }

    /// Whether the result is still to come.
    pub(crate) fn is_running(&self) -> bool {
        self.thread.is_some()
    }
}

impl<T> Drop for Task<T> {
    fn drop(&mut self) {
        self.cancel();
        if let Some(thread) = self.thread.take() {
            // The device must not go away under a thread that uses it.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_tells_its_share_and_ends_when_it_is_cancelled() {
        let mut task = Task::start(&egui::Context::default(), |control| {
            let mut told = 0;
            while control.tell(0.25).is_continue() {
                told += 1;
                std::thread::yield_now();
            }
            told
        });
        while task.share() == 0.0 {
            std::thread::yield_now();
        }
        assert_eq!((task.share(), task.is_running()), (0.25, true));
        task.cancel();
        let told = loop {
            if let Some(told) = task.take() {
                break told;
            }
            std::thread::yield_now();
        };
        assert!(!task.is_running(), "told {told} times");
    }
}
