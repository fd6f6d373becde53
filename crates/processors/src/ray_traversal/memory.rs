//! What a traversal keeps from run to run.

use std::sync::Arc;

use rayloom_gpu::Texture;
use rayloom_network::ProcessError;
use rayloom_volume::{LabelTable, TransferFunction, TransferFunction2D, ValueRange};
use rayloom_wgsl::{Assembled, Checked, Library, Skeleton, Validated, assemble, validate};

use super::bands::Pace;
use super::gaps::GapMemory;
use super::memo::Memo;
use super::skipping::SkipMemory;
use super::snippets::shader_error;
use super::splines::Splines;
use super::trace::LastRun;

/// A shader, for what it was made from.
pub(super) type ShaderMemo = Memo<Checked, Arc<Validated>>;

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
    /// The shader for a checked choice: assembled and validated, or the one of the last run.
    ///
    /// # Errors
    /// What is wrong with the snippets, with file, line and column.
    pub(super) fn shader(&mut self, library: &Library, checked: &Checked) -> Result<Arc<Validated>, ProcessError> {
        let shader = shader(&mut self.validated, library, &Skeleton::TRAVERSAL, checked)?;
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
    skeleton: &Skeleton,
    checked: &Checked,
) -> Result<Arc<Validated>, ProcessError> {
    memo.get(checked.clone(), || {
        let assembled = assemble(library, skeleton, checked).map_err(shader_error)?;
        validate(library, assembled).map(Arc::new).map_err(|problem| shader_error(vec![*problem]))
    })
}
