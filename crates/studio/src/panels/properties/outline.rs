//! The order of the panel: sections, and parameters below the property that brings them.

use std::collections::BTreeSet;

use rayloom_network::{PropertyDecl, PropertyKind};

/// A headed part of the panel.
pub(super) struct Section {
    /// Its heading.
    pub title: &'static str,
    /// What it holds.
    pub entries: Vec<Entry>,
}

/// A property and those that belong to it.
pub(super) struct Entry {
    /// The property.
    pub decl: PropertyDecl,
    /// Parameters of the snippet chosen by it.
    pub parameters: Vec<PropertyDecl>,
    /// The property that holds an edited text for the same slot.
    pub text: Option<PropertyDecl>,
}

impl Entry {
    /// The property and those that belong to it.
    pub fn decls(&self) -> impl Iterator<Item = &PropertyDecl> {
        [&self.decl].into_iter().chain(&self.parameters).chain(&self.text)
    }
}

/// The heading of what changes nothing as the other properties are.
pub(super) const IDLE: &str = "Without effect now";

/// The properties in the order of the panel, those in `idle` last.
pub(super) fn sections(decls: Vec<PropertyDecl>, idle: &BTreeSet<String>) -> Vec<Section> {
    let titles = ["Colour and opacity", "Shader", "Settings", IDLE];
    let mut sections = titles.map(|title| Section { title, entries: Vec::new() });
    for entry in entries(decls) {
        let place = match entry.decl.kind {
            _ if idle.contains(&entry.decl.id) => 3,
            PropertyKind::TransferFunction | PropertyKind::TransferFunction2D | PropertyKind::Labels => 0,
            PropertyKind::Snippet { .. } | PropertyKind::ShaderText { .. } => 1,
            _ => 2,
        };
        sections[place].entries.push(entry);
    }
    sections.into_iter().filter(|section| !section.entries.is_empty()).collect()
}

/// Puts parameters (`shading.ambient`) and texts (`shading.text`) below the choice of the snippet (`shading`).
fn entries(decls: Vec<PropertyDecl>) -> Vec<Entry> {
    let is_choice = |decl: &PropertyDecl| matches!(decl.kind, PropertyKind::Snippet { .. });
    let (owners, others): (Vec<_>, Vec<_>) =
        decls.into_iter().partition(|decl| is_choice(decl) || !decl.id.contains('.'));
    let entry = |decl| Entry { decl, parameters: Vec::new(), text: None };
    let mut entries: Vec<_> = owners.into_iter().map(entry).collect();
    for decl in others {
        let owner = decl
            .id
            .split_once('.')
            .and_then(|(slot, _)| entries.iter_mut().find(|entry| entry.decl.id == slot && is_choice(&entry.decl)));
        match (owner, &decl.kind) {
            (Some(owner), PropertyKind::ShaderText { .. }) => owner.text = Some(decl),
            (Some(owner), _) => owner.parameters.push(decl),
            (None, _) => entries.push(entry(decl)),
        }
    }
    entries
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rayloom_network::{Network, Value};
    use rayloom_processors::registry;

    use super::*;

    fn outline(changes: &[(&str, &str)]) -> Vec<Section> {
        let mut network = Network::new(Arc::new(registry()));
        network.add("ray_traversal", "traversal").expect("added");
        for (property, value) in changes {
            network.set_property("traversal", property, Value::Text((*value).into())).expect("set");
        }
        let processor = network.processor("traversal").expect("there");
        sections(processor.property_decls(), &processor.idle_properties(&BTreeSet::new()))
    }

    fn colours(sections: &[Section]) -> Vec<&str> {
        sections[0].entries.iter().map(|entry| entry.decl.id.as_str()).collect()
    }

    #[test]
    fn parameters_and_text_stand_below_their_snippet() {
        let sections = outline(&[("shading", "blinn_phong")]);
        let shader = &sections[1].entries;
        let shading = shader.iter().find(|entry| entry.decl.id == "shading").expect("shading");
        assert!(shading.parameters.iter().any(|decl| decl.id == "shading.ambient"));
        assert_eq!(shading.text.as_ref().map(|decl| decl.id.as_str()), Some("shading.text"));
    }

    #[test]
    fn what_the_classification_does_not_read_stands_last() {
        assert_eq!(colours(&outline(&[])), ["transfer_function"]);
        let sections = outline(&[]);
        let idle = sections.last().filter(|section| section.title == IDLE).expect("idle properties");
        assert!(idle.entries.iter().any(|entry| entry.decl.id == "label_table"));
        assert_eq!(colours(&outline(&[("classification", "transfer_function_2d")])), ["transfer_function_2d"]);
        assert_eq!(colours(&outline(&[("classification", "labels")])), ["label_table"]);
    }
}
