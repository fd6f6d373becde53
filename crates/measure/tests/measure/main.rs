//! Measuring small networks on the device.

mod convergence;
mod end_to_end;
mod network;
mod translation;
mod tuning;
