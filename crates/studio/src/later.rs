//! What comes later: from a disk, or from a person who is asked.

use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::task::Poll;

/// The result of work on a thread of its own, taken in by a later frame. Dropped, it is no longer wanted; nobody waits for it,
/// as a dialog may stay open for ever.
pub(crate) struct Later<T>(Receiver<T>);

impl<T: Send + 'static> Later<T> {
    /// Starts the work; the window is woken when it is done.
    pub fn start(context: &egui::Context, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (outbox, inbox) = channel();
        let context = context.clone();
        std::thread::spawn(move || {
            // Whoever wanted the result may be gone.
            let _ = outbox.send(work());
            context.request_repaint();
        });
        Self(inbox)
    }

    /// The result once it is there; `None` of it when the work panicked, which was printed when it happened.
    pub fn poll(&self) -> Poll<Option<T>> {
        match self.0.try_recv() {
            Ok(result) => Poll::Ready(Some(result)),
            Err(TryRecvError::Empty) => Poll::Pending,
            Err(TryRecvError::Disconnected) => Poll::Ready(None),
        }
    }
}
