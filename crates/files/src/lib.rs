//! How every file is opened, read and written: one way for all of the program.
//!
//! [`open`] takes only ordinary files, so that nothing waits for a FIFO or is fed by a device; [`read`] and [`read_text`] take
//! no more than a file of its kind may have; [`write()`] replaces a file as a whole or leaves the old one as it was.

mod open;
mod write;

pub use open::{Kind, open, read, read_text};
pub use write::write;
