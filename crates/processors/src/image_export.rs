//! Image export: writes an image to a file.

use std::path::Path;

use rayloom_network::{Declaration, ImageKind, InportDecl, Job, Outputs, PortType, ProcessError, PropertyDecl};

use crate::{Context, Data, Image, JobData, Picture, write_picture};

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    use ImageKind::{Color, Data, Depth, EntryPoints, ExitPoints, Normals};
    let any = [Color, EntryPoints, ExitPoints, Depth, Normals, Data].map(PortType::Image);
    Declaration::new("image_export", "Image export", "Sink")
        .help(
            "Writes every new image to a file: .png (8 bits, straight alpha), .exr (32-bit floats, premultiplied, with depth \
             as Z) or .npy (32-bit floats, height x width x 4).",
        )
        .input(InportDecl::new("image", "Image", &any).help("The image to write."))
        .property(
            PropertyDecl::file("file", "File", &["png", "exr", "npy"])
                .saved()
                .help("The file to write; its extension says in which format. An old one is replaced."),
        )
        .property(PropertyDecl::bool("enabled", "Enabled", true).help("Off: nothing is written."))
        .property(PropertyDecl::size("size", "Size", [512, 512]).help("Width and height of the image."))
        .sink()
}

/// Reads the image back and writes the file.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let mut outputs = Outputs::new();
    if job.properties.bool("enabled")? {
        let path: &Path = job.properties.path("file")?;
        let picture = job.image("image")?.read_back(context)?;
        write_picture(path, &picture)?;
        outputs.notes.push(format!("{} was written.", path.display()));
    }
    Ok(outputs)
}

impl Image {
    /// The image with its depth in memory. Waits for the device.
    pub fn read_back(&self, context: &Context) -> Result<Picture, rayloom_gpu::GpuError> {
        let pixels = context.gpu.read_rgba_f32(&self.color)?;
        let depth = match &self.depth {
            Some(depth) => Some(context.gpu.read_rgba_f32(depth)?.into_iter().map(|texel| texel[0]).collect()),
            None => None,
        };
        Ok(Picture { size: self.size(), pixels, depth })
    }
}
