use std::cell::Cell;
use std::time::{Duration, Instant};

use crate::{Gpu, GpuError};

/// Passes that one measurement can cover; later ones run unmeasured.
const PASSES: u32 = 1024;

/// Measures the GPU time of passes with timestamp queries: hand [`Timer::compute_pass`] or [`Timer::render_pass`] to
/// each pass, submit, then ask [`Timer::finish`] for the sum. On a device without timestamps every answer is `None`.
///
/// Software adapters run compute shaders while a submission is taken in and write timestamps whenever their rasteriser
/// gets to them, so there the clock on the wall is read instead: from the first pass to the end of all work.
#[derive(Debug)]
pub struct Timer {
    clock: Clock,
    used: Cell<u32>,
    enabled: bool,
}

/// What the time is read from.
#[derive(Debug)]
enum Clock {
    None,
    Device(Queries),
    Wall(Cell<Option<Instant>>),
}

#[derive(Debug)]
struct Queries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Nanoseconds per tick.
    period: f64,
}

impl Timer {
    /// A timer, switched on.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let clock = match gpu.info.device_type {
            _ if !gpu.features.timestamps => Clock::None,
            wgpu::DeviceType::Cpu => Clock::Wall(Cell::new(None)),
            _ => Clock::Device(Queries::new(gpu)?),
        };
        Ok(Self { clock, used: Cell::new(0), enabled: true })
    }

    /// Switches measuring on or off. Reading a measurement waits for the device, so off is faster.
    pub fn set_enabled(&mut self, enabled: bool) {
        self.enabled = enabled;
    }

    /// Whether passes are being measured.
    pub fn enabled(&self) -> bool {
        self.enabled && !matches!(self.clock, Clock::None)
    }

    /// The `timestamp_writes` of the next compute pass.
    pub fn compute_pass(&self) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, first) = self.next_pair()?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        })
    }

    /// The `timestamp_writes` of the next render pass.
    pub fn render_pass(&self) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, first) = self.next_pair()?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        })
    }

    fn next_pair(&self) -> Option<(&wgpu::QuerySet, u32)> {
        if !self.enabled {
            return None;
        }
        let queries = match &self.clock {
            Clock::Device(queries) => queries,
            Clock::Wall(start) => {
                start.set(start.get().or_else(|| Some(Instant::now())));
                return None;
            }
            Clock::None => return None,
        };
        let pass = self.used.get();
        (pass < PASSES).then(|| {
            self.used.set(pass + 1);
            (&queries.set, 2 * pass)
        })
    }

    /// Forgets the passes handed out since the last [`Timer::finish`], which may not have been submitted.
    pub fn discard(&self) {
        self.used.set(0);
        if let Clock::Wall(start) = &self.clock {
            start.set(None);
        }
    }

    /// The summed time of the passes handed out since the last call, all of which must have been submitted; `None`
    /// if there were none, or nothing can be measured. Waits for the device.
    pub fn finish(&self, gpu: &Gpu) -> Result<Option<Duration>, GpuError> {
        let passes = self.used.take();
        let queries = match &self.clock {
            Clock::Device(queries) if passes > 0 => queries,
            Clock::Wall(start) => {
                let Some(start) = start.take() else { return Ok(None) };
                gpu.wait("measuring GPU time")?;
                return Ok(Some(start.elapsed()));
            }
            _ => return Ok(None),
        };
        gpu.guarded("measuring GPU time", || {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.resolve_query_set(&queries.set, 0..2 * passes, &queries.resolved, 0);
            gpu.queue.submit([encoder.finish()]);
        })?;
        let bytes = gpu.read_buffer(&queries.resolved)?;
        let ticks: Vec<u64> = bytes
            .chunks_exact(8)
            .take(2 * passes as usize)
            .map(|b| u64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]))
            .collect();
        // Drivers may reset their counter between passes; such a pair counts as nothing.
        let total: u64 = ticks.chunks_exact(2).map(|pair| pair[1].saturating_sub(pair[0])).sum();
        Ok(Some(Duration::from_secs_f64(total as f64 * queries.period * 1e-9)))
    }
}

impl Queries {
    fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let count = 2 * PASSES;
        gpu.guarded("the timestamp queries", || Self {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count,
            }),
            resolved: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: u64::from(count) * 8,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            period: f64::from(gpu.queue.get_timestamp_period()),
        })
    }
}
