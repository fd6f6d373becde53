//! A field for a number: drag to slide, click to type.

use egui::{Align2, CornerRadius, CursorIcon, Id, Key, Rect, Response, Sense, StrokeKind, TextEdit, Ui, Vec2};

use super::row::HEIGHT;
use crate::pointer::dragged_by;

/// What the user entered.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Entered {
    /// Nothing.
    Nothing,
    /// A number within the range.
    Value(f64),
    /// Something that cannot be; why.
    Bad(String),
}

/// A field for a number.
pub(super) struct Number<'a> {
    /// Name, for those who do not see it.
    pub label: &'a str,
    /// Smallest and largest number, inclusive.
    pub range: [f64; 2],
    /// What sliding from end to end spans; `None` slides by a share of the number itself.
    pub slider: Option<[f64; 2]>,
    /// Unit, may be empty.
    pub unit: &'a str,
    /// Whether sliding is logarithmic.
    pub logarithmic: bool,
    /// Whether the number is whole.
    pub whole: bool,
}

/// What is being typed, while it is.
#[derive(Clone)]
struct Typing(String);

/// Where a drag has got to, in shares of the slider (or, without one, the number itself): finer than what is set.
#[derive(Clone, Copy)]
struct Dragged(f64);

impl Number<'_> {
    /// Shows the field.
    pub fn show(&self, ui: &mut Ui, value: f64, width: f32) -> Entered {
        let (id, area) = ui.allocate_space(Vec2::new(width, HEIGHT));
        let typing = ui.data(|data| data.get_temp::<Typing>(id));
        match typing {
            Some(Typing(text)) => self.type_in(ui, id, area, value, text),
            None => self.slide(ui, id, area, value),
        }
    }

    fn slide(&self, ui: &mut Ui, id: Id, area: Rect, value: f64) -> Entered {
        let response = ui.interact(area, id, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::slider(true, value, self.label));
        let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
        self.paint(ui, &response, area, value);
        let typed = response.has_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        if response.clicked() || typed {
            ui.data_mut(|data| data.insert_temp(id, Typing(value.to_string())));
            ui.ctx().request_repaint();
            return Entered::Nothing;
        }
        if response.drag_started() {
            ui.data_mut(|data| data.insert_temp(id, Dragged(self.share(value))));
        }
        if response.dragged() {
            return self.drag(ui, id, &response, area.width(), value);
        }
        self.keys(ui, &response, value)
    }

    fn drag(&self, ui: &Ui, id: Id, response: &Response, width: f32, value: f64) -> Entered {
        let fine = if ui.input(|input| input.modifiers.shift) { 0.1 } else { 1.0 };
        let moved = f64::from(dragged_by(response).x) * fine;
        let Dragged(mut at) = ui.data(|data| data.get_temp(id)).unwrap_or(Dragged(self.share(value)));
        at = match self.slider {
            Some(_) => (at + moved / f64::from(width.max(1.0))).clamp(0.0, 1.0),
            None => at + moved * 0.01 * value.abs().max(0.1),
        };
        ui.data_mut(|data| data.insert_temp(id, Dragged(at)));
        let next = self.clamp(self.tidy(self.at_share(at), f64::from(width) / fine));
        if next == value { Entered::Nothing } else { Entered::Value(next) }
    }

    /// Arrow keys step through the slider while the field has the focus.
    fn keys(&self, ui: &Ui, response: &Response, value: f64) -> Entered {
        if !response.has_focus() {
            return Entered::Nothing;
        }
        let pressed = |key| ui.input(|input| f64::from(input.num_presses(key) as u32));
        let steps = pressed(Key::ArrowUp) - pressed(Key::ArrowDown);
        if steps == 0.0 {
            return Entered::Nothing;
        }
        let next = match self.slider {
            _ if self.whole => value + steps,
            Some(_) => self.tidy(self.at_share((self.share(value) + 0.01 * steps).clamp(0.0, 1.0)), 200.0),
            None => value + steps * 0.1 * value.abs().max(0.1),
        };
        Entered::Value(self.clamp(next))
    }

    fn type_in(&self, ui: &mut Ui, id: Id, area: Rect, value: f64, mut text: String) -> Entered {
        let edit_id = id.with("edit");
        let edit = TextEdit::singleline(&mut text).id(edit_id).margin(egui::Margin::symmetric(5, 1));
        let fresh = !ui.data(|data| data.get_temp::<bool>(edit_id).unwrap_or(false));
        let mut output = ui.place(area, |ui: &mut Ui| {
            let output = edit.desired_width(area.width()).show(ui);
            let response = output.response.response.clone();
            if fresh {
                response.request_focus();
                select_all(ui, edit_id, &output);
            }
            response
        });
        output = output.on_hover_text("Enter to set, Escape to leave it");
        ui.ctx().accesskit_node_builder(edit_id, |node| node.set_label(self.label));
        ui.data_mut(|data| data.insert_temp(edit_id, true));
        if !output.lost_focus() {
            ui.data_mut(|data| data.insert_temp(id, Typing(text)));
            return Entered::Nothing;
        }
        ui.data_mut(|data| {
            data.remove::<Typing>(id);
            data.remove::<bool>(edit_id);
        });
        if ui.input(|input| input.key_pressed(Key::Escape)) || text == value.to_string() {
            return Entered::Nothing;
        }
        match self.parse(&text) {
            Ok(number) => Entered::Value(number),
            Err(why) => Entered::Bad(format!("{why} It stays {}.", format(value))),
        }
    }

    /// The number that a text says.
    fn parse(&self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let plain = text.strip_suffix(self.unit).unwrap_or(text).trim().replace(',', ".");
        let number = plain.parse::<f64>().ok().filter(|number| number.is_finite());
        let number = number.ok_or_else(|| format!("`{text}` is not a number."))?;
        let [low, high] = self.range;
        if self.whole && number.fract() != 0.0 {
            return Err(format!("{number} is not a whole number."));
        }
        if number < low {
            return Err(format!("{number} is below the smallest value, {}.", format(low)));
        }
        if number > high {
            return Err(format!("{number} is above the largest value, {}.", format(high)));
        }
        Ok(number)
    }

    fn clamp(&self, value: f64) -> f64 {
        let value = if self.whole { value.round() } else { value };
        value.max(self.range[0]).min(self.range[1])
    }

    /// Where a number lies on the slider, 0 to 1; without a slider the number itself.
    fn share(&self, value: f64) -> f64 {
        match self.slider {
            Some([low, high]) if self.is_logarithmic(low) => ((value / low).ln() / (high / low).ln()).clamp(0.0, 1.0),
            Some([low, high]) if high > low => ((value - low) / (high - low)).clamp(0.0, 1.0),
            Some(_) => 0.0,
            None => value,
        }
    }

    fn at_share(&self, share: f64) -> f64 {
        match self.slider {
            Some([low, high]) if self.is_logarithmic(low) => low * (high / low).powf(share),
            Some([low, high]) => low + share * (high - low),
            None => share,
        }
    }

    fn is_logarithmic(&self, low: f64) -> bool {
        self.logarithmic && low > 0.0
    }

    /// Rounds to the digits that one of `steps` on the slider can tell apart.
    fn tidy(&self, value: f64, steps: f64) -> f64 {
        let step = match self.slider {
            Some([low, high]) if !self.is_logarithmic(low) => (high - low) / steps,
            _ => value.abs() / 100.0,
        };
        if !(step > 0.0 && step.is_finite()) {
            return value;
        }
        // Dividing by a power of ten rounds correctly where multiplying by its inverse would not.
        let digits = (-step.log10()).ceil().clamp(-300.0, 300.0) as i32;
        let scale = 10_f64.powi(digits.abs());
        let rounded = if digits > 0 { (value * scale).round() / scale } else { (value / scale).round() * scale };
        if rounded.is_finite() { rounded } else { value }
    }

    fn paint(&self, ui: &Ui, response: &Response, area: Rect, value: f64) {
        let visuals = ui.style().interact(response);
        let (painter, radius) = (ui.painter().with_clip_rect(area.intersect(ui.clip_rect())), CornerRadius::same(3));
        painter.rect_filled(area, radius, ui.visuals().extreme_bg_color);
        if self.slider.is_some() {
            let filled = area.with_max_x(area.left() + area.width() * self.share(value) as f32);
            painter.rect_filled(filled, radius, ui.visuals().selection.bg_fill.gamma_multiply(0.75));
        }
        if response.hovered() || response.has_focus() {
            painter.rect_stroke(area, radius, visuals.bg_stroke, StrokeKind::Inside);
        }
        let font = egui::FontId::proportional(12.5);
        let left = area.left_center() + Vec2::new(6.0, 0.0);
        let number = painter.text(left, Align2::LEFT_CENTER, format(value), font, ui.visuals().strong_text_color());
        let font = egui::FontId::proportional(10.5);
        let unit = painter.layout_no_wrap(self.unit.to_owned(), font, ui.visuals().weak_text_color());
        // A long unit is told by the help.
        if unit.size().x + number.width() + 16.0 < area.width() {
            let at = area.right_center() - Vec2::new(unit.size().x + 6.0, unit.size().y / 2.0);
            painter.galley(at, unit, ui.visuals().weak_text_color());
        }
    }
}

