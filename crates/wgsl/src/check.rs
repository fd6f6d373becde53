//! Which combinations of snippets make sense, and what the program puts in beside them.

use std::collections::{BTreeMap, BTreeSet};

use crate::checked::{At, Checked, Features, Place, Settings};
use crate::choice::{Choice, Problem, SourceChoice};
use crate::declaration::{Declaration, Emptiness, Termination, Visibility};
use crate::library::Library;
use crate::slot::Slot;
use crate::snippet::Snippet;

/// Checks a choice; see [`Choice::check`].
pub(crate) fn check(choice: &Choice, library: &Library) -> Result<Checked, Vec<Problem>> {
    let used = Used::of(choice).map_err(|problem| vec![problem])?;
    let mut problems = Vec::new();
    for source in &used.sources {
        problems.extend(used.missing_gradient(source));
        problems.extend(used.unskippable(source));
        problems.extend(used.forbidden(source));
    }
    problems.extend(used.several());
    if problems.is_empty() { Ok(used.checked(choice, library)) } else { Err(problems) }
}

/// The snippets of a choice, reduced to those that matter.
struct Used<'a> {
    outputs: Vec<(usize, &'a Snippet)>,
    /// Slots that are filled once.
    once: BTreeMap<Slot, &'a Snippet>,
    sources: Vec<Source<'a>>,
}

/// What is left of the choice for one volume.
struct Source<'a> {
    chosen: &'a SourceChoice,
    snippets: BTreeMap<Slot, &'a Snippet>,
}

impl Source<'_> {
    fn reads(&self, slot: Slot, word: &str) -> bool {
        self.snippets.get(&slot).is_some_and(|snippet| snippet.reads(word))
    }
}

/// Those that are there to say that nothing is.
fn present(snippets: &BTreeMap<Slot, Snippet>) -> BTreeMap<Slot, &Snippet> {
    snippets
        .iter()
        .filter(|(_, snippet)| !snippet.declaration().absent)
        .map(|(slot, snippet)| (*slot, snippet))
        .collect()
}

fn misplaced(snippets: &BTreeMap<Slot, Snippet>) -> Option<Problem> {
    let (&slot, snippet) = snippets.iter().find(|(slot, snippet)| snippet.declaration().slot != **slot)?;
    let message =
        format!("`{}` is a {} snippet and cannot fill the slot {slot}.", snippet.path(), snippet.declaration().slot);
    Some(Problem { slot, message })
}

fn empty(slot: Slot, message: impl Into<String>) -> Problem {
    Problem { slot, message: message.into() }
}

impl<'a> Used<'a> {
    fn of(choice: &'a Choice) -> Result<Self, Problem> {
        let maps = choice.sources.iter().map(|source| &source.snippets).chain([&choice.snippets]);
        if let Some(problem) = maps.filter_map(misplaced).next() {
            return Err(problem);
        }
        let outputs: Vec<_> =
            (0..).zip(&choice.outputs).filter_map(|(index, output)| Some((index, output.as_ref()?))).collect();
        if outputs.is_empty() {
            return Err(empty(Slot::Compositing, "none of the outputs is used: connect one."));
        }
        let sources =
            choice.sources.iter().map(|chosen| Source { chosen, snippets: present(&chosen.snippets) }).collect();
        let mut used = Used { outputs, once: present(&choice.snippets), sources };
        used.drop_unread()?;
        Ok(used)
    }

    fn output_reads(&self, words: &[&str]) -> bool {
        self.outputs.iter().any(|(_, output)| words.iter().any(|word| output.reads(word)))
    }

    fn all_outputs(&self, test: impl Fn(&Declaration) -> bool) -> bool {
        self.outputs.iter().all(|(_, output)| test(output.declaration()))
    }

    fn shading_reads(&self, word: &str) -> bool {
        self.once.get(&Slot::Shading).is_some_and(|snippet| snippet.reads(word))
    }

    fn gradient_is_read(&self, source: &Source<'_>) -> bool {
        self.sample_gradient_is_read(source) || self.shading_reads("gradient")
    }

