//! rayloom
fn main() {}
