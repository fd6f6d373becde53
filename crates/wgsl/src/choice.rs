//! Which snippet fills which slot of a ray traversal.

use std::collections::{BTreeMap, BTreeSet};

use crate::checked::Checked;
use crate::library::Library;
use crate::slot::Slot;
use crate::snippet::Snippet;

/// A traversal has at most this many outputs, each with its own compositing.
pub const MAX_OUTPUTS: usize = 3;

/// One snippet for each slot, and the switches that change the text of the loop.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Choice {
    /// The volumes that the rays pass through, at least one.
    pub sources: Vec<SourceChoice>,
    /// Snippets of the slots that are filled once: shading and refinement.
    pub snippets: BTreeMap<Slot, Snippet>,
    /// Compositing snippet of each output that something consumes.
    pub outputs: [Option<Snippet>; MAX_OUTPUTS],
    /// Stop when no output can change by more than the user allows.
    pub early_termination: bool,
    /// Count rays and samples of the whole picture.
    pub statistics: bool,
    /// Store the samples of every ray in an image.
    pub sample_map: bool,
    /// Move the lattice of samples by a random share of a step, pixel by pixel.
    pub jitter: bool,
    /// Store colours as 16-bit instead of 32-bit floats.
    pub half_targets: bool,
    /// Rays take so many samples that sums of faint ones would lose places.
    pub long_rays: bool,
    /// Look for the next visible sample before shading it, where nothing else needs the samples between.
    pub search: bool,
}

/// What is chosen for one volume.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceChoice {
    /// Snippets of the slots that are filled for every volume: sampling, gradient, classification and skipping.
    pub snippets: BTreeMap<Slot, Snippet>,
    /// The channel that is classified, 0..=3.
    pub channel: u32,
    /// Channels of the volume, 1..=4.
    pub channels: u32,
    /// The volume has voxels without a value (NaN), which are not drawn.
    pub gaps: bool,
    /// The table of the transfer function is cut at its steps.
    pub steps: bool,
}

impl SourceChoice {
    /// These snippets for a volume of one channel, with every switch off.
    pub fn of(snippets: BTreeMap<Slot, Snippet>) -> Self {
        Self { snippets, channel: 0, channels: 1, gaps: false, steps: false }
    }
}

/// Why a combination is refused: a sentence for the user.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Problem {
    /// The slot whose choice should change.
    pub slot: Slot,
    /// What is wrong, why, and what to choose instead.
    pub message: String,
}

impl Choice {
    /// These snippets, in whatever scope their slots are, for one volume of one channel, with every switch off but the search.
    pub fn of(snippets: BTreeMap<Slot, Snippet>, outputs: [Option<Snippet>; MAX_OUTPUTS]) -> Self {
        let (once, source) = snippets.into_iter().partition(|(slot, _)| slot.is_filled_once());
        Self {
            sources: vec![SourceChoice::of(source)],
            snippets: once,
            outputs,
            early_termination: false,
            statistics: false,
            sample_map: false,
            jitter: false,
            half_targets: false,
            long_rays: false,
            search: true,
        }
    }

    /// The snippet of a slot; for those that every volume has, that of the first.
    pub fn snippet(&self, slot: Slot) -> Option<&Snippet> {
        self.snippets.get(&slot).or_else(|| self.sources.first()?.snippets.get(&slot))
    }

    /// Puts a snippet into its slot; into those that every volume has, for the first.
    pub fn put(&mut self, snippet: Snippet) {
        let slot = snippet.declaration().slot;
        match self.sources.first_mut() {
            Some(source) if !slot.is_filled_once() => source.snippets.insert(slot, snippet),
            _ => self.snippets.insert(slot, snippet),
        };
    }

    /// Checks the combination, and settles what the program fills in.
    ///
    /// # Errors
    /// Every [`Problem`] found: a slot that stays empty, a read that nothing provides, a combination that a snippet forbids.
    pub fn check(&self, library: &Library) -> Result<Checked, Vec<Problem>> {
        crate::check::check(self, library)
    }
}

/// Every legal choice with one output, once for each distinct text, for a one-channel volume with early termination on.
/// Used to validate all of them without a GPU and to list them.
pub fn legal_choices(library: &Library) -> BTreeSet<Choice> {
    let options = |slot| library.all(slot).filter(|snippet| !snippet.is_own()).cloned().collect::<Vec<_>>();
    let nothing = Choice::of(BTreeMap::new(), Default::default());
    let mut partial = vec![Choice { early_termination: true, ..nothing }];
    for slot in Slot::ALL {
        let options = options(slot);
        let with = |choice: &Choice, snippet: &Snippet| {
            let mut choice = choice.clone();
            match slot {
                Slot::Compositing => choice.outputs[0] = Some(snippet.clone()),
                _ => choice.put(snippet.clone()),
            }
            choice
        };
        partial = partial.iter().flat_map(|choice| options.iter().map(|snippet| with(choice, snippet))).collect();
    }
    partial.iter().filter_map(|choice| Some(choice.check(library).ok()?.effective(choice))).collect()
}
