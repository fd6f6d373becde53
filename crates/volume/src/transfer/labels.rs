//! Transfer functions of label volumes: one a label.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::TransferFunction;

/// A labelled structure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Label {
    /// What people call the structure.
    pub name: String,
    /// How values inside of the structure look; no knots hide it.
    pub transfer_function: TransferFunction,
}

/// Which label means what, as in a segmentation. In JSON an object whose keys are the labels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LabelTable {
    /// The labels in use; voxels with another label are transparent.
    pub labels: BTreeMap<u32, Label>,
}
