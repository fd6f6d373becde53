//! The study as a page that needs nothing else.

use super::{Axis, Case, Study, plot};
use crate::report::style::STYLE;
use crate::text::{escaped, number};

/// The whole page.
pub(super) fn page(study: &Study) -> String {
    let passed = study.cases.iter().filter(|case| case.passed()).count();
    let sections: String = Axis::ALL.iter().map(|axis| section(study, *axis)).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" \
         content=\"width=device-width\"><title>Convergence</title><style>{STYLE}</style></head><body><main><p \
         class=\"over\">Rayloom {}</p><h1>Convergence</h1><p class=\"advice\">{passed} of {} methods have the order that theory \
         gives them.</p><p class=\"quiet\">{}</p>{sections}</main></body></html>\n",
        study.rayloom,
        study.cases.len(),
        escaped(&study.adapter)
    )
}

fn section(study: &Study, axis: Axis) -> String {
    let (title, text) = match axis {
        Axis::Quadrature => (
            "Steps along the ray",
            "Against the same scene without samples, in float64. Trilinear values of a Gaussian blob on 20 voxels a side.",
        ),
        Axis::Grid => (
            "Voxels: values and pictures",
            "Against the Gaussian blob itself: values in the middles of rays, and a picture whose extinction and colour are the \
             value, at one sample a voxel.",
        ),
        Axis::Gradients => ("Voxels: gradients", "Against the gradient of the Gaussian blob, in the middles of rays."),
        Axis::Pixels => (
            "Pixels",
            "A homogeneous box: opacity interpolated between pixels against its formula, and the share of the picture that the \
             nearest pixel takes for the wrong side of the outline.",
        ),
    };
    let rows: String = study.cases.iter().filter(|case| case.axis == axis).map(row).collect();
    format!(
        "<section class=\"study\"><h2>{title}</h2><p class=\"quiet\">{text} Hollow: what arithmetic leaves, not judged.</p>{}<div \
         class=\"scroll\"><table><thead><tr><th>Method</th><th>Expected</th><th>Passes</th><th>Observed</th><th \
         class=\"text\"></th></tr></thead><tbody>{rows}</tbody></table></div></section>",
        plot::svg(study, axis)
    )
}

fn row(case: &Case) -> String {
    let [low, high] = case.allowed;
    let verdict = if case.passed() { "passed" } else { "FAILED" };
    format!(
        "<tr><td>{}</td><td>{}</td><td><small>{low:.1} \u{2013} {high:.1}</small></td><td>{:.2}</td><td \
         class=\"text\">{verdict}</td></tr>",
        escaped(&case.name),
        number(case.expected),
        case.order
    )
}
