use thiserror::Error;

/// What can go wrong on the graphics device; every message says what to do about it.
#[derive(Debug, Error)]
pub enum GpuError {
    /// No adapter was found, or none whose name matches the one asked for.
    #[error(
        "no graphics adapter could be used: {report}. Install a driver; without a graphics card a software one will do: \
         `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter {
        /// What was looked for and what was found instead.
        report: String,
    },
    /// The adapter refused to open a device.
    #[error("the graphics adapter `{adapter}` refused to open a device: {report}. Updating its driver may help")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// The driver's words.
        report: String,
    },
    /// A texture or buffer is larger than the device allows.
    #[error("{what} needs {found} {unit}, but this device's limit {limit} is {allowed}; use a smaller one")]
    OverLimit {
        /// The resource, by its label.
        what: String,
        /// The limit by its WebGPU name.
        limit: &'static str,
        /// The size asked for.
        found: u64,
        /// Unit of `found` and `allowed`: texels or bytes.
        unit: &'static str,
        /// The largest size the device allows.
        allowed: u64,
    },
    /// A texture with no texels, or data whose length does not match the texture's.
    #[error("{what} has a wrong size: {found}, expected {expected}")]
    WrongSize {
        /// The resource, by its label.
        what: String,
        /// What it has.
        found: String,
        /// What it should have.
        expected: String,
    },
    /// The device lacks what a texture format needs.
    #[error(
        "{what} needs the texture format {format:?} {purpose}, which this device does not offer; choose another precision"
    )]
    Unsupported {
        /// The resource, by its label.
        what: String,
        /// The format.
        format: wgpu::TextureFormat,
        /// What the format was needed for ("to be filtered", "to be read back").
        purpose: &'static str,
    },
    /// The device's memory is exhausted.
    #[error("the graphics device has no memory left for {what}; use a smaller volume, image or precision")]
    OutOfMemory {
        /// The work that was under way.
        what: String,
    },
    /// The shader or the use of the device was refused by validation.
    #[error("{what} was refused by the graphics device: {message}")]
    Refused {
        /// The work that was under way.
        what: String,
        /// The device's words; for a shader they carry line and column.
        message: String,
    },
    /// Waiting for the device or mapping its memory failed, which means that it was lost.
    #[error(
        "the graphics device stopped answering while {what}: {message}. Start the program again; a driver update may help"
    )]
    Lost {
        /// What was being waited for.
        what: String,
        /// The device's words.
        message: String,
    },
}

impl GpuError {
    pub(crate) fn from_scope(what: &str, error: wgpu::Error) -> Self {
        let what = what.to_owned();
        match error {
            wgpu::Error::OutOfMemory { .. } => Self::OutOfMemory { what },
            wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
                Self::Refused { what, message: description }
            }
        }
    }
}
