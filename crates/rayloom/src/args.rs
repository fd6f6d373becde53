//! What can be written on the command line. Everything that does not depend on a file is checked here.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use rayloom_measure::{Standard, Vary};
use rayloom_network::Address;
use rayloom_reference::Reference;
use serde_json::Value as Json;

/// The extensions of the files that a picture can be written to.
const PICTURES: [&str; 3] = ["png", "exr", "npy"];

/// Pictures are at most this wide and high, as a canvas is.
const MAX_SIZE: u32 = 16_384;

/// The command line of Rayloom.
#[derive(Debug, Parser)]
#[command(name = "rayloom", version)]
#[command(about = "Visual dataflow workbench for GPU volume raycasting. Without a command it opens the studio.")]
#[command(
    after_help = "Exit code: 0 when all is well, 1 when something failed (one message says what, where and what to \
                        do), 2 when the command line cannot be understood."
)]
pub struct Cli {
    /// What to do; without one the studio opens.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// One command each.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Evaluate a network and write a picture.
    Render(RenderArgs),
    /// Measure what speed costs in accuracy: times, samples and errors of many settings, with a page that says what to
    /// choose.
    Measure(MeasureArgs),
    /// Say for every processor what was computed, bound and allocated and why, and what was left out and why.
    Explain(ExplainArgs),
    /// Verify the ray loop on this device: by what power errors fall as steps, voxels and pixels get smaller.
    Verify(VerifyArgs),
    /// Pick the cheapest setting whose pictures keep within an error, or the most accurate within a time.
    Tune(TuneArgs),
    /// Say whether a network can be rendered, and if not, why. Needs no graphics adapter.
    Check {
        /// The network file (JSON).
        network: PathBuf,
    },
    /// List what networks are made of.
    List(ListArgs),
    /// Print the assembled WGSL of a ray traversal, each part with the file and line it comes from.
    Shader {
        /// The network file (JSON).
        network: PathBuf,
        /// Id of the processor in the network.
        processor: String,
        /// Set a property first; may be repeated. The value is JSON, or a bare word for a text.
        #[arg(long, value_name = "PROCESSOR.PROPERTY=JSON", value_parser = setting)]
        set: Vec<Setting>,
    },
    /// Follow the ray of one pixel through a ray traversal and print its samples as CSV: place, value, gradient, colours,
    /// and what the pixel has come to so far.
    Probe(ProbeArgs),
    /// Describe a volume file: size, values, place in the world.
    Info {
        /// The volume file; `rayloom list formats` says what can be read.
        volume: PathBuf,
    },
    /// Print the graphics adapter that would be used.
    Adapter,
    /// Open a network in the studio.
    Open {
        /// The network file (JSON).
        network: PathBuf,
        /// How to start; by default an application as such, any other network in development mode.
        #[arg(long, value_enum)]
        mode: Option<StartMode>,
    },
}

/// How the studio starts.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum StartMode {
    /// Everything visible and editable.
    Development,
    /// Canvases and what the author exposed, nothing else.
    Visualization,
}

/// Arguments of `rayloom render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The network file (JSON).
    pub network: PathBuf,
    /// Set a property first; may be repeated, in this order. The value is JSON, or a bare word for a text.
    /// Of a camera or light only the fields to change need be given, or one by its name: view.camera.fov_degrees=30.
    #[arg(long, value_name = "PROCESSOR.PROPERTY=JSON", value_parser = setting)]
    pub set: Vec<Setting>,
    /// Apply a preset of the network, before anything is set.
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Size of the picture in pixels, in place of the canvas's.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Write the image at this port instead of the canvas's.
    #[arg(long, value_name = "PROCESSOR.PORT", value_parser = address)]
    pub port: Option<Address>,
    /// Where to write: .png (8 bits, straight alpha), .exr (floats and depth) or .npy (float32, height x width x 4,
    /// premultiplied, row 0 at the top).
    #[arg(short, long, value_name = "FILE", value_parser = picture_file)]
    pub output: PathBuf,
    /// Write what the evaluation did as JSON: adapter, times and reasons of every run, rays and samples.
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// Write what the ray traversal should show instead, computed in float64 without the graphics device: `exact`, without
    /// samples, or `same-samples`, those that the device takes.
    #[arg(long, value_name = "REFERENCE", value_parser = reference, conflicts_with = "stats")]
    pub reference: Option<Reference>,
    /// Where pictures of the reference are kept, in place of the user's cache.
    #[arg(long, value_name = "FOLDER", requires = "reference")]
    pub cache: Option<PathBuf>,
}

