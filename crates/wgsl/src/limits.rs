//! What a snippet may not do: whatever reaches beyond its slot. A token tells, since WGSL has no macros and functions no aliases.

use crate::diagnostic::Diagnostic;
use crate::lexer::{Token, TokenKind, line_and_column, tokens};

/// The longest text of a user's snippet, bytes: far more than anybody writes, and quick to refuse.
pub(crate) const LONGEST: usize = 256 << 10;

/// Attributes that concern only what they stand at; all others describe entry points and bindings.
const ATTRIBUTES: [&str; 4] = ["align", "size", "must_use", "const"];

/// Words that change the whole module.
const MODULE_WORDS: [&str; 4] = ["override", "enable", "requires", "diagnostic"];

/// Functions that write to, or wait for, what other snippets and invocations share.
const SHARED: [&str; 5] =
    ["textureStore", "textureBarrier", "workgroupBarrier", "storageBarrier", "workgroupUniformLoad"];

/// Operators that one expression may chain, and blocks or `else` that may follow on one another without end: parsers work on them
/// by recursion, and a stack ends.
const LONGEST_CHAIN: usize = 500;

/// Refuses a text that is too long to be a snippet.
pub(crate) fn check_length(file: &str, text: &str) -> Result<(), Diagnostic> {
    if text.len() <= LONGEST {
        return Ok(());
    }
    let (size, most) = (text.len() >> 10, LONGEST >> 10);
    let (line, column) = line_and_column(text, text.floor_char_boundary(LONGEST));
    Err(Diagnostic::new(file, line, column, format!("the text is {size} KiB long, but a snippet may have {most} KiB")))
}

/// Where a snippet reaches beyond its slot. `foreign` are names that belong to other snippets of the same shader.
pub(crate) fn breaches(file: &str, text: &str, foreign: &[String]) -> Vec<Diagnostic> {
    let list = tokens(text);
    let found = (0..list.len()).filter_map(|at| Some((list[at].start, breach(&list, at, foreign)?)));
    let found = found.chain(endless(&list));
    found
        .map(|(start, message)| {
            let (line, column) = line_and_column(text, start);
            Diagnostic::new(file, line, column, message).with_excerpt(text)
        })
        .collect()
}

fn breach(list: &[Token<'_>], at: usize, foreign: &[String]) -> Option<String> {
    let text = |index: usize| list.get(index).map_or("", |token| token.text);
    let word = list[at].text;
    if word == "@" && !ATTRIBUTES.contains(&text(at + 1)) {
        return Some(format!(
            "`@{}` is up to the skeleton: a snippet has no entry points and no bindings",
            text(at + 1)
        ));
    }
    if list[at].kind != TokenKind::Identifier || (at > 0 && matches!(text(at - 1), "." | "@")) {
        return None;
    }
    if MODULE_WORDS.contains(&word) {
        return Some(format!("`{word}` would change the whole shader, which is up to the skeleton"));
    }
    if SHARED.contains(&word) || word.starts_with("atomic") {
        return Some(format!(
            "`{word}` reaches what all snippets share; a snippet gives back its result and nothing else"
        ));
    }
    if word == "var" && text(at + 1) == "<" && !matches!(text(at + 2), "private" | "function") {
        return Some(format!("`var<{}>` is up to the skeleton; a snippet may have `var<private>`", text(at + 2)));
    }
    foreign.iter().any(|name| name == word).then(|| format!("`{word}` belongs to another snippet of this shader"))
}

/// Where a chain of operators, members or `else` becomes longer than anybody writes.
fn endless(list: &[Token<'_>]) -> Option<(usize, String)> {
    let (mut operators, mut branches) = (0, 0);
    for token in list {
        match token.text {
            "," | ";" => (operators, branches) = (0, 0),
            "{" | "}" => operators = 0,
            "else" => branches += 1,
            _ => operators += usize::from(token.kind == TokenKind::Punctuation),
        }
        if operators.max(branches) > LONGEST_CHAIN {
            return Some((
                token.start,
                format!(
                    "more than {LONGEST_CHAIN} operators, members or branches follow on one another; split them up"
                ),
            ));
        }
    }
    None
}
