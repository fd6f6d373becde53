//! `rayloom render --reference`: writes what a ray traversal should show.

use std::path::Path;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_measure::{Chain, draw, user_cache};
use rayloom_network::Network;
use rayloom_processors::write_picture;
use rayloom_reference::{Cache, Reference, Source};

use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::progress::Line;
use crate::target::Target;

/// Draws the picture, or finds it in the cache, and returns where it is.
///
/// # Errors
/// There is no such ray traversal, what feeds it fails, it shows what the reference cannot draw, or the picture cannot be
/// written.
pub fn render(network: &Network, args: &RenderArgs, reference: Reference) -> Result<String, Failure> {
    let chain = Chain::find(network, args.port.as_ref())?;
    let target = Target::find(network, Some(&chain.image), args.size)?;
    let size = target.request.size.unwrap_or(DEFAULT_SIZE);
    let gpu = Gpu::new(&GpuOptions::default())?;
    let line = Line::new("drawing the reference");
    let listener = |what: &str, share: f64| line.share(what, share);
    let cache = cache(args.cache.as_deref());
    let (picture, cached) = draw(network, Some(&chain.image), reference, size, gpu, &cache, &listener)?;
    drop(line);
    write_picture(&args.output, &picture)?;
    if let Source::NotKept(error) = &cached.source {
        eprintln!("warning: the picture cannot be kept for the next time: {error}");
    }
    let found = if matches!(cached.source, Source::Found) { ", drawn before" } else { "" };
    let [width, height] = picture.size;
    Ok(format!("{}: {width} x {height} pixels, {}{found}\n", args.output.display(), reference.id()))
}

/// The size of a picture where neither the command nor a canvas says.
pub const DEFAULT_SIZE: [u32; 2] = [512, 512];

/// The pictures kept in a folder, or in the user's cache.
pub fn cache(folder: Option<&Path>) -> Cache {
    Cache::new(folder.map_or_else(user_cache, Path::to_owned))
}
