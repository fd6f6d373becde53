//! The form of an application in the network file.

use rayloom_network::{Address, Preset};
use serde_json::{Map, Value as Json, json};

use super::{Application, Exposed, Group, Layout};

/// Layouts by their names in the file.
const LAYOUTS: [(Layout, &str); 2] = [(Layout::Grid, "grid"), (Layout::FirstLarge, "first_large")];

/// Reads an application; what cannot be understood is left out and becomes a sentence.
pub(super) fn parse(json: &Json) -> (Application, Vec<String>) {
    let mut problems = Vec::new();
    let mut reader = Reader { problems: &mut problems };
    let application = reader.application(json);
    (application, problems)
}

struct Reader<'a> {
    problems: &'a mut Vec<String>,
}

impl Reader<'_> {
    fn complain(&mut self, path: &str, found: &Json, expected: &str) {
        let mut found = found.to_string();
        if found.chars().count() > 60 {
            found = found.chars().take(57).chain("...".chars()).collect();
        }
        self.problems.push(format!("{path}: found {found}, expected {expected}"));
    }

    /// The fields of an object, after a complaint about those that nobody knows.
    fn object<'j>(&mut self, path: &str, json: &'j Json, known: &[&str]) -> Option<&'j Map<String, Json>> {
        let Some(object) = json.as_object() else {
            self.complain(path, json, &format!("an object with {}", known.join(", ")));
            return None;
        };
        for field in object.keys().filter(|field| !known.contains(&field.as_str())) {
            self.problems.push(format!("{path}: found the field `{field}`, expected only {}", known.join(", ")));
        }
        Some(object)
    }

    fn list<'j>(&mut self, path: &str, json: Option<&'j Json>) -> &'j [Json] {
        match json {
            None => &[],
            Some(Json::Array(items)) => items,
            Some(other) => {
                self.complain(path, other, "an array");
                &[]
            }
        }
    }

    fn text(&mut self, path: &str, json: Option<&Json>) -> Option<String> {
        match json? {
            Json::String(text) => Some(text.clone()),
            other => {
                self.complain(path, other, "a text");
                None
            }
        }
    }

    fn address(&mut self, path: &str, text: &str) -> Option<Address> {
        text.parse().map_err(|error| self.problems.push(format!("{path}: {error}"))).ok()
    }

    fn application(&mut self, json: &Json) -> Application {
        let path = "visualization";
        let fields = ["canvases", "layout", "groups", "presets", "locked"];
        if json.is_null() {
            return Application::default();
        }
        let Some(object) = self.object(path, json, &fields) else { return Application::default() };
        let at = |field: &str| format!("{path}.{field}");
        let canvases = self.list(&at("canvases"), object.get("canvases")).iter();
        let canvases = canvases.filter_map(|canvas| self.text(&at("canvases"), Some(canvas))).collect();
        let layout = self.layout(&at("layout"), object.get("layout"));
        let groups = self.list(&at("groups"), object.get("groups")).iter().enumerate();
        let groups = groups.filter_map(|(i, group)| self.group(&format!("{path}.groups[{i}]"), group)).collect();
        let presets = self.list(&at("presets"), object.get("presets")).iter().enumerate();
        let presets = presets.filter_map(|(i, preset)| self.preset(&format!("{path}.presets[{i}]"), preset)).collect();
        let locked = match object.get("locked") {
            None => false,
            Some(Json::Bool(locked)) => *locked,
            Some(other) => {
                self.complain(&at("locked"), other, "true or false");
                false
            }
        };
        Application { canvases, layout, groups, presets, locked }
    }

    fn layout(&mut self, path: &str, json: Option<&Json>) -> Layout {
        let named = json.map(|json| LAYOUTS.into_iter().find(|(_, name)| json == name).ok_or(json));
        match named {
            None => Layout::default(),
            Some(Ok((layout, _))) => layout,
            Some(Err(found)) => {
                self.complain(path, found, &LAYOUTS.map(|(_, name)| name).join(" or "));
                Layout::default()
            }
        }
    }

    fn group(&mut self, path: &str, json: &Json) -> Option<Group> {
        let object = self.object(path, json, &["title", "properties"])?;
        let title = self.text(&format!("{path}.title"), object.get("title")).unwrap_or_default();
        let properties = self.list(&format!("{path}.properties"), object.get("properties")).iter().enumerate();
        let properties = properties.filter_map(|(i, one)| self.exposed(&format!("{path}.properties[{i}]"), one));
        Some(Group { title, properties: properties.collect() })
    }

    fn exposed(&mut self, path: &str, json: &Json) -> Option<Exposed> {
        let object = self.object(path, json, &["property", "label", "range"])?;
        let Some(property) = self.text(&format!("{path}.property"), object.get("property")) else {
            self.problems.push(format!("{path}: no `property`; name one as `processor.property`"));
            return None;
        };
        let property = self.address(&format!("{path}.property"), &property)?;
        let label = self.text(&format!("{path}.label"), object.get("label"));
        let range = object.get("range").and_then(|range| {
            let ends = range.as_array().and_then(|ends| Some([ends.first()?.as_f64()?, ends.get(1)?.as_f64()?]));
            let ends = ends.filter(|[low, high]| low < high && range.as_array().is_some_and(|ends| ends.len() == 2));
            if ends.is_none() {
                self.complain(&format!("{path}.range"), range, "two numbers, the smaller one first");
            }
            ends
        });
        Some(Exposed { property, label, range })
    }

    fn preset(&mut self, path: &str, json: &Json) -> Option<Preset> {
        Preset::from_json(json).map_err(|problem| self.problems.push(format!("{path}: {problem}"))).ok()
    }
}

