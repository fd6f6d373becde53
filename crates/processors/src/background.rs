//! Background: puts a colour, a gradient, a checkerboard or a picture behind an image.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use bytemuck::{Pod, Zeroable};
use glam::Vec2;
use rayloom_gpu::Texture;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_network::{
    Choice, Declaration, ImageKind, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, Properties,
    PropertyDecl,
};

use crate::{Bind, Context, Data, Image, ImagePass, JobData, read_picture};

const SHADER: &str = "image/background.wgsl";

/// As in the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Parameters {
    first: [f32; 4],
    second: [f32; 4],
    slope: [f32; 2],
    start: f32,
    square: f32,
    picture_scale: [f32; 2],
    picture_offset: [f32; 2],
    mode: u32,
}

/// The picture loaded last.
#[derive(Default)]
struct LastPicture {
    path: PathBuf,
    modified: Option<SystemTime>,
    texture: Option<Arc<Texture>>,
}

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let color = PortType::Image(ImageKind::Color);
    let modes = vec![
        Choice::new("color", "Colour", "The first colour everywhere."),
        Choice::new("gradient", "Gradient", "From the first colour to the second."),
        Choice::new("checkerboard", "Checkerboard", "Squares of both colours."),
        Choice::new("picture", "Picture", "An image file; the first colour where it is transparent or does not reach."),
    ];
    let fits = vec![
        Choice::new("cover", "Cover", "Fills the image and keeps its proportions; what does not fit is cut off."),
        Choice::new("contain", "Contain", "Is seen whole and keeps its proportions."),
        Choice::new("stretch", "Stretch", "Fills the image exactly."),
    ];
    Declaration::new("background", "Background", "Image")
        .help("Puts a background behind an image, or makes one on its own. Depth passes through.")
        .input(
            InportDecl::new("front", "Front", &[color]).optional().help("What lies in front, premultiplied colours."),
        )
        .output(OutportDecl::new("image", "Image", color).help("The image over the background, premultiplied colours."))
        .uses_render_size()
        .property(PropertyDecl::choice("mode", "Mode", "gradient", modes).help("What the background is."))
        .property(
            PropertyDecl::color("first", "First colour", [0.16, 0.18, 0.22, 1.0])
                .help("A colour, perhaps transparent."),
        )
        .property(
            PropertyDecl::color("second", "Second colour", [0.55, 0.58, 0.62, 1.0])
                .help("The other colour of a gradient or checkerboard."),
        )
        .property(
            PropertyDecl::float("angle", "Angle", 90.0)
                .range(-360.0, 360.0)
                .unit("degrees")
                .help("Direction of a gradient: 0 from left to right, 90 from bottom to top."),
        )
        .property(
            PropertyDecl::float("square", "Square", 16.0)
                .range(1.0, 4096.0)
                .unit("pixels")
                .help("Side of the squares of a checkerboard."),
        )
        .property(
            PropertyDecl::file("file", "Picture", &["png", "exr"]).optional().help("The image file of a picture."),
        )
        .property(PropertyDecl::choice("fit", "Fit", "cover", fits).help("How a picture is fitted into the image."))
}

/// Draws the background and the image over it.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let front = job.optional_image("front").cloned();
    let size = front.as_ref().map_or(job.size, |image| image.size());
    let blank = context.blank_color();
    let picture = match job.properties.text("mode")? {
        "picture" => load(context, job.id, job.properties.path("file")?)?,
        _ => blank.clone(),
    };
    let parameters = parameters(job.properties, size, picture.size_2d())?;
    let color = context.color_target("a background", size)?;
    context.run_image_pass(&ImagePass {
        label: "background",
        shader: SHADER,
        flags: &[],
        entry_point: "main",
        bindings: &[
            Bind::Uniform(bytemuck::bytes_of(&parameters)),
            Bind::Texture(front.as_ref().map_or(&blank, |image| &image.color)),
            Bind::Texture(&picture),
            Bind::Texture(&color),
        ],
        size,
    })?;
    let depth = front.as_ref().and_then(|image| image.depth.clone());
    let view = front.as_ref().and_then(|image| image.view.clone());
    Ok(Outputs::new().with("image", Image { color, depth, kind: ImageKind::Color, view }.into()))
}

fn parameters(properties: &Properties, size: [u32; 2], picture: [u32; 2]) -> Result<Parameters, ProcessError> {
    let size = Vec2::from_array(size.map(|n| n as f32));
    let angle = (properties.f64("angle")? as f32).to_radians();
    let direction = Vec2::new(angle.cos(), -angle.sin());
    // 0 and 1 are reached in the outermost corners.
    let slope = direction / direction.abs().dot(size);
    let picture = Vec2::from_array(picture.map(|n| n as f32));
    let ratio = picture / size;
    let scale = match properties.text("fit")? {
        "contain" => Vec2::splat(ratio.max_element()),
        "stretch" => ratio,
        _ => Vec2::splat(ratio.min_element()),
    };
    Ok(Parameters {
        first: premultiplied(properties.color("first")?),
        second: premultiplied(properties.color("second")?),
        slope: slope.to_array(),
        start: 0.5 - 0.5 * slope.dot(size),
        square: properties.f64("square")? as f32,
        picture_scale: scale.to_array(),
        picture_offset: (0.5 * (picture - scale * size)).to_array(),
        mode: match properties.text("mode")? {
            "color" => 0,
            "gradient" => 1,
            "checkerboard" => 2,
            _ => 3,
        },
    })
}

/// The premultiplied form of a colour with straight alpha.
fn premultiplied([r, g, b, a]: [f64; 4]) -> [f32; 4] {
    [r * a, g * a, b * a, a].map(|x| x as f32)
}

/// The picture in a file as a texture; kept as long as the file stays the same.
fn load(context: &mut Context, id: &str, path: &Path) -> Result<Arc<Texture>, ProcessError> {
    if path.as_os_str().is_empty() {
        return Err(ProcessError::new(
            "the background is to be a picture, but no file is chosen; choose one or another mode",
        ));
    }
    let modified = std::fs::metadata(path).and_then(|metadata| metadata.modified()).ok();
    let last: LastPicture = context.take_state(id);
    let texture = match last.texture {
        Some(texture) if last.path == path && last.modified == modified && modified.is_some() => texture,
        _ => {
            let picture = read_picture(path)?;
            let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
            let label = path.display().to_string();
            let texture = context.gpu.texture_2d(&label, picture.size, TextureFormat::Rgba32Float, usage)?;
            context.gpu.upload(&texture, bytemuck::cast_slice(&picture.pixels))?;
            Arc::new(texture)
        }
    };
    context.put_state(id, LastPicture { path: path.to_owned(), modified, texture: Some(texture.clone()) });
    Ok(texture)
}
