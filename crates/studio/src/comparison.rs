//! A part of a picture compared with the float64 reference, in the background.

use std::sync::Arc;
use std::time::{Duration, Instant};

use bytemuck::cast_slice;
use egui::ColorImage;
use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError};
use rayloom_measure::{Chain, Errors, MeasureError, Subject, error_color, user_cache};
use rayloom_network::{Address, Network};
use rayloom_processors::{Data, Image};
use rayloom_reference::{Cache, DisplayComparison, DisplayPicture, Rectangle, Reference, RenderError, Source};

use crate::engine::Results;
use crate::task::{Control, Task};

/// What to compare with what.
pub(crate) struct Question {
    /// The picture.
    pub(crate) image: Arc<Image>,
    /// Which part of it.
    pub(crate) part: Rectangle,
    /// The reference.
    pub(crate) reference: Reference,
    subject: Subject,
}

/// How far the part is from the reference.
pub(crate) struct Answer {
    /// On the numbers.
    pub(crate) errors: Errors,
    /// On the screen, over black.
    pub(crate) seen: DisplayComparison,
    /// The reference's picture of the part.
    pub(crate) reference: Arc<Image>,
    /// The error of every pixel, in colours.
    pub(crate) map: ColorImage,
    /// How long the reference took; `None` when it was found in the cache.
    pub(crate) took: Option<Duration>,
}

/// The result of a comparison; `None` when it was cancelled.
pub(crate) type Outcome = Result<Option<Answer>, MeasureError>;

impl Question {
    /// About what a ray traversal shows in the latest results.
    ///
    /// # Errors
    /// The reference cannot draw it, or its picture is not there (yet).
    pub(crate) fn new(
        network: &Network,
        results: &Results,
        chain: &Chain,
        part: Rectangle,
        reference: Reference,
    ) -> Result<Self, MeasureError> {
        let image = image_at(results, &chain.image)
            .ok_or_else(|| MeasureError::Evaluation(format!("{} holds no image yet.", chain.image)))?;
        let subject = Subject::of(network, |port| results.outputs.get(port), chain)?;
        subject.check(reference)?;
        Ok(Self { image, part, reference, subject })
    }

    /// Starts the comparison.
    pub(crate) fn ask(self, gpu: Gpu, context: &egui::Context) -> Task<Outcome> {
        Task::start(context, move |control| match self.answer(&gpu, control) {
            Err(MeasureError::Render(RenderError::Cancelled)) => Ok(None),
            other => other.map(Some),
        })
    }

    fn answer(&self, gpu: &Gpu, control: &Control) -> Result<Answer, MeasureError> {
        let Rectangle { x, y, width, height } = self.part;
        let size = [width, height];
        let picture = gpu.read_region(&self.image.color, [x, y, 0], [width, height, 1])?;
        let start = Instant::now();
        let progress = |share| control.tell(share);
        let cache = Cache::new(user_cache());
        let cached = cache.render(self.reference, &self.subject.scene(), Some(self.part), &progress)?;
        let took = (!matches!(cached.source, Source::Found)).then(|| start.elapsed());
        let (errors, pixels) = Errors::of(&picture, &cached.image.color)?;
        let black = [0.0; 3];
        let shown = DisplayPicture::of(size, &picture, black)?;
        let seen = DisplayComparison::new(&shown, &DisplayPicture::of(size, &cached.image.color, black)?)?;
        let colors: Vec<u8> = pixels.iter().flat_map(|&error| error_color(error)).collect();
        let map = ColorImage::from_rgb(size.map(|pixels| pixels as usize), &colors);
        Ok(Answer { errors, seen, reference: self.uploaded(gpu, &cached.image.color)?, map, took })
    }

    /// The reference as an image like that of the network, to be looked at in the same way.
    fn uploaded(&self, gpu: &Gpu, pixels: &[[f64; 4]]) -> Result<Arc<Image>, GpuError> {
        let narrow: Vec<[f32; 4]> = pixels.iter().map(|pixel| pixel.map(|channel| channel as f32)).collect();
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
        let size = [self.part.width, self.part.height];
        let color = gpu.texture_2d("reference", size, TextureFormat::Rgba32Float, usage)?;
        gpu.upload(&color, cast_slice(&narrow))?;
        Ok(Arc::new(Image { color: Arc::new(color), depth: None, kind: self.image.kind, view: None }))
    }
}

/// The image on an outport.
pub(crate) fn image_at(results: &Results, outport: &Address) -> Option<Arc<Image>> {
    match results.outputs.get(outport)? {
        Data::Image(image) => Some(image.clone()),
        _ => None,
    }
}
