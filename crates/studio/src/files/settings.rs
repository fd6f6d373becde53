//! How the user likes the window: kept in a file between runs.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use egui::{Context, ThemePreference};
use egui_tiles::{Tile, Tree};
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::folders::Folders;
use super::keeper::Keeper;
use crate::pane::Pane;

/// The longest file of settings, bytes.
const LONGEST: u64 = 1 << 20;

/// Names what could not be used, and the reason.
type Problem = String;

/// What is kept.
#[derive(Clone, Default, PartialEq)]
pub struct Settings {
    /// Dark, light, or as the system has it.
    pub theme: ThemePreference,
    /// Size of everything in the window against the system's.
    pub scale: Option<f32>,
    /// Size of the window's inside, points of the system.
    pub window: Option<[f32; 2]>,
    /// Whether the window fills the screen.
    pub maximized: bool,
    /// The panels; `None` for the default layout.
    pub layout: Option<Tree<Pane>>,
}

/// The file. Every part is read on its own, so that one that makes no sense, as after another version of the program, leaves
/// the others alone.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct Stored {
    theme: Json,
    scale: Json,
    window: Json,
    maximized: Json,
    layout: Json,
}

fn file(folders: &Folders) -> PathBuf {
    folders.config.join("settings.json")
}

impl Settings {
    /// What was kept in the folders, and what of it cannot be used. Waits for the disk: for the time before there is a window.
    pub fn load(folders: &Folders) -> (Self, Vec<Problem>) {
        let file = file(folders);
        match rayloom_files::read_text(&file, LONGEST) {
            Ok(text) => Self::parse(&text, &file),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => (Self::default(), Vec::new()),
            Err(error) => (Self::default(), vec![format!("{}: the settings cannot be read: {error}", file.display())]),
        }
    }

    fn parse(text: &str, file: &Path) -> (Self, Vec<Problem>) {
        let stored: Stored = match serde_json::from_str(text) {
            Ok(stored) => stored,
            Err(error) => {
                let problem = format!("{}: these are no settings: {error}; the defaults are used.", file.display());
                return (Self::default(), vec![problem]);
            }
        };
        let mut problems = Vec::new();
        let mut complain = |part: &str, error: &str| {
            problems.push(format!("{}: the {part} makes no sense here: {error}; the default is used.", file.display()));
        };
        let settings = Self {
            theme: read(stored.theme, Ok, |error| complain("theme", error)).unwrap_or_default(),
            scale: read(stored.scale, sane_scale, |error| complain("scale", error)),
            window: read(stored.window, sane_size, |error| complain("window's size", error)),
            maximized: read(stored.maximized, Ok, |error| complain("window's state", error)).unwrap_or_default(),
            layout: read(stored.layout, sane_layout, |error| complain("layout", error)),
        };
        (settings, problems)
    }

    /// Applies what a window that is open already takes.
    pub fn apply(&self, context: &Context) {
        context.set_theme(self.theme);
        if let Some(scale) = self.scale {
            context.set_zoom_factor(scale);
        }
    }

    /// How the window is now. Panels that belong to one network are left out.
    pub fn of(context: &Context, tiles: &Tree<Pane>, last: &Self) -> Self {
        let mut layout = tiles.clone();
        let passing = |tile: &Tile<Pane>| matches!(tile, Tile::Pane(pane) if !pane.is_lasting());
        let passing: Vec<_> = layout.tiles.iter().filter(|(_, tile)| passing(tile)).map(|(id, _)| *id).collect();
        for id in passing {
            layout.remove_recursively(id);
        }
        let zoom = context.zoom_factor();
        let (size, maximized) = context.input(|input| {
            let viewport = input.viewport();
            let size = viewport.inner_rect.map(|rect| (rect.size() * zoom).into());
            (size, viewport.maximized.unwrap_or(last.maximized))
        });
        // The size to come back to is the one before the window filled the screen.
        let window = size.filter(|_| !maximized).or(last.window);
        let theme = context.options(|options| options.theme_preference);
        Self { theme, scale: Some(zoom), window, maximized, layout: Some(layout) }
    }

