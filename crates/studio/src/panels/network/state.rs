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
    /// It is at work; how far, 0 to 1, if it tells.
    Running(Option<f32>),
    /// Nothing needs its result, so it has not run.
    Idle,
    /// It has a result, but what goes into it changed since, and nothing needs it.
    Stale,
    /// It cannot run yet.
    Waiting,
    /// It failed.
    Failed(String),
}

impl State {
    /// The state of a processor as of the last evaluation. `waits`: whether it cannot run now.
    pub fn of(session: &Session, id: &str, waits: bool) -> Self {
        let engine = &session.engine;
        let report = &engine.results.report;
        if let Some(progress) = engine.progress.get(id) {
            return Self::Running(Some(progress.done as f32 / progress.total.max(1) as f32));
        }
        if engine.running.as_deref() == Some(id) {
            return Self::Running(None);
        }
        match report.failed.get(id) {
            Some(error) => Self::Failed(error.to_string()),
            None if waits || report.not_ready.contains_key(id) => Self::Waiting,
            None if report.stale.contains(id) => Self::Stale,
            None if engine.results.runs.contains_key(id) => Self::Ready,
            None => Self::Idle,
        }
    }

    /// The colour of its mark.
    pub fn color(&self) -> Color32 {
        match self {
            Self::Ready => theme::READY,
            Self::Running(_) => theme::port_color(rayloom_network::PortType::Image(rayloom_network::ImageKind::Color)),
            Self::Idle => Color32::from_gray(0x80),
            Self::Stale => theme::STALE,
            Self::Waiting => theme::WARNING,
            Self::Failed(_) => theme::ERROR,
        }
    }

    /// One word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Ready => "ready",
            Self::Running(_) => "running",
            Self::Idle => "idle",
            Self::Stale => "stale",
            Self::Waiting => "waiting",
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
    let reasons = reasons(session, id);
    let state = State::of(session, id, !reasons.is_empty());
    match &state {
        State::Waiting => {
            for reason in reasons {
                ui.colored_label(state.color(), reason);
            }
        }
        State::Failed(error) => drop(theme::report(ui, theme::ERROR, error)),
        State::Running(part) => {
            let far = part.map(|part| format!(", {:.0} %", part * 100.0)).unwrap_or_default();
            ui.colored_label(state.color(), format!("running{far}"));
        }
        State::Idle => drop(ui.label("Idle: no canvas in sight and no export needs its result.")),
        State::Stale => drop(ui.colored_label(
            state.color(),
            "Stale: what goes into it changed since it ran, and no canvas in sight and no export needs it now.",
        )),
        State::Ready => {}
    }
    for advice in advice(session, processor) {
        ui.label(RichText::new(advice).italics());
    }
    if let Some(run) = session.engine.results.runs.get(id) {
        last_run(ui, run);
    }
}

/// Why a processor waits: what data brought to light, else what the network says.
fn reasons(session: &Session, id: &str) -> Vec<String> {
    match (session.engine.results.report.not_ready.get(id), readiness(session.network(), id)) {
        (_, Readiness::NotReady(reasons)) => reasons,
        (Some(reasons), Readiness::Ready) => reasons.clone(),
        (None, Readiness::Ready) => Vec::new(),
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
