//! The processors that can be added: grouped by task and searched.

use rayloom_network::{Declaration, Registry};

/// The order in which tasks are listed; any other comes after them, by name.
const TASKS: [&str; 6] = ["Source", "Volume", "Geometry", "Rendering", "Image", "Sink"];

/// A processor type on its way from a list to the canvas, dragged by the pointer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NewProcessor(pub String);

/// The declarations that match a search, best first within each task: those whose name begins with it, those whose name
/// contains it, those whose help does. Every word must be found. An empty search matches everything.
pub fn search<'a>(registry: &'a Registry, query: &str) -> Vec<(&'a str, Vec<&'a Declaration>)> {
    let words: Vec<String> = query.split_whitespace().map(str::to_lowercase).collect();
    let mut found: Vec<(usize, &Declaration)> =
        registry.declarations().filter_map(|declaration| Some((score(declaration, &words)?, declaration))).collect();
    found.sort_by_key(|(score, declaration)| (*score, declaration.label.as_str()));
    let mut groups: Vec<(&str, Vec<&Declaration>)> = Vec::new();
    for (_, declaration) in found {
        let task = declaration.category.as_str();
        match groups.iter_mut().find(|(name, _)| *name == task) {
            Some((_, members)) => members.push(declaration),
            None => groups.push((task, vec![declaration])),
        }
    }
    groups.sort_by_key(|(name, _)| (TASKS.iter().position(|task| task == name).unwrap_or(TASKS.len()), *name));
    groups
}

/// How far a declaration is from what is searched, 0 is nearest; `None` when a word is nowhere in it.
fn score(declaration: &Declaration, words: &[String]) -> Option<usize> {
    let name = format!("{} {}", declaration.label, declaration.id).to_lowercase();
    let help = format!("{} {}", declaration.category, declaration.help).to_lowercase();
    let scores = words.iter().map(|word| match () {
        () if name.starts_with(word) => Some(0),
        () if name.contains(word) => Some(1),
        () if help.contains(word) => Some(2),
        () => None,
    });
    scores.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(query: &str) -> Vec<String> {
        let registry = rayloom_processors::registry();
        let groups = search(&registry, query);
        groups.iter().flat_map(|(_, members)| members).map(|declaration| declaration.id.clone()).collect()
    }

    #[test]
    fn everything_is_listed_and_tasks_run_from_source_to_sink() {
        let registry = rayloom_processors::registry();
        assert_eq!(labels("").len(), registry.declarations().count());
        let groups = search(&registry, "");
        assert_eq!((groups[0].0, groups[groups.len() - 1].0), ("Source", "Sink"));
    }

    #[test]
    fn names_come_before_help_and_every_word_counts() {
        assert_eq!(labels("ray tra"), ["ray_traversal"]);
        assert!(labels("volume").starts_with(&["volume_generator".into(), "volume_source".into()]));
        assert!(labels("no such processor").is_empty());
    }
}