    /// Whether samples carry their gradient.
    fn sample_gradient_is_read(&self, source: &Source<'_>) -> bool {
        let classified = self.output_reads(&["medium", "medium_at"]);
        self.output_reads(&["gradient"]) || classified && source.reads(Slot::Classification, "gradient")
    }

    /// Forgets the slots that no output needs. Order matters: what is dropped no longer reads.
    fn drop_unread(&mut self) -> Result<(), Problem> {
        let lacks = |slot: Slot| empty(slot, format!("the output needs a {slot} snippet, but none is chosen."));
        if !self.output_reads(&["medium", "medium_at", "surface"]) {
            self.once.remove(&Slot::Shading);
        }
        if !self.output_reads(&["refinement"]) {
            self.once.remove(&Slot::Refinement);
        } else if !self.once.contains_key(&Slot::Refinement) {
            return Err(lacks(Slot::Refinement));
        }
        let classifies = self.output_reads(&["medium", "medium_at", "classify_value"]);
        for index in 0..self.sources.len() {
            let snippets = &mut self.sources[index].snippets;
            if !snippets.contains_key(&Slot::Sampling) {
                return Err(empty(Slot::Sampling, "no sampling snippet is chosen."));
            }
            if !classifies {
                snippets.remove(&Slot::Classification);
            } else if !snippets.contains_key(&Slot::Classification) {
                return Err(lacks(Slot::Classification));
            }
            if !self.gradient_is_read(&self.sources[index]) {
                self.sources[index].snippets.remove(&Slot::Gradient);
            }
        }
        Ok(())
    }

    fn missing_gradient(&self, source: &Source<'_>) -> Option<Problem> {
        if !self.gradient_is_read(source) || source.snippets.contains_key(&Slot::Gradient) {
            return None;
        }
        let shading = self.once.get(&Slot::Shading).filter(|snippet| snippet.reads("gradient"));
        let classification = source.snippets.get(&Slot::Classification).filter(|snippet| snippet.reads("gradient"));
        let reader = shading
            .or(classification)
            .map_or("the output".to_owned(), |snippet| format!("{} `{}`", snippet.declaration().slot, snippet.id()));
        Some(empty(
            Slot::Gradient,
            format!(
                "{reader} reads the gradient, but the gradient slot is empty: choose a gradient operator, for example `central`."
            ),
        ))
    }

    fn unskippable(&self, source: &Source<'_>) -> Option<Problem> {
        let skipping = source.snippets.get(&Slot::Skipping)?.id();
        let refuse = |message| Some(empty(Slot::Skipping, message));
        if let Some(sampling) =
            source.snippets.get(&Slot::Sampling).filter(|sampling| sampling.declaration().kernel.is_none())
        {
            return refuse(format!(
                "skipping `{skipping}` needs to know how far sampling `{}` reaches: declare it there with a line `//! kernel: APRON SPREAD`, or choose skipping `none`.",
                sampling.id()
            ));
        }
        for (_, output) in &self.outputs {
            let needs_visibility = match output.declaration().emptiness {
                None => {
                    return refuse(format!(
                        "skipping `{skipping}` cannot be combined with compositing `{}`, which needs every sample of the ray: choose skipping `none`.",
                        output.id()
                    ));
                }
                Some(Emptiness::NoCrossing(_)) => false,
                Some(_) => true,
            };
            let classification = source.snippets.get(&Slot::Classification);
            let unknown = |snippet: &&Snippet| snippet.declaration().visibility == Visibility::Always;
            if needs_visibility && classification.is_none_or(unknown) {
                return refuse(format!(
                    "skipping `{skipping}` cannot know what is empty with this classification, in which any value may be visible: choose skipping `none`."
                ));
            }
        }
        None
    }