/// Writes an application; what is as it would be without is left out.
pub(super) fn write(application: &Application) -> Json {
    let mut json = Map::new();
    if !application.canvases.is_empty() {
        json.insert("canvases".into(), json!(application.canvases));
    }
    if let Some((_, name)) = LAYOUTS.iter().find(|(layout, _)| *layout == application.layout)
        && application.layout != Layout::default()
    {
        json.insert("layout".into(), json!(name));
    }
    if !application.groups.is_empty() {
        json.insert("groups".into(), application.groups.iter().map(write_group).collect());
    }
    if !application.presets.is_empty() {
        json.insert("presets".into(), application.presets.iter().map(Preset::to_json).collect());
    }
    if application.locked {
        json.insert("locked".into(), Json::Bool(true));
    }
    if json.is_empty() { Json::Null } else { Json::Object(json) }
}

fn write_group(group: &Group) -> Json {
    let exposed = |exposed: &Exposed| {
        let mut json = json!({"property": exposed.property.to_string()});
        if let Some(label) = &exposed.label {
            json["label"] = json!(label);
        }
        if let Some(range) = exposed.range {
            json["range"] = json!(range);
        }
        json
    };
    json!({"title": group.title, "properties": group.properties.iter().map(exposed).collect::<Vec<_>>()})
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let json = json!({
            "canvases": ["a", "b"],
            "layout": "first_large",
            "groups": [{"title": "T", "properties": [
                {"property": "traversal.sampling_rate", "label": "Quality", "range": [0.5, 4.0]},
                {"property": "view.camera"}
            ]}],
            "presets": [{"name": "P", "values": {"traversal.sampling_rate": 2.0}}],
            "locked": true
        });
        let (application, problems) = parse(&json);
        assert_eq!(problems, Vec::<String>::new());
        assert_eq!(write(&application), json);
        assert_eq!(write(&Application::default()), Json::Null);
    }

    #[test]
    fn what_is_wrong_is_named_and_the_rest_counts() {
        let (application, problems) = parse(&json!({
            "canvas": [],
            "layout": "spiral",
            "groups": [{"title": 3, "properties": [{"property": "no address"}, {"label": "x"}, {"property": "a.b", "range": [2, 1]}]}],
            "presets": {},
            "locked": true
        }));
        assert!(application.locked);
        assert_eq!(application.groups[0].properties, [Exposed::new(Address::new("a", "b"))]);
        assert_eq!(
            problems,
            [
                "visualization: found the field `canvas`, expected only canvases, layout, groups, presets, locked",
                "visualization.layout: found \"spiral\", expected grid or first_large",
                "visualization.groups[0].title: found 3, expected a text",
                "visualization.groups[0].properties[0].property: `no address` is not an address; write `processor.item`, each of letters, digits, `_` or `-`",
                "visualization.groups[0].properties[1]: no `property`; name one as `processor.property`",
                "visualization.groups[0].properties[2].range: found [2,1], expected two numbers, the smaller one first",
                "visualization.presets: found {}, expected an array",
            ]
        );
    }
}
