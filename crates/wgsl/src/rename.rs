//! Scopes a snippet: its module-scope names become private to the slot it fills, so that no two snippets collide
//! and one compositing snippet can serve several outputs.

use std::collections::BTreeMap;

use crate::lexer::{Token, TokenKind, module_scope_names, tokens};

/// New names for the identifiers of one text.
#[derive(Clone, Debug, Default)]
pub(crate) struct Renaming {
    /// Identifier -> new identifier.
    names: BTreeMap<String, String>,
    /// Parameter -> field of the uniform struct, for `params.NAME`.
    parameters: BTreeMap<String, String>,
    /// Whether members are renamed, too.
    members: bool,
    /// Number of the first loop, when loops are to be counted.
    first_loop: Option<u32>,
}

/// One line after renaming, with the column shifts of `Origin::renames`.
pub(crate) struct Renamed {
    pub text: String,
    pub shifts: Vec<(u32, u32, u32)>,
}

impl Renaming {
    /// Private names of `text` get `prefix_`; `keep` lists the names that the skeleton calls as they are.
    pub fn scoped(text: &str, prefix: &str, keep: &[String], parameters: &[String]) -> Self {
        let private = module_scope_names(text)
            .into_iter()
            .map(|(name, _)| name)
            .filter(|name| !keep.iter().any(|kept| kept == name));
        Self {
            names: private.map(|name| (name.to_owned(), format!("{prefix}_{name}"))).collect(),
            parameters: parameters.iter().map(|name| (name.clone(), format!("{prefix}_{name}"))).collect(),
            ..Self::default()
        }
    }

    /// Lets every loop count its rounds, and leave when there are too many; loops are numbered from `first`.
    pub fn bounding_loops(self, first: u32) -> Self {
        Self { first_loop: Some(first), ..self }
    }

    /// Identifiers that start with `mark` get `prefix` in its place, fields of structs, too.
    pub fn marked(text: &str, mark: &str, prefix: &str) -> Self {
        let names = tokens(text).into_iter().filter_map(|token| Some((token.text, token.text.strip_prefix(mark)?)));
        Self {
            names: names.map(|(name, rest)| (name.to_owned(), format!("{prefix}{rest}"))).collect(),
            members: true,
            ..Self::default()
        }
    }

    /// All names at module scope get `prefix`, and parameters their new fields.
    pub fn prefixed(text: &str, prefix: &str, parameters: BTreeMap<String, String>) -> Self {
        let names = module_scope_names(text).into_iter();
        let names = names.map(|(name, _)| (name.to_owned(), format!("{prefix}{name}"))).collect();
        Self { names, parameters, ..Self::default() }
    }

    /// Renames a whole text and returns its lines.
    pub fn apply(&self, text: &str) -> Vec<Renamed> {
        let list = tokens(text);
        let fields = struct_fields(&list);
        let mut edits: Vec<(usize, usize, String)> = Vec::new();
        for (index, token) in list.iter().enumerate() {
            // A damaged text may even declare a keyword.
            let is_field = !self.members && fields.contains(&token.start);
            if token.kind != TokenKind::Identifier || LOOP_WORDS.contains(&token.text) || is_field {
                continue;
            }
            let before = |back: usize| index.checked_sub(back).and_then(|at| list.get(at)).map(|token| token.text);
            let member = before(1) == Some(".");
            let new = match member {
                true if before(2) == Some("params") => self.parameters.get(token.text),
                true if !self.members => None,
                _ => self.names.get(token.text),
            };
            if let Some(new) = new {
                edits.push((token.start, token.text.len(), new.clone()));
            }
        }
        for ((word, body), number) in
            loops(&list).into_iter().zip(self.first_loop.into_iter().flat_map(|first| first..))
        {
            edits.push((word.start, word.text.len(), format!("var rounds_of_loop_{number} = 0u; {}", word.text)));
            let leave = format!("{{ if loop_is_over(&rounds_of_loop_{number}, {number}u) {{ break; }}");
            edits.push((body.start, body.text.len(), leave));
        }
        edits.sort_by_key(|edit| edit.0);
        split_lines(text, &edits)
    }
}

/// What begins a loop in WGSL.
const LOOP_WORDS: [&str; 3] = ["loop", "while", "for"];

/// Whether a text has loops.
pub fn has_loops(text: &str) -> bool {
    !loops(&tokens(text)).is_empty()
}

/// The loops of a text: the word that begins each, and the brace that opens its body. In a damaged text a word may have no
/// body: no brace belongs to two.
pub(crate) fn loops<'a>(list: &[Token<'a>]) -> Vec<(Token<'a>, Token<'a>)> {
    let begins = |index: usize| LOOP_WORDS.contains(&list[index].text) && !(index > 0 && list[index - 1].text == ".");
    let mut found = Vec::new();
    for (index, token) in list.iter().enumerate().filter(|(index, _)| begins(*index)) {
        let mut depth = 0i32;
        let mut after = (index + 1..list.len()).take_while(|next| !begins(*next)).map(|next| &list[next]);
        let body = after.find(|next| {
            depth += match next.text {
                "(" => 1,
                ")" => -1,
                _ => 0,
            };
            depth <= 0 && next.text == "{"
        });
        found.extend(body.map(|body| (*token, *body)));
    }
    found
}

/// Byte offsets of the field names declared in struct bodies; a field is no module-scope name even if it is spelled like one.
fn struct_fields(list: &[Token<'_>]) -> Vec<usize> {
    let mut fields = Vec::new();
    let mut in_struct = false;
    for (index, token) in list.iter().enumerate() {
        match token.text {
            "struct" => in_struct = true,
            "}" => in_struct = false,
            _ if in_struct && list.get(index + 1).is_some_and(|next| next.text == ":") => fields.push(token.start),
            _ => {}
        }
    }
    fields
}

fn split_lines(text: &str, edits: &[(usize, usize, String)]) -> Vec<Renamed> {
    let mut lines = Vec::new();
    let mut start = 0;
    let mut edits = edits.iter().peekable();
    for line in text.split('\n') {
        let end = start + line.len();
        let mut renamed = Renamed { text: String::with_capacity(line.len()), shifts: Vec::new() };
        let mut at = start;
        while let Some((from, length, new)) = edits.peek().filter(|edit| edit.0 < end) {
            let (from, length) = (*from, *length);
            renamed.text += &text[at..from];
            let column = renamed.text.chars().count() as u32 + 1;
            renamed.shifts.push((column, new.chars().count() as u32, text[from..from + length].chars().count() as u32));
            renamed.text += new;
            at = from + length;
            edits.next();
        }
        renamed.text += &text[at..end];
        lines.push(renamed);
        start = end + 1;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scoped(text: &str, keep: &[&str], parameters: &[&str]) -> String {
        let own = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
        let renaming = Renaming::scoped(text, "out1", &own(keep), &own(parameters));
        renaming.apply(text).into_iter().map(|line| line.text).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn private_names_and_parameters_are_scoped() {
        let text = "struct State { add: f32 }\nfn add(s: State) -> f32 { return s.add * params.gain + half; } // add\nconst half = 0.5;";
        assert_eq!(
            scoped(text, &[], &["gain"]),
            "struct out1_State { add: f32 }\nfn out1_add(s: out1_State) -> f32 { return s.add * params.out1_gain + out1_half; } // add\nconst out1_half = 0.5;"
        );
    }

    #[test]
    fn contract_names_stay() {
        assert_eq!(
            scoped("fn shade() { soft(); }\nfn soft() {}", &["shade"], &[]),
            "fn shade() { out1_soft(); }\nfn out1_soft() {}"
        );
    }
}
