//! How far the picture is from what the network stands for.

use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat};
use egui::{
    Color32, ComboBox, Label, Pos2, ProgressBar, Rect, Sense, Stroke, StrokeKind, TextStyle, TextureHandle, Vec2,
};
use rayloom_measure::{Chain, FAINTEST_ERROR, MeasureError, error_colors};
use rayloom_network::Address;
use rayloom_processors::Image;
use rayloom_processors::types::RAY_TRAVERSAL;
use rayloom_reference::{Rectangle, Reference};

use crate::comparison::{Answer, Outcome, Question, image_at};
use crate::display::Look;
use crate::inspect::image::paint;
use crate::inspect::text::number;
use crate::pane::Pane;
use crate::panels::tuning::TuningControl;
use crate::session::Session;
use crate::task::Task;
use crate::theme;

/// Which picture of the compared part is shown.
#[derive(Clone, Copy, Default, PartialEq)]
enum Shown {
    /// The network's own.
    Picture,
    /// What it should be.
    Reference,
    /// The error of every pixel.
    #[default]
    Error,
}

/// What a comparison was about.
#[derive(Clone)]
struct Topic {
    image: Arc<Image>,
    part: Rectangle,
    reference: Reference,
}

/// A comparison that ended.
struct Compared {
    topic: Topic,
    answer: Result<(Answer, TextureHandle), MeasureError>,
}

/// What the panel remembers.
pub struct AccuracyPanel {
    /// Outport of the ray traversal that is looked at, where there are several.
    chosen: Option<Address>,
    reference: Reference,
    shown: Shown,
    running: Option<(Topic, Task<Outcome>)>,
    compared: Option<Compared>,
    tuning: TuningControl,
    /// Where the drag began that marks a part.
    from: Option<Pos2>,
}

impl Default for AccuracyPanel {
    fn default() -> Self {
        Self {
            chosen: None,
            reference: Reference::Exact,
            shown: Shown::default(),
            running: None,
            compared: None,
            tuning: TuningControl::default(),
            from: None,
        }
    }
}

impl AccuracyPanel {
    /// The panel of another document.
    pub(super) fn anew(self) -> Self {
        Self { tuning: self.tuning.anew(), ..Self::default() }
    }

