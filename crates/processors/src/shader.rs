//! Shaders without slots: image passes, entry and exit points, what the window draws.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayloom_wgsl::{Checked, Library, Skeleton, assemble};

/// A path, and flags.
type Key = (&'static str, &'static [&'static str]);

static SHADERS: Mutex<Option<HashMap<Key, Arc<str>>>> = Mutex::new(None);
static LIBRARY: OnceLock<Library> = OnceLock::new();

/// The text of the built-in shader at a path of the library, such as `image/compositor.wgsl`, with what it includes,
/// where these flags are set for `#if`.
///
/// # Panics
/// There is no such shader, or it is no legal one; the tests of the assembler assemble all there are.
pub fn plain_shader(path: &'static str, flags: &'static [&'static str]) -> Arc<str> {
    let mut shaders = SHADERS.lock().unwrap_or_else(PoisonError::into_inner);
    let text = shaders.get_or_insert_default().entry((path, flags)).or_insert_with(|| {
        let library =
            LIBRARY.get_or_init(|| Library::built_in().expect("the built-in snippets declare themselves well"));
        let assembled = assemble(library, &Skeleton::plain(path), &Checked::plain(flags));
        assembled.expect("a built-in shader assembles").text.into()
    });
    text.clone()
}
