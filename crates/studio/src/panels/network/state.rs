//! How a processor is doing, in a colour and in words.

use std::time::Duration;

use egui::{Color32, RichText, Ui};
use rayloom_network::{Processor, PropertyKind, Readiness, Run, readiness};

use crate::session::Session;
use crate::theme;

/// How a processor is doing.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    /// Its result is there.
    Ready,
    /// It is at work; how far, 0 to 1.
    Running(f32),
    /// Nothing needs its result.
    Idle,
    /// It cannot run yet, for these reasons.
    Waiting(Vec<String>),
    /// It failed.
    Failed(String),
}

impl State {
    /// The state of a processor as of the last evaluation. `open`: whether a required inport is not connected now.
    pub fn of(session: &Session, id: &str, open: bool) -> Self {
        let engine = &session.engine;
        let report = &engine.results.report;
        if let Some(progress) = engine.progress.get(id) {
            return Self::Running(progress.done as f32 / progress.total.max(1) as f32);
        }
        if let Some(error) = report.failed.get(id) {
            return Self::Failed(error.to_string());
        }
        if let Some(reasons) = report.not_ready.get(id) {
            return Self::Waiting(reasons.clone());
        }
        let ran = engine.results.runs.contains_key(id);
        if ran && !open {
            return Self::Ready;
        }
        // Following the whole chain takes time in a large network, so only where the evaluation had nothing to say.
        match readiness(session.network(), id) {
            Readiness::NotReady(reasons) => Self::Waiting(reasons),
            Readiness::Ready if ran => Self::Ready,
            Readiness::Ready => Self::Idle,
        }
    }

    /// The colour of its mark.
    pub fn color(&self) -> Color32 {
        match self {
            Self::Ready => theme::READY,
            Self::Running(_) => theme::port_color(rayloom_network::PortType::Image(rayloom_network::ImageKind::Color)),
            Self::Idle => Color32::from_gray(0x80),
            Self::Waiting(_) => theme::WARNING,
            Self::Failed(_) => theme::ERROR,
        }
    }

    /// One word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Ready => "ready",
            Self::Running(_) => "running",
            Self::Idle => "idle",
            Self::Waiting(_) => "waiting",
            Self::Failed(_) => "failed",
        }
    }
}

/// Milliseconds or seconds, short.
pub fn short(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1e3;
    match ms {
        _ if ms < 0.1 => "<0.1 ms".into(),
        _ if ms < 10.0 => format!("{ms:.1} ms"),
        _ if ms < 1000.0 => format!("{ms:.0} ms"),
        _ => format!("{:.1} s", ms * 1e-3),
    }
}

/// The time that a run took where it took longest.
pub fn cost(run: &Run) -> Duration {
    run.gpu.map_or(run.cpu, |gpu| gpu.max(run.cpu))
}

/// What resting on a node shows: what it is, how it is doing and what to do about that, its last run.
pub fn tooltip(ui: &mut Ui, session: &Session, id: &str) {
    ui.set_max_width(360.0);
    let Some(processor) = session.network().processor(id) else { return };
    let kind = processor.declaration().map_or(processor.type_id(), |declaration| declaration.label.as_str());
    ui.horizontal(|ui| {
        ui.strong(id);
        ui.weak(kind);
    });
    if let Some(declaration) = processor.declaration() {
        ui.label(&declaration.help);
    }
    ui.separator();
    let state = State::of(session, id, true);
    match &state {
        State::Waiting(reasons) => {
            for reason in reasons {
                ui.colored_label(state.color(), reason);
            }
        }
        State::Failed(error) => drop(ui.colored_label(state.color(), error)),
        State::Running(part) => drop(ui.colored_label(state.color(), format!("running, {:.0} %", part * 100.0))),
        State::Idle => drop(ui.label("Idle: no canvas or export needs its result.")),
        State::Ready => {}
    }
    for advice in advice(session, processor) {
        ui.label(RichText::new(advice).italics());
    }
    if let Some(run) = session.engine.results.runs.get(id) {
        last_run(ui, run);
    }
}

fn last_run(ui: &mut Ui, run: &Run) {
    let gpu = run.gpu.map_or_else(|| "GPU not measured".to_owned(), |gpu| format!("GPU {}", short(gpu)));
    ui.label(format!("CPU {}, {gpu}", short(run.cpu)));
    ui.weak(format!("ran last because: {}", run.why()));
    for note in &run.notes {
        ui.weak(note);
    }
}

/// What the user can do about a processor that waits.
fn advice(session: &Session, processor: &Processor) -> Vec<String> {
    let Some(declaration) = processor.declaration() else {
        return vec!["Replace it by a processor of a known type (context menu).".into()];
    };
    let connected = |inport: &str| session.network().inputs(processor.id()).any(|wire| wire.to.item == inport);
    let open = declaration.inports.iter().filter(|port| !port.optional && !connected(&port.id));
    let mut advice: Vec<String> = open
        .map(|port| {
            let types = port.accepts.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ");
            format!("Drag a wire from an output that gives {types} to `{}`.", port.label)
        })
        .collect();
    let values = processor.properties();
    let files = processor.property_decls().into_iter().filter(|property| {
        matches!(property.kind, PropertyKind::File { required: true, .. }) && values.text(&property.id) == Ok("")
    });
    advice.extend(files.map(|property| format!("Choose `{}` in its properties.", property.label)));
    advice
}
