//! What a check of a choice comes to: everything that an assembly takes.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::choice::Choice;
use crate::declaration::{Declaration, Parameter};
use crate::lexer::tokens;
use crate::rename::loops;
use crate::slot::Slot;
use crate::snippet::Snippet;

/// What a legal choice makes the loop contain.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// What snippets read, and what the program put in.
    pub flags: BTreeSet<String>,
    /// The users' slots that are emitted.
    pub slots: BTreeSet<Slot>,
}

impl Features {
    /// Whether a flag is set.
    pub fn has(&self, flag: &str) -> bool {
        self.flags.contains(flag)
    }
}

/// Where a snippet stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum At {
    /// In a slot that is filled once.
    Ray,
    /// In a slot of the volume with this number, from 0.
    Source(usize),
    /// In the slot of the output with this number, from 0.
    Output(usize),
}

/// A snippet in its place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Place {
    pub slot: Slot,
    pub at: At,
    pub snippet: Snippet,
}

/// What one volume, or all rays, need besides snippets.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Settings {
    /// Flags for `#if`.
    pub flags: BTreeSet<String>,
    /// Constants: name and value.
    pub constants: Vec<(&'static str, String)>,
}

/// A combination that was checked: snippets in their places, and what follows from them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked {
    pub(crate) places: Vec<Place>,
    /// What all rays need.
    pub(crate) common: Settings,
    /// What each volume needs.
    pub(crate) sources: Vec<Settings>,
    /// What the loop contains.
    pub features: Features,
}

impl Checked {
    /// For a skeleton without slots, with these flags for `#if`.
    pub fn plain(flags: &[&str]) -> Self {
        let flags: BTreeSet<String> = flags.iter().map(|flag| (*flag).to_owned()).collect();
        let common = Settings { flags: flags.clone(), constants: Vec::new() };
        Self { common, features: Features { flags, slots: BTreeSet::new() }, ..Self::default() }
    }

    /// The numbers of the outputs in use.
    pub(crate) fn outputs(&self) -> impl Iterator<Item = usize> {
        self.places.iter().filter_map(|place| match place.at {
            At::Output(output) => Some(output),
            _ => None,
        })
    }

    /// The snippet in a slot; of those that every volume has, that of the first.
    pub fn snippet(&self, slot: Slot) -> Option<&Snippet> {
        let first = |place: &&Place| place.slot == slot && !matches!(place.at, At::Source(1..));
        self.places.iter().find(first).map(|place| &place.snippet)
    }

    /// The snippets in use that are a user's own, and where they stand.
    pub fn own_snippets(&self) -> impl Iterator<Item = (At, &Snippet)> {
        self.places.iter().filter(|place| place.snippet.is_own()).map(|place| (place.at, &place.snippet))
    }

    /// The compositing snippets in use.
    pub fn output_snippets(&self) -> impl Iterator<Item = &Snippet> {
        self.places.iter().filter(|place| place.slot == Slot::Compositing).map(|place| &place.snippet)
    }

    /// The same choice with the slots that nothing reads cleared: equal choices assemble to equal text.
    pub(crate) fn effective(&self, choice: &Choice) -> Choice {
        let mut choice = choice.clone();
        choice.snippets.retain(|slot, _| self.features.slots.contains(slot));
        for source in &mut choice.sources {
            source.snippets.retain(|slot, _| self.features.slots.contains(slot));
        }
        choice
    }
}

/// What names of the volume with this number, from 0, begin with where there are several.
pub(crate) fn source_prefix(source: usize) -> String {
    if source == 0 { String::new() } else { format!("v{}_", source + 1) }
}

impl Place {
    pub fn declaration(&self) -> &Declaration {
        self.snippet.declaration()
    }

    pub fn path(&self) -> &Arc<str> {
        self.snippet.path()
    }

    /// What the names of its own begin with before those of its source.
    pub fn own_prefix(&self) -> String {
        match self.at {
            At::Output(output) => format!("out{}", output + 1),
            _ => self.slot.id().to_owned(),
        }
    }

    /// What its names begin with in the shader.
    pub fn prefix(&self) -> String {
        match self.at {
            At::Source(source) => source_prefix(source) + &self.own_prefix(),
            _ => self.own_prefix(),
        }
    }

    /// The field of the uniform struct that holds a parameter.
    pub fn field(&self, parameter: &Parameter) -> String {
        format!("{}_{}", self.prefix(), parameter.name)
    }

    /// Whether the program fills the slot: such a snippet is part of the skeleton.
    pub fn is_of_program(&self) -> bool {
        Slot::OF_PROGRAM.contains(&self.slot)
    }

    /// Whether there may be loops in its text, or in other files of a user's that it includes.
    pub fn may_loop(&self) -> bool {
        let text = self.snippet.text();
        !loops(&tokens(text)).is_empty() || text.contains("\"user/")
    }
}
