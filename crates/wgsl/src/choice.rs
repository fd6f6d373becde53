//! Which snippet fills which slot, what follows from it, and which combinations make sense.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::declaration::{Declaration, Emptiness, Termination, Visibility, stem};
use crate::library::Library;
use crate::slot::Slot;

/// A traversal has at most this many outputs, each with its own compositing.
pub const MAX_OUTPUTS: usize = 3;

/// One snippet (library path) a slot, and the switches that change the text of the loop.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Choice {
    /// Snippet paths of every slot but compositing.
    pub snippets: BTreeMap<Slot, Arc<str>>,
    /// Compositing snippet of each output that something consumes.
    pub outputs: [Option<Arc<str>>; MAX_OUTPUTS],
    /// Stop when no output can change by more than the user allows.
    pub early_termination: bool,
    /// Count rays and samples of the whole picture.
    pub statistics: bool,
    /// Store the samples of every ray in an image.
    pub sample_map: bool,
    /// Move the lattice of samples by a random share of a step, pixel by pixel.
    pub jitter: bool,
    /// Follow one ray and note its samples instead of drawing a picture.
    pub trace: bool,
    /// Store colours as 16-bit instead of 32-bit floats.
    pub half_targets: bool,
    /// The volume has voxels without a value (NaN), which are not drawn.
    pub gaps: bool,
    /// Rays take so many samples that sums of faint ones would lose places.
    pub long_rays: bool,
    /// Look for the next visible sample before shading it, where nothing else needs the samples between.
    pub search: bool,
    /// The table of the transfer function is cut at its steps.
    pub steps: bool,
    /// The channel that is classified, 0..=3.
    pub channel: u32,
    /// Channels of the volume, 1..=4.
    pub channels: u32,
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

/// What a legal choice makes the loop contain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Features {
    /// Flags for `#if` in the skeleton.
    pub flags: BTreeSet<String>,
    /// Slots that are emitted; compositing is emitted for every active output.
    pub slots: BTreeSet<Slot>,
}

impl Features {
    /// Whether a flag is set.
    pub fn has(&self, flag: &str) -> bool {
        self.flags.contains(flag)
    }
}

impl Choice {
    /// These snippets for a volume of one channel, with every switch off.
    pub fn of(snippets: BTreeMap<Slot, Arc<str>>, outputs: [Option<Arc<str>>; MAX_OUTPUTS]) -> Self {
        Self {
            snippets,
            outputs,
            early_termination: false,
            statistics: false,
            sample_map: false,
            gaps: false,
            long_rays: false,
            search: true,
            steps: false,
            jitter: false,
            trace: false,
            half_targets: false,
            channel: 0,
            channels: 1,
        }
    }

    /// Checks the combination.
    ///
    /// # Errors
    /// Every [`Problem`] found: a snippet that does not exist, a read that nothing provides, a combination that a snippet forbids.
    pub fn check(&self, library: &Library) -> Result<Features, Vec<Problem>> {
        let used = Used::of(self, library).map_err(|problem| vec![problem])?;
        let problems: Vec<_> =
            used.missing_gradient().into_iter().chain(used.unskippable()).chain(used.forbidden()).collect();
        if problems.is_empty() { Ok(used.features(self)) } else { Err(problems) }
    }

    /// The same choice with the slots that nothing reads cleared: equal keys assemble to equal text.
    pub fn effective(&self, features: &Features) -> Choice {
        let mut choice = self.clone();
        choice.snippets.retain(|slot, _| features.slots.contains(slot));
        choice
    }
}

/// The declarations behind a choice, reduced to those that matter.
struct Used<'a> {
    outputs: Vec<(&'a Arc<str>, &'a Arc<Declaration>)>,
    snippets: BTreeMap<Slot, (&'a Arc<str>, &'a Arc<Declaration>)>,
    absent: BTreeSet<Slot>,
}

