//! What the author of an application can change about it, each an edit of the network.

use std::convert::Infallible;

use rayloom_network::{Address, Network, PropertyKind};

use super::{Application, Exposed, Group, Layout, Preset, canvases, declared, json};
use crate::session::Session;

/// A property in an application: number of its group, number in the group.
pub type Place = (usize, usize);

/// A change of what visualization mode shows. Numbers count from 0; one that is out of range changes nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Adds a group at the end.
    AddGroup(String),
    /// Renames a group.
    TitleGroup(usize, String),
    /// Moves a group to another's place.
    MoveGroup(usize, usize),
    /// Removes a group with its properties.
    RemoveGroup(usize),
    /// Shows a property at the end of a group, which is made if there is none.
    Expose(Address, usize),
    /// Calls a property something else; as declared if there is nothing.
    Label(Place, Option<String>),
    /// Narrows what a slider reaches; as declared if there is nothing.
    Range(Place, Option<[f64; 2]>),
    /// Moves a property before another one, or to the end of a group.
    MoveProperty(Place, Place),
    /// Hides a property wherever it is shown.
    Hide(Address),
    /// Shows or hides a canvas.
    ShowCanvas(String, bool),
    /// Moves a canvas to another's place among those shown.
    MoveCanvas(usize, usize),
    /// Arranges the canvases.
    Arrange(Layout),
    /// Keeps the values that the shown properties have now under a name, in place of what had the name.
    StorePreset(String),
    /// Renames a set of values.
    RenamePreset(usize, String),
    /// Moves a set of values to another's place.
    MovePreset(usize, usize),
    /// Removes a set of values.
    RemovePreset(usize),
    /// Takes a value that cannot be set out of a set of values.
    Forget(usize, Address),
    /// Keeps the window in visualization mode, or lets it switch.
    Lock(bool),
}

impl Change {
    /// What the history calls it.
    pub fn label(&self) -> String {
        match self {
            Self::AddGroup(_) => "add a group".into(),
            Self::TitleGroup(..) => "rename a group".into(),
            Self::MoveGroup(..) => "move a group".into(),
            Self::RemoveGroup(_) => "remove a group".into(),
            Self::Expose(address, _) => format!("show {address} in the application"),
            Self::Label(..) => "label a property".into(),
            Self::Range(..) => "limit a property".into(),
            Self::MoveProperty(..) => "move a property".into(),
            Self::Hide(address) => format!("hide {address} in the application"),
            Self::ShowCanvas(id, true) => format!("show {id} in the application"),
            Self::ShowCanvas(id, false) => format!("hide {id} in the application"),
            Self::MoveCanvas(..) | Self::Arrange(_) => "arrange the canvases".into(),
            Self::StorePreset(name) => format!("store preset {name}"),
            Self::RenamePreset(..) => "rename a preset".into(),
            Self::MovePreset(..) => "move a preset".into(),
            Self::RemovePreset(_) | Self::Forget(..) => "remove from the presets".into(),
            Self::Lock(true) => "lock the application".into(),
            Self::Lock(false) => "unlock the application".into(),
        }
    }

    /// Changes with the same key, one right after the other, are one step: a text being typed, a number being dragged.
    pub fn key(&self) -> Option<String> {
        let key = |what: &str, place: &dyn std::fmt::Debug| Some(format!("application {what} {place:?}"));
        match self {
            Self::TitleGroup(group, _) => key("title", group),
            Self::Label(place, _) => key("label", place),
            Self::Range(place, _) => key("range", place),
            Self::RenamePreset(preset, _) => key("preset", preset),
            _ => None,
        }
    }

    /// Changes a network's application. What could not be read of it before is dropped.
    pub fn apply(self, network: &mut Network) {
        let (mut application, _) = json::parse(&network.visualization);
        application.change(self, network);
        network.visualization = application.to_json();
    }
}

