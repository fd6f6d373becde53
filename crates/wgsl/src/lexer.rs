//! A WGSL tokenizer that knows just enough to find identifiers outside comments.

/// What a token is. Numbers and punctuation matter only as "not an identifier".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TokenKind {
    Identifier,
    Number,
    Punctuation,
}

/// A token with its byte range in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token<'a> {
    pub kind: TokenKind,
    pub text: &'a str,
    pub start: usize,
}

/// Splits `text` into tokens; white space and comments (line, and nested block comments) are dropped.
/// Never fails: whatever is not WGSL becomes punctuation and is left to the WGSL parser to refuse.
pub(crate) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let length = if c.is_whitespace() {
            c.len_utf8()
        } else if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else {
            let (kind, length) = token(rest, c);
            found.push(Token { kind, text: &rest[..length], start: at });
            length
        };
        at += length;
    }
    found
}

fn token(rest: &str, first: char) -> (TokenKind, usize) {
    let run = |keep: fn(char) -> bool| rest.find(|c| !keep(c)).unwrap_or(rest.len());
    if first.is_alphabetic() || first == '_' {
        (TokenKind::Identifier, run(|c| c.is_alphanumeric() || c == '_'))
    } else if first.is_ascii_digit() {
        // `1.5e-3`: the sign of an exponent may split the number; harmless, no identifier comes out of it.
        (TokenKind::Number, run(|c| c.is_alphanumeric() || c == '.'))
    } else {
        (TokenKind::Punctuation, first.len_utf8())
    }
}

fn block_comment(rest: &str) -> usize {
    let (mut depth, mut at) = (0usize, 0);
    while at < rest.len() {
        if rest[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest[at..].starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    rest.len()
}

/// Names declared at module scope (functions, structs, constants, aliases, variables), with their byte offset.
pub(crate) fn module_scope_names(text: &str) -> Vec<(&str, usize)> {
    let mut names = Vec::new();
    let mut depth = 0i32;
    let list = tokens(text);
    for (index, token) in list.iter().enumerate() {
        match token.text {
            "{" | "(" => depth += 1,
            "}" | ")" => depth -= 1,
            "fn" | "struct" | "const" | "alias" | "override" | "var" if depth == 0 => {
                let mut next = index + 1;
                if list.get(next).is_some_and(|t| t.text == "<") {
                    next += list[next..].iter().position(|t| t.text == ">").map_or(0, |skip| skip + 1);
                }
                if let Some(name) = list.get(next).filter(|t| t.kind == TokenKind::Identifier) {
                    names.push((name.text, name.start));
                }
            }
            _ => {}
        }
    }
    names
}

/// 1-based line and column (in characters) of a byte offset.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (u32, u32) {
    let before = &text[..offset.min(text.len())];
    let line = before.matches('\n').count() as u32 + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() as u32 + 1;
    (line, column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_module_scope_names_only() {
        let text = "// fn no()\nstruct State { fn_like: f32 }\nvar<private> cache: f32;\nconst N = 3u; /* struct X /* nested */ */\nfn add(s: f32) { var local = 1.5e-3; const inner = 2; }";
        let names: Vec<_> = module_scope_names(text).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["State", "cache", "N", "add"]);
    }

    #[test]
    fn survives_anything() {
        for text in ["/*", "/* /* */", "1e", "é→x", "\"", "fn", "var<", "fn (", "}}}}", "//"] {
            tokens(text);
            module_scope_names(text);
        }
    }
}