impl<'a> Used<'a> {
    fn of(choice: &'a Choice, library: &'a Library) -> Result<Self, Problem> {
        let find = |slot: Slot, path: &'a Arc<str>| match library.declaration(path) {
            Some(declaration) if declaration.slot == slot => Ok((path, declaration)),
            Some(declaration) => Err(Problem {
                slot,
                message: format!("`{path}` is a {} snippet and cannot fill the slot {slot}.", declaration.slot),
            }),
            None => Err(Problem { slot, message: format!("there is no {slot} snippet `{path}`.") }),
        };
        let outputs =
            choice.outputs.iter().flatten().map(|path| find(Slot::Compositing, path)).collect::<Result<Vec<_>, _>>()?;
        if outputs.is_empty() {
            return Err(Problem {
                slot: Slot::Compositing,
                message: "none of the outputs is used: connect one.".into(),
            });
        }
        let mut used = Used { outputs, snippets: BTreeMap::new(), absent: BTreeSet::new() };
        for (&slot, path) in &choice.snippets {
            let (path, declaration) = find(slot, path)?;
            if declaration.absent {
                used.absent.insert(slot);
            } else {
                used.snippets.insert(slot, (path, declaration));
            }
        }
        if !used.snippets.contains_key(&Slot::Sampling) {
            return Err(Problem { slot: Slot::Sampling, message: "no sampling snippet is chosen.".into() });
        }
        used.drop_unread()?;
        Ok(used)
    }

    fn output_reads(&self, words: &[&str]) -> bool {
        self.outputs.iter().any(|(_, output)| words.iter().any(|word| output.reads.contains(*word)))
    }

    fn slot_reads(&self, slot: Slot, word: &str) -> bool {
        self.snippets.get(&slot).is_some_and(|(_, declaration)| declaration.reads.contains(word))
    }

    fn gradient_is_read(&self) -> bool {
        let sampled = self.output_reads(&["medium", "medium_at"]);
        self.output_reads(&["gradient"])
            || (sampled && self.slot_reads(Slot::Classification, "gradient"))
            || self.slot_reads(Slot::Shading, "gradient")
    }

    /// Forgets the slots that no output needs. Order matters: what is dropped no longer reads.
    fn drop_unread(&mut self) -> Result<(), Problem> {
        let needs = [
            (Slot::Classification, self.output_reads(&["medium", "medium_at", "classify_value"])),
            (Slot::Shading, self.output_reads(&["medium", "medium_at", "surface"])),
            (Slot::Refinement, self.output_reads(&["refinement"])),
        ];
        for (slot, needed) in needs {
            if !needed {
                self.snippets.remove(&slot);
            } else if slot != Slot::Shading && !self.snippets.contains_key(&slot) {
                return Err(Problem {
                    slot,
                    message: format!("the output needs a {slot} snippet, but none is chosen."),
                });
            }
        }
        if !self.gradient_is_read() {
            self.snippets.remove(&Slot::Gradient);
        }
        Ok(())
    }

    fn missing_gradient(&self) -> Option<Problem> {
        if !self.gradient_is_read() || self.snippets.contains_key(&Slot::Gradient) {
            return None;
        }
        let reader = [Slot::Shading, Slot::Classification]
            .into_iter()
            .find(|slot| self.slot_reads(*slot, "gradient"))
            .map_or("the output".to_owned(), |slot| format!("{slot} `{}`", stem(self.snippets[&slot].0)));
        Some(Problem {
            slot: Slot::Gradient,
            message: format!(
                "{reader} reads the gradient, but the gradient slot is empty: choose a gradient operator, for example `central`."
            ),
        })
    }

    fn unskippable(&self) -> Option<Problem> {
        let (path, _) = self.snippets.get(&Slot::Skipping)?;
        let refuse = |message| Some(Problem { slot: Slot::Skipping, message });
        if let Some((sampling, _)) =
            self.snippets.get(&Slot::Sampling).filter(|(_, declaration)| declaration.kernel.is_none())
        {
            return refuse(format!(
                "skipping `{}` needs to know how far sampling `{}` reaches: declare it there with a line `//! kernel: APRON SPREAD`, or choose skipping `none`.",
                stem(path),
                stem(sampling)
            ));
        }
        for (output, declaration) in &self.outputs {
            let needs_visibility = match declaration.emptiness {
                None => {
                    return refuse(format!(
                        "skipping `{}` cannot be combined with compositing `{}`, which needs every sample of the ray: choose skipping `none`.",
                        stem(path),
                        stem(output)
                    ));
                }
                Some(Emptiness::NoCrossing(_)) => false,
                Some(_) => true,
            };
            let classification = self.snippets.get(&Slot::Classification);
            if needs_visibility
                && classification.is_none_or(|(_, declaration)| declaration.visibility == Visibility::Always)
            {
                return refuse(format!(
                    "skipping `{}` cannot know what is empty with this classification, in which any value may be visible: choose skipping `none`.",
                    stem(path)
                ));
            }
        }
        None
    }

    fn all(&self) -> impl Iterator<Item = (Slot, &'a Arc<str>, &'a Arc<Declaration>)> {
        let slots = self.snippets.iter().map(|(slot, (path, declaration))| (*slot, *path, *declaration));
        slots.chain(self.outputs.iter().map(|(path, declaration)| (Slot::Compositing, *path, *declaration)))
    }

    fn forbidden(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        for (slot, path, declaration) in self.all() {
            for rule in &declaration.forbids {
                let culprit = self.all().find(|(other, path, declaration)| {
                    *other == rule.slot
                        && (rule.reads.as_ref().is_some_and(|word| declaration.reads.contains(word))
                            || rule.id.as_deref().is_some_and(|id| id == stem(path)))
                });
                if let Some((other, culprit, _)) = culprit {
                    let message = format!(
                        "{slot} `{}` cannot be combined with {other} `{}`, because {}.",
                        stem(path),
                        stem(culprit),
                        rule.reason
                    );
                    problems.push(Problem { slot: other, message });
                }
            }
        }
        problems
    }

    fn features(&self, choice: &Choice) -> Features {
        let mut flags: BTreeSet<String> =
            self.all().flat_map(|(_, _, declaration)| declaration.reads.iter().cloned()).collect();
        let mut set = |flag: &str, on: bool| {
            if on {
                flags.insert(flag.to_owned())
            } else {
                flags.remove(flag)
            };
        };
        let segment_ends = self.slot_reads(Slot::Classification, "previous");
        let shading = self.snippets.contains_key(&Slot::Shading);
        let medium = self.output_reads(&["medium"]);
        let classified_gradient = self.slot_reads(Slot::Classification, "gradient");
        let all_outputs = |test: &dyn Fn(&Declaration) -> bool| self.outputs.iter().all(|(_, output)| test(output));
        set("segment_ends", segment_ends);
        set("previous", segment_ends || self.output_reads(&["previous"]));
        set("gradient", self.snippets.contains_key(&Slot::Gradient));
        set("classified_gradient", classified_gradient && self.output_reads(&["medium", "medium_at"]));
        set("loop_gradient", self.output_reads(&["gradient"]) || (medium && classified_gradient));
        set("shading", shading);
        set("shaded_gradient", self.slot_reads(Slot::Shading, "gradient"));
        set("light", self.slot_reads(Slot::Shading, "light"));
        set("skipping", self.snippets.contains_key(&Slot::Skipping));
        set(
            "search",
            choice.search
                && medium
                && shading
                && all_outputs(&|output| output.emptiness == Some(Emptiness::Transparent))
                && !segment_ends,
        );
        set(
            "stop",
            all_outputs(&|output| match output.termination {
                Termination::Never => false,
                Termination::Opacity => choice.early_termination,
                Termination::Hit => true,
            }),
        );
        set("statistics", choice.statistics);
        set("sample_map", choice.sample_map);
        set("counting", choice.statistics || choice.sample_map);
        set("jitter", choice.jitter);
        set("trace", choice.trace);
        set("half_targets", choice.half_targets);
        set("gaps", choice.gaps);
        set("long_rays", choice.long_rays);
        set("steps", choice.steps);
        set(&format!("channel_{}", choice.channel), true);
        set(&format!("channels_{}", choice.channels), true);
        for slot in self.snippets.keys() {
            set(&format!("slot_{slot}"), true);
        }
        let slots = self.snippets.keys().copied().chain([Slot::Compositing]).collect();
        Features { flags, slots }
    }
}

/// Every legal choice with one output, once for each distinct text, for a one-channel volume with early termination on.
/// Used to validate all of them without a GPU and to list them.
pub fn legal_choices(library: &Library) -> BTreeSet<Choice> {
    let ids = |slot| {
        library
            .snippets(slot)
            .filter(|(path, _)| !path.starts_with("user/"))
            .map(|(path, _)| path.clone())
            .collect::<Vec<_>>()
    };
    let mut found = BTreeSet::new();
    let nothing = Choice::of(BTreeMap::new(), Default::default());
    let mut partial = vec![Choice { early_termination: true, ..nothing }];
    for slot in Slot::ALL {
        let options = ids(slot);
        partial = partial
            .into_iter()
            .flat_map(|choice| {
                options
                    .iter()
                    .map(move |path| {
                        let mut choice = choice.clone();
                        if slot == Slot::Compositing {
                            choice.outputs[0] = Some(path.clone());
                        } else {
                            choice.snippets.insert(slot, path.clone());
                        }
                        choice
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
    }
    for choice in partial {
        if let Ok(features) = choice.check(library) {
            found.insert(choice.effective(&features));
        }
    }
    found
}
