//! What a traversal keeps from run to run.

use std::sync::Arc;

use rayloom_gpu::Texture;
use rayloom_network::ProcessError;
use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D, ValueRange};
use rayloom_wgsl::{Assembled, Choice, Library, Validated, assemble, validate};

use super::bands::Pace;
use super::gaps::GapMemory;
use super::memo::Memo;
use super::skipping::SkipMemory;
use super::snippets::shader_error;
use super::splines::Splines;
use super::trace::LastRun;

/// A shader, for a choice and the texts in it that are not built in.
pub(super) type ShaderMemo = Memo<(Choice, Vec<Arc<str>>), Arc<Validated>>;

/// Everything kept.
#[derive(Default)]
pub struct Memory {
    pub(super) validated: ShaderMemo,
    last: Option<Arc<Validated>>,
    /// What the last run rendered, unless it failed; the ray probe looks at it.
    pub(super) last_run: Option<LastRun>,
    /// The shader of the ray probe.
    pub(super) tracing: ShaderMemo,
    /// How fast the last picture was.
    pub(super) pace: Pace,
    pub(super) splines: Splines,
    pub(super) skipping: SkipMemory,
    pub(super) gaps: GapMemory,
    pub(super) table: Memo<(TransferFunction, ValueRange), Arc<Texture>>,
    pub(super) table_2d: Memo<(TransferFunction2D, ValueRange), Arc<Texture>>,
    pub(super) preintegrated: Memo<(TransferFunction, ValueRange, Option<f64>), Arc<Texture>>,
    pub(super) labels: Memo<(LabelTable, ValueRange), Arc<Texture>>,
}

impl Memory {
    /// The shader for a choice: assembled and validated, or the one of the last run.
    ///
    /// # Errors
    /// What is wrong with the snippets, with file, line and column.
    pub(super) fn shader(&mut self, library: &Library, choice: &Choice) -> Result<Arc<Validated>, ProcessError> {
        let shader = shader(&mut self.validated, library, choice)?;
        self.last = Some(shader.clone());
        Ok(shader)
    }

    /// The last good shader.
    pub(super) fn last_shader(&self) -> Option<Arc<Validated>> {
        self.last.clone()
    }

    /// The shader of the last run.
    pub fn assembled(&self) -> Option<&Assembled> {
        self.last.as_ref().map(|shader| &shader.assembled)
    }
}

/// Assembles and validates a shader, or finds it in its memo.
///
/// # Errors
/// What is wrong with the snippets, with file, line and column.
pub(super) fn shader(
    memo: &mut ShaderMemo,
    library: &Library,
    choice: &Choice,
) -> Result<Arc<Validated>, ProcessError> {
    // A path stands for its text where that cannot change.
    let paths = choice.snippets.values().chain(choice.outputs.iter().flatten());
    let texts = paths.filter(|path| path.starts_with("edited/") || path.starts_with("user/"));
    let texts = texts.filter_map(|path| Some(library.source(path)?.text.clone())).collect();
    memo.get((choice.clone(), texts), || {
        let assembled = assemble(library, choice).map_err(shader_error)?;
        validate(library, assembled).map(Arc::new).map_err(|problem| shader_error(vec![*problem]))
    })
}
