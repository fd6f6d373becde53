//! slot: gradient
//! label: None
//! help: No gradient; nothing may read one.
//! absent
