//! Each processor on the real device, against closed forms.

mod common;
mod image_processors;
mod networks;
mod slices;
mod volumes;
