//! Canvas: shows an image.

use rayloom_network::{
    Declaration, ImageKind, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl,
};

use crate::{Context, Data, JobData};

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let color = PortType::Image(ImageKind::Color);
    Declaration::new(crate::types::CANVAS, "Canvas", "Sink")
        .help("Shows an image. Its size is the size that everything upstream is rendered at.")
        .input(
            InportDecl::new("image", "Image", &[color])
                .help("The image to show; a colour map makes one of anything else."),
        )
        .output(OutportDecl::new("shown", "Shown", color).help("The same image."))
        .property(PropertyDecl::size("size", "Size", [512, 512]).help("Width and height of the image."))
        .sink()
}

/// Hands the image on to whoever shows it.
pub fn process(_: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    Ok(Outputs::new().with("shown", Data::Image(job.image("image")?.clone())))
}
