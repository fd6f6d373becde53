//! Laying out JSON text so that it reads well and diffs stay small: what fits on a line stays on it, keys are sorted.

use serde_json::Value as Json;

/// Widest line, in characters, that an array or object is kept on.
const WIDTH: usize = 110;
const INDENT: usize = 2;

/// An object with its fields in the given order.
#[derive(Default)]
pub(crate) struct Ordered(pub Vec<(String, Piece)>);

impl Ordered {
    pub fn push(&mut self, name: impl Into<String>, piece: Piece) {
        self.0.push((name.into(), piece));
    }

    pub fn push_json(&mut self, name: impl Into<String>, json: impl Into<Json>) {
        self.push(name, Piece::Plain(json.into()));
    }
}

/// A part of the document.
pub(crate) enum Piece {
    Plain(Json),
    /// Its items on a line each, or more.
    List(Vec<Piece>),
    Object(Ordered),
}

/// The text, ending in a line break.
pub(crate) fn lay_out(document: Ordered) -> String {
    let mut out = String::new();
    break_object(&mut out, &named(document), 0);
    out.push('\n');
    out
}

/// A tree of what is to be written, with the order of fields fixed.
enum Tree {
    Leaf(String),
    Array(Vec<Tree>),
    Object(Vec<(String, Tree)>),
    /// Always one item a line.
    Lines(Vec<Tree>),
}

fn named(Ordered(fields): Ordered) -> Vec<(String, Tree)> {
    fields.into_iter().map(|(name, piece)| (name, tree_of(piece))).collect()
}

fn tree_of(piece: Piece) -> Tree {
    match piece {
        Piece::Plain(json) => tree(&json),
        Piece::List(items) if items.is_empty() => Tree::Array(Vec::new()),
        Piece::List(items) => Tree::Lines(items.into_iter().map(tree_of).collect()),
        Piece::Object(ordered) => Tree::Object(named(ordered)),
    }
}

fn tree(json: &Json) -> Tree {
    match json {
        Json::Array(items) => Tree::Array(items.iter().map(tree).collect()),
        Json::Object(map) => {
            let mut fields: Vec<(String, Tree)> = map.iter().map(|(key, value)| (key.clone(), tree(value))).collect();
            fields.sort_by(|(a, _), (b, _)| a.cmp(b));
            Tree::Object(fields)
        }
        Json::Number(number) => Tree::Leaf(whole(number).map_or_else(|| number.to_string(), |n| n.to_string())),
        other => Tree::Leaf(other.to_string()),
    }
}

/// A float that is a whole number, so that it is written without ".0".
fn whole(number: &serde_json::Number) -> Option<i64> {
    /// Up to here floats and integers mean the same.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let x = number.as_f64().filter(|_| number.is_f64())?;
    (x.fract() == 0.0 && x.abs() <= EXACT).then_some(x as i64)
}

/// `tree` at the given indent; `used` characters of the line are taken already.
fn write(out: &mut String, tree: &Tree, indent: usize, used: usize) {
    if let Some(line) = one_line(tree).filter(|line| used + line.chars().count() < WIDTH) {
        return out.push_str(&line);
    }
    match tree {
        Tree::Leaf(text) => out.push_str(text),
        Tree::Object(fields) => break_object(out, fields, indent),
        Tree::Array(items) | Tree::Lines(items) => {
            break_items(out, ['[', ']'], items.len(), indent, |out, i, inner| write(out, &items[i], inner, inner));
        }
    }
}

fn break_object(out: &mut String, fields: &[(String, Tree)], indent: usize) {
    break_items(out, ['{', '}'], fields.len(), indent, |out, i, inner| {
        let (name, value) = &fields[i];
        let key = format!("{}: ", Json::from(name.as_str()));
        out.push_str(&key);
        write(out, value, inner, inner + key.chars().count());
    });
}

/// Items on lines of their own between brackets.
fn break_items(
    out: &mut String,
    brackets: [char; 2],
    count: usize,
    indent: usize,
    item: impl Fn(&mut String, usize, usize),
) {
    let inner = indent + INDENT;
    out.push(brackets[0]);
    for i in 0..count {
        out.push_str(if i == 0 { "\n" } else { ",\n" });
        out.push_str(&" ".repeat(inner));
        item(out, i, inner);
    }
    out.push('\n');
    out.push_str(&" ".repeat(indent));
    out.push(brackets[1]);
}

/// The tree on one line, unless it holds something that always takes several.
fn one_line(tree: &Tree) -> Option<String> {
    match tree {
        Tree::Leaf(text) => Some(text.clone()),
        Tree::Lines(_) => None,
        Tree::Array(items) => {
            let items: Option<Vec<String>> = items.iter().map(one_line).collect();
            Some(format!("[{}]", items?.join(", ")))
        }
        Tree::Object(fields) => {
            let field =
                |(name, value): &(String, Tree)| Some(format!("{}: {}", Json::from(name.as_str()), one_line(value)?));
            let fields: Option<Vec<String>> = fields.iter().map(field).collect();
            Some(format!("{{{}}}", fields?.join(", ")))
        }
    }
}
