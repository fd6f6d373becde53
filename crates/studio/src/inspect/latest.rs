//! Answers computed in the background about data that keeps changing.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::thread::JoinHandle;

/// Frames after which an answer that nobody asked for is forgotten.
const KEPT_FRAMES: u64 = 120;

/// One question at a time, on a thread of its own.
struct Entry<D, A> {
    /// What the newest question is about; held so that its address stays its own.
    asked: Arc<D>,
    pending: Option<JoinHandle<A>>,
    answer: Option<Arc<A>>,
    last_used: u64,
}

/// The latest answer for each key. While data changes faster than answers come, questions in between are left out and the
/// previous answer stands, so that what is shown neither flickers nor lags behind by more than one answer.
pub(super) struct Latest<K: Ord, D, A> {
    entries: BTreeMap<K, Entry<D, A>>,
    frame: u64,
}

impl<K: Ord, D, A> Default for Latest<K, D, A> {
    fn default() -> Self {
        Self { entries: BTreeMap::new(), frame: 0 }
    }
}

impl<K: Ord + Clone, D: Send + Sync + 'static, A: Send + 'static> Latest<K, D, A> {
    /// The newest answer there is for `data`, or for what it was before; `None` before the first. Never waits.
    pub(super) fn get(
        &mut self,
        key: &K,
        data: &Arc<D>,
        context: &egui::Context,
        answer: impl FnOnce(Arc<D>) -> A + Send + 'static,
    ) -> Option<Arc<A>> {
        let frame = self.frame;
        let entry = self.entries.entry(key.clone());
        let mut is_new = false;
        let entry = entry.or_insert_with(|| {
            is_new = true;
            Entry { asked: data.clone(), pending: None, answer: None, last_used: frame }
        });
        entry.last_used = frame;
        if let Some(pending) = entry.pending.take_if(|pending| pending.is_finished()) {
            // A panic was printed when it happened; the previous answer stands.
            entry.answer = pending.join().ok().map(Arc::new).or(entry.answer.take());
        }
        if entry.pending.is_none() && (is_new || !Arc::ptr_eq(&entry.asked, data)) {
            entry.asked = data.clone();
            let (data, context) = (data.clone(), context.clone());
            entry.pending = Some(std::thread::spawn(move || {
                let answer = answer(data);
                context.request_repaint();
                answer
            }));
        }
        entry.answer.clone()
    }

    /// To be called once a frame: forgets what was not asked for in a while.
    pub(super) fn end_frame(&mut self) {
        self.frame += 1;
        let oldest = self.frame.saturating_sub(KEPT_FRAMES);
        let running = |entry: &Entry<D, A>| entry.pending.as_ref().is_some_and(|pending| !pending.is_finished());
        self.entries.retain(|_, entry| entry.last_used >= oldest || running(entry));
    }
}

impl<K: Ord, D, A> Drop for Latest<K, D, A> {
    fn drop(&mut self) {
        // The device must not go away under a thread that uses it.
        for pending in self.entries.values_mut().filter_map(|entry| entry.pending.take()) {
            // A panic was printed when it happened.
            let _ = pending.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_previous_answer_stands_until_the_next_and_is_forgotten_when_unused() {
        let context = egui::Context::default();
        let mut latest = Latest::<&str, u32, u32>::default();
        let wait = |latest: &mut Latest<&'static str, u32, u32>, data: &Arc<u32>, wanted: u32| {
            let until = std::time::Instant::now() + std::time::Duration::from_secs(10);
            while std::time::Instant::now() < until {
                if latest.get(&"a", data, &context, |data| *data * 2).as_deref() == Some(&wanted) {
                    return;
                }
                std::thread::yield_now();
            }
            panic!("no answer {wanted}");
        };
        let (one, two) = (Arc::new(1), Arc::new(2));
        wait(&mut latest, &one, 2);
        assert_eq!(latest.get(&"a", &two, &context, |data| *data * 2).as_deref(), Some(&2));
        wait(&mut latest, &two, 4);
        (0..=KEPT_FRAMES).for_each(|_| latest.end_frame());
        assert!(latest.entries.is_empty());
    }
}
