//! The welcome page: shipped networks with their pictures, recent files, an empty network.

mod window;

use std::path::{Path, PathBuf};

use egui_kittest::kittest::Queryable;
use rayloom_studio::{Folders, Options};
use window::{keep_picture, project, studio, wait_for, wait_until};

/// Two networks that need no data.
fn shipped(folder: &Path) -> PathBuf {
    let networks = folder.join("networks");
    std::fs::create_dir_all(networks.join("apps")).expect("made");
    std::fs::copy(project("networks/hydrogen.json"), networks.join("hydrogen.json")).expect("copied");
    std::fs::copy(project("networks/marschner_lobb.json"), networks.join("apps/signal.json")).expect("copied");
    std::fs::write(networks.join("broken.json"), "{").expect("written");
    networks
}

fn pictures(folders: &Folders) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folders.cache.join("thumbnails")).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).collect()
}

#[test]
fn shipped_networks_are_shown_with_pictures_that_are_rendered_once() {
    let home = tempfile::tempdir().expect("a folder");
    let folders = Folders::within(home.path());
    let shipped = shipped(home.path());
    let options =
        Options { folders: Some(folders.clone()), shipped: Some(shipped), welcome: true, ..Options::default() };
    let mut window = studio(options.clone());
    wait_for(&mut window, "Hydrogen orbital");
    wait_for(&mut window, "Marschner-Lobb signal");
    wait_until(&mut window, |_| pictures(&folders).len() == 2);
    window.run_steps(4);
    keep_picture(&mut window, "welcome");
    let rendered = |folders: &Folders| {
        let picture = pictures(folders).into_iter().next().expect("a picture");
        std::fs::metadata(picture).and_then(|facts| facts.modified()).expect("a time")
    };
    let first = rendered(&folders);
    window.get_by_label("Hydrogen orbital").click();
    wait_until(&mut window, |studio| studio.session.network().name == "Hydrogen orbital");
    wait_for(&mut window, "Properties");
    assert!(window.query_by_label("New network").is_none(), "the page is over the network");
    drop(window);
    let mut window = studio(options);
    wait_for(&mut window, "Hydrogen orbital");
    wait_for(&mut window, "hydrogen.json");
    assert_eq!((pictures(&folders).len(), rendered(&folders)), (2, first), "a picture was rendered again");
    window.get_by_label("New network").click();
    wait_for(&mut window, "The network is empty");
}

#[test]
fn a_volume_dropped_on_the_page_becomes_a_source() {
    let mut window = studio(Options { welcome: true, ..Options::default() });
    wait_for(&mut window, "are not beside the program");
    window::drop_file(&mut window, &project("data/brainsmall.volume.json"));
    wait_until(&mut window, |studio| studio.session.network().processors().count() == 1);
}
