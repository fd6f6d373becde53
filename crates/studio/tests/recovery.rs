//! Changes survive a program that is killed, and belong to one program at a time.

mod window;

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_kittest::kittest::Queryable;
use rayloom_network::Network;
use rayloom_studio::{Abandoned, Document, Folders, Options, Recovery};
use window::{keep_picture, studio, wait_for, wait_until};

/// Says where the program that is to be killed keeps its copy.
const FOLDER: &str = "RAYLOOM_TEST_RECOVERY";

/// What the killed program was editing.
const ORIGINAL: &str = "/somewhere/head.json";

fn edited() -> Document {
    let network = Network::new(Arc::new(rayloom_processors::registry()));
    let mut document = Document::unsaved(network, Some(ORIGINAL.into()));
    document.edit("add", |network| network.add("canvas", "precious")).expect("added");
    document
}

#[test]
#[ignore = "the program that the other test starts and kills"]
fn victim() {
    let folder = std::env::var_os(FOLDER).expect("a folder");
    let mut recovery = Recovery::start(Path::new(&folder)).expect("a place");
    recovery.follow(&edited());
    std::thread::sleep(Duration::from_secs(300));
}

fn copies(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter(|entry| entry.path().extension().is_some_and(|extension| extension == "json")).count()
}

#[test]
fn changes_of_a_killed_program_are_offered_once_and_recovered() {
    let home = tempfile::tempdir().expect("a folder");
    let folders = Folders::within(home.path());
    let folder = folders.state.join("recovery");
    let mut victim = Command::new(std::env::current_exe().expect("this test"))
        .args(["--exact", "victim", "--ignored"])
        .env(FOLDER, &folder)
        .stdout(Stdio::null())
        .spawn()
        .expect("started");
    let start = Instant::now();
    while copies(&folder) == 0 {
        assert!(start.elapsed() < Duration::from_secs(60), "no copy is written");
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(Abandoned::find(&folder).0.is_empty(), "taken from a program that runs");
    // SIGKILL on Unix: nothing of the program runs after it.
    victim.kill().expect("killed");
    victim.wait().expect("ended");

    let options = Options { folders: Some(folders), ..Options::default() };
    let mut window = studio(options.clone());
    wait_for(&mut window, "ended with unsaved changes of head.json");
    keep_picture(&mut window, "recovery");
    let other = Abandoned::find(&folder);
    assert!(other.0.is_empty() && other.1.is_empty(), "offered to two programs");
    window.get_by_label("Recover").click();
    wait_until(&mut window, |studio| studio.session.network().processor("precious").is_some());
    let document = &window.state().session.document;
    assert!(document.is_modified() && document.path() == Some(Path::new(ORIGINAL)));
    // Ended again without saving: still there. This time it is not wanted.
    drop(window);
    assert_eq!(copies(&folder), 1);
    let mut window = studio(options);
    wait_for(&mut window, "ended with");
    window.get_by_label("Discard").click();
    window.run_steps(4);
    assert!(window.query_by_label_contains("ended with").is_none());
    drop(window);
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 0, "something is left behind");
}

#[test]
fn a_copy_lasts_as_long_as_there_are_changes() {
    let home = tempfile::tempdir().expect("a folder");
    let mut recovery = Recovery::start(home.path()).expect("a place");
    let mut document = edited();
    recovery.follow(&document);
    let wait = |wanted: usize| {
        let start = Instant::now();
        while copies(home.path()) != wanted {
            assert!(start.elapsed() < Duration::from_secs(60), "there are {} copies", copies(home.path()));
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    wait(1);
    let network = document.network().clone();
    document.saved_as(ORIGINAL.into(), &network);
    recovery.follow(&document);
    wait(0);
    // What is nearly written is written when the program ends, so that a crash between two writes loses nothing.
    document.undo();
    recovery.follow(&document);
    drop(recovery);
    let found = Abandoned::find(home.path()).0;
    let recovered = found[0].document(&Arc::new(rayloom_processors::registry())).expect("a network");
    assert_eq!(recovered.text(), document.text());
}

#[test]
fn a_broken_copy_is_told_and_the_window_opens() {
    let home = tempfile::tempdir().expect("a folder");
    let folders = Folders::within(home.path());
    let folder = folders.state.join("recovery");
    std::fs::create_dir_all(&folder).expect("made");
    std::fs::write(folder.join("1-2.json"), "{\"network\": \"").expect("written");
    let mut window = studio(Options { folders: Some(folders), ..Options::default() });
    wait_for(&mut window, "this copy of unsaved changes cannot be read");
}