impl Application {
    fn change(&mut self, change: Change, network: &Network) {
        match change {
            Change::AddGroup(title) => self.groups.push(Group { title, properties: Vec::new() }),
            Change::TitleGroup(group, title) => with(self.groups.get_mut(group), |group| group.title = title),
            Change::MoveGroup(from, to) => shift(&mut self.groups, from, to),
            Change::RemoveGroup(group) => remove(&mut self.groups, group),
            Change::Expose(address, group) => self.expose(address, group),
            Change::Label(place, label) => with(self.at(place), |shown| shown.label = label),
            Change::Range(place, range) if range.is_none_or(|[low, high]| low < high) => {
                with(self.at(place), |shown| shown.range = range);
            }
            // An empty range would be refused when the file is read.
            Change::Range(..) => {}
            Change::MoveProperty(from, to) => self.move_property(from, to),
            Change::Hide(address) => {
                self.groups.iter_mut().for_each(|group| group.properties.retain(|shown| shown.property != address));
            }
            Change::ShowCanvas(id, shown) => self.show_canvas(id, shown, network),
            Change::MoveCanvas(from, to) => {
                let mut shown = self.listed_canvases(network);
                shift(&mut shown, from, to);
                self.set_canvases(shown, network);
            }
            Change::Arrange(layout) => self.layout = layout,
            Change::StorePreset(name) => self.store(name, network),
            Change::RenamePreset(preset, name) => with(self.presets.get_mut(preset), |preset| preset.name = name),
            Change::MovePreset(from, to) => shift(&mut self.presets, from, to),
            Change::RemovePreset(preset) => remove(&mut self.presets, preset),
            Change::Forget(preset, address) => {
                with(self.presets.get_mut(preset), |preset| drop(preset.values.remove(&address)));
            }
            Change::Lock(locked) => self.locked = locked,
        }
    }

    fn at(&mut self, (group, index): Place) -> Option<&mut Exposed> {
        self.groups.get_mut(group)?.properties.get_mut(index)
    }

    /// Whether a property is shown in any group.
    pub fn shows(&self, address: &Address) -> bool {
        self.groups.iter().flat_map(|group| &group.properties).any(|shown| shown.property == *address)
    }

    fn expose(&mut self, address: Address, group: usize) {
        if self.shows(&address) {
            return;
        }
        if self.groups.is_empty() {
            self.groups.push(Group { title: "Settings".into(), properties: Vec::new() });
        }
        let group = group.min(self.groups.len() - 1);
        self.groups[group].properties.push(Exposed::new(address));
    }

    fn move_property(&mut self, from: Place, to: Place) {
        if to.0 >= self.groups.len() || self.at(from).is_none() {
            return;
        }
        let shown = self.groups[from.0].properties.remove(from.1);
        // What stood behind it in the same group has moved up.
        let index = if from.0 == to.0 && to.1 > from.1 { to.1 - 1 } else { to.1 };
        let target = &mut self.groups[to.0].properties;
        target.insert(index.min(target.len()), shown);
    }

    /// Ids of the canvases shown, in order, those included that are not in the network any more.
    pub fn listed_canvases(&self, network: &Network) -> Vec<String> {
        match self.canvases.is_empty() {
            true => canvases(network).map(str::to_owned).collect(),
            false => self.canvases.clone(),
        }
    }

    /// All canvases in their own order are what is shown when nothing is said.
    fn set_canvases(&mut self, shown: Vec<String>, network: &Network) {
        self.canvases = if canvases(network).eq(shown.iter().map(String::as_str)) { Vec::new() } else { shown };
    }

    /// The last canvas stays: an application without a picture would show all of them.
    fn show_canvas(&mut self, id: String, shown: bool, network: &Network) {
        let mut listed = self.listed_canvases(network);
        listed.retain(|listed| *listed != id);
        if shown {
            listed.push(id);
        }
        if !listed.is_empty() {
            self.set_canvases(listed, network);
        }
    }

    fn store(&mut self, name: String, network: &Network) {
        let shown = self.groups.iter().flat_map(|group| &group.properties).map(|shown| &shown.property);
        let value = |address: &Address| {
            let decl = declared(network, address).ok()?;
            // The path of a file is stored relative to the network's in one place only: the property itself.
            let storable = !matches!(decl.kind, PropertyKind::File { .. });
            let value = network.value(&address.processor, &address.item).filter(|_| storable)?;
            Some((address.clone(), value.to_json()))
        };
        let preset = Preset { values: shown.filter_map(value).collect(), name };
        match self.presets.iter_mut().find(|known| known.name == preset.name) {
            Some(known) => *known = preset,
            None => self.presets.push(preset),
        }
    }

    /// Follows a processor that got another id.
    fn rename(&mut self, old: &str, new: &str) {
        let follow = |id: &mut String| {
            if *id == old {
                new.clone_into(id);
            }
        };
        self.canvases.iter_mut().for_each(follow);
        let shown = self.groups.iter_mut().flat_map(|group| &mut group.properties);
        shown.for_each(|shown| follow(&mut shown.property.processor));
        for preset in &mut self.presets {
            let values = std::mem::take(&mut preset.values).into_iter();
            let renamed = values.map(|(mut address, value)| {
                follow(&mut address.processor);
                (address, value)
            });
            preset.values = renamed.collect();
        }
    }
}

