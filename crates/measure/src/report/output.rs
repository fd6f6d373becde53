//! The files of a measurement.

use std::path::{Path, PathBuf};

use crate::report::{self, csv};
use crate::{MeasureError, Measurements};

/// Writes `measurements.csv`, `views.csv`, `measurements.json` and `report.html` into a folder, which is made if it is not there, and
/// returns their paths.
///
/// # Errors
/// The folder cannot be made or a file cannot be written.
pub fn write_all(folder: &Path, measurements: &Measurements) -> Result<Vec<PathBuf>, MeasureError> {
    let json = serde_json::to_string_pretty(measurements)? + "\n";
    let files = [
        ("measurements.csv", csv::settings(measurements)),
        ("views.csv", csv::views(measurements)),
        ("measurements.json", json),
        ("report.html", report::page(measurements)?),
    ];
    write_files(folder, files)
}

/// Writes texts into a folder, which is made if it is not there, and returns their paths.
pub(crate) fn write_files(
    folder: &Path,
    files: impl IntoIterator<Item = (impl AsRef<Path>, String)>,
) -> Result<Vec<PathBuf>, MeasureError> {
    let write_error = |path: &Path| {
        let path = path.to_owned();
        move |source| MeasureError::Write { path, source }
    };
    std::fs::create_dir_all(folder).map_err(write_error(folder))?;
    let written = files.into_iter().map(|(name, text)| {
        let path = folder.join(name);
        rayloom_files::write(&path, text.as_bytes()).map_err(write_error(&path))?;
        Ok(path)
    });
    written.collect()
}