fn select_all(ui: &Ui, id: Id, output: &egui::text_edit::TextEditOutput) {
    let mut state = output.state.clone();
    let all = egui::text::CCursorRange::select_all(&output.galley);
    state.cursor.set_char_range(Some(all));
    state.store(ui.ctx(), id);
}

/// A number with at most six digits that count.
pub(super) fn format(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if !(1e-4..1e7).contains(&size) {
        return format!("{value:.3e}").replace(".000e", "e");
    }
    let decimals = (5 - size.log10().floor() as i32).clamp(0, 8) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: Number<'_> = Number {
        label: "Rate",
        range: [0.25, 16.0],
        slider: Some([0.25, 16.0]),
        unit: "samples",
        logarithmic: true,
        whole: false,
    };

    #[test]
    fn what_cannot_be_is_refused_with_the_reason() {
        assert_eq!(RATE.parse(" 1,5 samples"), Ok(1.5));
        assert_eq!(RATE.parse("fast").unwrap_err(), "`fast` is not a number.");
        assert_eq!(RATE.parse("17").unwrap_err(), "17 is above the largest value, 16.");
        assert!(RATE.parse("NaN").is_err() && RATE.parse("0").is_err());
        let whole = Number { whole: true, ..RATE };
        assert_eq!(whole.parse("1.5").unwrap_err(), "1.5 is not a whole number.");
    }

    #[test]
    fn sliding_reaches_both_ends_and_comes_back() {
        for value in [0.25, 1.0, 2.0, 16.0] {
            assert!((RATE.at_share(RATE.share(value)) - value).abs() < 1e-12);
        }
        assert_eq!(RATE.share(2.0), 0.5);
        assert_eq!(RATE.tidy(1.234_567, 100.0), 1.23);
    }

    #[test]
    fn numbers_are_short() {
        let formatted = [0.0, 1.5, 1.0 / 3.0, 123_456.78, 0.002, 1e-6, 1e30, -40.0].map(format);
        assert_eq!(formatted, ["0", "1.5", "0.333333", "123457", "0.002", "1e-6", "1e30", "-40"]);
    }
}