    fn text(&self) -> String {
        let json = |value: serde_json::Result<Json>| value.unwrap_or_default();
        let stored = Stored {
            theme: json(serde_json::to_value(self.theme)),
            scale: json(serde_json::to_value(self.scale)),
            window: json(serde_json::to_value(self.window)),
            maximized: self.maximized.into(),
            layout: json(serde_json::to_value(&self.layout)),
        };
        json(serde_json::to_value(stored)).to_string()
    }
}

/// A part of the file; `None` when it is not there or makes no sense, which is told.
fn read<T: serde::de::DeserializeOwned>(
    json: Json,
    sane: impl FnOnce(T) -> Result<T, String>,
    complain: impl FnOnce(&str),
) -> Option<T> {
    let value = serde_json::from_value::<Option<T>>(json).map_err(|error| error.to_string());
    value.and_then(|value| value.map(sane).transpose()).unwrap_or_else(|error| {
        complain(&error);
        None
    })
}

fn sane_scale(scale: f32) -> Result<f32, String> {
    if (0.2..=5.0).contains(&scale) { Ok(scale) } else { Err(format!("{scale} is not from 0.2 to 5")) }
}

fn sane_size(size: [f32; 2]) -> Result<[f32; 2], String> {
    let sane = size.iter().all(|side| (200.0..=20_000.0).contains(side));
    if sane { Ok(size) } else { Err(format!("{size:?} is not from 200 to 20000")) }
}

/// Refuses a layout in which a tile lies in two places, or nowhere.
fn sane_layout(tree: Tree<Pane>) -> Result<Tree<Pane>, String> {
    let mut queue = vec![tree.root().ok_or("it is empty")?];
    let mut seen = HashSet::new();
    while let Some(id) = queue.pop() {
        if !seen.insert(id) {
            return Err("a panel lies in two places".into());
        }
        match tree.tiles.get(id) {
            Some(Tile::Container(container)) => queue.extend(container.children()),
            Some(Tile::Pane(_)) => {}
            None => return Err("a panel is missing".into()),
        }
    }
    Ok(tree)
}

/// Keeps the settings up to date in their file.
pub struct Preferences {
    last: Settings,
    keeper: Option<Keeper>,
}

impl Preferences {
    /// Follows what was loaded; without folders nothing is kept.
    pub fn new(loaded: Settings, folders: Option<&Folders>) -> Self {
        Self { last: loaded, keeper: folders.map(|folders| Keeper::start(file(folders))) }
    }

    /// To be called every frame; why the settings could not be kept.
    pub fn follow(&mut self, context: &Context, tiles: &Tree<Pane>) -> Option<String> {
        let keeper = self.keeper.as_ref()?;
        let now = Settings::of(context, tiles, &self.last);
        if now != self.last {
            self.last = now.clone();
            keeper.write(move || now.text());
        }
        keeper.problem()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels::default_layout;

    #[test]
    fn settings_come_back_and_what_makes_no_sense_is_told_and_left_out() {
        let settings = Settings {
            theme: ThemePreference::Light,
            scale: Some(1.25),
            window: Some([800.0, 600.0]),
            maximized: true,
            layout: Some(default_layout()),
        };
        let file = Path::new("settings.json");
        let (read, problems) = Settings::parse(&settings.text(), file);
        assert_eq!(problems, Vec::<String>::new());
        assert!(read == settings);
        for (broken, told) in [
            ("{", "no settings"),
            ("[]", ""),
            ("{\"theme\": 7}", "theme"),
            ("{\"window\": [0, 1e30]}", "window's size"),
            ("{\"scale\": -1}", "scale"),
            ("{\"maximized\": \"no\"}", "window's state"),
            ("{\"layout\": {\"root\": 1}}", "layout"),
        ] {
            let (read, problems) = Settings::parse(broken, file);
            assert!(read == Settings::default(), "{broken}");
            assert!(problems.iter().any(|problem| problem.contains(told)) || told.is_empty(), "{broken}: {problems:?}");
        }
        // A layout that holds a panel in itself would never end.
        let mut twisted = default_layout();
        let root = twisted.root().expect("a root");
        if let Some(Tile::Container(container)) = twisted.tiles.get_mut(root) {
            container.add_child(root);
        }
        let twisted = Settings { layout: Some(twisted), ..Settings::default() };
        let (read, problems) = Settings::parse(&twisted.text(), file);
        assert!(read.layout.is_none() && problems.len() == 1, "{problems:?}");
    }
}
