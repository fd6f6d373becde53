//! Parses and validates assembled text with naga and maps what it says back to the snippets.

use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::assemble::Assembled;
use crate::diagnostic::Diagnostic;
use crate::footprint;
use crate::interface::Interface;
use crate::library::Library;

/// A shader that naga accepts, ready for a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Validated {
    /// The assembled text and its origins.
    pub assembled: Assembled,
    /// Bindings and parameter layout.
    pub interface: Interface,
}

/// Validates an assembled shader.
///
/// # Errors
/// What the parser or validator refused, or what is too large for drivers, at file, line and column of the snippet it came
/// from.
pub fn validate(library: &Library, assembled: Assembled) -> Result<Validated, Box<Diagnostic>> {
    let module = naga::front::wgsl::parse_str(&assembled.text).map_err(|error| {
        let mut message = error.message().to_owned();
        let adds = |note: &str| !note.is_empty() && !error.message().contains(note);
        let notes: Vec<_> = error.labels().map(|(_, note)| note).filter(|note| adds(note)).collect();
        if !notes.is_empty() {
            message += &format!(" ({})", notes.join("; "));
        }
        let location = error
            .labels()
            .next()
            .map(|(span, _)| span.location(&assembled.text))
            .or_else(|| error.location(&assembled.text));
        Box::new(locate(library, &assembled, location, message))
    })?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::default()).validate(&module).map_err(|error| {
        // The last span is the offending expression; the first is the whole function.
        let location = error.spans().last().map(|(span, _)| span.location(&assembled.text));
        Box::new(locate(library, &assembled, location, causes(error.as_inner())))
    })?;
    if assembled.features.has("own")
        && let Some((span, message)) = footprint::excess(&module, &info, own_places(library, &assembled))
    {
        return Err(Box::new(locate(library, &assembled, Some(span.location(&assembled.text)), message)));
    }
    let interface = Interface::of(&module, &info);
    Ok(Validated { assembled, interface })
}

/// Tells which places of an assembled text come from a user's own snippets.
fn own_places<'a>(library: &'a Library, assembled: &'a Assembled) -> impl Fn(naga::Span) -> bool + 'a {
    let ends: Vec<usize> = assembled.text.match_indices('\n').map(|(at, _)| at).collect();
    move |span| {
        let Some(start) = span.to_range().map(|range| range.start) else { return false };
        let line = ends.partition_point(|end| *end < start);
        assembled.map.lines().get(line).is_some_and(|origin| assembled.is_own(library, &origin.file))
    }
}

fn causes(error: &dyn std::error::Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        message += &format!(": {inner}");
        cause = inner.source();
    }
    message
}

fn locate(
    library: &Library,
    assembled: &Assembled,
    location: Option<naga::SourceLocation>,
    message: String,
) -> Diagnostic {
    let origin = location.and_then(|location| Some((location, assembled.map.origin(location.line_number)?)));
    match origin {
        Some((location, origin)) => {
            // naga counts columns in bytes.
            let line = assembled.text.lines().nth(location.line_number as usize - 1).unwrap_or_default();
            let bytes = (location.line_position as usize).saturating_sub(1).min(line.len());
            let column = line.get(..bytes).map_or(location.line_position, |before| before.chars().count() as u32 + 1);
            let text = assembled.source(library, &origin.file);
            Diagnostic::new(&origin.file, origin.line, origin.column(column), message).with_excerpt(text)
        }
        None => Diagnostic::new("shader", 0, 0, message),
    }
}
