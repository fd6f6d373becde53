//! The built command line from outside: exit codes, texts and files.

mod documents;
mod failures;
mod listings;
mod measuring;
mod pictures;
mod program;
