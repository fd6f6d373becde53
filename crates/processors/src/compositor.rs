//! Compositor: makes one image of two.

use bytemuck::{Pod, Zeroable};
use rayloom_network::{
    Choice, Declaration, ImageKind, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl,
};

use crate::{Bind, Context, Data, Image, ImagePass, JobData};

const SHADER: &str = "image/compositor.wgsl";

/// The modes in the order of the shader's constants.
const MODES: [(&str, &str, &str); 6] = [
    (
        "depth_test",
        "Depth test",
        "The nearer pixel replaces the other; at one depth, or where neither hits, the first lies over the second. Depth: the nearer.",
    ),
    (
        "depth_over",
        "Nearer over farther",
        "The nearer pixel lies over the other; at one depth the first over the second. Depth: the nearer.",
    ),
    (
        "over",
        "First over second",
        "The first lies over the second, whatever their depths. Depth: the first's where it hits, else the second's.",
    ),
    ("weighted", "Weighted", "A mixture: weight 0 is the first, 1 the second. Depth: the nearer."),
    ("difference", "Difference", "The amount by which the colours differ, times the gain, opaque. Depth: none."),
    (
        "maximum",
        "Maximum",
        "The larger of the two numbers in each channel. Depth: that of the more opaque one; of the first when they are equal.",
    ),
];

/// As in the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Parameters {
    mode: u32,
    weight: f32,
    gain: f32,
}

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let color = PortType::Image(ImageKind::Color);
    let modes = MODES.iter().map(|&(id, label, help)| Choice::new(id, label, help)).collect();
    Declaration::new("compositor", "Compositor", "Image")
        .help("Makes one image of two of the same size. An image without depth is farther away than anything with one.")
        .input(InportDecl::new("first", "First", &[color]).help("An image, premultiplied colours."))
        .input(InportDecl::new("second", "Second", &[color]).help("Another one of the same size."))
        .output(
            OutportDecl::new("image", "Image", color)
                .help("The composite, premultiplied colours; with depth if an input has one, as the mode says."),
        )
        .property(PropertyDecl::choice("mode", "Mode", "depth_over", modes).help("How the two are combined."))
        .property(
            PropertyDecl::float("weight", "Weight", 0.5)
                .range(0.0, 1.0)
                .help("Share of the second image in a weighted composite."),
        )
        .property(
            PropertyDecl::float("gain", "Gain", 1.0)
                .range(0.0, 1e6)
                .logarithmic()
                .help("What a difference is multiplied with, to make small ones visible."),
        )
}

/// Combines the images.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let (first, second) = (job.image("first")?, job.image("second")?);
    let size = first.size();
    if size != second.size() {
        let [[w, h], [v, k]] = [size, second.size()];
        return Err(ProcessError::new(format!(
            "the two images have different sizes: the first {w} x {h}, the second {v} x {k} pixels; render both for one canvas"
        )));
    }
    let chosen = job.properties.text("mode")?;
    let mode = MODES.iter().position(|&(id, ..)| id == chosen).unwrap_or(0);
    let has_depth = chosen != "difference" && (first.depth.is_some() || second.depth.is_some());
    if matches!(chosen, "depth_test" | "depth_over") && !has_depth {
        return Err(ProcessError::new(format!(
            "the mode `{chosen}` needs depth, but neither image has any; connect one that has or choose another mode"
        )));
    }
    let parameters = Parameters {
        mode: mode as u32,
        weight: job.properties.f64("weight")? as f32,
        gain: job.properties.f64("gain")? as f32,
    };
    let color = context.color_target("a composite", size)?;
    // Writing beyond a texture does nothing, so one texel serves when there is no depth.
    let depth_size = if has_depth { size } else { [1, 1] };
    let depth = context.depth_target("the depth of a composite", depth_size)?;
    let no_depth = context.blank_depth();
    context.run_image_pass(&ImagePass {
        label: "compositor",
        shader: SHADER,
        flags: &[],
        entry_point: "main",
        bindings: &[
            Bind::Uniform(bytemuck::bytes_of(&parameters)),
            Bind::Texture(&first.color),
            Bind::Texture(first.depth.as_ref().unwrap_or(&no_depth)),
            Bind::Texture(&second.color),
            Bind::Texture(second.depth.as_ref().unwrap_or(&no_depth)),
            Bind::Texture(&color),
            Bind::Texture(&depth),
        ],
        size,
    })?;
    let view = first.view.clone().or_else(|| second.view.clone());
    let depth = has_depth.then_some(depth);
    Ok(Outputs::new().with("image", Image { color, depth, kind: ImageKind::Color, view }.into()))
}
