use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::GpuError;

/// Optional abilities that are treated as missing although the adapter has them, so that the paths without them can
/// be tested anywhere. By default nothing is hidden.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Hidden {
    /// Hide timestamp queries.
    pub timestamps: bool,
    /// Hide filtering of 32-bit float textures.
    pub float32_filterable: bool,
    /// Hide 16-bit normalised texture formats.
    pub norm16: bool,
}

/// How to open a device.
#[derive(Debug, Clone, Default)]
pub struct GpuOptions {
    /// Optional abilities to do without.
    pub hidden: Hidden,
    /// Part of the wanted adapter's name in any case, or none for the fastest one.
    pub adapter: Option<String>,
}

/// The optional abilities of an open device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Features {
    /// GPU time can be measured.
    pub timestamps: bool,
    /// 32-bit float textures can be sampled with linear filtering.
    pub float32_filterable: bool,
    /// 16-bit normalised texture formats exist.
    pub norm16: bool,
}

impl Features {
    fn of(features: wgpu::Features) -> Self {
        Self {
            timestamps: features.contains(wgpu::Features::TIMESTAMP_QUERY),
            float32_filterable: features.contains(wgpu::Features::FLOAT32_FILTERABLE),
            norm16: features.contains(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM),
        }
    }
}

/// An open graphics device. Cloning it clones handles to the same device.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its only queue: work is done in the order it is submitted.
    pub queue: wgpu::Queue,
    /// The adapter's name, driver and kind.
    pub info: Arc<wgpu::AdapterInfo>,
    /// The optional abilities the device was opened with.
    pub features: Features,
    /// The largest sizes it allows.
    pub limits: Arc<wgpu::Limits>,
    lost: Arc<AtomicBool>,
}

impl Gpu {
    /// Opens the fastest adapter (or the named one) with all its optional abilities that are not hidden, and with its
    /// own maxima as limits. The `WGPU_BACKEND` environment variable narrows the choice.
    pub fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(
            wgpu::InstanceDescriptor {
                // OpenGL has too little of what the ray loop needs, and merely looking for it can be noisy.
                backends: wgpu::Backends::PRIMARY,
                ..wgpu::InstanceDescriptor::new_without_display_handle()
            }
            .with_env(),
        );
        let adapter = match &options.adapter {
            Some(name) => named_adapter(&instance, name)?,
            None => fastest_adapter(&instance)?,
        };
        let descriptor = Self::descriptor(&adapter, options.hidden);
        let info = adapter.get_info();
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| GpuError::NoDevice { adapter: info.name.clone(), report: error.to_string() })?;
        Ok(Self::from_device(info, device, queue))
    }

    /// What to ask an adapter for: for programs whose window system opens the device, followed by
    /// [`Gpu::from_device`].
    pub fn descriptor(adapter: &wgpu::Adapter, hidden: Hidden) -> wgpu::DeviceDescriptor<'static> {
        let mut wanted = wgpu::Features::empty();
        wanted.set(wgpu::Features::TIMESTAMP_QUERY, !hidden.timestamps);
        wanted.set(wgpu::Features::FLOAT32_FILTERABLE, !hidden.float32_filterable);
        wanted.set(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM, !hidden.norm16);
        let mut limits = adapter.limits();
        // More than zero would need the immediates feature, which nothing here uses.
        limits.max_immediate_size = 0;
        wgpu::DeviceDescriptor {
            label: Some("rayloom"),
            required_features: wanted & adapter.features(),
            required_limits: limits,
            ..Default::default()
        }
    }

    /// Wraps a device that somebody else opened; its abilities and limits are asked from it. Whoever then sets a callback of
    /// their own for the loss of the device hears of it instead of [`Gpu::is_lost`].
    pub fn from_device(info: wgpu::AdapterInfo, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let features = Features::of(device.features());
        let limits = Arc::new(device.limits());
        let lost = Arc::new(AtomicBool::new(false));
        let flag = lost.clone();
        device.set_device_lost_callback(move |_, _| flag.store(true, Ordering::Relaxed));
        Self { device, queue, info: Arc::new(info), features, limits, lost }
    }

    /// Whether the device is gone for good: its driver was reset or updated, or the card was taken away.
    pub fn is_lost(&self) -> bool {
        // The news may be waiting for somebody to ask; a failure to ask is no news.
        let _ = self.device.poll(wgpu::PollType::Poll);
        self.lost.load(Ordering::Relaxed)
    }

    /// Opens a new device in place of a lost one: on the same adapter if it is still there, with the same abilities.
    ///
    /// # Errors
    /// No adapter can be used any more.
    pub fn reopen(&self) -> Result<Self, GpuError> {
        let hidden = Hidden {
            timestamps: !self.features.timestamps,
            float32_filterable: !self.features.float32_filterable,
            norm16: !self.features.norm16,
        };
        let same = GpuOptions { hidden, adapter: Some(self.info.name.clone()) };
        Self::new(&same).or_else(|_| Self::new(&GpuOptions { hidden, adapter: None }))
    }

    /// Runs `work` and returns the first error the device raised meanwhile, named after `what` is under way.
    ///
    /// Errors outside such a guard would end the program, hence all recording and creating happens within one. Guards
    /// may be nested: the innermost takes the error.
    pub fn guarded<T>(&self, what: &str, work: impl FnOnce() -> T) -> Result<T, GpuError> {
        let scopes = [wgpu::ErrorFilter::Internal, wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation]
            .map(|filter| self.device.push_error_scope(filter));
        let result = work();
        let mut first = None;
        for scope in scopes.into_iter().rev() {
            let error = pollster::block_on(scope.pop());
            first = first.or(error);
        }
        match first {
            Some(error) => Err(GpuError::from_scope(what, error)),
            None => Ok(result),
        }
    }

    /// Waits until all submitted work is done.
    pub fn wait(&self, what: &str) -> Result<(), GpuError> {
        match self.device.poll(wgpu::PollType::wait_indefinitely()) {
            Ok(_) => Ok(()),
            Err(error) => Err(GpuError::Lost { what: what.to_owned(), message: error.to_string() }),
        }
    }

    /// How many rounds all loops of one shader invocation may make together, where the driver stops them silently; `None`
    /// where it does not. Mesa's software drivers do, after 65,535 (`LP_MAX_TGSI_LOOP_ITERATIONS`).
    pub fn loop_rounds(&self) -> Option<u32> {
        self.info.name.contains("llvmpipe").then_some(65_535)
    }

    /// One line for humans: adapter, kind, backend and driver.
    pub fn describe(&self) -> String {
        let info = &self.info;
        let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ");
        format!("{} ({:?}, {:?}, {})", info.name, info.device_type, info.backend, driver.trim())
    }
}

fn fastest_adapter(instance: &wgpu::Instance) -> Result<wgpu::Adapter, GpuError> {
    let options =
        wgpu::RequestAdapterOptions { power_preference: wgpu::PowerPreference::HighPerformance, ..Default::default() };
    pollster::block_on(instance.request_adapter(&options))
        .map_err(|error| GpuError::NoAdapter { report: error.to_string() })
}

fn named_adapter(instance: &wgpu::Instance, name: &str) -> Result<wgpu::Adapter, GpuError> {
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let names: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let wanted = name.to_lowercase();
    adapters.into_iter().find(|adapter| adapter.get_info().name.to_lowercase().contains(&wanted)).ok_or_else(|| {
        GpuError::NoAdapter { report: format!("none is called `{name}`; there is [{}]", names.join(", ")) }
    })
}
