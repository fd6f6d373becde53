//! The ray probe: what a traversal meets along the ray of one pixel.

mod plots;
mod reading;

use egui::{ComboBox, RichText, Ui};
use rayloom_processors::Trace;

use crate::inspect::text::number;
use crate::probe::{self, Mark};
use crate::session::Session;
use crate::theme;

/// What plots are drawn over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Along {
    /// Distance from the entry point, world units.
    #[default]
    Distance,
    /// Number of the sample.
    Number,
}

/// What the panel remembers.
#[derive(Default)]
pub struct RayProbePanel {
    along: Along,
    /// Number of the sample under the cursor; the last one stays when the pointer leaves.
    cursor: Option<u32>,
}

impl RayProbePanel {
    /// Shows the ray, live: it is followed anew whenever the network changes.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            let Some(ray) = session.probe.ray.clone() else {
                ui.weak("Ctrl and click on a pixel of a canvas, or of a pinned picture, to follow its ray.");
                return;
            };
            session.engine.ray = Some(ray);
            self.bar(ui, session);
            match session.engine.results.trace.clone().as_deref() {
                None => {
                    ui.spinner();
                }
                Some(Err(error)) => {
                    theme::colored(ui, theme::ERROR, error.to_string());
                }
                Some(Ok(trace)) => {
                    summary(ui, trace);
                    if trace.samples.is_empty() {
                        ui.weak(trace.absence().unwrap_or_default());
                        return;
                    }
                    self.trace(ui, session, trace);
                }
            }
        });
    }

    /// Which traversal, and what the plots are drawn over.
    fn bar(&mut self, ui: &mut Ui, session: &mut Session) {
        let choices = probe::choices(session.network(), &session.probe.picked_in);
        let Some(ray) = &mut session.probe.ray else { return };
        ui.horizontal(|ui| {
            if choices.len() > 1 {
                ComboBox::from_id_salt("traversal").selected_text(&ray.processor).show_ui(ui, |ui| {
                    for id in choices {
                        ui.selectable_value(&mut ray.processor, id.clone(), id);
                    }
                });
            } else {
                ui.strong(&ray.processor);
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.selectable_value(&mut self.along, Along::Number, "Sample");
                ui.selectable_value(&mut self.along, Along::Distance, "Distance")
                    .on_hover_text("Distance from the entry point, world units");
            });
        });
    }

    fn trace(&mut self, ui: &mut Ui, session: &mut Session, trace: &Trace) {
        let chosen = self.cursor.and_then(|index| nearest(trace, |sample| f64::from(sample.index), f64::from(index)));
        let readings = reading::height(trace);
        let room = (ui.available_height() - readings).max(90.0);
        let hovered = plots::show(ui, trace, self.along, chosen, room);
        let sample = hovered.or(chosen);
        self.cursor = sample.map(|sample| trace.samples[sample].index);
        if let Some(sample) = sample.map(|sample| &trace.samples[sample]) {
            let mark = Mark { value: sample.value, gradient: sample.gradient };
            let traversal = session.probe.ray.as_ref().map(|ray| ray.processor.clone());
            if session.probe.mark(mark, traversal.into_iter().collect()) {
                // Editors show it in the next frame.
                ui.ctx().request_repaint();
            }
            reading::show(ui, trace, sample);
        } else {
            ui.weak("Point into the plots to read a sample.");
        }
    }
}

/// The sample (by place in the list) for which a number is nearest to what is wanted; they rise along the ray.
fn nearest(trace: &Trace, of: impl Fn(&rayloom_processors::TraceSample) -> f64, wanted: f64) -> Option<usize> {
    let after = trace.samples.partition_point(|sample| of(sample) < wanted);
    let near = [after.saturating_sub(1), after].into_iter().filter(|at| *at < trace.samples.len());
    near.min_by(|a, b| (of(&trace.samples[*a]) - wanted).abs().total_cmp(&(of(&trace.samples[*b]) - wanted).abs()))
}

/// One line about the whole ray.
fn summary(ui: &mut Ui, trace: &Trace) {
    let [x, y] = trace.pixel;
    let mut text = format!("Pixel ({x}, {y})");
    if trace.count > 0 {
        text += &format!(": {} of {} samples", trace.taken, trace.count);
        let last = trace.samples.last().map_or(0, |sample| sample.index + 1);
        if trace.stopped {
            text += &format!(", left early after sample {}", last.saturating_sub(1));
        }
        let end = if trace.stopped { last } else { trace.count };
        if end > trace.taken {
            text += &format!(", {} skipped", end - trace.taken);
        }
        text += &format!(", length {}", number(trace.length));
    }
    ui.label(RichText::new(text).size(12.0).weak());
    if trace.truncated() > 0 {
        let text = format!("The last {} samples did not fit and are not shown.", trace.truncated());
        theme::colored(ui, theme::WARNING, text);
    }
}
