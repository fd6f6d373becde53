//! Volume source: reads a volume from a file.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use rayloom_network::{Declaration, Job, Level, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl};
use rayloom_volume::{Volume, formats, read};

use crate::{Context, Data, Precision, Storage, VolumeData};

/// What was read last, so that another precision does not read the file again.
#[derive(Default)]
struct LastRead {
    path: PathBuf,
    modified: Option<SystemTime>,
    volume: Option<Arc<Volume>>,
}

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let extensions: Vec<&str> = formats().iter().flat_map(|format| format.extensions).copied().collect();
    let known: Vec<&str> = formats().iter().map(|format| format.help).collect();
    let file = PropertyDecl::file("file", "File", &extensions)
        .help("The volume file; its extension says which format it has.")
        .level(Level::Parameters);
    let volume = OutportDecl::new("volume", "Volume", PortType::Volume)
        .help("The volume in world coordinates: right-anterior-superior millimetres where the format defines a patient space.");
    Declaration::new(crate::types::VOLUME_SOURCE, "Volume source", "Source")
        .help(format!("Reads a volume from a file. {}", known.join(" ")))
        .output(volume)
        .property(file)
        .property(Precision::property())
}

/// Reads the file unless it is the one read last.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let path = job.properties.path("file")?;
    let precision = Precision::from_id(job.properties.text("precision")?);
    let modified = modification_time(path);
    let last: LastRead = context.take_state(job.id);
    let volume = match last.volume {
        Some(volume) if last.path == path && last.modified == modified && modified.is_some() => volume,
        _ => Arc::new(read(path, &mut |progress| context.report(job.id, progress))?),
    };
    context.put_state(job.id, LastRead { path: path.to_owned(), modified, volume: Some(volume.clone()) });
    Ok(outputs_of(context, "volume", volume, precision))
}

/// The outputs of a source, with notes about what is lost on the device and about values that cannot be drawn.
pub(crate) fn outputs_of(context: &Context, outport: &str, volume: Arc<Volume>, precision: Precision) -> Outputs<Data> {
    let mut notes: Vec<String> = Storage::choose(&volume, precision, context.gpu.features).loss.into_iter().collect();
    if volume.non_finite() > 0 {
        notes.push(format!(
            "{} voxels are NaN or infinite; NaN is not drawn, nor what is interpolated with it; infinities are drawn as the ends of the range.",
            volume.non_finite()
        ));
    }
    let mut outputs = Outputs::new().with(outport, VolumeData::new(volume, precision).into());
    outputs.notes = notes;
    outputs
}

fn modification_time(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|metadata| metadata.modified()).ok()
}
