//! Opening a network file for a command: loading, warnings, settings.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::Arc;

use rayloom_network::{LoadError, Network, Preset, Warning, closest};
use rayloom_processors::snippet_library;

use crate::args::Setting;
use crate::failure::Failure;

/// Loads a network; what is odd about it is returned with it.
///
/// # Errors
/// The file cannot be read (the closest names in its folder are offered) or holds no network.
pub fn load(file: &Path) -> Result<(Network, Vec<Warning>), Failure> {
    let registry = Arc::new(rayloom_processors::registry());
    let loaded = Network::load(file, &registry).map_err(|error| match error {
        LoadError::Read { .. } if !file.exists() => missing(file),
        other => other.into(),
    })?;
    Ok((loaded.network, loaded.warnings))
}

/// Loads a network, prints its warnings and sets properties in the given order.
///
/// # Errors
/// As [`load`], or a property that does not exist or refuses its value.
pub fn open(file: &Path, settings: &[Setting]) -> Result<Network, Failure> {
    open_with(file, None, settings)
}

/// As [`open`], with a preset of the network applied before properties are set.
///
/// # Errors
/// As [`open`], or a preset that does not exist or that the network refuses.
pub fn open_with(file: &Path, preset: Option<&str>, settings: &[Setting]) -> Result<Network, Failure> {
    let (mut network, warnings) = load(file)?;
    for problem in snippet_library().1.iter() {
        eprintln!("warning: {problem}");
    }
    for warning in warnings {
        eprintln!("warning: {}: {warning}", file.display());
    }
    if let Some(name) = preset {
        let presets = network.presets();
        let preset =
            presets.iter().find(|preset| preset.name == name).ok_or_else(|| no_preset(file, name, &presets))?;
        preset.apply(&mut network).map_err(|error| Failure::new(format!("preset `{name}`: {error}")))?;
    }
    for Setting { property, value } in settings {
        network
            .set_from_json(&property.processor, &property.item, value)
            .map_err(|error| Failure::new(format!("--set {property}: {error}")))?;
    }
    Ok(network)
}

fn no_preset(file: &Path, name: &str, presets: &[Preset]) -> Failure {
    let known: Vec<&str> = presets.iter().map(|preset| preset.name.as_str()).collect();
    let known = if known.is_empty() { "it has none".into() } else { format!("it has {}", known.join(", ")) };
    Failure::new(format!("{}: there is no preset `{name}`; {known}", file.display()))
}

/// The failure that there is no such file, with the networks beside it that it may stand for.
fn missing(file: &Path) -> Failure {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let text = |name: &OsStr| name.to_string_lossy().into_owned();
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Failure::new(format!("{}: there is no such file, nor a folder {}", file.display(), folder.display()));
    };
    let mut names: Vec<String> = entries.flatten().map(|entry| text(&entry.file_name())).collect();
    names.retain(|name| name.ends_with(".json"));
    names.sort();
    let wanted = file.file_name().map(text).unwrap_or_default();
    let near = closest(&wanted, names.iter().map(String::as_str));
    let hint = match (near.is_empty(), names.is_empty()) {
        (false, _) => format!("did you mean {}?", paths(folder, &near).join(" or ")),
        (true, false) => format!("networks there: {}", names.join(", ")),
        (true, true) => "no network is in that folder".to_owned(),
    };
    Failure::new(format!("{}: there is no such network file; {hint}", file.display()))
}

fn paths(folder: &Path, names: &[&str]) -> Vec<String> {
    names.iter().map(|name| folder.join(name).display().to_string()).collect()
}
