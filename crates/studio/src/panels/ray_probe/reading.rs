//! The exact numbers of one sample.

use egui::{Color32, RichText, Sense, Ui, Vec2};
use rayloom_processors::{Trace, TraceSample};

use crate::inspect::text::number;

/// Height of a line of text.
const LINE: f32 = 18.0;

/// Height of the numbers of a sample.
pub(super) fn height(trace: &Trace) -> f32 {
    let Some(sample) = trace.samples.first() else { return 0.0 };
    let colors = usize::from(sample.classified.is_some()) + usize::from(sample.shaded.is_some()) + trace.outputs.len();
    LINE * (1 + colors) as f32 + 14.0
}

/// The numbers of a sample.
pub(super) fn show(ui: &mut Ui, trace: &Trace, sample: &TraceSample) {
    ui.spacing_mut().item_spacing = Vec2::new(8.0, 2.0);
    let mut parts = vec![
        format!("sample {}", sample.index),
        format!("at {}", number(sample.distance)),
        format!("value {}", number(sample.value)),
    ];
    parts.extend(sample.gradient.map(|gradient| format!("gradient {}", number(gradient))));
    ui.horizontal(|ui| {
        for part in parts {
            ui.label(RichText::new(part).monospace().size(11.5));
        }
    })
    .response
    .on_hover_text(format!("world coordinates {}", sample.position.map(number).join(", ")));
    for (name, medium) in [("classified", sample.classified), ("shaded", sample.shaded)] {
        if let Some(medium) = medium {
            color(ui, name, straight(medium), f64::from(opacity(medium)), "Opacity of one reference length");
        }
    }
    for (output, rgba) in trace.outputs.iter().zip(&sample.accumulated) {
        let name = if trace.outputs.len() > 1 { format!("{} so far", output.outport) } else { "so far".into() };
        color(ui, &name, straight(*rgba), f64::from(rgba[3]), "What the pixel would be if the ray ended here");
    }
}

/// A colour with its opacity.
fn color(ui: &mut Ui, name: &str, rgb: [f32; 3], opacity: f64, what: &str) {
    ui.horizontal(|ui| {
        let (swatch, _) = ui.allocate_exact_size(Vec2::new(22.0, 12.0), Sense::hover());
        ui.painter().rect_filled(swatch, 2.0, screen(rgb, 1.0));
        let [r, g, b] = rgb.map(|c| format!("{c:.3}"));
        let text = format!("{name:<11}{r} {g} {b}  opacity {}", number(opacity));
        ui.label(RichText::new(text).monospace().size(11.5));
    })
    .response
    .on_hover_text(what);
}

/// The colour behind a medium or a premultiplied colour: its first three components over the fourth.
pub(super) fn straight(color: [f32; 4]) -> [f32; 3] {
    let [r, g, b, weight] = color;
    if weight > 0.0 { [r, g, b].map(|c| c / weight) } else { [0.0; 3] }
}

/// The opacity of one reference length of a medium.
pub(super) fn opacity(medium: [f32; 4]) -> f32 {
    -(-medium[3]).exp_m1()
}

/// A colour on the screen, dimmed over black.
pub(super) fn screen(rgb: [f32; 3], share: f32) -> Color32 {
    let [r, g, b] = rgb.map(|c| (c * share * 255.0).round().clamp(0.0, 255.0) as u8);
    Color32::from_rgb(r, g, b)
}
