//! Pictures of canvases at any size, as files.

use std::path::{Path, PathBuf};

use egui::{Button, ComboBox, Context, DragValue, Frame, Grid, Id, Key, Modal, RichText};
use rayloom_network::Processor;
use rayloom_processors::types::CANVAS;
use rayloom_processors::write_picture;

use crate::dialogs::{Dialogs, Question};
use crate::session::{Session, Severity};

/// The largest side of a picture, pixels; devices have no larger textures.
const LARGEST: u32 = 16384;

/// The formats that pictures are written in, the first by default.
const EXTENSIONS: [&str; 3] = ["png", "exr", "npy"];

/// The dialog, and the pictures on their way into files.
#[derive(Default)]
pub struct Screenshot {
    opening: bool,
    form: Option<Form>,
    dialogs: Dialogs<Result<PathBuf, String>>,
}

/// What is to be rendered.
struct Form {
    canvas: String,
    size: [u32; 2],
}

impl Screenshot {
    /// Whether there is anything to make a picture of.
    pub fn has_canvas(session: &Session) -> bool {
        canvases(session).next().is_some()
    }

    /// Opens the dialog for the first canvas in sight, at the size that it has there.
    pub fn open(&mut self) {
        self.opening = true;
    }

    /// To be called after the panels, which tell their sizes: shows the dialog while it is open, and tells what became of the pictures.
    pub fn show(&mut self, context: &Context, session: &mut Session) {
        let who = Id::new("screenshot");
        match self.dialogs.answer(who) {
            None => {}
            Some(Ok(path)) => session.tell(Severity::Note, format!("saved {}", path.display())),
            Some(Err(error)) => session.tell(Severity::Error, error),
        }
        if std::mem::take(&mut self.opening) {
            let in_sight = session.shown.keys().next().map(String::as_str);
            let first = in_sight.or_else(|| canvases(session).next()).map(str::to_owned);
            self.form = first.map(|canvas| Form { size: size_of(session, &canvas), canvas });
        }
        let Some(form) = &mut self.form else { return };
        match form.show(context, session) {
            None => return,
            Some(false) => {}
            Some(true) => form.save(who, context, session, &mut self.dialogs),
        }
        self.form = None;
    }
}

impl Form {
    /// Shows itself; whether to go on, once that is decided.
    fn show(&mut self, context: &Context, session: &Session) -> Option<bool> {
        let mut decision = None;
        let frame = Frame::popup(&context.global_style()).inner_margin(20.0);
        let modal = Modal::new(Id::new("picture of a canvas")).frame(frame).show(context, |ui| {
            ui.set_width(320.0);
            ui.label(RichText::new("Picture of a canvas").heading());
            ui.add_space(8.0);
            Grid::new("picture").num_columns(2).spacing([16.0, 8.0]).show(ui, |ui| {
                ui.label("Canvas");
                let before = self.canvas.clone();
                ComboBox::from_id_salt("canvas").selected_text(&self.canvas).show_ui(ui, |ui| {
                    for id in canvases(session) {
                        ui.selectable_value(&mut self.canvas, id.to_owned(), id);
                    }
                });
                if self.canvas != before {
                    self.size = size_of(session, &self.canvas);
                }
                ui.end_row();
                for (label, pixels) in ["Width", "Height"].into_iter().zip(&mut self.size) {
                    let label = ui.label(label).id;
                    ui.add(DragValue::new(pixels).range(1..=LARGEST).suffix(" pixels")).labelled_by(label);
                    ui.end_row();
                }
            });
            ui.add_space(12.0);
            ui.horizontal(|ui| {
                let save = ui.add(Button::new("Save...").fill(ui.visuals().selection.bg_fill));
                if save.clicked() || ui.input(|input| input.key_pressed(Key::Enter)) {
                    decision = Some(true);
                }
                if ui.button("Cancel").clicked() {
                    decision = Some(false);
                }
            });
        });
        decision.or_else(|| modal.should_close().then_some(false))
    }

    /// Asks for a file, then renders and writes the picture, away from the window's thread.
    fn save(&self, who: Id, context: &Context, session: &Session, dialogs: &mut Dialogs<Result<PathBuf, String>>) {
        let (canvas, size) = (self.canvas.clone(), self.size);
        let (photographer, network) = (session.engine.photographer(), session.network().clone());
        let name = format!("{canvas}.{}", EXTENSIONS[0]);
        let question = Question {
            name: "Picture",
            extensions: &EXTENSIONS.map(str::to_owned),
            folder: session.document.path().and_then(Path::parent),
            save_as: Some(&name),
        };
        dialogs.ask(who, context, &session.chooser, &question, move |path| {
            let picture = photographer.picture(network, &canvas, size)?;
            write_picture(&path, &picture).map_err(|error| error.to_string())?;
            Ok(path)
        });
    }
}

fn canvases(session: &Session) -> impl Iterator<Item = &str> {
    session.network().processors().filter(|processor| processor.type_id() == CANVAS).map(Processor::id)
}

/// The size of a canvas in the window, or else the one that it has in the network.
fn size_of(session: &Session, canvas: &str) -> [u32; 2] {
    let own = || {
        let processor = session.network().processor(canvas)?;
        processor.properties().array::<2>("size").ok().map(|size| size.map(|pixels| pixels as u32))
    };
    session.shown.get(canvas).copied().or_else(own).unwrap_or([800, 600])
}
