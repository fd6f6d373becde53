//! Results kept together with what they were made from.

use std::sync::Arc;

use rayloom_volume::Volume;

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