/// Arguments of `rayloom measure`.
#[derive(Debug, Args)]
pub struct MeasureArgs {
    /// The network file (JSON).
    pub network: PathBuf,
    /// Set a property first; may be repeated, in this order. The value is JSON, or a bare word for a text.
    #[arg(long, value_name = "PROCESSOR.PROPERTY=JSON", value_parser = setting)]
    pub set: Vec<Setting>,
    /// Vary a property; may be repeated: every combination of the values is measured.
    #[arg(long, value_name = "PROCESSOR.PROPERTY=A,B,C", value_parser = vary)]
    pub vary: Vec<Vary>,
    /// Vary a ready knob around the network's own setting; may be repeated: quality, rate, jitter, pixel_rate, integrator,
    /// sampling, gradient, gradients (storage of precomputed ones), entry, volume, target, termination, skipping, or all,
    /// which is what happens when nothing is varied.
    #[arg(long, value_name = "NAME")]
    pub ladder: Vec<String>,
    /// Number of camera views: the saved one and orbits around its focus.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub views: u16,
    /// Number of timings of every setting and view, taken in turns.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub rounds: u16,
    /// Size of the pictures in pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, default_value = "256x256")]
    pub size: [u32; 2],
    /// What to compare with: `exact` (float64, without samples), `same-samples` (float64, the samples of each setting) or
    /// `finest` (the device's own picture at its finest). Without it: exact where that can be drawn, else finest.
    #[arg(long, value_name = "REFERENCE", value_parser = standard)]
    pub reference: Option<Standard>,
    /// The ray traversal to measure, by its outport; may be left out where there is only one.
    #[arg(long, value_name = "PROCESSOR.PORT", value_parser = address)]
    pub port: Option<Address>,
    /// Where pictures of the reference are kept, in place of the user's cache.
    #[arg(long, value_name = "FOLDER")]
    pub cache: Option<PathBuf>,
    /// Leave out the table that splits the error into its causes.
    #[arg(long)]
    pub no_budget: bool,
    /// The folder for measurements.csv, views.csv, measurements.json and report.html; made if it is not there.
    #[arg(short, long, value_name = "FOLDER")]
    pub output: PathBuf,
}

/// Arguments of `rayloom explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The network file (JSON).
    pub network: PathBuf,
    /// Set a property first; may be repeated, in this order. The value is JSON, or a bare word for a text.
    #[arg(long, value_name = "PROCESSOR.PROPERTY=JSON", value_parser = setting)]
    pub set: Vec<Setting>,
    /// Size of the pictures in pixels, in place of those of the canvases.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `rayloom verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Only as much as it takes to tell an order: some seconds.
    #[arg(long)]
    pub quick: bool,
    /// Write a page with plots, the plots as SVG files and all errors as JSON into this folder; made if it is not there.
    #[arg(long, value_name = "FOLDER")]
    pub report: Option<PathBuf>,
}

/// Arguments of `rayloom probe`.
#[derive(Debug, Args)]
pub struct ProbeArgs {
    /// The network file (JSON).
    pub network: PathBuf,
    /// The pixel: column and row, counted from 0 at the upper left.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub pixel: [u32; 2],
    /// The file to write; the standard output without it.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Id of the ray traversal; needed where there are several.
    #[arg(long)]
    pub processor: Option<String>,
    /// Size of the picture instead of that of its canvas.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Set a property first; may be repeated. The value is JSON, or a bare word for a text.
    #[arg(long, value_name = "PROCESSOR.PROPERTY=JSON", value_parser = setting)]
    pub set: Vec<Setting>,
}

/// Arguments of `rayloom tune`.
#[derive(Debug, Args)]
#[command(group(clap::ArgGroup::new("goal").required(true).multiple(true).args(["max_error", "budget"])))]
pub struct TuneArgs {
    /// The network file (JSON).
    pub network: PathBuf,
    /// Set a property first; may be repeated, in this order. The value is JSON, or a bare word for a text.
    #[arg(long, value_name = "PROCESSOR.PROPERTY=JSON", value_parser = setting)]
    pub set: Vec<Setting>,
    /// The largest error, such as 0.004 or 1/255, that 99 % of the pixels may have on any view. Errors are of premultiplied
    /// colours from 0 to 1, in the pixels that show anything.
    #[arg(long, value_name = "ERROR", value_parser = fraction, allow_negative_numbers = true)]
    pub max_error: Option<f64>,
    /// The longest time that a picture may take, milliseconds on the device, at the size of the canvas.
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub budget: Option<f64>,
    /// Where to write the network with the setting as a preset; may be the network file itself. Without it the preset is
    /// printed.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// What the preset is called, in place of a name made from the goal.
    #[arg(long)]
    pub name: Option<String>,
    /// Number of camera views to choose by, all around the focus of the saved one; half as many join them where it is close.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u16).range(2..=64))]
    pub views: u16,
    /// Number of further views that the choice is then looked at from.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub unseen: u16,
    /// Size of the pictures that errors are measured on, in pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, default_value = "64x64")]
    pub size: [u32; 2],
    /// What to compare with: `exact` (float64, without samples) or `finest` (the device's own picture at its finest). Without
    /// it: exact where that can be drawn, else finest.
    #[arg(long, value_name = "REFERENCE", value_parser = standard)]
    pub reference: Option<Standard>,
    /// The ray traversal to tune, by its outport; may be left out where there is only one.
    #[arg(long, value_name = "PROCESSOR.PORT", value_parser = address)]
    pub port: Option<Address>,
    /// Where pictures of the reference are kept, in place of the user's cache.
    #[arg(long, value_name = "FOLDER")]
    pub cache: Option<PathBuf>,
}

