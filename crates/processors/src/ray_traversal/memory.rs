//! What a traversal keeps from run to run, each part with what it was made from.

use std::sync::Arc;

use rayloom_gpu::Texture;
use rayloom_network::ProcessError;
use rayloom_volume::{LabelTable, MinMaxBricks, TransferFunction, TransferFunction2D, ValueRange, Volume};
use rayloom_wgsl::{Assembled, Choice, Library, Validated, assemble, validate};

use super::snippets::shader_error;

/// A value and the key it was made for.
pub(super) struct Memo<K, V>(Option<(K, V)>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(None)
    }
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    /// The value for `key`, made anew only when the key is not that of the last call.
    pub fn get<E>(&mut self, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
        if let Some((known, value)) = &self.0
            && *known == key
        {
            return Ok(value.clone());
        }
        let value = make()?;
        self.0 = Some((key, value.clone()));
        Ok(value)
    }
}

/// Identity of a volume in memory; keeps it alive, so that no other can take its place.
#[derive(Clone)]
pub(super) struct VolumeKey(pub Arc<Volume>);

impl PartialEq for VolumeKey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Bricks depend on volume, channel, brick size, apron and whether they are those of spline coefficients.
pub(super) type BrickKey = (VolumeKey, u32, u32, u32, bool);

/// What makes something visible, for the skipping map.
#[derive(Clone, PartialEq)]
pub(super) enum VisibilityKey {
    Function(TransferFunction),
    Function2D(TransferFunction2D),
    Between([f64; 2]),
    Nothing,
}

/// The skipping map depends on the bricks, on what is visible, on isovalues and on the kind of map.
pub(super) type MapKey = (BrickKey, VisibilityKey, Vec<f64>, bool, f64);

/// Everything kept.
#[derive(Default)]
pub struct Memory {
    pub(super) validated: Memo<(Choice, Vec<Arc<str>>), Arc<Validated>>,
    last: Option<Arc<Validated>>,
    pub(super) bricks: Memo<BrickKey, Arc<MinMaxBricks>>,
    pub(super) map: Memo<MapKey, super::skipping::SkipMap>,
    pub(super) map_texture: Memo<MapKey, Arc<Texture>>,
    pub(super) coefficients: Memo<(VolumeKey, u32), Arc<Volume>>,
    pub(super) coefficient_texture: Memo<(VolumeKey, u32), Arc<Texture>>,
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
        // A path stands for its text, but for edited ones.
        let edited = choice.snippets.values().chain(choice.outputs.iter().flatten()).filter(|path| path.starts_with("edited/"));
        let texts = edited.filter_map(|path| Some(library.source(path)?.text.clone())).collect();
        let shader = self.validated.get((choice.clone(), texts), || {
            let assembled = assemble(library, choice).map_err(shader_error)?;
            validate(library, assembled).map(Arc::new).map_err(|problem| shader_error(vec![*problem]))
        })?;
        self.last = Some(shader.clone());
        Ok(shader)
    }

    /// The shader of the last run.
    pub fn assembled(&self) -> Option<&Assembled> {
        self.last.as_ref().map(|shader| &shader.assembled)
    }
}
