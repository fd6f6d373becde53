//! Which properties change nothing, given the others.

use std::collections::{BTreeMap, BTreeSet};

use rayloom_network::Properties;
use rayloom_wgsl::{Choice, Features, Library, MAX_OUTPUTS, Slot};

use super::OUTPORTS;
use super::snippets::PLACES;

/// Ids of the properties that the assembled shader does not depend on while only the outports in `used` are. Empty where the
/// choice is refused: what has to be changed then is not known.
pub(super) fn idle(library: &Library, properties: &Properties, used: &BTreeSet<String>) -> BTreeSet<String> {
    let Some(choice) = choice(library, properties, used) else { return BTreeSet::new() };
    let Ok(checked) = choice.check(library) else { return BTreeSet::new() };
    let features = checked.features;
    let skips = properties.text("skipping").is_ok_and(|id| id != "none");
    let jitters = properties.bool("jitter").unwrap_or(false);
    let lit = features.has("light");
    let unread = [
        ("transfer_function", !reads(&features, "transfer_function") && !reads(&features, "preintegration")),
        ("transfer_function_2d", !features.has("transfer_function_2d")),
        ("label_table", !features.has("labels")),
        ("light", !lit),
        ("two_sided", !features.has("shaded_gradient")),
        ("gradient_fade", !features.has("shaded_gradient")),
        ("jitter_seed", !jitters),
        ("brick_size", !skips),
    ];
    let unread = unread.into_iter().filter(|(_, unread)| *unread).map(|(id, _)| id.to_owned());
    let places = PLACES.iter().filter(|place| match place.output {
        Some(output) => choice.outputs[output].is_none(),
        None => place.slot != Slot::Skipping && !features.slots.contains(&place.slot) && !is_none(properties, place.id),
    });
    let brought: Vec<String> = places.map(|place| place.id.to_owned()).collect();
    let belongs = |id: &str| brought.iter().any(|place| id.split('.').next() == Some(place));
    let parameters = properties.iter().map(|(id, _)| id.to_owned()).filter(|id| belongs(id));
    unread.chain(parameters).collect()
}

/// Whether a slot is left empty by choice: that can always be changed.
fn is_none(properties: &Properties, slot: &str) -> bool {
    properties.text(slot).is_ok_and(|id| id == "none")
}

/// Whether a word of the declarations that begins so is read.
fn reads(features: &Features, word: &str) -> bool {
    features.flags.iter().any(|flag| flag == word || (word == "preintegration" && flag.starts_with(word)))
}

/// The choice of snippets, as far as it does not depend on data. `None` where a snippet is unknown or its text broken.
fn choice(library: &Library, properties: &Properties, used: &BTreeSet<String>) -> Option<Choice> {
    let nothing_used = !OUTPORTS.iter().any(|outport| used.contains(*outport));
    let mut snippets = BTreeMap::new();
    let mut outputs: [_; MAX_OUTPUTS] = Default::default();
    for place in PLACES {
        match place.output {
            Some(0) if nothing_used => outputs[0] = place.snippet(library, properties).ok()?,
            Some(output) if used.contains(OUTPORTS[output]) => {
                outputs[output] = place.snippet(library, properties).ok()?
            }
            Some(_) => {}
            None => snippets.extend(place.snippet(library, properties).ok()?.map(|snippet| (place.slot, snippet))),
        }
    }
    Some(Choice::of(snippets, outputs))
}

#[cfg(test)]
mod tests {
    use rayloom_network::{Network, Value};
    use std::sync::Arc;

    use super::*;

    fn idle_with(changes: &[(&str, &str)], used: &[&str]) -> BTreeSet<String> {
        let mut network = Network::new(Arc::new(crate::registry()));
        network.add("ray_traversal", "traversal").expect("added");
        for (property, value) in changes {
            network.set_property("traversal", property, Value::Text((*value).into())).expect("set");
        }
        let used = used.iter().map(|outport| (*outport).to_owned()).collect();
        network.processor("traversal").expect("there").idle_properties(&used)
    }

    #[test]
    fn what_nothing_reads_is_idle_and_nothing_else() {
        let unlit = idle_with(&[], &["image"]);
        for idle in ["light", "two_sided", "gradient", "refinement", "refinement.steps", "compositing2", "label_table"]
        {
            assert!(unlit.contains(idle), "{idle}");
        }
        for busy in ["shading", "compositing", "transfer_function", "sampling_rate", "skipping"] {
            assert!(!unlit.contains(busy), "{busy}");
        }
        let lit = idle_with(&[("shading", "blinn_phong")], &["image", "image2"]);
        for busy in ["light", "two_sided", "gradient", "compositing2", "shading.ambient"] {
            assert!(!lit.contains(busy), "{busy}");
        }
        let surface = idle_with(&[("compositing", "isosurface")], &["image"]);
        assert!(!surface.contains("refinement.steps") && surface.contains("transfer_function"));
    }

    #[test]
    fn a_refused_choice_hides_nothing() {
        assert_eq!(idle_with(&[("shading", "blinn_phong"), ("gradient", "none")], &["image"]), BTreeSet::new());
    }
}
