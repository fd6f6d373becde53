//! Where an assembled line came from, and messages that name that place.

use std::fmt;
use std::sync::Arc;

/// The place of one line of assembled text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Library path of the file, such as `gradient/central.wgsl`, or `<generated: ...>` for lines that the assembler wrote.
    pub file: Arc<str>,
    /// 1-based line in that file.
    pub line: u32,
    /// Renamed identifiers: (column where the new name starts, length of the new name, length of the old name), in characters, left to right.
    pub(crate) renames: Vec<(u32, u32, u32)>,
}

impl Origin {
    /// Maps a 1-based column of the assembled line to the column of the file it came from.
    pub fn column(&self, assembled: u32) -> u32 {
        let mut shift = 0i64;
        for &(start, new, old) in &self.renames {
            if assembled < start {
                break;
            }
            if assembled < start + new {
                return (i64::from(start) + shift).max(1) as u32;
            }
            shift += i64::from(old) - i64::from(new);
        }
        (i64::from(assembled) + shift).max(1) as u32
    }
}

impl Origin {
    /// Notes that the line was renamed once more.
    pub(crate) fn shift(&mut self, later: &[(u32, u32, u32)]) {
        let grown = |column: u32| {
            let before = later.iter().filter(|(start, new, _)| i64::from(*start) < i64::from(column) + i64::from(*new));
            before.map(|(_, new, old)| i64::from(*new) - i64::from(*old)).sum::<i64>()
        };
        for (start, ..) in &mut self.renames {
            *start = (i64::from(*start) + grown(*start)).max(1) as u32;
        }
        self.renames.extend(later);
        self.renames.sort_by_key(|(start, ..)| *start);
    }
}

/// One [`Origin`] for every line of an assembled shader.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceMap {
    pub(crate) lines: Vec<Origin>,
}

impl SourceMap {
    /// Origin of a 1-based line of the assembled text.
    pub fn origin(&self, line: u32) -> Option<&Origin> {
        self.lines.get((line as usize).checked_sub(1)?)
    }

    /// Origins in the order of the assembled lines.
    pub fn lines(&self) -> &[Origin] {
        &self.lines
    }
}

/// A message about shader text for the person who wrote it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Diagnostic {
    /// Library path of the file, or `<generated: ...>`.
    pub file: String,
    /// 1-based line, 0 when the message is about the whole file.
    pub line: u32,
    /// 1-based column in characters, 0 when unknown.
    pub column: u32,
    /// What is wrong and, where it is known, what to do.
    pub message: String,
    /// The line of text that the message is about, empty when unknown.
    pub excerpt: String,
}

impl Diagnostic {
    pub(crate) fn new(file: &str, line: u32, column: u32, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), line, column, message: message.into(), excerpt: String::new() }
    }

    pub(crate) fn with_excerpt(mut self, text: &str) -> Self {
        let line = (self.line as usize).checked_sub(1).and_then(|line| text.lines().nth(line));
        self.excerpt = line.unwrap_or_default().to_owned();
        self
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => write!(f, "{}: {}", self.file, self.message)?,
            (line, 0) => write!(f, "{}:{line}: {}", self.file, self.message)?,
            (line, column) => write!(f, "{}:{line}:{column}: {}", self.file, self.message)?,
        }
        if self.excerpt.trim().is_empty() {
            return Ok(());
        }
        let number = self.line.to_string();
        write!(f, "\n  {number} | {}", self.excerpt)?;
        if self.column > 0 {
            let pad = " ".repeat(number.len());
            write!(f, "\n  {pad} | {}^", " ".repeat(self.column as usize - 1))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_map_back_through_renames() {
        // file:      `return soft(x) + soft(y);`
        // assembled: `return shading_soft(x) + shading_soft(y);`
        let origin = Origin { file: "a".into(), line: 1, renames: vec![(8, 12, 4), (26, 12, 4)] };
        assert_eq!(origin.column(1), 1);
        assert_eq!(origin.column(8), 8);
        assert_eq!(origin.column(15), 8);
        assert_eq!(origin.column(20), 12);
        assert_eq!(origin.column(26), 18);
        assert_eq!(origin.column(38), 22);
    }
}
