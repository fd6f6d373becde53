//! The reference's picture of a network.

use std::ops::ControlFlow;
use std::path::PathBuf;

use rayloom_gpu::Gpu;
use rayloom_network::{Address, Network};
use rayloom_processors::Picture;
use rayloom_reference::{Cache, Cached, Reference};

use crate::run::bench::Bench;
use crate::subject::chain::Chain;
use crate::{Listener, MeasureError};

/// Draws what the ray traversal at `port` shows (the only one's if not given), or finds it in the cache. The device gives the
/// volume and the rays' box; the picture is computed without it.
///
/// # Errors
/// There is no such ray traversal, what feeds it fails, or it shows what the reference cannot draw.
pub fn draw(
    network: &Network,
    port: Option<&Address>,
    reference: Reference,
    size: [u32; 2],
    gpu: Gpu,
    cache: &Cache,
    listener: Listener<'_>,
) -> Result<(Picture, Cached), MeasureError> {
    let chain = Chain::find(network, port)?;
    let subject = Bench::new(network, chain, gpu, size)?.subject()?;
    subject.check(reference)?;
    let progress = |share| {
        listener("drawing the reference", share);
        ControlFlow::Continue(())
    };
    let cached = cache.render(reference, &subject.scene(), None, &progress)?;
    let narrow = |pixel: &[f64; 4]| pixel.map(|channel| channel as f32);
    let picture = Picture {
        size: cached.image.size,
        pixels: cached.image.color.iter().map(narrow).collect(),
        depth: Some(cached.image.depth.iter().map(|&depth| depth as f32).collect()),
    };
    Ok((picture, cached))
}

/// The folder where reference pictures are kept when none is named: in the user's cache, or in the system's folder for
/// temporary files.
pub fn user_cache() -> PathBuf {
    let folder = |variable| std::env::var_os(variable).filter(|value| !value.is_empty()).map(PathBuf::from);
    let cache = folder("XDG_CACHE_HOME").or_else(|| Some(folder("HOME")?.join(".cache")));
    cache.unwrap_or_else(std::env::temp_dir).join("rayloom").join("reference")
}
