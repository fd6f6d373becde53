//! Colour map: shows any numbers of an image as colours.

use bytemuck::{Pod, Zeroable};
use rayloom_gpu::GpuError;
use rayloom_network::{
    Choice, Declaration, ImageKind, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl,
};

use crate::{Bind, Context, Data, Image, ImagePass, JobData, MISS};

const SHADER: &str = "image/color_map.wgsl";

/// What can be shown, in the order of the shader's numbers.
const SHOWN: [(&str, &str, &str); 6] = [
    ("color", "Colours", "The first three channels as red, green and blue."),
    ("red", "Channel 1", "Red, or x."),
    ("green", "Channel 2", "Green, or y."),
    ("blue", "Channel 3", "Blue, or z."),
    ("alpha", "Channel 4", "Alpha, or whether something was hit."),
    ("depth", "Depth", "The distance along the viewing direction."),
];
const DEPTH: usize = 5;

/// Colour maps: stops at equal distances.
const MAPS: [(&str, &str, &str, &[[f32; 3]]); 5] = [
    ("gray", "Gray", "From black to white.", &[[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]),
    (
        "viridis",
        "Viridis",
        "From violet over green to yellow: equal steps look equal, also without colour vision.",
        &[
            [0.267, 0.005, 0.329],
            [0.229, 0.322, 0.546],
            [0.128, 0.567, 0.551],
            [0.369, 0.789, 0.383],
            [0.993, 0.906, 0.144],
        ],
    ),
    (
        "heat",
        "Heat",
        "Black, red, yellow, white.",
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]],
    ),
    (
        "diverging",
        "Diverging",
        "Blue below the middle of the range, red above, white at it.",
        &[[0.1, 0.25, 0.7], [1.0, 1.0, 1.0], [0.7, 0.1, 0.1]],
    ),
    (
        "hue",
        "Hue",
        "Once around the colours, for angles: both ends are red.",
        &[
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 1.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
        ],
    ),
];

/// As in the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Parameters {
    stops: [[f32; 4]; 8],
    range: [f32; 2],
    stop_count: u32,
    show: u32,
    has_misses: u32,
}

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    use ImageKind::{Color, Data, Depth, EntryPoints, ExitPoints, Normals};
    let any = [Color, EntryPoints, ExitPoints, Depth, Normals, Data].map(PortType::Image);
    let shown = SHOWN.iter().map(|&(id, label, help)| Choice::new(id, label, help)).collect();
    let maps = MAPS.iter().map(|&(id, label, help, _)| Choice::new(id, label, help)).collect();
    Declaration::new("color_map", "Colour map", "Image")
        .help(
            "Shows numbers of an image as colours: a channel, the depth, entry points, normals. Pixels in which nothing was hit \
             are transparent.",
        )
        .input(InportDecl::new("source", "Source", &any).help("An image of any kind."))
        .output(
            OutportDecl::new("image", "Image", PortType::Image(Color)).help("Premultiplied colours; the depth passes through."),
        )
        .property(PropertyDecl::choice("show", "Show", "color", shown).help("Which numbers."))
        .property(PropertyDecl::choice("map", "Map", "viridis", maps).help("Which colours; not used when colours are shown."))
        .property(
            PropertyDecl::bool("automatic", "Automatic range", true)
                .help("On: a channel or depth is shown from its smallest to its largest value in this image, colours from 0 to 1."),
        )
        .property(
            PropertyDecl::vector("range", "Range", &[0.0, 1.0])
                .help("Without automatic range: the numbers shown with the first and with the last colour."),
        )
}

/// Maps the numbers to colours.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let image = job.image("source")?;
    let chosen = job.properties.text("show")?;
    let show = SHOWN.iter().position(|&(id, ..)| id == chosen).unwrap_or(0);
    if show == DEPTH && image.depth.is_none() {
        return Err(ProcessError::new("this image has no depth; show something else or connect an image that has one"));
    }
    let has_misses = !matches!(image.kind, ImageKind::Color | ImageKind::Data);
    let range = if !job.properties.bool("automatic")? {
        job.properties.array("range")?.map(|x: f64| x as f32)
    } else if show == 0 {
        [0.0, 1.0]
    } else {
        extremes(context, image, show, has_misses)?
    };
    if range[0] == range[1] && !job.properties.bool("automatic")? {
        return Err(ProcessError::new(format!(
            "the range [{}, {}] is empty; give it two different ends",
            range[0], range[1]
        )));
    }
    let parameters = parameters(job.properties.text("map")?, range, show, has_misses);
    let size = image.size();
    let color = context.color_target("a colour map", size)?;
    let no_depth = context.blank_depth();
    context.run_image_pass(&ImagePass {
        label: "colour map",
        shader: SHADER,
        flags: &[],
        entry_point: "main",
        bindings: &[
            Bind::Uniform(bytemuck::bytes_of(&parameters)),
            Bind::Texture(&image.color),
            Bind::Texture(image.depth.as_ref().unwrap_or(&no_depth)),
            Bind::Texture(&color),
        ],
        size,
    })?;
    let (depth, view) = (image.depth.clone(), image.view.clone());
    let mut outputs = Outputs::new().with("image", Image { color, depth, kind: ImageKind::Color, view }.into());
    outputs.statistics.insert("minimum".into(), range[0].into());
    outputs.statistics.insert("maximum".into(), range[1].into());
    Ok(outputs)
}

fn parameters(map: &str, range: [f32; 2], show: usize, has_misses: bool) -> Parameters {
    let (.., colors) = MAPS.iter().find(|&&(id, ..)| id == map).unwrap_or(&MAPS[0]);
    let mut stops = [[0.0; 4]; 8];
    for (stop, &[r, g, b]) in stops.iter_mut().zip(*colors) {
        *stop = [r, g, b, 1.0];
    }
    // A range of one value would divide by zero; any width shows that value with the first colour.
    let upper = if range[1] == range[0] { range[0] + 1.0 } else { range[1] };
    Parameters {
        stops,
        range: [range[0], upper],
        stop_count: colors.len() as u32,
        show: show as u32,
        has_misses: has_misses.into(),
    }
}

/// The smallest and the largest of the numbers to be shown; 0 and 1 when there are none.
fn extremes(context: &Context, image: &Image, show: usize, has_misses: bool) -> Result<[f32; 2], GpuError> {
    let numbers: Vec<f32> = match &image.depth {
        Some(depth) if show == DEPTH => {
            context.gpu.read_rgba_f32(depth)?.iter().map(|t| t[0]).filter(|&d| d < MISS).collect()
        }
        _ => {
            let texels = context.gpu.read_rgba_f32(&image.color)?;
            texels.iter().filter(|t| !has_misses || t[3] > 0.0).map(|t| t[show - 1]).collect()
        }
    };
    let finite = || numbers.iter().copied().filter(|x| x.is_finite());
    let (low, high) = (finite().fold(f32::INFINITY, f32::min), finite().fold(f32::NEG_INFINITY, f32::max));
    Ok(if low <= high { [low, high] } else { [0.0, 1.0] })
}
