//! What flows through connections, shown without changing or running anything that was not needed anyway.

mod digest;
mod geometry;
pub(crate) mod image;
mod judgement;
mod latest;
mod probe;
mod statistics;
pub(crate) mod text;
mod volume;

pub use judgement::Judgement;
pub use probe::{Pixel, Reading};
pub use statistics::{ChannelStatistics, Statistics, statistics};

use std::sync::{Arc, Mutex};

use rayloom_gpu::{GpuError, PipelineCache};
use rayloom_network::{Address, Readiness, readiness};
use rayloom_processors::{Data, Image, VolumeData};

use crate::pane::Pane;
use crate::session::Session;
use crate::theme;
use digest::Digest;
use latest::Latest;

/// What is known about the data that is looked at.
#[derive(Default)]
pub struct Inspection {
    pipelines: Arc<Mutex<PipelineCache>>,
    statistics: Latest<Address, Image, Result<Statistics, GpuError>>,
    digests: Latest<usize, VolumeData, Digest>,
    readings: Latest<String, Pixel, Result<Reading, GpuError>>,
    judge: judgement::Judge,
}

impl Inspection {
    /// To be called once a frame: forgets what is no longer looked at.
    pub fn end_frame(&mut self) {
        self.statistics.end_frame();
        self.digests.end_frame();
        self.readings.end_frame();
        self.judge.end_frame();
    }
}

impl Session {
    /// Numbers about the image on an outport: the newest there are, which may be about the image just before this one.
    pub fn statistics(
        &mut self,
        context: &egui::Context,
        outport: &Address,
        image: &Arc<Image>,
    ) -> Option<Arc<Result<Statistics, GpuError>>> {
        let (gpu, pipelines) = (self.display.gpu().clone(), self.inspection.pipelines.clone());
        let compute = move |image: Arc<Image>| statistics(&gpu, &pipelines, &image);
        self.inspection.statistics.get(outport, image, context, compute)
    }

    /// What a pixel holds: the newest reading for whoever asks, which may be of the pixel asked for before.
    pub fn reading(
        &mut self,
        context: &egui::Context,
        who: &str,
        pixel: &Arc<Pixel>,
    ) -> Option<Arc<Result<Reading, GpuError>>> {
        let gpu = self.display.gpu().clone();
        self.inspection.readings.get(&who.to_owned(), pixel, context, move |pixel| Reading::of(&gpu, &pixel))
    }

    /// A volume in brief, once it has been looked at.
    fn digest(&mut self, context: &egui::Context, data: &Arc<VolumeData>) -> Option<Arc<Digest>> {
        let features = self.display.gpu().features;
        let key = Arc::as_ptr(data) as usize;
        self.inspection.digests.get(&key, data, context, move |data| Digest::new(&data, features))
    }
}

/// What flows from an outport, for a tooltip: live, and computed if it was not needed so far. The key P pins it as a pane (a
/// button could not be reached: the tooltip keeps its distance from the pointer).
pub fn hover(ui: &mut egui::Ui, session: &mut Session, outport: &Address) {
    session.watched.insert(outport.clone());
    ui.spacing_mut().item_spacing = egui::vec2(6.0, 4.0);
    ui.horizontal(|ui| {
        heading(ui, session, outport);
        ui.weak("P pins it");
        let typing = ui.ctx().text_edit_focused();
        if !typing && ui.input(|input| input.key_pressed(egui::Key::P) && input.modifiers.is_none()) {
            session.to_open.push(Pane::Inspector(outport.clone()));
        }
    });
    show(ui, session, outport);
}

/// What flows from an outport, or why nothing does.
pub(crate) fn show(ui: &mut egui::Ui, session: &mut Session, outport: &Address) {
    match session.engine.results.outputs.get(outport).cloned() {
        Some(data) => content(ui, session, outport, &data),
        None => absence(ui, session, outport),
    }
}

fn content(ui: &mut egui::Ui, session: &mut Session, outport: &Address, data: &Data) {
    match data {
        Data::Image(image) => image::show(ui, session, outport, image),
        Data::Volume(volume) => volume::show(ui, session, volume),
        Data::Geometry(mesh) => geometry::show(ui, outport, mesh),
    }
}

/// The address, in the colour of its type.
pub(crate) fn heading(ui: &mut egui::Ui, session: &Session, outport: &Address) {
    let declared = session.network().processor(&outport.processor).and_then(|processor| processor.declaration());
    let port = declared.and_then(|declaration| declaration.outport(&outport.item));
    ui.horizontal(|ui| {
        if let Some(port) = port {
            let (dot, _) = ui.allocate_exact_size(egui::Vec2::splat(10.0), egui::Sense::hover());
            ui.painter().circle_filled(dot.center(), 4.0, theme::port_color(port.port_type));
        }
        ui.strong(outport.to_string());
    });
}

/// Why there is nothing on an outport.
fn absence(ui: &mut egui::Ui, session: &Session, outport: &Address) {
    let report = &session.engine.results.report;
    let id = &outport.processor;
    ui.set_max_width(320.0);
    if let Some(error) = report.failed.get(id) {
        theme::colored(ui, theme::ERROR, format!("{id} failed: {error}"));
        return;
    }
    let reasons = match (report.not_ready.get(id), readiness(session.network(), id)) {
        (Some(reasons), _) => reasons.clone(),
        (None, Readiness::NotReady(reasons)) => reasons,
        (None, Readiness::Ready) => Vec::new(),
    };
    for reason in &reasons {
        theme::colored(ui, theme::WARNING, reason);
    }
    if reasons.is_empty() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.weak("being computed...");
        });
    }
}