    /// Shows the picture of a ray traversal; a part of it that is marked by dragging is compared with the reference.
    pub fn show(&mut self, ui: &mut egui::Ui, session: &mut Session) {
        self.listen(ui.ctx());
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            self.choose_image(ui, session);
            let chain = match Chain::find(session.network(), self.chosen.as_ref()) {
                Ok(chain) => chain,
                Err(error) => {
                    ui.weak(error.to_string());
                    return;
                }
            };
            session.watched.insert(chain.image.clone());
            let Some(image) = image_at(&session.engine.results, &chain.image) else {
                ui.weak(format!("{} holds no image yet.", chain.image));
                return;
            };
            let [width, height] = image.size();
            let whole = Rectangle { x: 0, y: 0, width, height };
            estimate(ui, session, &chain);
            self.tuning.show(ui, session, &chain, image.size());
            let asked = self.bar(ui, whole);
            self.numbers(ui);
            let marked = self.picture(ui, session, &image);
            if let Some(part) = asked.or(marked) {
                self.compare(ui.ctx(), session, &chain, part);
            }
        });
    }

    /// Takes in what was finished in the background.
    fn listen(&mut self, context: &egui::Context) {
        let Some((topic, task)) = &mut self.running else { return };
        if let Some(outcome) = task.take() {
            let texture = |answer: Answer| {
                let map = context.load_texture("error map", answer.map.clone(), egui::TextureOptions::NEAREST);
                (answer, map)
            };
            let ended = outcome.map(|answer| answer.map(texture)).transpose();
            self.compared = ended.map(|answer| Compared { topic: topic.clone(), answer });
            self.running = None;
        } else if !task.is_running() {
            // It panicked, which was printed.
            self.running = None;
        }
    }

    /// Which ray traversal, where there are several.
    fn choose_image(&mut self, ui: &mut egui::Ui, session: &Session) {
        let traversals = session.network().processors().filter(|processor| processor.type_id() == RAY_TRAVERSAL);
        let images: Vec<Address> = traversals.map(|processor| Address::new(processor.id(), "image")).collect();
        if self.chosen.as_ref().is_none_or(|chosen| !images.contains(chosen)) {
            self.chosen = images.first().cloned();
        }
        if images.len() > 1 {
            let text = self.chosen.as_ref().map(Address::to_string).unwrap_or_default();
            ComboBox::from_label("Picture").selected_text(text).show_ui(ui, |ui| {
                for image in images {
                    ui.selectable_value(&mut self.chosen, Some(image.clone()), image.to_string());
                }
            });
        }
    }

    /// The reference and what to show; the part to compare when all of it is asked for.
    fn bar(&mut self, ui: &mut egui::Ui, whole: Rectangle) -> Option<Rectangle> {
        let mut asked = None;
        ui.horizontal_wrapped(|ui| {
            ui.label("Compare with");
            for reference in Reference::ALL {
                let (label, help) = words(reference);
                ui.selectable_value(&mut self.reference, reference, label).on_hover_text(help);
            }
            ui.separator();
            match &self.running {
                Some((_, task)) => {
                    ui.add(ProgressBar::new(task.share()).desired_width(140.0).show_percentage());
                    if ui.button("Cancel").clicked() {
                        task.cancel();
                    }
                }
                None if ui.button("Everything").on_hover_text("Compare the whole picture.").clicked() => {
                    asked = Some(whole);
                }
                None => {
                    ui.weak("or drag over a part of the picture");
                }
            }
        });
        asked
    }

    /// The errors of the compared part.
    fn numbers(&mut self, ui: &mut egui::Ui) {
        let Some(Compared { topic, answer }) = &self.compared else { return };
        let (answer, _) = match answer {
            Ok(answer) => answer,
            Err(error) => {
                theme::colored(ui, theme::WARNING, error.to_string());
                return;
            }
        };
        ui.horizontal_wrapped(|ui| {
            for (shown, label) in
                [(Shown::Picture, "Picture"), (Shown::Reference, words(topic.reference).0), (Shown::Error, "Error")]
            {
                ui.selectable_value(&mut self.shown, shown, label);
            }
            if self.shown == Shown::Error {
                scale(ui);
            }
        });
        let (errors, seen) = (&answer.errors, &answer.seen);
        let rows = [
            ("largest", number(errors.max), "Largest error of a premultiplied channel, of 1."),
            ("root mean square", number(errors.rmse), "Of the largest error of each pixel."),
            ("99 % below", number(errors.p99), "The error that 99 % of the pixels do not exceed."),
            ("visible", format!("{:.2} %", 100.0 * errors.visible), "Pixels off by more than half an 8-bit step."),
            ("PSNR", format!("{:.1} dB", seen.psnr), "Peak signal-to-noise ratio on the screen, over black."),
            ("SSIM", format!("{:.5}", seen.ssim), "Structural similarity on the screen; 1 is the same."),
            ("FLIP", number(seen.flip_mean), "Mean difference that the eye sees when flipping between both."),
            ("CIEDE2000", number(seen.ciede2000_mean), "Mean colour difference; 1 is just noticeable."),
        ];
        ui.horizontal_wrapped(|ui| {
            for (name, value, help) in rows {
                // One label each, so that a value never moves to another line than its name.
                let mut text = LayoutJob::default();
                let font = TextStyle::Body.resolve(ui.style());
                text.append(name, 0.0, TextFormat::simple(font.clone(), ui.visuals().weak_text_color()));
                text.append(&value, 6.0, TextFormat::simple(font, ui.visuals().text_color()));
                ui.add(Label::new(text).extend()).on_hover_text(help);
                ui.add_space(6.0);
            }
        });
        let Rectangle { x, y, width, height } = topic.part;
        let took =
            answer.took.map_or("was kept from before".into(), |took| format!("took {:.1} s", took.as_secs_f64()));
        ui.weak(format!("{width} x {height} pixels at ({x}, {y}); the reference {took}"));
    }

    /// The picture; over the compared part what is chosen. Returns a part that was marked just now.
    fn picture(&mut self, ui: &mut egui::Ui, session: &mut Session, image: &Arc<Image>) -> Option<Rectangle> {
        let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::Image, true, "compared picture"));
        let size = Vec2::from(image.size().map(|pixels| pixels as f32));
        let scale = (area.width() / size.x).min(area.height() / size.y);
        let placed = Rect::from_center_size(area.center(), size * scale);
        ui.painter().rect_filled(area, 0.0, ui.visuals().extreme_bg_color);
        paint(ui, placed, session.display.picture(image, Look::default()));
        let place = |part: Rectangle| {
            let corner = placed.min + Vec2::new(part.x as f32, part.y as f32) * scale;
            Rect::from_min_size(corner, Vec2::new(part.width as f32, part.height as f32) * scale)
        };
        let accent = ui.visuals().selection.stroke.color;
        if let Some((topic, _)) = &self.running {
            ui.painter().rect_stroke(place(topic.part), 0.0, Stroke::new(1.0, accent), StrokeKind::Outside);
        }
        if let Some(Compared { topic, answer: Ok((answer, map)) }) = &self.compared
            && topic.image.size() == image.size()
        {
            let part = place(topic.part);
            match self.shown {
                Shown::Picture => {}
                Shown::Reference => paint(ui, part, session.display.picture(&answer.reference, Look::default())),
                Shown::Error => paint(ui, part, Ok(map.id())),
            }
            let is_current = Arc::ptr_eq(&topic.image, image);
            let color = if is_current { accent } else { theme::WARNING };
            ui.painter().rect_stroke(part, 0.0, Stroke::new(1.0, color), StrokeKind::Outside);
            if !is_current {
                let below = part.left_top() + Vec2::splat(4.0);
                let text = "of an earlier picture";
                ui.painter().text(below, egui::Align2::LEFT_TOP, text, egui::FontId::proportional(12.0), color);
            }
        }
        if response.drag_started() {
            self.from = ui.input(|input| input.pointer.press_origin()).or(response.interact_pointer_pos());
        }
        let between = self.from.zip(response.interact_pointer_pos());
        let marked = between.and_then(|ends| marked(ends, placed, image.size()));
        if let Some(part) = marked {
            ui.painter().rect_filled(place(part), 0.0, accent.gamma_multiply(0.2));
        }
        if !response.drag_stopped() {
            return None;
        }
        self.from = None;
        marked
    }

    fn compare(&mut self, context: &egui::Context, session: &Session, chain: &Chain, part: Rectangle) {
        let question = Question::new(session.network(), &session.engine.results, chain, part, self.reference);
        match question {
            Ok(question) => {
                let topic = Topic { image: question.image.clone(), part, reference: question.reference };
                let gpu = session.display.gpu().clone();
                self.running = Some((topic, question.ask(gpu, context)));
            }
            Err(error) => {
                let image = image_at(&session.engine.results, &chain.image);
                let topic = image.map(|image| Topic { image, part, reference: self.reference });
                self.compared = topic.map(|topic| Compared { topic, answer: Err(error) });
            }
        }
    }
}

