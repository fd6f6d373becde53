//! Assembles WGSL from skeletons and swappable snippets. Text in, text and spans out: no device, no window.
//!
//! # How a shader comes about
//! 1. [`Library`] holds the source files: the built-in ones under `shaders/` and those of a user folder. A text edited for one
//!    processor is a [`Snippet`] of its own.
//! 2. Every snippet file starts with a [`Declaration`] in `//!` lines: its slot, help, what it reads and forbids, and its parameters.
//! 3. A [`Choice`] says what fills the slots. [`Choice::check`] refuses combinations that make no sense, with the reason; what it
//!    gives, [`Checked`], also holds the snippets that the program puts in.
//! 4. [`assemble`] fills a [`Skeleton`]. What no entry point leads to is left out. Every line knows the file and line it came from.
//! 5. [`validate`] parses and validates the text with naga. Every [`Diagnostic`] names file, line and column of the *snippet*.
//!
//! # The preprocessor
//! A line that starts with `#` is a directive; everything else is WGSL.
//!
//! | directive | meaning |
//! |---|---|
//! | `#include "folder/file.wgsl"` | inserts the file, once for each shader, or for each volume inside `#each source` |
//! | `#if flag`, `#if !flag`, `#else`, `#endif` | keeps lines only where the flag is set |
//! | `#each output` ... `#end` | repeats the lines for every output in use, `OUT_` becoming `out1_`, `out2_`, `out3_` |
//! | `#each source` ... `#end` | repeats the lines for every volume; `SRC_` and the names declared there begin with `v2_`, `v3_`, ... for all but the first |
//! | `#snippet slot` | inserts the snippet in a slot, of the output or volume at hand |
//! | `#parameters` | inserts the uniform struct that holds the snippets' parameters |
//! | `#constants` | inserts constants of the volume at hand, or of all rays |
//!
//! Bindings are numbered by the assembler where `@binding(auto)` is written.
//!
//! ## Not supported
//! Macros, nested `#each`, expressions in `#if`, and includes by relative path: a snippet that needs more should be two snippets.

mod assemble;
mod check;
mod checked;
mod choice;
mod declaration;
mod diagnostic;
mod footprint;
mod highlight;
mod interface;
mod lexer;
mod library;
mod limits;
mod moved;
mod rename;
mod shake;
mod skeleton;
mod slot;
mod snippet;
mod validate;

pub use assemble::{Assembled, assemble};
pub use checked::{At, Checked, Features};
pub use choice::{Choice, MAX_OUTPUTS, Problem, SourceChoice, legal_choices};
pub use declaration::{
    Declaration, Emptiness, Forbidden, Kernel, Parameter, ParameterType, READS, Termination, Visibility,
    parse_declaration,
};
pub use diagnostic::{Diagnostic, Origin, SourceMap};
pub use highlight::{Highlight, highlight};
pub use interface::{Field, Interface, ParameterLayout};
pub use library::{Library, Source, SourceKind};
pub use rename::has_loops;
pub use skeleton::{Scope, Skeleton};
pub use slot::{Prototype, Slot, contract};
pub use snippet::Snippet;
pub use validate::{Validated, validate};
