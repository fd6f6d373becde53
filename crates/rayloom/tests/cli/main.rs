//! The built command line from outside: exit codes, texts and files.

mod documents;
mod explaining;
mod failures;
mod flagship;
mod listings;
mod measuring;
mod pictures;
mod program;
mod tutorial;
#[path = "../../../studio/tests/window/mod.rs"]
mod window;
