//! The graphics device that the window and the evaluation share.

use std::sync::{Arc, Mutex};

use eframe::egui_wgpu::{SurfaceErrorAction, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use rayloom_gpu::wgpu::{CurrentSurfaceTexture, Device};
use rayloom_gpu::{Gpu, Hidden};

/// How the window sets up its device: with everything that the processors ask for.
pub fn setup() -> WgpuSetup {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.device_descriptor = Arc::new(|adapter| Gpu::descriptor(adapter, Hidden::default()));
    WgpuSetup::CreateNew(setup)
}

/// How the window draws on it.
///
/// A surface can only be configured (at every new size) while the device is idle; when the evaluation submits work at that very
/// moment the attempt fails, the frame is dropped, and the next one tries again.
pub fn configuration() -> WgpuConfiguration {
    let default = WgpuConfiguration::default();
    let others = default.on_surface_status.clone();
    WgpuConfiguration {
        wgpu_setup: setup(),
        on_surface_status: Arc::new(move |status| match status {
            CurrentSurfaceTexture::Validation => SurfaceErrorAction::Reconfigure,
            other => others(other),
        }),
        ..default
    }
}

/// What the device complained about outside of any error scope, for the user to read.
#[derive(Clone, Default)]
pub struct Complaints(Arc<Mutex<Heard>>);

#[derive(Default)]
struct Heard {
    complaints: Vec<String>,
    /// Why the device is gone, once it is.
    lost: Option<String>,
}

impl Complaints {
    /// Collects what a device complains about from now on; by default the program would end. Also hears when it is lost.
    pub fn of(device: &Device) -> Self {
        let complaints = Self::default();
        let (collected, lost) = (complaints.clone(), complaints.clone());
        device.on_uncaptured_error(Arc::new(move |error| collected.add(&error.to_string())));
        device.set_device_lost_callback(move |reason, message| lost.lose(&format!("{reason:?}: {message}")));
        complaints
    }

    fn add(&self, message: &str) {
        let mut heard = self.lock();
        // A surface that could not be configured is tried again; of a lost device more than that it is lost says nothing.
        if !message.contains("Surface::") && heard.lost.is_none() {
            heard.complaints.push(message.to_owned());
        }
    }

    fn lose(&self, reason: &str) {
        let mut heard = self.lock();
        if heard.lost.is_none() {
            // A window on a lost device may never be drawn again.
            eprintln!("error: {LOST} ({reason})");
            heard.complaints = vec![format!("{LOST} ({reason})")];
            heard.lost = Some(reason.to_owned());
        }
    }

    /// What came since the last call.
    pub fn take(&self) -> Vec<String> {
        std::mem::take(&mut self.lock().complaints)
    }

    /// Whether the device is gone for good.
    pub fn is_lost(&self) -> bool {
        self.lock().lost.is_some()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Heard> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

/// What the user is told when the device is gone.
pub const LOST: &str =
    "the graphics device was lost; save (Ctrl+S) and start the program again: it will offer what is not saved";
