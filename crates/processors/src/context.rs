//! What a processor works with: the device, its caches and the processor's own memory.

use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::sync::Arc;

use rayloom_gpu::wgpu::{TextureFormat, TextureUsages};
use rayloom_gpu::{Gpu, GpuError, PipelineCache, Texture, TexturePool, Timer};

use rayloom_volume::Progress;

use crate::explain::{Explanation, Role, texture};
use crate::{Ledger, MISS};

/// Told how far a slow processor is: its id, and its progress.
pub type ProgressListener = Box<dyn FnMut(&str, Progress) + Send>;

/// The device and everything that outlives one run of one processor.
pub struct Context {
    /// The device.
    pub gpu: Gpu,
    /// Render targets.
    pub pool: TexturePool,
    /// Compiled shaders.
    pub pipelines: PipelineCache,
    /// Measures GPU time; hand it to every pass.
    pub timer: Timer,
    /// Whether ray traversals count rays and samples, which costs a little time.
    pub count_samples: bool,
    /// Where processors write down what they do and why.
    pub ledger: Ledger,
    /// Whom to tell about progress.
    pub progress: Option<ProgressListener>,
    /// Says whether nobody waits any more for what is being computed.
    pub interrupt: Option<Box<dyn Fn() -> bool + Send>>,
    states: HashMap<(String, TypeId), Box<dyn Any + Send>>,
    blank_color: Arc<Texture>,
    blank_depth: Arc<Texture>,
}

impl Context {
    /// A context on a device, with empty caches and GPU time not measured.
    pub fn new(gpu: Gpu) -> Result<Self, GpuError> {
        let mut timer = Timer::new(&gpu)?;
        timer.set_enabled(false);
        let blank_color = one_texel(&gpu, TextureFormat::Rgba32Float, &[0.0; 4])?;
        let blank_depth = one_texel(&gpu, TextureFormat::R32Float, &[MISS])?;
        Ok(Self {
            gpu,
            pool: TexturePool::new(),
            pipelines: PipelineCache::new(),
            timer,
            count_samples: false,
            ledger: Ledger::default(),
            progress: None,
            interrupt: None,
            states: HashMap::new(),
            blank_color,
            blank_depth,
        })
    }

    /// Starts again on another device, with empty caches; who listens and what is switched on stay.
    ///
    /// # Errors
    /// The device cannot be used.
    pub fn renew(&mut self, gpu: Gpu) -> Result<(), GpuError> {
        let mut fresh = Self::new(gpu)?;
        fresh.timer.set_enabled(self.timer.enabled());
        fresh.count_samples = self.count_samples;
        fresh.ledger = std::mem::take(&mut self.ledger);
        fresh.progress = self.progress.take();
        fresh.interrupt = self.interrupt.take();
        *self = fresh;
        Ok(())
    }

    /// What the processor with this id remembers from its last run, as a `T` of its own; the default at first.
    pub fn state<T: Any + Default + Send>(&mut self, id: &str) -> &mut T {
        let slot = self.states.entry((id.to_owned(), TypeId::of::<T>())).or_insert_with(|| Box::new(T::default()));
        match slot.downcast_mut() {
            Some(state) => state,
            None => unreachable!("states are stored under their own type"),
        }
    }

    /// Like [`Context::state`], but takes it out, so that the context can be used beside it; the next call starts from
    /// the default unless [`Context::put_state`] is called.
    pub fn take_state<T: Any + Default + Send>(&mut self, id: &str) -> T {
        let slot = self.states.remove(&(id.to_owned(), TypeId::of::<T>()));
        slot.and_then(|state| state.downcast().ok()).map_or_else(T::default, |state| *state)
    }

    /// Stores what the processor with this id remembers.
    pub fn put_state<T: Any + Send>(&mut self, id: &str, state: T) {
        self.states.insert((id.to_owned(), TypeId::of::<T>()), Box::new(state));
    }

    /// Forgets what processors remember that do not exist any more.
    pub fn forget_others(&mut self, exists: impl Fn(&str) -> bool) {
        self.states.retain(|(id, _), _| exists(id));
    }

    /// A target from the pool, of `size` pixels. Its contents are old, so write every pixel.
    pub fn target(&mut self, label: &str, size: [u32; 2], format: TextureFormat) -> Result<Arc<Texture>, GpuError> {
        let made = self.pool.counts().created;
        let target = self.pool.get(&self.gpu, label, size, format)?;
        let is_new = self.pool.counts().created > made;
        self.ledger.record(|| {
            let allocated = |why| Explanation::new(Role::Allocated, format!("{label}: {}", texture(&target)), why);
            match is_new {
                true => allocated("made anew").bytes(target.bytes()),
                false => allocated("taken over from an earlier use, so no new memory"),
            }
        });
        Ok(target)
    }

    /// A colour target from the pool: rgba32float of `size` pixels. Its contents are old, so write every pixel.
    pub fn color_target(&mut self, label: &str, size: [u32; 2]) -> Result<Arc<Texture>, GpuError> {
        self.target(label, size, TextureFormat::Rgba32Float)
    }

    /// A depth target from the pool: r32float of `size` pixels. Its contents are old, so write every pixel.
    pub fn depth_target(&mut self, label: &str, size: [u32; 2]) -> Result<Arc<Texture>, GpuError> {
        self.target(label, size, TextureFormat::R32Float)
    }

    /// One transparent texel, for an optional colour input that is not connected.
    pub fn blank_color(&self) -> Arc<Texture> {
        self.blank_color.clone()
    }

    /// One texel of [`MISS`], for a depth that does not exist.
    pub fn blank_depth(&self) -> Arc<Texture> {
        self.blank_depth.clone()
    }

    /// Whether nobody waits any more for what is being computed; slow processors then fail, with whatever error.
    pub fn interrupted(&self) -> bool {
        self.interrupt.as_ref().is_some_and(|interrupted| interrupted())
    }

    /// Tells the listener, if any, how far the processor with this id is.
    pub fn report(&mut self, id: &str, progress: Progress) {
        if let Some(listener) = &mut self.progress {
            listener(id, progress);
        }
    }
}

fn one_texel(gpu: &Gpu, format: TextureFormat, texel: &[f32]) -> Result<Arc<Texture>, GpuError> {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let texture = gpu.texture_2d("an input that is not connected", [1, 1], format, usage)?;
    gpu.upload(&texture, bytemuck::cast_slice(texel))?;
    Ok(Arc::new(texture))
}
