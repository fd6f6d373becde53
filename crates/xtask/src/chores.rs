//! What each chore does.

use std::path::PathBuf;

use crate::adapter;
use crate::command::{cargo, program, root, run, succeeds};
use crate::window::{self, Outcome};
use crate::{licences, unused};

/// The network behind the picture in the README.
const FLAGSHIP: &str = "networks/brain.json";
/// Where its picture goes.
const PICTURE: &str = "out/brain.png";

/// Builds the program, renders the flagship network, and opens it in the studio where there is a display.
pub fn start() -> Result<(), String> {
    let rayloom = build("release")?;
    adapter::ensure(&rayloom)?;
    let picture = root().join(PICTURE);
    let folder = root().join("out");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{} cannot be made: {error}", folder.display()))?;
    run(&mut program(&rayloom.to_string_lossy(), &["render", FLAGSHIP, "-o", PICTURE]))?;
    println!("The picture is at {}", picture.display());
    if !has_display() {
        println!("There is no display, so the studio stays closed.");
        return Ok(());
    }
    println!("Opening the network in the studio");
    run(&mut program(&rayloom.to_string_lossy(), &["open", FLAGSHIP]))
}

/// Whether a window can be opened; systems other than X11 and Wayland are taken to have a display.
fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos"))) || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

/// Everything that must hold before a change is merged; goes on after a failure and sums up at the end.
pub fn test() -> Result<(), String> {
    // The tests render, so that without an adapter nothing else is worth waiting for.
    let rayloom = build("dev")?;
    adapter::ensure(&rayloom)?;
    let nextest = succeeds(&mut cargo(&["nextest", "--version"]));
    let tests = if nextest {
        cargo(&["nextest", "run", "--workspace", "--no-fail-fast"])
    } else {
        cargo(&["test", "--workspace", "--lib", "--bins", "--tests", "--no-fail-fast"])
    };
    let mut documentation = cargo(&["doc", "--workspace", "--no-deps", "--quiet"]);
    documentation.env("RUSTDOCFLAGS", "-D warnings");
    let steps = [
        ("formatting", cargo(&["fmt", "--all", "--check"])),
        ("lints", cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"])),
        ("tests", tests),
        ("documentation tests", cargo(&["test", "--workspace", "--doc", "--quiet"])),
        ("documentation", documentation),
    ];
    let mut results: Vec<_> =
        steps.into_iter().map(|(name, mut command)| (name, run(&mut command).map(|()| Outcome::Passed))).collect();
    results.extend(dependency_checks());
    eprintln!("> a window on an X server without a monitor");
    results.push(("window", window::check(&rayloom)));
    summary(&results)
}

/// Checks the dependencies alone.
pub fn dependencies() -> Result<(), String> {
    summary(&dependency_checks())
}

fn dependency_checks() -> Vec<(&'static str, Result<Outcome, String>)> {
    eprintln!("> dependencies");
    vec![
        ("licences", licences::check().map(|()| Outcome::Passed)),
        ("unused dependencies", unused::check().map(|()| Outcome::Passed)),
        ("advisories", advisories()),
    ]
}

/// Says how all steps went, and fails if one did.
fn summary(results: &[(&str, Result<Outcome, String>)]) -> Result<(), String> {
    eprintln!("\nSummary");
    for (name, result) in results {
        eprintln!("  {name:<22}{}", told(result));
    }
    let failed: Vec<&str> = results.iter().filter(|(_, result)| result.is_err()).map(|(name, _)| *name).collect();
    if failed.is_empty() { Ok(()) } else { Err(format!("failed: {}", failed.join(", "))) }
}

/// Looks for known faults in dependencies with cargo-deny, where it and its database are; nothing is downloaded.
fn advisories() -> Result<Outcome, String> {
    if !succeeds(&mut cargo(&["deny", "--version"])) {
        return Ok(Outcome::Skipped("cargo-deny is not installed; to do so: cargo install cargo-deny".into()));
    }
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    if !home.is_some_and(|home| home.join("advisory-dbs").exists()) {
        return Ok(Outcome::Skipped("there is no database of advisories; to fetch it: cargo deny fetch".into()));
    }
    run(&mut cargo(&["deny", "--offline", "check"])).map(|()| Outcome::Passed)
}

/// Opens a real window and uses it.
pub fn window() -> Result<(), String> {
    let rayloom = build("dev")?;
    adapter::ensure(&rayloom)?;
    let result = window::check(&rayloom);
    eprintln!("window: {}", told(&result));
    result.map(drop)
}

/// How a step went.
fn told(result: &Result<Outcome, String>) -> String {
    match result {
        Ok(Outcome::Passed) => "passed".into(),
        Ok(Outcome::Skipped(why)) => format!("skipped: {why}"),
        Err(error) => format!("FAILED: {error}"),
    }
}

/// Tries damaged files of every kind for so many minutes, other ones every time.
pub fn fuzz(minutes: &str) -> Result<(), String> {
    let seconds: f64 = minutes.parse::<f64>().map_err(|_| format!("`{minutes}` is no number of minutes"))? * 60.0;
    if !(1.0..=1e6).contains(&seconds) {
        return Err(format!("{minutes} minutes are too short or too long; give at least 0.02"));
    }
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(1, |time| time.as_secs());
    let mut test = cargo(&["test", "--package", "rayloom-tests", "--test", "fuzz", "--", "--nocapture"]);
    test.env("RAYLOOM_FUZZ_SECONDS", (seconds as u64).to_string()).env("RAYLOOM_FUZZ_SEED", now.to_string());
    run(&mut test)
}

/// Rewrites the golden images.
pub fn golden() -> Result<(), String> {
    adapter::ensure(&build("dev")?)?;
    let mut test = cargo(&["test", "--package", "rayloom-tests", "--test", "golden"]);
    run(test.env("RAYLOOM_UPDATE_GOLDEN", "1"))
}

/// Rewrites the pages that are generated from declarations. Pages of what does not exist any more go, too.
pub fn docs() -> Result<(), String> {
    let rayloom = build("dev")?;
    for what in ["processors", "snippets"] {
        let folder = root().join("docs").join(what);
        if folder.exists() {
            std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        let pages = folder.to_string_lossy();
        let mut list = program(&rayloom.to_string_lossy(), &["list", what, "--pages", &pages]);
        // In place of the user's own snippets, which are not to be documented: there are no snippets right in this folder.
        run(list.env("RAYLOOM_SNIPPETS", "shaders"))?;
    }
    Ok(())
}

/// Goes through the tutorial and renews its pictures.
pub fn tutorial() -> Result<(), String> {
    adapter::ensure(&build("dev")?)?;
    let mut test = cargo(&["test", "--package", "rayloom", "--test", "cli", "tutorial"]);
    run(test.env("RAYLOOM_UPDATE_TUTORIAL", "1"))
}

/// Runs the benches.
pub fn bench() -> Result<(), String> {
    adapter::ensure(&build("release")?)?;
    run(&mut cargo(&["bench", "--workspace", "--benches"]))
}

/// Builds the command line and returns where it is.
fn build(profile: &str) -> Result<PathBuf, String> {
    run(&mut cargo(&["build", "--package", "rayloom", "--profile", profile]))?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |dir| root().join(dir));
    let folder = if profile == "dev" { "debug" } else { profile };
    Ok(target.join(folder).join(format!("rayloom{}", std::env::consts::EXE_SUFFIX)))
}