/// What is known without a reference, and the way to the map of samples.
fn estimate(ui: &mut egui::Ui, session: &mut Session, chain: &Chain) {
    let judgement = session.judgement(ui.ctx(), &chain.image);
    ui.horizontal_wrapped(|ui| {
        match judgement {
            None => ui.weak("The error is estimated once the picture stands still."),
            Some(Err(error)) => theme::colored(ui, theme::WARNING, error),
            Some(Ok(judgement)) => {
                let (rmse, p99) = (number(judgement.estimate.rmse), number(judgement.estimate.p99));
                let order = judgement.estimate.order.map_or(String::new(), |order| format!(", order {order:.1}"));
                ui.label(format!("Estimated error: {rmse} root mean square, 99 % below {p99}{order}.")).on_hover_text(
                    "By Richardson's estimate, from pictures with half and twice the sampling rate. The order is the power of \
                     the step with which the error falls: 2 in smooth scenes, 1 where there are jumps.",
                );
                ui.label(format!("{:.1} % of the samples contribute.", 100.0 * judgement.contributing))
            }
        };
        if ui.small_button("Map of samples").on_hover_text("Samples taken and contributing, pixel by pixel.").clicked() {
            session.to_open.push(Pane::Inspector(Address::new(chain.traversal(), "samples")));
        }
    });
}

/// Name and meaning of a reference.
fn words(reference: Reference) -> (&'static str, &'static str) {
    match reference {
        Reference::Exact => ("Exact", "What the network stands for, in float64 without samples: the whole error."),
        Reference::SameSamples => {
            ("Same samples", "The same samples in float64: the arithmetic and storage of the device alone.")
        }
    }
}

/// What the colours of the error map mean.
fn scale(ui: &mut egui::Ui) {
    ui.weak(format!("{FAINTEST_ERROR:e}"));
    let (bar, _) = ui.allocate_exact_size(Vec2::new(120.0, 10.0), Sense::hover());
    let colors: Vec<Color32> = error_colors().map(|[r, g, b]| Color32::from_rgb(r, g, b)).collect();
    let mut mesh = egui::Mesh::default();
    for (index, color) in colors.iter().enumerate() {
        let x = bar.left() + bar.width() * index as f32 / (colors.len() - 1) as f32;
        mesh.colored_vertex(Pos2::new(x, bar.top()), *color);
        mesh.colored_vertex(Pos2::new(x, bar.bottom()), *color);
        if index > 0 {
            let last = 2 * index as u32;
            mesh.add_triangle(last - 2, last - 1, last);
            mesh.add_triangle(last - 1, last, last + 1);
        }
    }
    ui.painter().add(mesh);
    ui.weak("1");
}

/// The part of the picture between two points of the screen; `None` when there is nothing between them.
fn marked((from, to): (Pos2, Pos2), placed: Rect, size: [u32; 2]) -> Option<Rectangle> {
    let pixel = |point: Pos2| {
        let at = (point - placed.min) / placed.size() * Vec2::from(size.map(|pixels| pixels as f32));
        [at.x.clamp(0.0, size[0] as f32) as u32, at.y.clamp(0.0, size[1] as f32) as u32]
    };
    let (a, b) = (pixel(from), pixel(to));
    let [x, y] = [a[0].min(b[0]), a[1].min(b[1])];
    let [width, height] = [a[0].abs_diff(b[0]), a[1].abs_diff(b[1])];
    (width > 0 && height > 0).then_some(Rectangle { x, y, width, height })
}
