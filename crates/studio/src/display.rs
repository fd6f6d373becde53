//! Images of the network as textures of the window. Nothing is read back; what is no longer shown is freed.

use std::collections::HashMap;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use eframe::egui_wgpu::RenderState;
use egui::TextureId;
use rayloom_gpu::wgpu::{self, TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, PipelineCache, Texture};
use rayloom_network::ImageKind;
use rayloom_processors::{Image, plain_shader};

const SHADER: &str = "image/display.wgsl";
const DIFFERENCE: &str = "image/difference.wgsl";

/// Frames after which a picture that nobody asked for is freed.
const KEPT_FRAMES: u64 = 30;

/// What of an image to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Layer {
    /// Colours over a checkerboard; coordinates where the image holds such.
    #[default]
    Natural,
    /// One channel, 0 to 3, as grey.
    Channel(u8),
    /// View depth as grey, near is bright.
    Depth,
}

/// How to show an image.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Look {
    /// Which layer.
    pub layer: Layer,
    /// The values shown black and white, for single channels and depth; `None`: 0 and 1.
    pub range: Option<[f32; 2]>,
    /// Side of a square of the checkerboard behind translucent colours, pixels; 0: black.
    pub checker: u32,
    /// Pixels are squares when the picture is enlarged, not smooth.
    pub sharp: bool,
    /// Values below the range are blue, those above it red; the range is 0 to 1 for colours and coordinates. What is not finite
    /// is magenta in any case.
    pub mark: bool,
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Parameters {
    range: [f32; 2],
    show: u32,
    checker: u32,
    mark: u32,
    padding: u32,
}

impl Look {
    fn parameters(self, kind: ImageKind) -> Parameters {
        let coordinates = matches!(kind, ImageKind::EntryPoints | ImageKind::ExitPoints);
        let show = match self.layer {
            Layer::Natural if coordinates => 6,
            Layer::Natural => 0,
            Layer::Channel(channel) => 1 + u32::from(channel.min(3)),
            Layer::Depth => 5,
        };
        let range = self.range.unwrap_or([0.0, 1.0]);
        Parameters { range, show, checker: self.checker, mark: self.mark.into(), padding: 0 }
    }
}

/// Identity of a shown picture: the images in memory and how they are looked at.
type Key = ([usize; 2], [u32; 6]);

struct Shown {
    /// Kept alive so that their addresses stay their own.
    _images: [Arc<Image>; 2],
    texture: Texture,
    id: TextureId,
    last_used: u64,
}

/// The window's pictures.
pub struct Display {
    gpu: Gpu,
    renderer: RenderState,
    pipelines: PipelineCache,
    shown: HashMap<Key, Shown>,
    frame: u64,
}

impl Display {
    /// Pictures for a window that draws on the same device.
    pub fn new(gpu: Gpu, renderer: RenderState) -> Self {
        Self { gpu, renderer, pipelines: PipelineCache::new(), shown: HashMap::new(), frame: 0 }
    }

    /// The picture of an image, for this frame.
    ///
    /// # Errors
    /// The device has no room for it.
    pub fn picture(&mut self, image: &Arc<Image>, look: Look) -> Result<TextureId, GpuError> {
        let parameters = look.parameters(image.kind);
        let Parameters { range: [black, white], show, checker, mark, .. } = parameters;
        let bits = [black.to_bits(), white.to_bits(), show, checker, mark, look.sharp.into()];
        // An image without depth is only asked for its colours; any texture will do in the other's place.
        let depth = image.depth.as_ref().unwrap_or(&image.color);
        let uniform = bytemuck::bytes_of(&parameters);
        self.shown(([image, image], bits), look.sharp, SHADER, uniform, [&image.color, depth])
    }

    /// The picture of how much two images of one size differ, times a gain, for this frame.
    ///
    /// # Errors
    /// The device has no room for it.
    pub fn difference(&mut self, images: [&Arc<Image>; 2], gain: f32, sharp: bool) -> Result<TextureId, GpuError> {
        let bits = [gain.to_bits(), u32::MAX, u32::MAX, u32::MAX, u32::MAX, sharp.into()];
        self.shown((images, bits), sharp, DIFFERENCE, bytemuck::bytes_of(&gain), images.map(|image| &image.color))
    }

    /// A picture that is there already, or is computed now.
    fn shown(
        &mut self,
        (images, bits): ([&Arc<Image>; 2], [u32; 6]),
        sharp: bool,
        shader: &'static str,
        parameters: &[u8],
        inputs: [&Arc<Texture>; 2],
    ) -> Result<TextureId, GpuError> {
        let key = (images.map(|image| Arc::as_ptr(image) as usize), bits);
        if let Some(shown) = self.shown.get_mut(&key) {
            shown.last_used = self.frame;
            return Ok(shown.id);
        }
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
        let texture = self.gpu.texture_2d("picture", images[0].size(), TextureFormat::Rgba8Unorm, usage)?;
        self.convert(shader, parameters, inputs, &texture)?;
        let filter = if sharp { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear };
        let mut renderer = self.renderer.renderer.write();
        let id = renderer.register_native_texture(&self.gpu.device, &texture.view, filter);
        self.shown.insert(key, Shown { _images: images.map(Arc::clone), texture, id, last_used: self.frame });
        Ok(id)
    }

    fn convert(
        &mut self,
        shader: &'static str,
        parameters: &[u8],
        [first, second]: [&Arc<Texture>; 2],
        result: &Texture,
    ) -> Result<(), GpuError> {
        let gpu = &self.gpu;
        let pipeline = self.pipelines.compute(gpu, "display", &plain_shader(shader, &[]), "main")?;
        let uniform = gpu.buffer("display", parameters, wgpu::BufferUsages::UNIFORM)?;
        gpu.guarded("display", || {
            let views = [&first.view, &second.view, &result.view].map(wgpu::BindingResource::TextureView);
            let resources = [uniform.as_entire_binding()].into_iter().chain(views);
            let entries: Vec<_> =
                (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
            let layout = &pipeline.get_bind_group_layout(0);
            let group =
                gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            let [width, height] = result.size_2d().map(|pixels| pixels.div_ceil(8));
            pass.dispatch_workgroups(width, height, 1);
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        })
    }

    /// To be called once a frame: frees what was not shown for a while.
    pub fn end_frame(&mut self) {
        self.frame += 1;
        let oldest = self.frame.saturating_sub(KEPT_FRAMES);
        let mut renderer = self.renderer.renderer.write();
        self.shown.retain(|_, shown| {
            let keep = shown.last_used >= oldest;
            if !keep {
                renderer.free_texture(&shown.id);
            }
            keep
        });
    }

    /// Number of pictures held and their bytes.
    pub fn load(&self) -> (usize, u64) {
        (self.shown.len(), self.shown.values().map(|shown| shown.texture.bytes()).sum())
    }

    /// The device that the pictures are on.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }
}

/// The device that a window draws on, as the network's own.
pub fn gpu_of(renderer: &RenderState) -> Gpu {
    Gpu::from_device(renderer.adapter.get_info(), renderer.device.clone(), renderer.queue.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_image_has_a_natural_look() {
        let look = Look::default();
        assert_eq!(look.parameters(ImageKind::Color).show, 0);
        assert_eq!(look.parameters(ImageKind::EntryPoints).show, 6);
        assert_eq!(Look { layer: Layer::Channel(3), ..look }.parameters(ImageKind::Color).show, 4);
        assert_eq!(Look { layer: Layer::Depth, ..look }.parameters(ImageKind::ExitPoints).show, 5);
    }
}
