//! slot: skipping
//! label: None
//! help: Every sample is taken: best for dense scenes.
//! absent