    /// All snippets that work on one volume.
    fn all<'s>(&'s self, source: &'s Source<'a>) -> impl Iterator<Item = &'a Snippet> + 's {
        let outputs = self.outputs.iter().map(|(_, snippet)| *snippet);
        source.snippets.values().chain(self.once.values()).copied().chain(outputs)
    }

    fn forbidden(&self, source: &Source<'a>) -> Vec<Problem> {
        let mut problems = Vec::new();
        for snippet in self.all(source) {
            for rule in &snippet.declaration().forbids {
                let culprit = self.all(source).find(|other| {
                    other.declaration().slot == rule.slot
                        && (rule.reads.as_ref().is_some_and(|word| other.reads(word))
                            || rule.id.as_deref().is_some_and(|id| id == other.id()))
                });
                if let Some(culprit) = culprit {
                    let (slot, other) = (snippet.declaration().slot, culprit.declaration().slot);
                    let message = format!(
                        "{slot} `{}` cannot be combined with {other} `{}`, because {}.",
                        snippet.id(),
                        culprit.id(),
                        rule.reason
                    );
                    problems.push(empty(other, message));
                }
            }
        }
        problems
    }

    /// What several volumes cannot share.
    fn several(&self) -> Option<Problem> {
        if self.sources.len() < 2 {
            return None;
        }
        let values = |snippet: &Snippet| {
            ["previous", "medium_at", "classify_value", "surface", "gradient", "voxel"]
                .iter()
                .any(|word| snippet.reads(word))
                || !snippet.reads("medium")
        };
        if let Some((_, output)) = self.outputs.iter().find(|(_, output)| values(output)) {
            return Some(empty(
                Slot::Compositing,
                format!(
                    "compositing `{}` looks at the values of one volume, but several are connected: choose `dvr`, or connect one volume.",
                    output.id()
                ),
            ));
        }
        let segments = self.sources.iter().filter_map(|source| source.snippets.get(&Slot::Classification));
        let segment = segments.into_iter().find(|snippet| snippet.reads("previous"))?;
        Some(empty(
            Slot::Classification,
            format!(
                "classification `{}` integrates between two samples of one volume, but several are mixed at every sample: choose `transfer_function`.",
                segment.id()
            ),
        ))
    }

    fn checked(&self, choice: &Choice, library: &Library) -> Checked {
        let mut places = Vec::new();
        let mut put = |slot: Slot, at: At, snippet: &Snippet| places.push(Place { slot, at, snippet: snippet.clone() });
        for (index, source) in self.sources.iter().enumerate() {
            source.snippets.iter().for_each(|(slot, snippet)| put(*slot, At::Source(index), snippet));
        }
        self.once.iter().for_each(|(slot, snippet)| put(*slot, At::Ray, snippet));
        self.outputs.iter().for_each(|(index, snippet)| put(Slot::Compositing, At::Output(*index), snippet));
        let users: BTreeSet<Slot> = places.iter().map(|place| place.slot).collect();
        let bounded = places.iter().any(|place| place.snippet.is_own() && place.may_loop());
        for (slot, at, id) in self.filled_by_program(choice, bounded) {
            // Each is embedded, and the tests assemble with every one of them.
            if let Some(snippet) = library.snippet(slot, id) {
                places.push(Place { slot, at, snippet: snippet.clone() });
            }
        }
        let common = Settings { flags: self.flags(choice, bounded), constants: self.constants(choice) };
        let sources: Vec<_> = self.sources.iter().map(|source| settings(source.chosen)).collect();
        let of_sources = sources.iter().flat_map(|source| source.flags.iter());
        let flags = common.flags.iter().chain(of_sources).cloned().collect();
        Checked { features: Features { flags, slots: users }, common, sources, places }
    }

    /// The slots that users do not fill.
    fn filled_by_program(&self, choice: &Choice, bounded: bool) -> Vec<(Slot, At, &'static str)> {
        let pick = |on: bool, yes: &'static str, no: &'static str| if on { yes } else { no };
        let stepping = match () {
            () if self.sources.len() > 1 => "several",
            () if !self.output_reads(&["medium"]) => "values",
            () if self.searches(choice) => "search",
            () => "media",
        };
        let lighting = match self.once.get(&Slot::Shading) {
            None => "unlit",
            Some(shading) => pick(shading.reads("gradient"), "by_normal", "by_view"),
        };
        let mut filled = vec![
            (Slot::Lattice, At::Ray, pick(choice.jitter, "jittered", "regular")),
            (Slot::Stepping, At::Ray, stepping),
            (Slot::Endings, At::Ray, pick(bounded, "watched", "trusted")),
            (Slot::Statistics, At::Ray, pick(choice.statistics, "counted", "none")),
            (Slot::SampleMap, At::Ray, pick(choice.sample_map, "stored", "none")),
        ];
        for (index, source) in self.sources.iter().enumerate() {
            let at = At::Source(index);
            filled.push((Slot::Gaps, at, pick(source.chosen.gaps, "map", "none")));
            filled.push((Slot::Slope, at, pick(self.sample_gradient_is_read(source), "taken", "unread")));
            filled.push((Slot::Lighting, at, lighting));
            if !source.snippets.contains_key(&Slot::Skipping) {
                filled.push((Slot::Skipping, at, "none"));
            }
        }
        filled
    }

    /// Whether the next visible sample is looked for before any light is put on it.
    fn searches(&self, choice: &Choice) -> bool {
        choice.search
            && self.once.contains_key(&Slot::Shading)
            && self.all_outputs(|output| output.emptiness == Some(Emptiness::Transparent))
            && !self.segment_ends()
    }

    fn segment_ends(&self) -> bool {
        self.sources.iter().any(|source| source.reads(Slot::Classification, "previous"))
    }

    /// Whether samples need their predecessor.
    fn previous(&self) -> bool {
        self.segment_ends() || self.output_reads(&["previous"])
    }

    fn may_stop(&self, choice: &Choice) -> bool {
        self.all_outputs(|output| match output.termination {
            Termination::Never => false,
            Termination::Opacity => choice.early_termination,
            Termination::Hit => true,
        })
    }

    fn constants(&self, choice: &Choice) -> Vec<(&'static str, String)> {
        vec![
            ("MAY_STOP", self.may_stop(choice).to_string()),
            ("SEGMENT_ENDS", self.segment_ends().to_string()),
            ("PREVIOUS", self.previous().to_string()),
        ]
    }

    /// What the host, and those who ask why, want to know.
    fn flags(&self, choice: &Choice, bounded: bool) -> BTreeSet<String> {
        let mut flags: BTreeSet<String> = self
            .sources
            .iter()
            .flat_map(|source| self.all(source))
            .flat_map(|snippet| snippet.declaration().reads.iter().cloned())
            .collect();
        let any = |test: &dyn Fn(&Source<'_>) -> bool| self.sources.iter().any(test);
        let classified_gradient = any(&|source| source.reads(Slot::Classification, "gradient"));
        let switches = [
            ("own", self.sources.iter().flat_map(|source| self.all(source)).any(Snippet::is_own)),
            ("bounded", bounded),
            ("segment_ends", self.segment_ends()),
            ("previous", self.previous()),
            ("gradient", any(&|source| source.snippets.contains_key(&Slot::Gradient))),
            ("classified_gradient", classified_gradient && self.output_reads(&["medium", "medium_at"])),
            ("shading", self.once.contains_key(&Slot::Shading)),
            ("shaded_gradient", self.shading_reads("gradient")),
            ("light", self.shading_reads("light")),
            ("skipping", any(&|source| source.snippets.contains_key(&Slot::Skipping))),
            ("search", self.output_reads(&["medium"]) && self.searches(choice)),
            ("stop", self.may_stop(choice)),
            ("statistics", choice.statistics),
            ("sample_map", choice.sample_map),
            ("jitter", choice.jitter),
            ("half_targets", choice.half_targets),
            ("long_rays", choice.long_rays),
            ("gaps", any(&|source| source.chosen.gaps)),
        ];
        for (flag, on) in switches {
            if on {
                flags.insert(flag.to_owned());
            } else {
                flags.remove(flag);
            }
        }
        let slots = self.sources.iter().flat_map(|source| source.snippets.keys()).chain(self.once.keys());
        flags.extend(slots.map(|slot| format!("slot_{slot}")));
        flags
    }
}

fn settings(chosen: &SourceChoice) -> Settings {
    let mut flags = BTreeSet::from([format!("channels_{}", chosen.channels)]);
    if chosen.steps {
        flags.insert("steps".to_owned());
    }
    Settings { flags, constants: vec![("CHANNEL", format!("{}u", chosen.channel))] }
}
