//! Image files: PNG for looking at, OpenEXR and NumPy arrays for computing with.

use std::io::{self, BufReader, Cursor};
use std::path::{Path, PathBuf};

use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Layer, LayerAttributes, SmallVec, WritableImage};
use image::{ExtendedColorType, ImageEncoder, ImageReader, codecs::png::PngEncoder};
use npyz::WriterBuilder;
use thiserror::Error;

/// An image in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Premultiplied colours, or whatever the image holds; row 0 at the top.
    pub pixels: Vec<[f32; 4]>,
    /// Depth of each pixel (distance along the viewing direction in world units), if there is one.
    pub depth: Option<Vec<f32>>,
}

/// Why an image file could not be read or written.
#[derive(Debug, Error)]
pub enum ImageFileError {
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The contents could not be coded or decoded.
    #[error("{}: not a usable image: {message}", path.display())]
    Contents {
        /// The file.
        path: PathBuf,
        /// The reason.
        message: String,
    },
    /// An extension that no format here has.
    #[error("{}: found the extension `{found}`, expected one of .png, .exr, .npy", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
        /// Its extension, without the dot.
        found: String,
    },
    /// The numbers of pixels do not match the size.
    #[error("{}: found {found} pixels or depths, expected {expected}", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Pixels or depths given.
        found: usize,
        /// Pixels that the size asks for.
        expected: usize,
    },
}

/// Writes an image in the format of the path's extension: .png, .exr or .npy.
pub fn write_picture(path: &Path, picture: &Picture) -> Result<(), ImageFileError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "png" => write_png(path, picture),
        "exr" => write_exr(path, picture),
        "npy" => write_npy(path, picture),
        _ => Err(ImageFileError::Extension { path: path.to_owned(), found: extension }),
    }
}

/// Writes an 8-bit PNG with straight alpha. The colours go into the file as they are, which viewers take for sRGB; what
/// lies outside `0 ..= 1` is clamped, and depth is not written.
pub fn write_png(path: &Path, picture: &Picture) -> Result<(), ImageFileError> {
    check_length(path, picture)?;
    let bytes: Vec<u8> = picture.pixels.iter().flat_map(|&pixel| straight_bytes(pixel)).collect();
    let mut file = Cursor::new(Vec::new());
    let [width, height] = picture.size;
    PngEncoder::new(&mut file)
        .write_image(&bytes, width, height, ExtendedColorType::Rgba8)
        .map_err(|error| contents(path, error))?;
    store(path, file.into_inner())
}

/// Writes 32-bit floats as OpenEXR: channels R, G, B, A (premultiplied, as that format has it) and, with depth, Z.
pub fn write_exr(path: &Path, picture: &Picture) -> Result<(), ImageFileError> {
    check_length(path, picture)?;
    let channel = |name: &str, samples: Vec<f32>| AnyChannel::new(name, FlatSamples::F32(samples));
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = ["R", "G", "B", "A"]
        .iter()
        .enumerate()
        .map(|(i, name)| channel(name, picture.pixels.iter().map(|pixel| pixel[i]).collect()))
        .collect();
    channels.extend(picture.depth.iter().map(|depth| channel("Z", depth.clone())));
    let size = picture.size.map(|n| n as usize);
    let layer = Layer::new(
        (size[0], size[1]),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let mut file = Cursor::new(Vec::new());
    exr::image::Image::from_layer(layer).write().to_buffered(&mut file).map_err(|error| contents(path, error))?;
    store(path, file.into_inner())
}

/// Writes a NumPy array of 32-bit floats with the shape (height, width, 4). Depth is not written.
pub fn write_npy(path: &Path, picture: &Picture) -> Result<(), ImageFileError> {
    check_length(path, picture)?;
    let [width, height] = picture.size.map(u64::from);
    let mut file = Cursor::new(Vec::new());
    let write = |file: &mut Cursor<Vec<u8>>| -> io::Result<()> {
        let options = npyz::WriteOptions::<f32>::new().default_dtype().shape(&[height, width, 4]).writer(file);
        let mut writer = options.begin_nd()?;
        writer.extend(picture.pixels.iter().flatten().copied())?;
        writer.finish()
    };
    write(&mut file).map_err(|source| ImageFileError::Io { path: path.to_owned(), source })?;
    store(path, file.into_inner())
}

/// Reads a PNG or OpenEXR file as premultiplied colours. PNG numbers are taken as they are, 0 to 1.
pub fn read_picture(path: &Path) -> Result<Picture, ImageFileError> {
    let io_error = |source| ImageFileError::Io { path: path.to_owned(), source };
    let file = BufReader::new(rayloom_files::open(path).map_err(io_error)?);
    let reader = ImageReader::new(file).with_guessed_format().map_err(io_error)?;
    let premultiplied = reader.format() == Some(image::ImageFormat::OpenExr);
    let decoded = reader.decode().map_err(|error| contents(path, error))?.into_rgba32f();
    let multiply = |[r, g, b, a]: [f32; 4]| {
        if premultiplied { [r, g, b, a] } else { [r * a, g * a, b * a, a] }
    };
    let pixels = decoded.pixels().map(|pixel| multiply(pixel.0)).collect();
    Ok(Picture { size: decoded.dimensions().into(), pixels, depth: None })
}

/// Straight 8-bit RGBA of a premultiplied colour; transparent pixels are black.
fn straight_bytes([r, g, b, a]: [f32; 4]) -> [u8; 4] {
    let divisor = if a > 0.0 { a } else { 1.0 };
    // Casts saturate, and turn NaN into 0.
    let code = |value: f32| (value * 255.0).round() as u8;
    if a > 0.0 { [code(r / divisor), code(g / divisor), code(b / divisor), code(a)] } else { [0; 4] }
}

fn check_length(path: &Path, picture: &Picture) -> Result<(), ImageFileError> {
    let expected = picture.size[0] as usize * picture.size[1] as usize;
    let lengths = [Some(picture.pixels.len()), picture.depth.as_ref().map(Vec::len)];
    match lengths.into_iter().flatten().find(|&found| found != expected) {
        Some(found) => Err(ImageFileError::Length { path: path.to_owned(), found, expected }),
        None => Ok(()),
    }
}

fn contents(path: &Path, error: impl ToString) -> ImageFileError {
    ImageFileError::Contents { path: path.to_owned(), message: error.to_string() }
}

fn store(path: &Path, bytes: Vec<u8>) -> Result<(), ImageFileError> {
    rayloom_files::write(path, &bytes).map_err(|source| ImageFileError::Io { path: path.to_owned(), source })
}
