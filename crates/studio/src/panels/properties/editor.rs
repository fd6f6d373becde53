//! The editor of a value, by the kind of its property.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Color32, Ui};
use rayloom_network::{Address, Network, ProcessError, Properties, PropertyDecl, PropertyKind, Value};
use rayloom_volume::Volume;

use super::action::Action;
use super::exchange::Exchanged;
use super::histograms::Histograms;
use super::number::{Entered, Number};
use super::{camera, choice, file, labels, light, shader_text, text, transfer_function, transfer_function_2d, vector};
use crate::dialogs::{Chooser, Dialogs};
use crate::probe::Mark;
use crate::theme;

/// How long it is told why a number was refused.
const COMPLAINT_SHOWN: Duration = Duration::from_secs(8);

/// Ends beyond this are no help to a slider.
const ENDLESS: f64 = 1e9;

/// What editors remember from frame to frame.
#[derive(Default)]
pub(super) struct Tools {
    /// Histograms of the volumes seen.
    pub histograms: Histograms,
    /// Open dialogs that ask for a file.
    pub dialogs: Dialogs<PathBuf>,
    /// Values on their way from or to files.
    pub exchanges: Dialogs<Exchanged>,
    /// Transfer function editors.
    pub curves: BTreeMap<Address, transfer_function::State>,
    /// Editors of 2-D transfer functions.
    pub planes: BTreeMap<Address, transfer_function_2d::State>,
    /// Values that are edited as text.
    pub texts: BTreeMap<Address, String>,
    /// Texts that are not applied yet.
    pub drafts: BTreeMap<Address, String>,
    /// What was wrong with what was typed last.
    complaints: BTreeMap<Address, (String, Instant)>,
}

impl Tools {
    /// Takes in what was computed or chosen meanwhile.
    pub fn begin_frame(&mut self, context: &egui::Context) {
        self.histograms.listen(context);
    }
}

/// What an editor may know and do.
pub(super) struct Surroundings<'a> {
    /// The processor that the property belongs to.
    pub processor: &'a str,
    /// The network.
    pub network: &'a Network,
    /// All properties of the processor.
    pub properties: &'a Properties,
    /// The volume that flows into the processor.
    pub volume: Option<Arc<Volume>>,
    /// The sample that the ray probe points at.
    pub marker: Option<Mark>,
    /// Why the processor failed.
    pub failure: Option<&'a ProcessError>,
    /// The folder of the network file.
    pub folder: Option<&'a Path>,
    /// Whom to ask for files.
    pub chooser: &'a Chooser,
    /// Whether the user edits the network, not only values.
    pub authoring: bool,
    /// What editors remember.
    pub tools: &'a mut Tools,
    /// What the user did.
    pub actions: &'a mut Vec<Action>,
}

impl Surroundings<'_> {
    /// The address of a property.
    pub fn address(&self, decl: &PropertyDecl) -> Address {
        Address::new(self.processor, &decl.id)
    }

    /// A number as entered; says what is wrong with a bad one below the row.
    pub fn number(&mut self, decl: &PropertyDecl, entered: Entered) -> Option<f64> {
        let address = self.address(decl);
        match entered {
            Entered::Nothing => None,
            Entered::Value(value) => {
                self.tools.complaints.remove(&address);
                Some(value)
            }
            Entered::Bad(why) => {
                self.tools.complaints.insert(address, (why, Instant::now()));
                None
            }
        }
    }

    /// The channel of the volume that the processor looks at.
    pub fn channel(&self, volume: &Volume) -> u32 {
        crate::upstream::channel(volume, self.properties.int("channel").ok())
    }
}

/// Shows the editor of a property; the new value if the user gave one.
pub(super) fn show(
    ui: &mut Ui,
    decl: &PropertyDecl,
    value: &Value,
    surroundings: &mut Surroundings<'_>,
) -> Option<Value> {
    let width = ui.available_width();
    match (&decl.kind, value) {
        (PropertyKind::Bool, Value::Bool(on)) => yes_or_no(ui, decl, *on),
        (PropertyKind::Int { range, unit }, Value::Int(number)) => {
            let range = range.map(|end| end as f64);
            let field =
                Number { label: &decl.label, range, slider: finite(range), unit, logarithmic: false, whole: true };
            let entered = field.show(ui, *number as f64, width);
            surroundings.number(decl, entered).map(|number| Value::Int(number as i64))
        }
        (PropertyKind::Float { range, unit, logarithmic }, Value::Float(number)) => {
            let slider = finite(*range).or_else(|| data_range(unit, surroundings));
            let field =
                Number { label: &decl.label, range: *range, slider, unit, logarithmic: *logarithmic, whole: false };
            let entered = field.show(ui, *number, width);
            surroundings.number(decl, entered).map(Value::Float)
        }
        (PropertyKind::Vector { .. }, Value::Vector(components)) => vector::show(ui, decl, components, surroundings),
        (PropertyKind::Color, Value::Color(color)) => color_button(ui, &decl.label, *color).map(Value::Color),
        (PropertyKind::Choice { choices }, Value::Text(id)) => choice::show(ui, decl, choices, id).map(Value::Text),
        (PropertyKind::Snippet { slot }, Value::Text(id)) => {
            choice::show(ui, decl, &choice::snippets(slot), id).map(Value::Text)
        }
        (PropertyKind::Text { multiline }, Value::Text(content)) => {
            text::show(ui, decl, content, *multiline, surroundings).map(Value::Text)
        }
        (PropertyKind::File { .. }, Value::Text(path)) => file::show(ui, decl, path, surroundings).map(Value::Text),
        (PropertyKind::Camera, Value::Camera(camera)) => {
            camera::show(ui, decl, camera, surroundings).map(Value::Camera)
        }
        (PropertyKind::Light, Value::Light(light)) => light::show(ui, decl, light, surroundings).map(Value::Light),
        (PropertyKind::TransferFunction, Value::TransferFunction(function)) => {
            transfer_function::show(ui, decl, function, surroundings).map(Value::TransferFunction)
        }
        (PropertyKind::TransferFunction2D, Value::TransferFunction2D(function)) => {
            transfer_function_2d::show(ui, decl, function, surroundings).map(Value::TransferFunction2D)
        }
        (PropertyKind::ShaderText { .. }, Value::Text(own)) => {
            shader_text::show(ui, decl, own, surroundings).map(Value::Text)
        }
        (PropertyKind::Labels, Value::Labels(table)) => labels::show(ui, decl, table, surroundings).map(Value::Labels),
        // Values are checked against their declarations before they get here.
        _ => None,
    }
}

