//! Tests of the network model with processor types and a backend that only count.

mod edits;
mod evaluation;
mod fake;
mod files;
mod malformed;
mod random_edits;
