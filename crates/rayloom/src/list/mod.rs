//! `rayloom list`: what networks are made of, as text, as JSON or as Markdown pages.

mod formats;
mod processors;
mod property;
mod snippets;

use std::fs;
use std::path::Path;

use serde_json::Value as Json;

use crate::args::{ListArgs, Listed};
use crate::failure::Failure;

/// A Markdown page: its path below the folder of pages, and its text.
struct Page {
    path: String,
    text: String,
}

/// Lists what is asked for, or writes its pages and says where.
///
/// # Errors
/// The pages cannot be written.
pub fn run(args: &ListArgs) -> Result<String, Failure> {
    if let Some(folder) = &args.pages {
        let pages = match args.what {
            Listed::Processors => processors::pages(),
            Listed::Snippets => snippets::pages()?,
            Listed::Formats => return Err(Failure::new("--pages: formats have no pages; list them without it")),
        };
        return write_pages(folder, &pages);
    }
    let json = match (args.what, args.json) {
        (Listed::Processors, true) => processors::json(),
        (Listed::Snippets, true) => snippets::json(),
        (Listed::Formats, true) => formats::json(),
        (Listed::Processors, false) => return Ok(processors::text()),
        (Listed::Snippets, false) => return Ok(snippets::text()),
        (Listed::Formats, false) => return Ok(formats::text()),
    };
    Ok(serde_json::to_string_pretty(&Json::Array(json))? + "\n")
}

fn write_pages(folder: &Path, pages: &[Page]) -> Result<String, Failure> {
    for page in pages {
        let path = folder.join(&page.path);
        let written = path
            .parent()
            .map_or(Ok(()), fs::create_dir_all)
            .and_then(|()| rayloom_files::write(&path, page.text.as_bytes()));
        written.map_err(|error| Failure::new(format!("{}: cannot be written: {error}", path.display())))?;
    }
    Ok(format!("{}: {} pages\n", folder.display(), pages.len()))
}

/// Names and helps as two columns, the help beginning at its first sentence.
fn columns<'a>(rows: impl IntoIterator<Item = (&'a str, &'a str)>) -> String {
    let rows: Vec<_> = rows.into_iter().collect();
    let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0) + 2;
    rows.iter().map(|(name, help)| format!("  {name:width$}{}\n", first_sentence(help))).collect()
}

fn first_sentence(help: &str) -> &str {
    help.find(". ").map_or(help, |end| &help[..=end])
}

/// Text inside a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// An end of a range: short where it is large, with a sign for infinity.
fn number(value: f64) -> String {
    match value {
        f64::INFINITY => "∞".to_owned(),
        f64::NEG_INFINITY => "-∞".to_owned(),
        value if value.abs() >= 1e6 => format!("{value:e}"),
        value => value.to_string(),
    }
}