/// Says what was wrong with what was typed last.
pub(super) fn complaint(ui: &Ui, decl: &PropertyDecl, row: egui::Rect, surroundings: &mut Surroundings<'_>) {
    let address = surroundings.address(decl);
    let Some((why, since)) = surroundings.tools.complaints.get(&address) else { return };
    let rest = COMPLAINT_SHOWN.checked_sub(since.elapsed());
    let Some(rest) = rest.filter(|_| !ui.input(|input| input.pointer.any_pressed())) else {
        surroundings.tools.complaints.remove(&address);
        return;
    };
    ui.ctx().request_repaint_after(rest);
    ui.painter().rect_stroke(row, 3.0, egui::Stroke::new(1.0, theme::ERROR), egui::StrokeKind::Outside);
    // Over the rows below: what moved under the pointer would be hit by mistake.
    egui::Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), ui.id().with("complaint"), row)
        .show(|ui| theme::colored(ui, theme::ERROR, egui::RichText::new(why).size(11.5)));
}

/// What values are possible, in words.
pub(super) fn range_text(kind: &PropertyKind) -> Option<String> {
    let (range, unit) = match kind {
        PropertyKind::Int { range, unit } => (range.map(|end| end as f64), unit),
        PropertyKind::Float { range, unit, .. } | PropertyKind::Vector { range, unit, .. } => (*range, unit),
        _ => return None,
    };
    let [low, high] = range.map(super::number::format);
    let text = match range.map(|end| end.abs() < ENDLESS) {
        [true, true] => format!("{low} to {high} {unit}"),
        [true, false] => format!("from {low} {unit}"),
        [false, true] => format!("up to {high} {unit}"),
        [false, false] => unit.clone(),
    };
    Some(text.trim().to_owned()).filter(|text| !text.is_empty())
}

fn finite(range: [f64; 2]) -> Option<[f64; 2]> {
    range.iter().all(|end| end.abs() < ENDLESS).then_some(range)
}

/// The range of the volume, for parameters in its unit.
fn data_range(unit: &str, surroundings: &Surroundings<'_>) -> Option<[f64; 2]> {
    let volume = surroundings.volume.as_ref().filter(|_| unit == "value")?;
    let range = volume.ranges().get(surroundings.channel(volume) as usize)?;
    (range.max > range.min).then_some([range.min, range.max])
}

fn yes_or_no(ui: &mut Ui, decl: &PropertyDecl, on: bool) -> Option<Value> {
    let mut on = on;
    let response = ui.add(egui::Checkbox::without_text(&mut on));
    response.widget_info(|| egui::WidgetInfo::selected(egui::WidgetType::Checkbox, true, on, &decl.label));
    response.changed().then_some(Value::Bool(on))
}

/// A button with a colour that opens a picker; the new colour if the user picked one. Straight alpha.
pub(super) fn color_button(ui: &mut Ui, label: &str, color: [f64; 4]) -> Option<[f64; 4]> {
    let bytes = color.map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8);
    let mut picked = bytes;
    let response = ui.color_edit_button_srgba_unmultiplied(&mut picked);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::ColorButton, true, label));
    // What the user did not touch keeps its exact value.
    let merged = std::array::from_fn(|c| if picked[c] == bytes[c] { color[c] } else { f64::from(picked[c]) / 255.0 });
    (picked != bytes).then_some(merged)
}

/// A button with an opaque colour that opens a picker.
pub(super) fn rgb_button(ui: &mut Ui, label: &str, color: [f64; 3]) -> Option<[f64; 3]> {
    let bytes = color.map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8);
    let mut picked = bytes;
    let response = ui.color_edit_button_srgb(&mut picked);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::WidgetType::ColorButton, true, label));
    let merged = std::array::from_fn(|c| if picked[c] == bytes[c] { color[c] } else { f64::from(picked[c]) / 255.0 });
    (picked != bytes).then_some(merged)
}

/// A colour of a transfer function on the screen, opaque.
pub(super) fn screen_color(color: [f64; 3]) -> Color32 {
    let [r, g, b] = color.map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8);
    Color32::from_rgb(r, g, b)
}
