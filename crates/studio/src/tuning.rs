//! Tuning in the background: the cheapest setting within an error, or the most accurate within a time.

use std::sync::{Arc, Mutex, PoisonError};

use rayloom_gpu::Gpu;
use rayloom_measure::{Goal, MeasureError, Tuned, tune, user_cache};
use rayloom_network::{Address, Network};
use rayloom_reference::{Cache, RenderError};

use crate::task::Task;

/// Pixels along the edges of the pictures that errors are measured on.
const SIZE: [u32; 2] = [64, 64];
/// Views to choose by, and to look from afterwards.
const VIEWS: [usize; 2] = [6, 4];

/// What tuning is to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wish {
    /// An error that 99 % of the pixels do not exceed.
    Error(f64),
    /// Milliseconds that a picture takes on the device.
    Time(f64),
}

/// The result of tuning; `None` when it was cancelled.
pub(crate) type Outcome = Result<Option<Box<Tuned>>, MeasureError>;

/// Tuning that is under way.
pub(crate) struct Tuning {
    /// The work.
    pub(crate) task: Task<Outcome>,
    doing: Arc<Mutex<String>>,
}

impl Tuning {
    /// Begins to tune what a ray traversal gives on an outport; times are those of pictures of this size.
    pub(crate) fn start(
        context: &egui::Context,
        gpu: Gpu,
        network: Network,
        outport: &Address,
        wish: Wish,
        picture: [u32; 2],
    ) -> Self {
        let (max_error, budget_ms) = match wish {
            Wish::Error(error) => (Some(error), None),
            Wish::Time(milliseconds) => (None, Some(milliseconds)),
        };
        let [views, unseen] = VIEWS;
        let port = Some(outport.clone());
        let goal = Goal { port, max_error, budget_ms, size: SIZE, picture, views, unseen, standard: None };
        let doing = Arc::<Mutex<String>>::default();
        let telling = doing.clone();
        let task = Task::start(context, move |control| {
            let progress = |what: &str, share: f64| {
                let mut doing = telling.lock().unwrap_or_else(PoisonError::into_inner);
                if *doing != what {
                    what.clone_into(&mut doing);
                }
                control.tell(share)
            };
            match tune(&network, &goal, gpu, &Cache::new(user_cache()), &progress) {
                Err(MeasureError::Render(RenderError::Cancelled)) => Ok(None),
                found => found.map(|tuned| Some(Box::new(tuned))),
            }
        });
        Self { task, doing }
    }

    /// What is being done just now.
    pub(crate) fn doing(&self) -> String {
        self.doing.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}
