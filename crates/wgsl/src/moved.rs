//! Words of earlier contracts: a snippet that was written for them is told what to change.

use crate::diagnostic::Diagnostic;
use crate::lexer::{line_and_column, tokens};

/// What a member was called, of what (anything, where that is empty), and what to write now.
const MOVED: [(&str, &str, &str); 12] = [
    ("frame", "dims", "write `source.dims`: a volume's data are reached through its source"),
    ("frame", "gradient_scale", "write `source.gradient_scale`"),
    ("frame", "brick_scale", "write `source.brick_scale`"),
    ("frame", "texel_scale", "call `voxel_at` or `value_at`, which give normalised values"),
    ("frame", "label_minimum", "write `source.label_minimum`"),
    ("ray", "entry", "write `ray.origin`, the volume coordinates at distance 0, or `position_along(ray, ray.begin)`"),
    ("ray", "steps", "write `ray.end`: places on a ray are distances in reference lengths"),
    ("ray", "step", "write `direction_of_ray(ray) * frame.step`: places on a ray are distances in reference lengths"),
    ("ray", "step_length", "leave it out: distances are in reference lengths already"),
    ("ray", "count", "write `ray.last`, the number of the sample after the last"),
    ("", "along", "write `distance`: places on a ray are distances in reference lengths"),
    ("", "previous_along", "write `previous_distance`: places on a ray are distances in reference lengths"),
];

/// Where a text uses what is called otherwise now.
pub(crate) fn moved(file: &str, text: &str) -> Vec<Diagnostic> {
    let list = tokens(text);
    let is_declared = |name: &str| list.windows(2).any(|pair| pair[0].text == name && pair[1].text == ":");
    let members = list.windows(3).filter(|three| three[1].text == ".");
    let found = members.filter_map(|three| {
        let (owner, member) = (three[0].text, three[2].text);
        let is_it = |known: &&(&str, &str, &str)| known.1 == member && (known.0 == owner || known.0.is_empty());
        let (.., advice) = MOVED.iter().find(is_it).filter(|(of, name, _)| !of.is_empty() || !is_declared(name))?;
        let (line, column) = line_and_column(text, three[2].start);
        let message = format!("`{owner}.{member}` is of an earlier contract; {advice}");
        Some(Diagnostic::new(file, line, column, message).with_excerpt(text))
    });
    found.collect()
}
