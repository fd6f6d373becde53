//! Histograms of volumes, counted in the background, once a volume.

use std::collections::HashMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};

use rayloom_volume::{Histogram, Histogram2D, Volume, Voxels, histogram, histogram_2d};

/// Bins of a histogram of values at most.
const BINS: usize = 256;
/// Bins along the gradient magnitudes.
const BINS_UP: usize = 128;

/// A volume in memory and its channel. The address stays its own while the `Weak` beside it is held.
type Key = (usize, u32);

/// What is known of a volume: nothing yet while it is being counted.
struct Entry<T> {
    _volume: Weak<Volume>,
    counted: Option<Arc<T>>,
}

enum Counted {
    Values(Key, Histogram),
    Plane(Key, Histogram2D),
}

/// The histograms counted so far.
pub(super) struct Histograms {
    values: HashMap<Key, Entry<Histogram>>,
    planes: HashMap<Key, Entry<Histogram2D>>,
    outbox: Sender<Counted>,
    news: Receiver<Counted>,
    context: egui::Context,
}

impl Default for Histograms {
    fn default() -> Self {
        let (outbox, news) = channel();
        Self { values: HashMap::new(), planes: HashMap::new(), outbox, news, context: egui::Context::default() }
    }
}

impl Histograms {
    /// Takes in what has been counted and forgets volumes that are gone. To be called once a frame.
    pub fn listen(&mut self, context: &egui::Context) {
        self.context = context.clone();
        while let Ok(news) = self.news.try_recv() {
            match news {
                Counted::Values(key, counted) => {
                    self.values.entry(key).and_modify(|entry| entry.counted = Some(Arc::new(counted)));
                }
                Counted::Plane(key, counted) => {
                    self.planes.entry(key).and_modify(|entry| entry.counted = Some(Arc::new(counted)));
                }
            }
        }
        self.values.retain(|_, entry| entry._volume.strong_count() > 0);
        self.planes.retain(|_, entry| entry._volume.strong_count() > 0);
    }

    /// The histogram of a channel; `None` while it is being counted.
    pub fn values(&mut self, volume: &Arc<Volume>, channel: u32) -> Option<Arc<Histogram>> {
        let key = (Arc::as_ptr(volume) as usize, channel);
        if let Some(entry) = self.values.get(&key) {
            return entry.counted.clone();
        }
        self.values.insert(key, Entry { _volume: Arc::downgrade(volume), counted: None });
        self.count(volume, move |volume| Counted::Values(key, histogram(volume, channel, bins(volume, channel))));
        None
    }

    /// The histogram of a channel and its gradient magnitudes; `None` while it is being counted.
    pub fn plane(&mut self, volume: &Arc<Volume>, channel: u32) -> Option<Arc<Histogram2D>> {
        let key = (Arc::as_ptr(volume) as usize, channel);
        if let Some(entry) = self.planes.get(&key) {
            return entry.counted.clone();
        }
        self.planes.insert(key, Entry { _volume: Arc::downgrade(volume), counted: None });
        self.count(volume, move |volume| {
            Counted::Plane(key, histogram_2d(volume, channel, [bins(volume, channel), BINS_UP]))
        });
        None
    }

    fn count(&self, volume: &Arc<Volume>, count: impl FnOnce(&Volume) -> Counted + Send + 'static) {
        let (volume, outbox, context) = (volume.clone(), self.outbox.clone(), self.context.clone());
        std::thread::spawn(move || {
            let counted = count(&volume);
            // The volume may be as large as the memory; it must not stay because of its histogram.
            drop(volume);
            // The panel may be gone; then nobody needs it.
            let _ = outbox.send(counted);
            context.request_repaint();
        });
    }
}

/// As many bins as whole-numbered data have codes, so that none stays empty for want of a code; else the most.
fn bins(volume: &Volume, channel: u32) -> usize {
    let codes = volume.stored_range(channel).width() + 1.0;
    let whole = !matches!(volume.voxels, Voxels::F32(_) | Voxels::F64(_));
    if whole && codes < BINS as f64 { codes as usize } else { BINS }
}
