//! What was just added shows its first data well: the camera sees all of it, and the transfer function makes something of it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::task::Poll;

use rayloom_network::{PropertyDecl, PropertyKind, Value};
use rayloom_processors::types::RAY_TRAVERSAL;
use rayloom_volume::{Histogram, Knot, TransferFunction, Volume, histogram};

use crate::later::Later;
use crate::session::{Session, Severity};
use crate::upstream;

/// Bins of the histogram that a transfer function is made for.
const BINS: usize = 256;
/// Share of the voxels above the background that are as bright as can be.
const BRIGHT: f64 = 0.02;

/// The processors that were added here and have met no data yet.
#[derive(Default)]
pub struct FirstLook {
    waiting: BTreeSet<String>,
    counting: BTreeMap<String, Later<Histogram>>,
}

impl FirstLook {
    /// Waits for the first data of processors.
    pub fn wait_for(&mut self, processors: impl IntoIterator<Item = String>) {
        self.waiting.extend(processors);
    }

    /// Whether it still waits for the data of anything.
    pub fn is_waiting(&self) -> bool {
        !self.waiting.is_empty() || !self.counting.is_empty()
    }
}

impl Session {
    /// Sets what was never set of new processors that data has reached. To be called once a frame.
    pub(crate) fn look_first(&mut self, context: &egui::Context) {
        for id in self.first_look.waiting.clone() {
            let Some(processor) = self.network().processor(&id) else {
                self.first_look.waiting.remove(&id);
                continue;
            };
            let is_traversal = processor.type_id() == RAY_TRAVERSAL;
            let nothing = |kind| self.untouched(&id, kind).is_empty();
            if nothing(&PropertyKind::Camera) && nothing(&PropertyKind::TransferFunction) {
                self.first_look.waiting.remove(&id);
                continue;
            }
            let Some(volume) = upstream::volume(self.network(), &self.engine.results.outputs, &id) else { continue };
            self.first_look.waiting.remove(&id);
            self.frame_first(&id, &volume);
            if is_traversal && volume.channels > 0 {
                let chosen = self.network().processor(&id).and_then(|p| p.properties().int("channel").ok());
                let channel = upstream::channel(&volume, chosen);
                let counting = Later::start(context, move || histogram(&volume, channel, BINS));
                self.first_look.counting.insert(id, counting);
            }
        }
        for (id, counting) in std::mem::take(&mut self.first_look.counting) {
            match counting.poll() {
                Poll::Pending => drop(self.first_look.counting.insert(id, counting)),
                Poll::Ready(Some(counted)) => self.color_first(&id, &counted),
                Poll::Ready(None) => {}
            }
        }
    }

    fn frame_first(&mut self, id: &str, volume: &Arc<Volume>) {
        for decl in self.untouched(id, &PropertyKind::Camera) {
            if let Value::Camera(camera) = decl.default {
                let (center, radius) = upstream::bounds(volume);
                self.amend(id, &decl.id, Value::Camera(camera.framing(center, radius)));
            }
        }
    }

    fn color_first(&mut self, id: &str, counted: &Histogram) {
        for decl in self.untouched(id, &PropertyKind::TransferFunction) {
            self.amend(id, &decl.id, Value::TransferFunction(for_data(counted)));
        }
    }

    fn amend(&mut self, id: &str, property: &str, value: Value) {
        if let Err(error) = self.document.amend(|network| network.set_property(id, property, value)) {
            self.tell(Severity::Error, error.to_string());
        }
    }

    /// The properties of a kind that still are what they are by default.
    fn untouched(&self, id: &str, kind: &PropertyKind) -> Vec<PropertyDecl> {
        let Some(processor) = self.network().processor(id) else { return Vec::new() };
        let properties = processor.properties();
        let decls = processor.property_decls().into_iter();
        decls.filter(|decl| decl.kind == *kind && properties.get(&decl.id) == Some(&decl.default)).collect()
    }
}

/// A ramp that leaves out the background and is brightest where the highest values are that are not rare.
fn for_data(counted: &Histogram) -> TransferFunction {
    let background = threshold(&counted.counts);
    let above: u64 = counted.counts[background..].iter().sum();
    let mut rest = (above as f64 * BRIGHT) as u64;
    let bright = (background + 1..counted.counts.len()).rev().find(|bin| {
        let taken = counted.counts[*bin].min(rest);
        rest -= taken;
        taken < counted.counts[*bin]
    });
    let at = |bin: usize| counted.range.denormalise(bin as f64 / counted.counts.len() as f64);
    let (low, high) = (at(background), at(bright.unwrap_or(background + 1).max(background + 1)));
    let dark = [0.55, 0.35, 0.28];
    TransferFunction { knots: vec![Knot::new(low, dark, 0.0), Knot::new(high, [1.0, 0.95, 0.88], 0.5)] }
}

/// The first bin of what is no background: where the variance between the two is largest (Otsu 1979).
fn threshold(counts: &[u64]) -> usize {
    let all: f64 = counts.iter().map(|count| *count as f64).sum();
    let moment: f64 = counts.iter().enumerate().map(|(bin, count)| bin as f64 * *count as f64).sum();
    let (mut below, mut moment_below, mut best) = (0.0, 0.0, (0.0, 0));
    for (bin, count) in counts.iter().enumerate() {
        let above = all - below;
        if below > 0.0 && above > 0.0 {
            let apart = moment_below / below - (moment - moment_below) / above;
            let between = below * above * apart * apart;
            if between > best.0 {
                best = (between, bin);
            }
        }
        below += *count as f64;
        moment_below += bin as f64 * *count as f64;
    }
    best.1
}

#[cfg(test)]
mod tests {
    use rayloom_volume::ValueRange;

    use super::*;

    #[test]
    fn the_background_is_left_out_and_rare_values_do_not_darken_the_rest() {
        let mut counts = vec![0; BINS];
        counts[0..20].fill(1000);
        counts[80..120].fill(100);
        counts[255] = 3;
        let function = for_data(&Histogram { range: ValueRange::new(-100.0, 1180.0), counts });
        let [low, high] = [function.knots[0].at, function.knots[1].at];
        assert!((0.0..=300.0).contains(&low), "{low}");
        assert!(high > 450.0 && high < 510.0, "{high}");
        assert!(function.check().is_ok());
        let constant = for_data(&Histogram { range: ValueRange::new(5.0, 5.0), counts: vec![7] });
        assert!(constant.check().is_ok(), "{constant:?}");
    }
}
