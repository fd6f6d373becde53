//! Ports and fixed properties of the ray traversal.

use rayloom_network::{
    Choice, Declaration, Facts, ImageKind, InportDecl, Level, Light, OutportDecl, PortType, PropertyDecl,
};
use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D, ValueRange};
use rayloom_wgsl::{Library, Slot};

use super::snippets::{PLACES, Place};
use super::{OUTPORTS, SAMPLES};

/// Upper bound of the samples on one ray.
pub(super) const MOST_SAMPLES: i64 = 1 << 24;

pub(super) fn declaration(library: &Library) -> Declaration {
    let declaration = Declaration::new(crate::types::RAY_TRAVERSAL, "Ray traversal", "Rendering")
        .help(
            "Walks the ray of every pixel from its entry to its exit point. What happens at a sample is up to the snippets \
             in its slots; the shader is assembled from them and holds nothing that they do not need.",
        )
        .uses_render_size()
        .scales_render_size("pixel_rate");
    let declaration = ports(declaration);
    let declaration =
        PLACES.iter().fold(declaration, |declaration, place| declaration.property(snippet(library, place)));
    let declaration = appearance(sampling(declaration));
    PLACES.iter().fold(declaration, |declaration, place| {
        declaration.property(
            PropertyDecl::shader_text(place.text, format!("{} text", label(place)), place.slot.id())
                .help("Your own WGSL for this slot, used in place of the chosen snippet and stored in the network."),
        )
    })
}

fn ports(declaration: Declaration) -> Declaration {
    let image = |kind| PortType::Image(kind);
    let mut declaration = declaration
        .input(InportDecl::new("volume", "Volume", &[PortType::Volume]).help("The volume that is sampled."))
        .input(
            InportDecl::new("entry", "Entry points", &[image(ImageKind::EntryPoints)]).help("Where the rays enter, volume coordinates."),
        )
        .input(InportDecl::new("exit", "Exit points", &[image(ImageKind::ExitPoints)]).help("Where the rays leave, volume coordinates."))
        .input(
            InportDecl::new("labels", "Labels", &[PortType::Volume])
                .optional()
                .help("A label volume in the same box, for the classification `labels`; without it the volume holds the labels.")
                .condition("a volume with one channel", |facts| matches!(facts, Facts::Volume { channels: 1, .. })),
        );
    for (index, id) in OUTPORTS.iter().enumerate() {
        let label = if index == 0 { "Image".to_owned() } else { format!("Image {}", index + 1) };
        declaration = declaration.output(
            OutportDecl::new(*id, label, image(ImageKind::Color))
                .help("Premultiplied colour with view depth. An output that nothing uses is not even compiled."),
        );
    }
    declaration.output(
        OutportDecl::new(SAMPLES, "Samples", image(ImageKind::Data)).help(
            "For every ray the samples taken (red), those of them that contribute (green), and 1 in alpha where the ray meets \
             the volume. Counted only where something is connected.",
        ),
    )
}

fn label(place: &Place) -> String {
    let id = place.slot.id();
    let mut label = id[..1].to_uppercase() + &id[1..];
    if let Some(output @ 1..) = place.output {
        label += &format!(" {}", output + 1);
    }
    label
}

fn snippet(library: &Library, place: &Place) -> PropertyDecl {
    let default = match (place.slot, place.output) {
        (Slot::Sampling, _) => "filtered",
        (Slot::Gradient, _) => "central",
        (Slot::Classification, _) => "transfer_function",
        (Slot::Shading, _) => "none",
        (Slot::Compositing, Some(1)) => "first_hit_point",
        (Slot::Compositing, Some(2)) => "first_hit_normal",
        (Slot::Compositing, _) => "dvr",
        (Slot::Refinement, _) => "secant",
        // Skipping; the program's own slots have no property.
        _ => "auto",
    };
    let mut help = match place.slot {
        Slot::Skipping => "auto: chosen by the share of bricks in which anything is visible.".to_owned(),
        _ => String::new(),
    };
    for (path, declaration) in library.snippets(place.slot) {
        help += &format!("{}{}: {}", if help.is_empty() { "" } else { " " }, Library::id(path), declaration.help);
    }
    PropertyDecl::snippet(place.id, label(place), place.slot.id(), default).help(help)
}

