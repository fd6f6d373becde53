//! Where the studio keeps what belongs to its user from one run to the next.

use std::path::{Path, PathBuf};

use etcetera::{AppStrategy, AppStrategyArgs};

/// The variable that names one folder for everything, in place of the system's.
const HOME: &str = "RAYLOOM_HOME";

/// Folders of the user; they are made when something is written.
#[derive(Clone, Debug)]
pub struct Folders {
    /// What the user chose: the layout of the panels.
    pub config: PathBuf,
    /// What happened: files opened lately, changes that are not saved.
    pub state: PathBuf,
    /// What can be computed anew.
    pub cache: PathBuf,
}

impl Folders {
    /// `config`, `state` and `cache` in `$RAYLOOM_HOME`, or the folders that the system has for each; `None` for a user
    /// who has no home.
    pub fn of_user() -> Option<Self> {
        if let Some(home) = std::env::var_os(HOME).filter(|home| !home.is_empty()) {
            return Some(Self::within(Path::new(&home)));
        }
        let name = AppStrategyArgs { app_name: "rayloom".into(), ..AppStrategyArgs::default() };
        let system = etcetera::choose_app_strategy(name).ok()?;
        let state = system.state_dir().unwrap_or_else(|| system.data_dir());
        Some(Self { config: system.config_dir(), state, cache: system.cache_dir() })
    }

    /// Folders within one.
    pub fn within(home: &Path) -> Self {
        Self { config: home.join("config"), state: home.join("state"), cache: home.join("cache") }
    }
}
