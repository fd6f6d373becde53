//! How cameras are moved.

/// What the user prefers, in all canvases.
#[derive(Clone, Copy, Debug)]
pub struct Navigation {
    /// A camera let go while it turns goes on for a while.
    pub inertia: bool,
    /// Canvases show the orientation cube.
    pub cube: bool,
}

impl Default for Navigation {
    fn default() -> Self {
        Self { inertia: false, cube: true }
    }
}