/// Arguments of `rayloom list`.
#[derive(Debug, Args)]
pub struct ListArgs {
    /// What to list.
    pub what: Listed,
    /// Print JSON with everything that is declared.
    #[arg(long)]
    pub json: bool,
    /// Write one Markdown page each into this folder instead (processors and snippets).
    #[arg(long, value_name = "FOLDER", conflicts_with = "json")]
    pub pages: Option<PathBuf>,
}

/// What can be listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Listed {
    /// Types of processors with ports and properties.
    Processors,
    /// Snippets that fill the slots of the ray loop.
    Snippets,
    /// File formats of volumes and pictures.
    Formats,
}

/// A property and the value it is to have.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The property.
    pub property: Address,
    /// Its value.
    pub value: Json,
}

fn setting(text: &str) -> Result<Setting, String> {
    let (property, value) = text
        .split_once('=')
        .ok_or("there is no `=`; write PROCESSOR.PROPERTY=JSON, such as canvas.size='[800, 600]'")?;
    Ok(Setting { property: address(property.trim())?, value: json(value)? })
}

/// JSON, or the text itself where it cannot be meant as JSON.
fn json(text: &str) -> Result<Json, String> {
    match serde_json::from_str(text) {
        Ok(json) => Ok(json),
        Err(error) if text.trim_start().starts_with(['{', '[', '"']) => {
            Err(format!("the value is not JSON: {error}; check its quotes and brackets"))
        }
        Err(_) => Ok(Json::from(text)),
    }
}

fn address(text: &str) -> Result<Address, String> {
    text.parse().map_err(|error: rayloom_network::AddressError| error.to_string())
}

fn vary(text: &str) -> Result<Vary, String> {
    text.parse()
}

/// A number, or one number divided by another.
fn fraction(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let found = match text.split_once('/') {
        Some((above, below)) => number(above).zip(number(below)).map(|(above, below)| above / below),
        None => number(text),
    };
    found
        .filter(|found| *found > 0.0 && *found <= 1.0)
        .ok_or_else(|| "write a number above 0 and at most 1, such as 0.004 or 1/255".into())
}

fn reference(text: &str) -> Result<Reference, String> {
    Reference::from_id(text).ok_or_else(|| choices(text, &Reference::ALL.map(Reference::id)))
}

fn standard(text: &str) -> Result<Standard, String> {
    let found = Standard::ALL.into_iter().find(|standard| standard.id() == text);
    found.ok_or_else(|| choices(text, &Standard::ALL.map(Standard::id)))
}

fn choices(found: &str, known: &[&str]) -> String {
    format!("there is no reference `{found}`; choose {}", known.join(" or "))
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.trim().parse().ok().filter(|side| (1..=MAX_SIZE).contains(side));
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| format!("write WIDTHxHEIGHT in pixels, each from 1 to {MAX_SIZE}, such as 800x600"))
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let pixel = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    pixel.ok_or_else(|| "write X,Y: column and row from the upper left, such as 120,80".to_owned())
}

fn picture_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
    if PICTURES.contains(&extension.as_str()) {
        return Ok(path);
    }
    let found = if extension.is_empty() { "no extension".to_owned() } else { format!("the extension .{extension}") };
    Err(format!("the file has {found}; pictures are written as .png, .exr or .npy"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn settings_are_json_or_bare_words() {
        let value = |text| setting(text).map(|setting| setting.value);
        assert_eq!(value("a.b=2"), Ok(Json::from(2)));
        assert_eq!(value("a.b=8-bit"), Ok(Json::from("8-bit")));
        assert_eq!(value("a.b=../x=y.nii"), Ok(Json::from("../x=y.nii")));
        assert_eq!(value("a.b=[1, 2]"), Ok(Json::from(vec![1, 2])));
        for refused in ["a.b", "a=1", "a.b={\"x\":", "a.b=\"open"] {
            assert!(setting(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn errors_are_numbers_or_fractions() {
        assert_eq!((fraction("0.004"), fraction("1/255")), (Ok(0.004), Ok(1.0 / 255.0)));
        for refused in ["0", "-1", "2", "1/0", "nan", "a/b", ""] {
            assert!(fraction(refused).is_err(), "{refused}");
        }
    }

    #[test]
    fn sizes_and_files_are_checked() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        for refused in ["640", "0x5", "5x0", "-1x3", "1x16385", "axb"] {
            assert!(size(refused).is_err(), "{refused}");
        }
        assert!(picture_file("a.PNG").is_ok());
        assert!(picture_file("a").is_err() && picture_file("a.jpg").is_err());
    }
}
