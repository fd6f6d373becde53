//! The frame budget: what every processor of the last picture took, and why it ran.

use std::collections::BTreeSet;

use egui::text::{LayoutJob, TextWrapping};
use egui::{Align2, FontId, Rect, Sense, TextFormat, TextStyle, Ui, Vec2, WidgetInfo, WidgetType};
use rayloom_network::Run;

use super::network::state::{cost, short};
use crate::quality::TARGET;
use crate::session::Session;
use crate::theme;

/// Height of the row of a processor, points.
const ROW: f32 = 38.0;
const MARGIN: f32 = 8.0;

/// Shows what the last evaluation that had anything to do took, the most expensive processor first.
pub fn show(ui: &mut Ui, session: &mut Session) {
    let frame = &session.engine.results.frame;
    let ran: BTreeSet<&str> = frame.ran().into_iter().collect();
    let known = &session.engine.results.runs;
    let mut rows: Vec<(&Run, bool)> = frame
        .needed
        .iter()
        .filter_map(|id| known.get(id))
        .map(|run| (run, ran.contains(run.processor.as_str())))
        .collect();
    rows.sort_by_key(|(run, ran)| (!ran, std::cmp::Reverse(cost(run))));
    let total = frame.elapsed.as_secs_f64();
    let mut chosen = None;
    egui::Frame::new().inner_margin(egui::Margin::symmetric(10, 8)).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        summary(ui, total);
        ui.add_space(6.0);
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if rows.is_empty() {
                ui.weak("Nothing was evaluated yet.");
            }
            for (run, ran) in rows {
                let selected = session.selection.contains(&run.processor);
                if row(ui, run, ran.then_some(total), selected) {
                    chosen = Some(run.processor.clone());
                }
            }
        });
    });
    if let Some(id) = chosen {
        session.selection = [id].into();
    }
}

/// The time of the whole picture against the target.
fn summary(ui: &mut Ui, total: f64) {
    let target = TARGET.as_secs_f64();
    let color = if total > target { theme::WARNING } else { theme::READY };
    ui.horizontal(|ui| {
        ui.strong(format!("{:.1} ms", total * 1e3));
        ui.weak(format!("of {:.0} ms", target * 1e3));
    })
    .response
    .on_hover_text(format!("What is in time for {:.0} pictures a second while something moves.", 1.0 / target));
    let (area, _) = ui.allocate_exact_size(Vec2::new(ui.available_width(), 6.0), Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(area, 3.0, ui.visuals().extreme_bg_color);
    // Beyond the target the bar shows the target as a part of the time.
    let whole = total.max(target).max(1e-9);
    let part = |seconds: f64| area.width() * (seconds / whole) as f32;
    painter.rect_filled(Rect::from_min_size(area.min, Vec2::new(part(total), area.height())), 3.0, color);
    let mark = area.left() + part(target).min(area.width() - 1.0);
    painter.vline(mark, area.expand(2.0).y_range(), (1.0, ui.visuals().strong_text_color()));
}

/// One processor; whether it was clicked. `total`: seconds of the whole picture, if the processor ran for it.
fn row(ui: &mut Ui, run: &Run, total: Option<f64>, selected: bool) -> bool {
    let (area, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), ROW), Sense::click());
    let gpu = run.gpu.map_or_else(|| "not measured".to_owned(), short);
    let share = total.map(|total| (cost(run).as_secs_f64() / total.max(1e-9)).min(1.0));
    let (times, why) = match share {
        Some(share) => {
            let gpu = run.gpu.map(|gpu| format!("GPU {}   ", short(gpu))).unwrap_or_default();
            (format!("{gpu}CPU {}   {:.0} %", short(run.cpu), share * 100.0), run.why())
        }
        None => ("cached".to_owned(), format!("last ran because {}; GPU {gpu}, CPU {}", run.why(), short(run.cpu))),
    };
    response.widget_info(|| {
        WidgetInfo::selected(WidgetType::SelectableLabel, true, selected, format!("{}: {times}", run.processor))
    });
    let (painter, visuals) = (ui.painter().with_clip_rect(area), ui.visuals());
    if selected || response.hovered() {
        let fill = if selected { visuals.selection.bg_fill } else { visuals.widgets.hovered.weak_bg_fill };
        painter.rect_filled(area, 4.0, fill.gamma_multiply(0.6));
    }
    if let Some(share) = share {
        let bar =
            Rect::from_min_size(area.left_bottom() - Vec2::new(0.0, 3.0), Vec2::new(area.width() * share as f32, 2.0));
        painter.rect_filled(bar, 1.0, theme::READY);
    }
    let text = TextStyle::Body.resolve(ui.style());
    let small = FontId::proportional(11.5);
    let color = if share.is_some() { visuals.strong_text_color() } else { visuals.weak_text_color() };
    let left = area.left_top() + Vec2::new(MARGIN, 4.0);
    painter.text(left, Align2::LEFT_TOP, &run.processor, text, color);
    let right = area.right_top() + Vec2::new(-MARGIN, 5.0);
    painter.text(right, Align2::RIGHT_TOP, times, small.clone(), color);
    let mut job = LayoutJob::single_section(why.clone(), TextFormat::simple(small, visuals.weak_text_color()));
    job.wrap = TextWrapping::truncate_at_width(area.width() - 2.0 * MARGIN);
    painter.galley(left + Vec2::new(0.0, 16.0), ui.painter().layout_job(job), visuals.weak_text_color());
    response.on_hover_text(why).clicked()
}
