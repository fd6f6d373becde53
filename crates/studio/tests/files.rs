//! Documents and their files: nothing is lost without a question, nothing waits for a dialog or a disk.

mod window;

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use egui::{Key, Modifiers, ViewportCommand, ViewportEvent};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use rayloom_network::Network;
use rayloom_studio::{Chooser, Folders, Mode, Options, Pane, Studio};
use window::{drop_file, keep_picture, project, studio, wait_for, wait_until};

type Window = Harness<'static, Studio>;

/// Answers dialogs with the file that is set, and waits for ever while there is none, as a user may.
#[derive(Clone, Default)]
struct Hand(Arc<Mutex<Option<PathBuf>>>);

impl Hand {
    fn choose(&self, path: &Path) {
        *self.0.lock().expect("a hand") = Some(path.to_owned());
    }

    fn chooser(&self) -> Chooser {
        let chosen = self.0.clone();
        Chooser::new(move |_| match chosen.lock().expect("a hand").clone() {
            Some(path) => Box::pin(std::future::ready(Some(path))),
            None => Box::pin(std::future::pending()),
        })
    }
}

fn add_canvas(window: &mut Window, id: &'static str) {
    let session = &mut window.state_mut().session;
    assert!(session.edit("add", |network: &mut Network| network.add("canvas", id).map(|_| ())));
    window.run_steps(2);
}

fn command(window: &mut Window, key: Key) {
    window.key_press_modifiers(Modifiers::COMMAND, key);
    window.run_steps(3);
}

fn sent(window: &Window, command: &ViewportCommand) -> bool {
    window.output().viewport_output.values().any(|output| output.commands.contains(command))
}

fn processors(studio: &Studio) -> usize {
    studio.session.network().processors().count()
}

#[test]
fn where_the_system_has_no_dialog_a_path_is_typed() {
    let folder = tempfile::tempdir().expect("a folder");
    let nothing = Chooser::new(|_| Box::pin(std::future::ready(None)));
    let mut window = studio(Options { chooser: nothing, ..Options::default() });
    window.run_steps(2);
    for typed in ["", "/nowhere/at/all.json", &tiny(folder.path()).display().to_string()] {
        command(&mut window, Key::O);
        window::wait_for(&mut window, "type the path");
        window.run_steps(2);
        window.event(egui::Event::Text(typed.to_owned()));
        window.run_steps(2);
        window.key_press(if typed.is_empty() { Key::Escape } else { Key::Enter });
        window.run_steps(2);
        window::wait_while(&mut window, "type the path");
        wait_until(&mut window, |studio| {
            let told = studio.session.messages.iter().any(|message| message.text.contains("/nowhere/at/all.json"));
            typed.is_empty() || told
        });
    }
    wait_until(&mut window, |studio| studio.session.network().name == "Tiny");
}

#[test]
fn opening_and_saving_go_through_dialogs_that_the_window_does_not_wait_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let hand = Hand::default();
    let mut window = studio(Options { chooser: hand.chooser(), ..Options::default() });
    window.run_steps(2);
    // A dialog that stays open: the window goes on.
    command(&mut window, Key::O);
    add_canvas(&mut window, "early");
    let file = folder.path().join("mine.json");
    hand.choose(&file);
    command(&mut window, Key::S);
    wait_until(&mut window, |studio| !studio.session.document.is_modified());
    assert_eq!(window.state().session.document.path(), Some(file.as_path()));
    assert!(std::fs::read_to_string(&file).expect("saved").contains("early"));
    add_canvas(&mut window, "late");
    command(&mut window, Key::S);
    wait_until(&mut window, |studio| !studio.session.document.is_modified());
    assert!(std::fs::read_to_string(&file).expect("saved").contains("late"));
    hand.choose(&tiny(folder.path()));
    command(&mut window, Key::O);
    wait_until(&mut window, |studio| studio.session.network().name == "Tiny");
    // What cannot be read is told, and the document stays.
    let broken = folder.path().join("broken.json");
    std::fs::write(&broken, "{\"rayloom\": 1, \"processors\": [").expect("written");
    hand.choose(&broken);
    command(&mut window, Key::O);
    wait_for(&mut window, "this is not JSON");
    assert_eq!(window.state().session.network().name, "Tiny");
    // What cannot be written is told, and the changes stay unsaved.
    add_canvas(&mut window, "last");
    hand.choose(&folder.path().join("nowhere").join("x.json"));
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    wait_for(&mut window, "cannot be saved here");
    assert!(window.state().session.document.is_modified());
}

#[test]
fn leaving_unsaved_changes_asks_to_save_or_discard_or_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("kept.json");
    let hand = Hand::default();
    hand.choose(&file);
    let mut window = studio(Options { chooser: hand.chooser(), ..Options::default() });
    window.run_steps(2);
    add_canvas(&mut window, "a");
    command(&mut window, Key::N);
    wait_for(&mut window, "Save the changes of this network?");
    keep_picture(&mut window, "unsaved_changes");
    window.get_by_label("Cancel").click();
    window.run_steps(3);
    assert_eq!(processors(window.state()), 1);
    command(&mut window, Key::N);
    window.run_steps(2);
    window.get_by_label("Discard").click();
    wait_until(&mut window, |studio| processors(studio) == 0);
    add_canvas(&mut window, "b");
    command(&mut window, Key::N);
    window.run_steps(2);
    window.get_by_label("Save").click();
    wait_until(&mut window, |studio| processors(studio) == 0);
    assert!(std::fs::read_to_string(&file).expect("saved").contains("\"b\""));
    assert!(window.query_by_label_contains("Save the changes").is_none());
}

