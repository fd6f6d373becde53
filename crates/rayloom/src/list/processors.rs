//! The processor types: text, JSON, and a page each.

use std::sync::Arc;

use rayloom_network::{Declaration, InportDecl, OutportDecl};
use rayloom_processors::{Process, processors};
use serde_json::{Value as Json, json};

use super::{Page, cell, columns, first_sentence, property};

/// The types by category, one line each.
pub fn text() -> String {
    let all = processors();
    let mut text = String::new();
    for category in categories(&all) {
        let members = members(&all, category).map(|declaration| (declaration.id.as_str(), declaration.help.as_str()));
        text += &format!("{category}\n{}", columns(members));
    }
    text
}

/// One object a type, with everything it declares.
pub fn json() -> Vec<Json> {
    processors().iter().map(|process| declared(process.declaration())).collect()
}

/// A page for every type, and one that lists them.
pub fn pages() -> Vec<Page> {
    let all = processors();
    let mut overview = "# Processors\n\nGenerated from the declarations by `cargo xtask docs`.\n".to_owned();
    for category in categories(&all) {
        overview += &format!("\n## {category}\n\n| processor | what it does |\n|---|---|\n");
        for Declaration { id, help, .. } in members(&all, category) {
            overview += &format!("| [`{id}`]({id}.md) | {} |\n", cell(first_sentence(help)));
        }
    }
    let page =
        |declaration: &Declaration| Page { path: format!("{}.md", declaration.id), text: page_text(declaration) };
    let mut pages: Vec<Page> = all.iter().map(|process| page(process.declaration())).collect();
    pages.push(Page { path: "README.md".to_owned(), text: overview });
    pages
}

/// The categories in the order in which they first occur.
fn categories(all: &[Arc<dyn Process>]) -> Vec<&str> {
    let mut categories: Vec<&str> = Vec::new();
    for process in all {
        let category = process.declaration().category.as_str();
        if !categories.contains(&category) {
            categories.push(category);
        }
    }
    categories
}

fn members<'a>(all: &'a [Arc<dyn Process>], category: &'a str) -> impl Iterator<Item = &'a Declaration> {
    all.iter().map(|process| process.declaration()).filter(move |declaration| declaration.category == category)
}

fn declared(declaration: &Declaration) -> Json {
    json!({
        "id": declaration.id,
        "label": declaration.label,
        "category": declaration.category,
        "help": declaration.help,
        "sink": declaration.sink,
        "inports": declaration.inports.iter().map(inport).collect::<Vec<_>>(),
        "outports": declaration.outports.iter().map(outport).collect::<Vec<_>>(),
        "properties": declaration.properties.iter().map(property::json).collect::<Vec<_>>(),
    })
}

fn inport(port: &InportDecl) -> Json {
    json!({
        "id": port.id,
        "label": port.label,
        "help": port.help,
        "accepts": port.accepts.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "several": port.several,
        "optional": port.optional,
        "conditions": port.conditions.iter().map(|condition| condition.message).collect::<Vec<_>>(),
    })
}

fn outport(port: &OutportDecl) -> Json {
    json!({"id": port.id, "label": port.label, "help": port.help, "type": port.port_type.to_string()})
}

fn page_text(declaration: &Declaration) -> String {
    let Declaration { id, label, category, help, inports, outports, properties, .. } = declaration;
    let mut text = format!("# {label}\n\nType `{id}`, category {category}.\n\n{help}\n");
    if !inports.is_empty() {
        text += "\n## Inports\n\n| id | takes | help |\n|---|---|---|\n";
        for port in inports {
            text += &format!("| `{}` | {} | {} |\n", port.id, cell(&accepted(port)), cell(&port.help));
        }
    }
    if !outports.is_empty() {
        text += "\n## Outports\n\n| id | gives | help |\n|---|---|---|\n";
        for port in outports {
            text += &format!("| `{}` | {} | {} |\n", port.id, port.port_type, cell(&port.help));
        }
    }
    if !properties.is_empty() {
        text += "\n## Properties\n\n| id | takes | default | help |\n|---|---|---|---|\n";
        text.extend(properties.iter().map(property::row));
    }
    text
}

/// What an inport accepts and needs: "a volume, takes several, optional; needs a scalar volume".
fn accepted(port: &InportDecl) -> String {
    let mut text = port.accepts.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ");
    if port.several {
        text += ", takes several";
    }
    if port.optional {
        text += ", optional";
    }
    for condition in &port.conditions {
        text += &format!("; needs {}", condition.message);
    }
    text
}