/// Lets the application follow a processor that got another id.
pub fn follow_rename(network: &mut Network, old: &str, new: &str) {
    let (before, _) = json::parse(&network.visualization);
    let mut after = before.clone();
    after.rename(old, new);
    if after != before {
        network.visualization = after.to_json();
    }
}

impl Session {
    /// Changes what visualization mode shows.
    pub fn author(&mut self, change: Change) {
        let (label, key) = (change.label(), change.key());
        let change = |network: &mut Network| -> Result<(), Infallible> {
            change.apply(network);
            Ok(())
        };
        let Ok(()) = match key {
            Some(key) => self.document.edit_merged(&label, &key, change),
            None => self.document.edit(&label, change),
        };
    }
}

fn with<T>(item: Option<&mut T>, change: impl FnOnce(&mut T)) {
    if let Some(item) = item {
        change(item);
    }
}

/// Moves an item to another's place.
fn shift<T>(items: &mut Vec<T>, from: usize, to: usize) {
    if from < items.len() && to < items.len() {
        let item = items.remove(from);
        items.insert(to, item);
    }
}

fn remove<T>(items: &mut Vec<T>, index: usize) {
    if index < items.len() {
        items.remove(index);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rayloom_processors::registry;

    use super::*;

    fn network() -> Network {
        let mut network = Network::new(Arc::new(registry()));
        for (type_id, id) in [("ray_traversal", "traversal"), ("canvas", "canvas"), ("canvas", "side")] {
            network.add(type_id, id).expect("added");
        }
        network
    }

    fn changed(network: &mut Network, changes: impl IntoIterator<Item = Change>) -> Application {
        changes.into_iter().for_each(|change| change.apply(network));
        Application::of(network).0
    }

    fn shown(application: &Application) -> Vec<Vec<&str>> {
        let groups = application.groups.iter();
        groups.map(|group| group.properties.iter().map(|shown| shown.property.item.as_str()).collect()).collect()
    }

    #[test]
    fn properties_move_within_and_between_groups() {
        let mut network = network();
        let expose = |item: &str, group| Change::Expose(Address::new("traversal", item), group);
        let first = ["shading", "compositing", "gradient"].map(|item| expose(item, 0));
        changed(&mut network, first);
        changed(&mut network, [Change::AddGroup("More".into()), expose("light", 1), expose("light", 0)]);
        let application = changed(&mut network, [Change::MoveProperty((0, 0), (0, 2))]);
        assert_eq!(shown(&application), [vec!["compositing", "shading", "gradient"], vec!["light"]]);
        let application = changed(&mut network, [Change::MoveProperty((1, 0), (0, 1)), Change::MoveGroup(1, 0)]);
        assert_eq!(shown(&application), [vec![], vec!["compositing", "light", "shading", "gradient"]]);
        let out_of_range = [Change::MoveProperty((7, 0), (0, 0)), Change::MoveGroup(5, 0), Change::RemovePreset(3)];
        assert_eq!(changed(&mut network, out_of_range), application);
    }

    #[test]
    fn all_canvases_are_shown_unless_chosen_and_one_always_stays() {
        let mut network = network();
        let show = |id: &str, shown| Change::ShowCanvas(id.into(), shown);
        assert_eq!(changed(&mut network, [show("canvas", false)]).canvases, ["side"]);
        assert_eq!(changed(&mut network, [show("side", false)]).canvases, ["side"]);
        assert_eq!(changed(&mut network, [show("canvas", true)]).canvases, ["side", "canvas"]);
        assert_eq!(changed(&mut network, [Change::MoveCanvas(1, 0)]), Application::default());
        assert!(network.visualization.is_null(), "what is as it would be without is left out");
    }

    #[test]
    fn an_application_follows_a_rename() {
        let mut network = network();
        let address = Address::new("traversal", "shading");
        let changes = [Change::Expose(address.clone(), 0), Change::StorePreset("P".into()), Change::MoveCanvas(0, 1)];
        changed(&mut network, changes);
        network.rename("traversal", "rays").expect("renamed");
        follow_rename(&mut network, "traversal", "rays");
        network.rename("canvas", "main").expect("renamed");
        follow_rename(&mut network, "canvas", "main");
        let (application, problems) = Application::of(&network);
        assert_eq!(problems, Vec::<String>::new());
        assert_eq!(application.canvases, ["side", "main"]);
        assert_eq!(application.presets[0].values.keys().next(), Some(&Address::new("rays", "shading")));
    }
}
