//! `rayloom tune`: the cheapest setting within an error, as a preset.

use std::ops::ControlFlow;

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_measure::{Goal, tune};
use rayloom_network::Network;
use rayloom_processors::types;

use crate::args::TuneArgs;
use crate::failure::{Failure, check_folder};
use crate::network_file;
use crate::progress::Line;
use crate::reference::{DEFAULT_SIZE, cache};

/// Tunes, writes the preset and returns what was found.
///
/// # Errors
/// The network cannot be loaded or tuned, or the file cannot be written.
pub fn run(args: &TuneArgs) -> Result<String, Failure> {
    args.output.iter().try_for_each(|file| check_folder(file))?;
    let network = network_file::open(&args.network, &args.set)?;
    let goal = Goal {
        port: args.port.clone(),
        max_error: args.max_error,
        budget_ms: args.budget,
        size: args.size,
        picture: picture_size(&network),
        views: args.views.into(),
        unseen: args.unseen.into(),
        standard: args.reference,
    };
    let gpu = Gpu::new(&GpuOptions::default())?;
    let line = Line::new("tuning");
    let progress = |what: &str, share: f64| {
        line.share(what, share);
        ControlFlow::Continue(())
    };
    let mut tuned = tune(&network, &goal, gpu, &cache(args.cache.as_deref()), &progress)?;
    drop(line);
    tuned.preset.name = args.name.clone().unwrap_or(tuned.preset.name.clone());
    let message = tuned.message();
    let preset = &tuned.preset;
    match &args.output {
        None => Ok(format!("{message}\n{:#}\n", preset.to_json())),
        Some(output) => {
            let mut network = network_file::load(&args.network)?.0;
            network.keep_preset(preset);
            network.save(output)?;
            Ok(format!("{message}\n{}: preset `{}`\n", output.display(), preset.name))
        }
    }
}

/// The largest canvas.
fn picture_size(network: &Network) -> [u32; 2] {
    let canvases = network.processors().filter(|processor| processor.type_id() == types::CANVAS);
    let sizes = canvases.filter_map(|canvas| canvas.properties().array::<2>("size").ok());
    let larger = |a: [f64; 2], b: [f64; 2]| if b[0] * b[1] > a[0] * a[1] { b } else { a };
    sizes.reduce(larger).map_or(DEFAULT_SIZE, |size| size.map(|side| (side as u32).max(1)))
}
