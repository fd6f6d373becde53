//! What the parts of a WGSL text are, for colouring it.

use std::ops::Range;

use crate::lexer::{TokenKind, tokens};

/// What a part of a text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Highlight {
    /// A comment.
    Comment,
    /// A line of the declaration at the head (`//!`).
    Declaration,
    /// A line for the preprocessor (`#if`, `#include`, ...).
    Directive,
    /// A word of the language.
    Keyword,
    /// A type.
    Type,
    /// A function where it is called or defined.
    Function,
    /// A parameter of the snippet (`params.NAME`).
    Parameter,
    /// A number.
    Number,
    /// Names, operators, brackets, white space.
    Plain,
}

const KEYWORDS: [&str; 26] = [
    "alias",
    "break",
    "case",
    "const",
    "const_assert",
    "continue",
    "continuing",
    "default",
    "diagnostic",
    "discard",
    "else",
    "enable",
    "false",
    "fn",
    "for",
    "if",
    "let",
    "loop",
    "override",
    "requires",
    "return",
    "struct",
    "switch",
    "true",
    "var",
    "while",
];

const TYPES: [&str; 12] =
    ["array", "atomic", "bool", "f16", "f32", "i32", "ptr", "sampler", "u32", "vec2", "vec3", "vec4"];

/// The parts of a text from its beginning to its end, as byte ranges without gaps.
pub fn highlight(text: &str) -> Vec<(Range<usize>, Highlight)> {
    let list = tokens(text);
    let mut parts = Parts { text, found: Vec::new(), end: 0 };
    let mut index = 0;
    while let Some(token) = list.get(index) {
        if token.text == "#" && text[..token.start].rsplit('\n').next().is_some_and(|before| before.trim().is_empty()) {
            let end = text[token.start..].find('\n').map_or(text.len(), |length| token.start + length);
            parts.add(token.start..end, Highlight::Directive);
            index += list[index..].iter().take_while(|token| token.start < end).count();
            continue;
        }
        let before = |back: usize| index.checked_sub(back).and_then(|at| list.get(at)).map(|token| token.text);
        let kind = match token.kind {
            TokenKind::Number => Highlight::Number,
            TokenKind::Punctuation => Highlight::Plain,
            TokenKind::Identifier if before(1) == Some(".") => match before(2) {
                Some("params") => Highlight::Parameter,
                _ => Highlight::Plain,
            },
            TokenKind::Identifier => identifier(token.text, list.get(index + 1).is_some_and(|next| next.text == "(")),
        };
        parts.add(token.start..token.start + token.text.len(), kind);
        index += 1;
    }
    parts.gap(text.len());
    parts.found
}

fn identifier(word: &str, called: bool) -> Highlight {
    let is_type = TYPES.contains(&word)
        || ["vec", "mat", "texture_"].iter().any(|start| word.starts_with(start))
        || word.starts_with(|c: char| c.is_ascii_uppercase()) && word.chars().any(|c| c.is_ascii_lowercase());
    match () {
        () if KEYWORDS.contains(&word) => Highlight::Keyword,
        () if is_type => Highlight::Type,
        () if called => Highlight::Function,
        () => Highlight::Plain,
    }
}

struct Parts<'a> {
    text: &'a str,
    found: Vec<(Range<usize>, Highlight)>,
    end: usize,
}

impl Parts<'_> {
    fn add(&mut self, range: Range<usize>, kind: Highlight) {
        self.gap(range.start);
        self.end = range.end;
        self.found.push((range, kind));
    }

    /// What lies between tokens: white space and comments.
    fn gap(&mut self, until: usize) {
        let mut at = self.end;
        while at < until {
            let rest = &self.text[at..until];
            let (length, kind) = if rest.starts_with("//") {
                let kind = if rest.starts_with("//!") { Highlight::Declaration } else { Highlight::Comment };
                (rest.find('\n').unwrap_or(rest.len()), kind)
            } else if rest.starts_with("/*") {
                (block(rest), Highlight::Comment)
            } else {
                (rest.find('/').filter(|&found| found > 0).unwrap_or(rest.len()), Highlight::Plain)
            };
            self.found.push((at..at + length, kind));
            at += length;
        }
        self.end = self.end.max(until);
    }
}

/// Length of the block comment at the beginning; a gap holds only whole ones.
fn block(rest: &str) -> usize {
    let (mut depth, mut at) = (0usize, 0);
    for pair in rest.as_bytes().windows(2) {
        match pair {
            b"/*" => depth += 1,
            b"*/" => depth = depth.saturating_sub(1),
            _ => {}
        }
        at += 1;
        if depth == 0 {
            return (at + 1).min(rest.len());
        }
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_known_and_none_is_lost() {
        let text = "//! slot: shading\n#if light\nfn shade(m: vec4f) -> State { /* a /* b */ c */ return params.gain * 2.0; } // end\n#endif";
        let parts = highlight(text);
        assert_eq!(parts.iter().map(|(range, _)| &text[range.clone()]).collect::<String>(), text);
        let kind = |wanted: &str| parts.iter().find(|(range, _)| &text[range.clone()] == wanted).map(|(_, kind)| *kind);
        for (wanted, expected) in [
            ("//! slot: shading", Highlight::Declaration),
            ("#if light", Highlight::Directive),
            ("fn", Highlight::Keyword),
            ("shade", Highlight::Function),
            ("vec4f", Highlight::Type),
            ("State", Highlight::Type),
            ("/* a /* b */ c */", Highlight::Comment),
            ("gain", Highlight::Parameter),
            ("2.0", Highlight::Number),
            ("// end", Highlight::Comment),
        ] {
            assert_eq!(kind(wanted), Some(expected), "{wanted}: {parts:?}");
        }
    }

    #[test]
    fn survives_anything() {
        for text in ["", "/*", "/* /* */", "/", "//", "é→x /*é", "#", "# é\n//!", "a/b", "}} \"", "/*/"] {
            let parts = highlight(text);
            assert_eq!(parts.iter().map(|(range, _)| &text[range.clone()]).collect::<String>(), text);
        }
    }
}
