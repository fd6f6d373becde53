//! slot: shading
//! label: None
//! help: The classified colour as it is.
//! absent
