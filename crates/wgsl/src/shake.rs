//! Leaves out what nothing uses: functions, types, constants and bindings that no entry point leads to.

use std::collections::{BTreeMap, BTreeSet};

use crate::lexer::{Token, TokenKind, tokens};

/// Words that begin a declaration at module scope.
const DECLARING: [&str; 7] = ["fn", "struct", "const", "alias", "override", "var", "const_assert"];

/// A declaration at module scope.
struct Item<'a> {
    name: Option<&'a str>,
    is_entry: bool,
    /// Identifiers in it.
    uses: BTreeSet<&'a str>,
    /// Lines, from 0, both included.
    first: usize,
    last: usize,
}

/// Which lines of `text` stay. Those for which `keep` holds do, and all that they use. A text whose brackets do not match stays
/// whole: the parser has to see it.
pub(crate) fn used_lines(text: &str, keep: impl Fn(usize) -> bool) -> Vec<bool> {
    let count = text.lines().count();
    let Some(items) = items(text) else { return vec![true; count] };
    let by_name: BTreeMap<&str, usize> =
        items.iter().enumerate().filter_map(|(index, item)| Some((item.name?, index))).collect();
    let is_root = |item: &Item<'_>| item.is_entry || item.name.is_none() || (item.first..=item.last).any(&keep);
    let mut open: Vec<usize> = (0..items.len()).filter(|index| is_root(&items[*index])).collect();
    let mut used: BTreeSet<usize> = open.iter().copied().collect();
    while let Some(index) = open.pop() {
        let next = items[index].uses.iter().filter_map(|name| by_name.get(name)).copied();
        open.extend(next.filter(|index| used.insert(*index)));
    }
    let mut lines = vec![false; count];
    for item in used.iter().map(|index| &items[*index]) {
        lines[item.first..=item.last].fill(true);
    }
    with_comments(text, &mut lines);
    lines
}

/// Comments and blank lines go with the declaration that they stand before.
fn with_comments(text: &str, lines: &mut [bool]) {
    let all: Vec<&str> = text.lines().map(str::trim).collect();
    for line in (0..all.len().saturating_sub(1)).rev() {
        if all[line].is_empty() || all[line].starts_with("//") {
            lines[line] |= lines[line + 1];
        }
    }
}

fn items(text: &str) -> Option<Vec<Item<'_>>> {
    let list = tokens(text);
    let starts: Vec<usize> = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
    let line_of = |token: &Token<'_>| starts.partition_point(|start| *start <= token.start) - 1;
    let mut found = Vec::new();
    let (mut depth, mut begin) = (0i32, 0);
    for (index, token) in list.iter().enumerate() {
        match token.text {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            _ => {}
        }
        if depth < 0 {
            return None;
        }
        // A struct's body may be followed by a semicolon, which is a declaration of nothing.
        if depth == 0 && matches!(token.text, "}" | ";") {
            found.push(item(&list[begin..=index], line_of(&list[begin]), line_of(token)));
            begin = index + 1;
        }
    }
    (depth == 0 && begin == list.len()).then_some(found)
}

fn item<'a>(list: &[Token<'a>], first: usize, last: usize) -> Item<'a> {
    let declaring = list.iter().position(|token| DECLARING.contains(&token.text));
    let name = declaring.and_then(|at| {
        let mut next = at + 1;
        if list.get(next).is_some_and(|token| token.text == "<") {
            next += list[next..].iter().position(|token| token.text == ">")? + 1;
        }
        list.get(next).filter(|token| token.kind == TokenKind::Identifier).map(|token| token.text)
    });
    let uses = list.iter().filter(|token| token.kind == TokenKind::Identifier).map(|token| token.text).collect();
    let stages = ["compute", "vertex", "fragment"];
    let is_entry = list.windows(2).any(|pair| pair[0].text == "@" && stages.contains(&pair[1].text));
    Item { name, is_entry, uses, first, last }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaken(text: &str) -> String {
        let lines = used_lines(text, |_| false);
        text.lines().zip(lines).filter(|(_, used)| *used).map(|(line, _)| line).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn what_no_entry_point_leads_to_goes_with_its_comment() {
        let text = "/// Unused.\nfn a() { b(); }\n\n/// Used.\nfn b() -> C { return C(D); }\nstruct C { x: f32 }\nconst D = 1.0;\n@group(0) @binding(0) var t: texture_2d<f32>;\n@compute @workgroup_size(1)\nfn main() {\n    b();\n}";
        assert_eq!(
            shaken(text),
            "\n/// Used.\nfn b() -> C { return C(D); }\nstruct C { x: f32 }\nconst D = 1.0;\n@compute @workgroup_size(1)\nfn main() {\n    b();\n}"
        );
    }

    #[test]
    fn a_text_with_a_bracket_too_many_stays_whole() {
        for text in ["fn a() { }\n}\nfn b() {}", "fn a() { (\nfn b() {}", "fn a() {}\nfn b("] {
            assert_eq!(shaken(text), text);
        }
    }
}
