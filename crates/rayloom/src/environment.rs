//! The environment that drivers are started in.

/// Keeps Mesa's device selection layer out where there is no desktop session.
///
/// The layer asks the Wayland compositor which adapter is the main one, and without a session the client library prints
/// an "error:" of its own, which a user would take for one of Rayloom's.
#[allow(unsafe_code)]
pub fn quieten_drivers() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: called first thing in `main`, when there are no other threads that could read the environment.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