#[test]
fn the_window_stays_open_until_the_changes_are_decided_about() {
    let mut window = studio(Options::default());
    window.run_steps(2);
    add_canvas(&mut window, "a");
    let close = |window: &mut Window| {
        let id = window.input().viewport_id;
        window.input_mut().viewports.entry(id).or_default().events.push(ViewportEvent::Close);
        window.step();
    };
    close(&mut window);
    assert!(sent(&window, &ViewportCommand::CancelClose), "the window closes with what is not saved");
    window.input_mut().viewports.values_mut().for_each(|viewport| viewport.events.clear());
    wait_for(&mut window, "lost by quitting");
    window.run_steps(2);
    window.get_by_label("Discard").click();
    window.run_steps(3);
    close(&mut window);
    assert!(!sent(&window, &ViewportCommand::CancelClose), "the window does not close although the user decided");
}

#[test]
fn a_dropped_network_opens_and_a_dropped_volume_becomes_a_source() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = studio(Options::default());
    window.run_steps(2);
    drop_file(&mut window, &project("data/brainsmall.volume.json"));
    wait_until(&mut window, |studio| processors(studio) == 1);
    let source = window.state().session.network().processors().next().expect("a source").type_id().to_owned();
    assert_eq!(source, "volume_source");
    window.state_mut().session.document.undo();
    let network = tiny(folder.path());
    drop_file(&mut window, &network);
    wait_until(&mut window, |studio| studio.session.network().name == "Tiny");
    assert_eq!(window.state().session.document.path(), Some(network.as_path()));
}

/// A network file that takes no time to evaluate.
fn tiny(folder: &Path) -> PathBuf {
    let path = folder.join("tiny.json");
    std::fs::write(&path, r#"{"rayloom": 1, "name": "Tiny", "processors": []}"#).expect("written");
    path
}

#[test]
fn the_layout_and_recent_files_come_back_and_broken_settings_are_a_note() {
    let home = tempfile::tempdir().expect("a folder");
    let folders = Folders::within(home.path());
    let options = |network: Option<PathBuf>| Options { network, folders: Some(folders.clone()), ..Options::default() };
    let network = tiny(home.path());
    let mut window = studio(options(Some(network.clone())));
    window.run_steps(2);
    window.state_mut().session.to_open.push(Pane::Budget);
    window.state_mut().session.to_open.push(Pane::Inspector("a.image".parse().expect("an address")));
    window.run_steps(4);
    let list = folders.state.join("recent.json");
    wait_until(&mut window, |_| list.exists());
    drop(window);
    std::fs::remove_file(&network).expect("removed");
    let mut window = studio(options(None));
    window.run_steps(4);
    assert!(window.query_by_label("Frame budget").is_some(), "the panel that was open is not");
    assert!(window.query_by_label("a.image").is_none(), "a panel of another network is open");
    window.get_by_label("File").click();
    window.run_steps(3);
    window.get_by_label_contains("Open recent").hover();
    wait_for(&mut window, "tiny.json");
    assert!(window.get_by_label("tiny.json").accesskit_node().is_disabled(), "a file that is gone can be opened");
    drop(window);
    std::fs::write(folders.config.join("settings.json"), "{\"layout\": 5, \"scale\": 1.25}").expect("written");
    let mut window = studio(options(None));
    wait_for(&mut window, "the layout makes no sense here");
    assert_eq!(window.ctx.zoom_factor(), 1.25, "what makes sense is left out with what does not");
}

#[test]
fn files_that_change_on_the_disk_are_read_again_and_unsaved_changes_are_asked_about() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("watched.json");
    let write = |name: &str| {
        let text = format!(
            r#"{{"rayloom": 1, "name": "{name}", "processors": [
                {{"id": "source", "type": "volume_source", "properties": {{"file": "ball.volume.json"}}}}]}}"#
        );
        std::fs::write(&path, text).expect("written");
    };
    let data = |value: u8| {
        std::fs::write(folder.path().join("ball.raw"), [value; 8]).expect("written");
        let header = format!(r#"{{"raw": "ball.raw", "dims": [2, 2, 2], "type": "u8", "note": {value}}}"#);
        std::fs::write(folder.path().join("ball.volume.json"), header.replace(r#", "note": 1"#, "")).expect("written");
    };
    write("First");
    data(1);
    let mut window = studio(Options { network: Some(path.clone()), ..Options::default() });
    window.run_steps(4);
    // Looked at once before it changes.
    std::thread::sleep(std::time::Duration::from_millis(700));
    write("Second edition");
    wait_until(&mut window, |studio| studio.session.network().name == "Second edition");
    assert!(!window.state().session.document.is_modified());
    add_canvas(&mut window, "mine");
    write("Third");
    wait_for(&mut window, "changed by another program");
    keep_picture(&mut window, "changed_on_disk");
    assert_eq!(window.state().session.network().name, "Second edition");
    window.get_by_label("Take the file's").click();
    wait_until(&mut window, |studio| studio.session.network().name == "Third");
    assert!(window.state_mut().session.document.undo(), "what was replaced is lost");
    assert!(window.state().session.network().processor("mine").is_some());
    data(77);
    wait_for(&mut window, "ball.volume.json changed and is read again");
}

#[test]
fn an_application_opens_as_one_and_other_networks_in_development_mode() {
    for (network, mode) in
        [("networks/apps/mri_viewer.json", Mode::Visualization), ("networks/marschner_lobb.json", Mode::Development)]
    {
        let started = window::studio(Options { network: Some(window::project(network)), ..Options::default() });
        assert_eq!(started.state().session.mode, mode, "{network}");
        let mut dropped = window::studio(Options::default());
        window::drop_file(&mut dropped, &window::project(network));
        window::wait_until(&mut dropped, |studio| studio.session.document.path().is_some());
        assert_eq!(dropped.state().session.mode, mode, "{network}");
    }
}