fn sampling(declaration: Declaration) -> Declaration {
    let bricks = vec![
        Choice::new("4", "4 voxels", "Follows the visible parts closely."),
        Choice::new("8", "8 voxels", "An eighth of the memory."),
    ];
    let precisions = vec![
        Choice::new("32-bit", "32-bit float", "Accumulates and stores without visible loss."),
        Choice::new("16-bit", "16-bit float", "Half the memory; stored colours are off by up to 0.0005."),
    ];
    declaration
        .property(
            PropertyDecl::float("sampling_rate", "Sampling rate", 1.0)
                .range(1.0 / 64.0, 4096.0)
                .logarithmic()
                .unit("samples per voxel")
                .help("Samples a voxel along the ray. The error of smooth scenes falls with its square; time grows with it."),
        )
        .property(
            PropertyDecl::float("pixel_rate", "Pixel rate", 1.0)
                .range(0.25, 4.0)
                .logarithmic()
                .unit("rays per pixel edge")
                .help(
                    "Rays along each edge of a pixel: at 2 four rays a pixel are averaged, at 0.5 one ray serves four pixels, with \
                     linear interpolation between rays.",
                ),
        )
        .property(
            PropertyDecl::bool("jitter", "Jitter", false)
                .level(Level::Shader)
                .help("Moves the samples of every ray by a random share of a step: rings of undersampling become noise."),
        )
        .property(
            PropertyDecl::int("jitter_seed", "Jitter seed", 0)
                .int_range(0, i64::from(i32::MAX))
                .help("Another number gives other noise, the same number the same noise."),
        )
        .property(
            PropertyDecl::int("max_samples", "Most samples", 1 << 20)
                .int_range(1, MOST_SAMPLES)
                .help("Upper bound of the samples on one ray; beyond it the steps get longer."),
        )
        .property(
            PropertyDecl::float("termination_error", "Termination error", 0.002)
                .range(0.0, 0.5)
                .help("Early ray termination: the largest error of a colour component that stopping may cause. 0 walks the whole ray."),
        )
        .property(PropertyDecl::choice("brick_size", "Brick size", "4", bricks).help("Edge of the bricks of empty-space skipping."))
        .property(
            PropertyDecl::choice("target", "Target precision", "32-bit", precisions)
                .level(Level::Shader)
                .help("How colours are stored; accumulation is always in 32 bits."),
        )
        .property(
            PropertyDecl::int("channel", "Channel", 0)
                .int_range(0, 3)
                .level(Level::Shader)
                .help("The channel of the volume that is classified, counted from 0; of a gradient volume always the value."),
        )
}

fn appearance(declaration: Declaration) -> Declaration {
    let ramp = TransferFunction::ramp(ValueRange::new(0.0, 1.0), 0.1);
    declaration
        .property(
            PropertyDecl::transfer_function("transfer_function", "Transfer function", ramp)
                .level(Level::Parameters)
                .help("Colour and opacity of values, in the volume's own unit; opacity is that of one reference length."),
        )
        .property(
            PropertyDecl::transfer_function_2d("transfer_function_2d", "2-D transfer function", TransferFunction2D::default())
                .level(Level::Parameters)
                .help("Colour and opacity over value (volume's unit) and gradient magnitude (volume's unit a world unit)."),
        )
        .property(
            PropertyDecl::labels("label_table", "Label table", LabelTable::default())
                .level(Level::Parameters)
                .help("A transfer function for each label, for the classification `labels`."),
        )
        .property(
            PropertyDecl::float("reference_length", "Reference length", 0.0)
                .range(0.0, f64::INFINITY)
                .unit("world units")
                .help("The length to which opacities refer. 0 takes the mean voxel spacing. The picture does not depend on step or spacing otherwise."),
        )
        .property(PropertyDecl::light("light", "Light", Light::default()).help("A directional light, fixed to the camera or to the world."))
        .property(PropertyDecl::bool("two_sided", "Two-sided", true).help("Lights both sides: normals of surfaces are turned towards the viewer, those of media, which have no front, towards the light."))
        .property(
            PropertyDecl::float("gradient_fade", "Gradient fade", 0.002)
                .range(1e-6, 1.0)
                .logarithmic()
                .unit("value range per voxel")
                .help("Gradient magnitude at which shading has faded half: flat regions have no surface to light."),
        )
}
