//! The networks that come with the program.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayloom_network::{Network, Registry};

/// A network that comes with the program.
#[derive(Clone)]
pub struct Shipped {
    /// Its file.
    pub path: PathBuf,
    /// What it is called, or else its file.
    pub name: String,
    /// What it shows.
    pub description: String,
    /// Whether it is an application, made for visualization mode.
    pub is_application: bool,
}

/// The folder of the networks: beside the program, in a `networks` or `share/rayloom/networks` of a folder that it lies in, or
/// in the sources that it was built from.
pub fn folder() -> Option<PathBuf> {
    let program = std::env::current_exe().ok();
    let beside = program.iter().flat_map(|program| program.ancestors().skip(1));
    let installed = beside.flat_map(|folder| [folder.join("networks"), folder.join("share/rayloom/networks")]);
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    installed.chain([sources]).find(|folder| folder.join("apps").is_dir())
}

/// The networks in the `apps` of a folder and in itself, by name; files that hold no network are left out. Waits for the disk.
pub fn list(folder: &Path, registry: &Arc<Registry>) -> Vec<(Shipped, Network)> {
    let mut found = Vec::new();
    for (folder, is_application) in [(folder.join("apps"), true), (folder.to_owned(), false)] {
        let mut files: Vec<PathBuf> =
            std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
        files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
        files.sort();
        for path in files {
            let Ok(loaded) = Network::load(&path, registry) else { continue };
            let network = loaded.network;
            let file = path.file_stem().unwrap_or_default().to_string_lossy();
            let name = if network.name.is_empty() { file.into_owned() } else { network.name.clone() };
            found.push((Shipped { path, name, description: network.description.clone(), is_application }, network));
        }
    }
    found
}
