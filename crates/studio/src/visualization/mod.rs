//! Visualization mode: what the author of a network lets its users see and set.
//!
//! A network file says so in `visualization`:
//!
//! ```json
//! {
//!   "canvases": ["canvas"],
//!   "layout": "first_large",
//!   "groups": [
//!     {"title": "Sampling", "properties": [
//!       {"property": "traversal.sampling_rate", "label": "Quality", "range": [0.5, 4]}
//!     ]}
//!   ],
//!   "presets": [{"name": "Fast", "values": {"traversal.sampling_rate": 0.5}}],
//!   "locked": false
//! }
//! ```
//!
//! Every field may be left out. No `canvases` means all of them; `layout` is `grid` unless it is `first_large`. `label` and `range` replace those of the declaration; a range
//! only narrows what sliders reach. A locked file cannot be switched to development mode from the window.

mod change;
mod json;
mod preset;
mod show;

pub use change::{Change, Place, follow_rename};
pub use preset::refused;
pub use show::Visualization;

use rayloom_network::{Address, Network, Preset, PropertyDecl, PropertyKind, closest};
use rayloom_processors::types::CANVAS;
use serde_json::Value as Json;

use crate::session::Mode;

/// What visualization mode shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Application {
    /// Ids of the canvases, in the order shown; all of them if empty.
    pub canvases: Vec<String>,
    /// How the canvases lie.
    pub layout: Layout,
    /// Properties that users may set.
    pub groups: Vec<Group>,
    /// Sets of values to choose from.
    pub presets: Vec<Preset>,
    /// Whether the window stays in visualization mode.
    pub locked: bool,
}

/// How canvases lie in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// In rows of about square cells.
    #[default]
    Grid,
    /// The first one large, the others beside or below it.
    FirstLarge,
}

/// Properties under a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// The heading.
    pub title: String,
    /// The properties, in the order shown.
    pub properties: Vec<Exposed>,
}

/// A property that users may set.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposed {
    /// Which one.
    pub property: Address,
    /// What it is called here; as declared if there is nothing.
    pub label: Option<String>,
    /// Smallest and largest value that a slider reaches; as declared if there is nothing.
    pub range: Option<[f64; 2]>,
}

impl Application {
    /// What a network's author wants shown, and what is wrong with it, a sentence each with the place in the file. What is
    /// wrong is left out; the rest counts.
    pub fn of(network: &Network) -> (Self, Vec<String>) {
        let (application, mut problems) = json::parse(&network.visualization);
        problems.extend(application.check(network));
        (application, problems)
    }

    /// What in the file cannot be read, a sentence each; the next change drops it.
    pub fn unreadable(network: &Network) -> Vec<String> {
        json::parse(&network.visualization).1
    }

    /// The form in the file.
    pub fn to_json(&self) -> Json {
        json::write(self)
    }

    /// What does not fit the network.
    fn check(&self, network: &Network) -> Vec<String> {
        let mut problems = Vec::new();
        let ids: Vec<_> = canvases(network).collect();
        for id in self.canvases.iter().filter(|id| !ids.contains(&id.as_str())) {
            problems.push(format!("visualization.canvases: there is no canvas `{id}`; there is [{}]", ids.join(", ")));
        }
        for (group, exposed) in self.groups.iter().flat_map(|group| group.properties.iter().map(move |e| (group, e))) {
            if let Err(problem) = declared(network, &exposed.property) {
                problems.push(format!("visualization.groups (`{}`): {problem}", group.title));
            }
        }
        for preset in &self.presets {
            let refused = refused(preset, network).into_iter();
            problems
                .extend(refused.map(|(_, problem)| format!("visualization.presets (`{}`): {problem}", preset.name)));
        }
        problems
    }

    /// How a network is shown when it is opened: one that its author made an application of, as that.
    pub fn mode_of(network: &Network) -> Mode {
        let (application, _) = json::parse(&network.visualization);
        let made = !application.groups.is_empty() || !application.presets.is_empty() || application.locked;
        if made { Mode::Visualization } else { Mode::Development }
    }

    /// Ids of the canvases to show.
    pub fn shown_canvases<'a>(&'a self, network: &'a Network) -> Vec<&'a str> {
        let all: Vec<_> = canvases(network).collect();
        match self.canvases.iter().map(String::as_str).filter(|id| all.contains(id)).collect::<Vec<_>>() {
            chosen if chosen.is_empty() => all,
            chosen => chosen,
        }
    }
}

impl Exposed {
    /// A property as it is declared.
    pub fn new(property: Address) -> Self {
        Self { property, label: None, range: None }
    }

    /// The declaration with the author's label and range; `None` when there is no such property at the moment.
    pub fn decl(&self, network: &Network) -> Option<PropertyDecl> {
        let mut decl = declared(network, &self.property).ok()?;
        if let Some(label) = &self.label {
            decl.label.clone_from(label);
        }
        if let Some([low, high]) = self.range {
            match &mut decl.kind {
                PropertyKind::Float { range, .. } | PropertyKind::Vector { range, .. } => *range = [low, high],
                PropertyKind::Int { range, .. } => *range = [low.ceil() as i64, high.floor() as i64],
                _ => {}
            }
        }
        Some(decl)
    }
}

/// Ids of the processors that show an image.
pub fn canvases(network: &Network) -> impl Iterator<Item = &str> {
    network.processors().filter(|processor| processor.type_id() == CANVAS).map(|processor| processor.id())
}

/// The declaration of a property, or a sentence about what is missing.
pub fn declared(network: &Network, address: &Address) -> Result<PropertyDecl, String> {
    let suggest = |names: Vec<&str>| match names.is_empty() {
        true => String::new(),
        false => format!("; did you mean {}?", names.join(" or ")),
    };
    let processor = network.processor(&address.processor).ok_or_else(|| {
        let names = closest(&address.processor, network.processors().map(|processor| processor.id()));
        format!("there is no processor `{}`{}", address.processor, suggest(names))
    })?;
    let decls = processor.property_decls();
    decls.iter().find(|decl| decl.id == address.item).cloned().ok_or_else(|| {
        let names = closest(&address.item, decls.iter().map(|decl| decl.id.as_str()));
        format!("`{}` has no property `{}` at the moment{}", address.processor, address.item, suggest(names))
    })
}
