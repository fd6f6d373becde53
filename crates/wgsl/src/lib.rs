//! Assembles the WGSL of a ray traversal from swappable snippets. Text in, text and spans out: no device, no window.
//!
//! # How a shader comes about
//! 1. [`Library`] holds the source files: the built-in ones under `shaders/`, those of a user folder, and edited texts that replace a file for one processor.
//! 2. Every snippet file starts with a [`Declaration`] in `//!` lines: its slot, help, what it reads and forbids, and its parameters.
//! 3. A [`Choice`] names one snippet a slot. [`Choice::check`] refuses combinations that make no sense, with the reason.
//! 4. [`assemble`] fills the skeleton with the snippets. What nothing reads is not emitted. Every output line knows the file and line it came from.
//! 5. [`validate`] parses and validates the text with naga. Every [`Diagnostic`] names file, line and column of the *snippet*.
//!
//! # The preprocessor
//! A line that starts with `#` is a directive; everything else is WGSL.
//!
//! | directive | meaning |
//! |---|---|
//! | `#include "folder/file.wgsl"` | inserts the file, once a shader |
//! | `#if flag`, `#if !flag`, `#else`, `#endif` | keeps lines only where the flag is set; flags are computed from what the chosen snippets read |
//! | `#each output` ... `#end` | repeats the lines for every active output, `OUT` becoming `out1`, `out2`, `out3` |
//! | `#snippet slot` | inserts the chosen snippet |
//! | `#parameters` | inserts the uniform struct that holds the snippets' parameters |
//!
//! ## Not supported
//! Macros, nested `#each`, expressions in `#if`, and includes by relative path: a snippet that needs more should be two snippets.

mod assemble;
mod choice;
mod declaration;
mod diagnostic;
mod footprint;
mod highlight;
mod interface;
mod lexer;
mod library;
mod limits;
mod rename;
mod slot;
mod validate;

pub use assemble::{Assembled, assemble};
pub use choice::{Choice, Features, MAX_OUTPUTS, Problem, legal_choices};
pub use declaration::{
    Declaration, Emptiness, Forbidden, Kernel, Parameter, ParameterType, READS, Termination, Visibility,
    parse_declaration,
};
pub use diagnostic::{Diagnostic, Origin, SourceMap};
pub use highlight::{Highlight, highlight};
pub use interface::{Field, Interface, ParameterLayout};
pub use library::{Library, Source, SourceKind};
pub use rename::has_loops;
pub use slot::{Prototype, Slot, contract};
pub use validate::{Validated, validate};

/// Path of the skeleton of the ray traversal inside the library.
pub const TRAVERSAL: &str = "traversal/traversal.wgsl";
