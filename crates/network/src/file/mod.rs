//! Network files: JSON, versioned, with defaults left out.
//!
//! ```json
//! {
//!   "rayloom": 1,
//!   "name": "Head",
//!   "processors": [
//!     {"id": "source", "type": "volume_source", "properties": {"file": "../data/head.nrrd"}, "position": [0, 0]}
//!   ],
//!   "connections": ["source.volume -> proxy.volume"],
//!   "links": [["entry.camera", "view.camera"]],
//!   "frames": [{"title": "Data", "text": "Any volume does.", "rect": [-20, -40, 200, 140]}]
//! }
//! ```
//!
//! An inport for several connections has an entry for each in `connections`; their order means nothing.
//!
//! `frames` are titled rectangles with notes (left, top, width, height); files without any lack the field, as older ones do.

mod layout;
mod load;
mod paths;
mod save;

pub use load::{LoadError, Loaded, Warning};
pub use save::SaveError;

/// The version of the format that is written. Older ones are read, newer ones refused.
pub const VERSION: i64 = 1;
