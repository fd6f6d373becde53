//! Tests of the volume crate from outside, one module a concern.

mod files;
mod formats;
mod generators;
mod malformed;
mod orientation;
mod shipped;
mod structures;
mod transfer;
mod two_dimensional;
mod volumes;
