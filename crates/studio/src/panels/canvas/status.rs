//! What a canvas says about its picture: that it is being computed, or that it is an older one and why.

use std::time::Duration;

use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, WidgetType};

use crate::session::{Session, upstream};
use crate::theme;

/// A picture that is there sooner needs no word about it.
const SOON: Duration = Duration::from_millis(400);

/// How the picture of a canvas is doing.
enum Status {
    /// It shows the network as it is, or will in a moment.
    Current,
    /// It is being computed: what is at work, and how far that is, 0 to 1.
    Working(String, Option<f32>),
    /// It shows an older state of the network: what failed.
    Old(String),
}

impl Status {
    fn of(session: &Session, canvas: &str) -> Self {
        let (engine, network) = (&session.engine, session.network());
        let feeding = upstream(network, canvas);
        let label = |id: &str| network.processor(id).and_then(|p| p.label()).unwrap_or(id).to_owned();
        if engine.busy_for() > SOON && session.quality.divisor() == 1 {
            let at_work = engine.running.as_deref().filter(|id| feeding.contains(id));
            let Some(id) =
                at_work.or_else(|| engine.progress.keys().map(String::as_str).find(|id| feeding.contains(id)))
            else {
                return Self::Working("Waiting for other pictures".into(), None);
            };
            let part = engine.progress.get(id).map(|progress| progress.done as f32 / progress.total.max(1) as f32);
            let far = part.map(|part| format!(", {:.0} %", 100.0 * part)).unwrap_or_default();
            return Self::Working(format!("Computing {}{far}", label(id)), part);
        }
        match engine.results.report.failed.keys().find(|id| feeding.contains(id.as_str())) {
            Some(id) => Self::Old(format!("{} failed: this picture is an older one", label(id))),
            None => Self::Current,
        }
    }
}

/// Shows over a picture what is to be known about it.
pub(super) fn show(ui: &Ui, area: Rect, session: &Session, canvas: &str) {
    match Status::of(session, canvas) {
        Status::Current => {
            if let Some(rest) = SOON.checked_sub(session.engine.busy_for()).filter(|_| session.engine.is_busy()) {
                ui.ctx().request_repaint_after(rest + Duration::from_millis(10));
            }
        }
        Status::Working(text, part) => {
            let bar = Rect::from_min_size(area.min, Vec2::new(area.width() * part.unwrap_or(1.0), 3.0));
            let color = theme::WARNING.gamma_multiply(if part.is_some() { 1.0 } else { 0.4 });
            ui.painter().rect_filled(bar, 0.0, color);
            note(ui, area, canvas, &text, Color32::from_black_alpha(190));
        }
        Status::Old(text) => {
            ui.painter().rect_filled(area, 0.0, Color32::from_black_alpha(110));
            ui.painter().rect_stroke(area, 0.0, Stroke::new(2.0, theme::ERROR), StrokeKind::Inside);
            note(ui, area, canvas, &text, Color32::from_rgb(0x8e, 0x2f, 0x27));
        }
    }
}

/// A line in the corner, to be read on every picture.
fn note(ui: &Ui, area: Rect, canvas: &str, text: &str, fill: Color32) {
    let room = (area.width() - 36.0).max(1.0);
    let galley = ui.painter().layout(text.to_owned(), FontId::proportional(12.5), Color32::WHITE, room);
    let place = Align2::LEFT_TOP.align_size_within_rect(galley.size(), area.shrink(14.0));
    let response = ui.interact(place, ui.id().with(("status", canvas)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Label, true, text));
    ui.painter().rect_filled(place.expand2(Vec2::new(7.0, 4.0)), 4.0, fill);
    ui.painter().galley(place.min, galley, Color32::WHITE);
}
