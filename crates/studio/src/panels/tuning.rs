//! The control that tunes a ray traversal: an error or a time, the way there, what was found.

use egui::{DragValue, Label, RichText};
use rayloom_measure::{Chain, MeasureError, Tuned, Verdict};
use rayloom_network::Address;
use serde_json::Value as Json;

use crate::session::Session;
use crate::theme;
use crate::tuning::{Tuning, Wish};

/// What can be asked for: errors of one code in some thousand up to half of all there is, and times in milliseconds.
const ERRORS: std::ops::RangeInclusive<f64> = 1e-4..=0.5;
const TIMES: std::ops::RangeInclusive<f64> = 0.1..=10_000.0;

/// What the control remembers.
pub(super) struct TuningControl {
    wish: Wish,
    running: Option<(Address, Tuning)>,
    found: Option<(Address, Result<Box<Tuned>, MeasureError>)>,
    /// What was cancelled because its document is gone. It ends with its next word, for which the window does not wait.
    leaving: Vec<Tuning>,
}

impl Default for TuningControl {
    fn default() -> Self {
        Self { wish: Wish::Error(0.01), running: None, found: None, leaving: Vec::new() }
    }
}

impl TuningControl {
    /// The control of another document.
    pub(super) fn anew(mut self) -> Self {
        if let Some((_, tuning)) = self.running.take() {
            tuning.task.cancel();
            self.leaving.push(tuning);
        }
        Self { leaving: self.leaving, ..Self::default() }
    }

    /// Shows the control for a ray traversal with a picture of `size` pixels.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, session: &mut Session, chain: &Chain, size: [u32; 2]) {
        self.listen();
        ui.horizontal_wrapped(|ui| match &self.running {
            Some((_, tuning)) => {
                ui.spinner();
                if ui.button("Cancel tuning").clicked() {
                    tuning.task.cancel();
                }
                ui.weak(format!("Tuning: {}", tuning.doing()));
            }
            None => {
                self.ask(ui);
                let help = "Finds the cheapest setting (sampling rate, integrator, early termination, skipping, storage) that keeps \
                            the error on views all around, or the most accurate one within the time. Nothing changes until you \
                            apply it.";
                if ui.button("Tune").on_hover_text(help).clicked() {
                    let (gpu, network) = (session.display.gpu().clone(), session.network().clone());
                    let tuning = Tuning::start(ui.ctx(), gpu, network, &chain.image, self.wish, size);
                    self.running = Some((chain.image.clone(), tuning));
                    self.found = None;
                }
            }
        });
        self.result(ui, session, chain);
    }

    /// Takes in what was found in the background.
    fn listen(&mut self) {
        self.leaving.retain_mut(|tuning| tuning.task.take().is_none() && tuning.task.is_running());
        let Some((image, tuning)) = &mut self.running else { return };
        if let Some(outcome) = tuning.task.take() {
            self.found = outcome.transpose().map(|found| (image.clone(), found));
            self.running = None;
        } else if !tuning.task.is_running() {
            // It panicked, which was printed.
            self.running = None;
        }
    }

    /// What is to be kept.
    fn ask(&mut self, ui: &mut egui::Ui) {
        ui.label("Tune for");
        if ui.selectable_label(matches!(self.wish, Wish::Error(_)), "an error").clicked() {
            self.wish = Wish::Error(0.01);
        }
        if ui.selectable_label(matches!(self.wish, Wish::Time(_)), "a time").clicked() {
            self.wish = Wish::Time(50.0);
        }
        ui.weak("of at most");
        match &mut self.wish {
            Wish::Error(error) => {
                let speed = (*error * 0.02).max(1e-4);
                ui.add(DragValue::new(error).range(ERRORS).speed(speed).max_decimals(4)).on_hover_text(
                    "The error that 99 % of the pixels may have on any view, of premultiplied colours from 0 to 1: 0.004 is one \
                     code of an 8-bit picture.",
                );
            }
            Wish::Time(time) => {
                let speed = (*time * 0.02).max(0.1);
                ui.add(DragValue::new(time).range(TIMES).speed(speed).max_decimals(1).suffix(" ms"))
                    .on_hover_text("What the rays of a picture of this size may take on the device.");
            }
        }
    }

    /// What was found for this ray traversal, and the way to have it.
    fn result(&mut self, ui: &mut egui::Ui, session: &mut Session, chain: &Chain) {
        let tuned = match &self.found {
            Some((image, Ok(tuned))) if *image == chain.image => tuned,
            Some((image, Err(error))) if *image == chain.image => {
                theme::colored(ui, theme::WARNING, error.to_string());
                return;
            }
            _ => return,
        };
        let reached = matches!(tuned.verdict, Verdict::Met | Verdict::InTime);
        let text = RichText::new(tuned.message());
        let warning = theme::ink(ui.visuals(), theme::WARNING);
        ui.add(Label::new(if reached { text } else { text.color(warning) }).wrap());
        let mut done = false;
        ui.horizontal(|ui| {
            let name = &tuned.preset.name;
            let knob = |(address, value): (&Address, &Json)| format!("{address} = {value}");
            let knobs: Vec<String> = tuned.preset.values.iter().map(knob).collect();
            let help = format!("Sets, as one step that can be undone:\n{}", knobs.join("\n"));
            if ui.button("Apply").on_hover_text(help).clicked() {
                let preset = tuned.preset.clone();
                done = session.edit(&format!("tune: {name}"), |network| {
                    preset.apply(network)?;
                    network.keep_preset(&preset);
                    Ok::<_, rayloom_network::EditError>(())
                });
            }
            done |= ui.button("Dismiss").clicked();
            ui.weak(format!("Kept as the preset \u{201c}{name}\u{201d}."));
        });
        if done {
            self.found = None;
        }
    }
}
