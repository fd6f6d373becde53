//! A window without a screen, on the real device with the real evaluator.

#![allow(dead_code, reason = "every test program uses its own part")]

pub mod nodes;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use rayloom_studio::{Options, Session, Studio};

/// Longest time that anything may take on a slow device.
const PATIENCE: Duration = Duration::from_secs(120);

/// A piece of the window: one function that shows something of a session.
pub struct Piece<F> {
    /// The session's owner.
    pub studio: Studio,
    show: F,
}

impl<F: FnMut(&mut egui::Ui, &mut Session)> eframe::App for Piece<F> {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        let session = &mut self.studio.session;
        session.begin_frame();
        egui::CentralPanel::default().show(ui, |ui| (self.show)(ui, session));
        session.end_frame(ui.ctx());
    }
}

/// A file of the project.
pub fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

fn builder<T: eframe::App>() -> egui_kittest::HarnessBuilder<T> {
    Harness::builder().with_size([1280.0, 800.0]).with_step_dt(1.0 / 60.0).wgpu_setup(rayloom_studio::wgpu_setup())
}

/// A piece of the window with a network open.
pub fn harness<F: FnMut(&mut egui::Ui, &mut Session) + 'static>(network: &str, show: F) -> Harness<'static, Piece<F>> {
    let options = Options { network: Some(project(network)), ..Options::default() };
    builder().build_eframe(move |creation| Piece { studio: Studio::new(creation, &options).expect("a studio"), show })
}

/// The whole window.
pub fn studio(options: Options) -> Harness<'static, Studio> {
    builder().build_eframe(move |creation| {
        let mut studio = Studio::new(creation, &options).expect("a studio");
        // Tests that are not about it need not wait for the pictures that it takes.
        studio.session.estimating = false;
        studio
    })
}

/// Frames until something is labelled so.
pub fn wait_for<T>(harness: &mut Harness<'_, T>, label: &str) {
    let start = Instant::now();
    while harness.query_all_by_label_contains(label).next().is_none() {
        assert!(start.elapsed() < PATIENCE, "nothing says `{label}`");
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Frames until nothing is labelled so.
pub fn wait_while<T>(harness: &mut Harness<'_, T>, label: &str) {
    let start = Instant::now();
    while harness.query_all_by_label_contains(label).next().is_some() {
        assert!(start.elapsed() < PATIENCE, "something still says `{label}`");
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Writes what is on the window for people to look at.
pub fn keep_picture<T>(harness: &mut Harness<'_, T>, name: &str) {
    let picture = harness.render().expect("a picture");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("studio");
    std::fs::create_dir_all(&folder).expect("a folder");
    picture.save(folder.join(format!("{name}.png"))).expect("saved");
}

/// The flagship network in development mode.
pub fn flagship() -> Options {
    Options { network: Some(project("networks/brain.json")), ..Options::default() }
}

/// Frames until something holds.
pub fn wait_until<T>(harness: &mut Harness<'_, T>, holds: impl Fn(&T) -> bool) {
    let start = Instant::now();
    while !holds(harness.state()) {
        assert!(start.elapsed() < PATIENCE, "waited for too long");
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Runs a test in a program of its own with an empty folder of snippets: there its path is returned, here nothing once that run
/// is over. (The folder is named by the environment.)
pub fn alone_with_snippets(test: &str) -> Option<PathBuf> {
    const FOLDER: &str = "RAYLOOM_SNIPPETS";
    const INSIDE: &str = "RAYLOOM_SNIPPETS_OF_TEST";
    if std::env::var_os(INSIDE).is_some() {
        return std::env::var_os(FOLDER).map(PathBuf::from);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let program = std::env::current_exe().expect("a program");
    let mut run = std::process::Command::new(program);
    run.args([test, "--exact"]).envs([(FOLDER, folder.path().as_os_str()), (INSIDE, "1".as_ref())]);
    let output = run.output().expect("it runs");
    let said = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success() && said[0].contains("1 passed"), "{}", said.concat());
    None
}

/// Drops a file from the desktop onto the window.
pub fn drop_file<T>(harness: &mut Harness<'_, T>, path: &Path) {
    harness.input_mut().dropped_files.push(Arc::new(Dropped(path.to_owned())));
    harness.run_steps(3);
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}
