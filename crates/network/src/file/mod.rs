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
//!   "links": [["entry.camera", "view.camera"]]
//! }
//! ```

mod layout;
mod load;
mod paths;
mod save;

pub use load::{LoadError, Loaded, Warning};
pub use save::{SaveError, write_whole};

/// The version of the format that is written. Older ones are read, newer ones refused.
pub const VERSION: i64 = 1;
