//! `rayloom verify`: the orders of convergence on the reader's own device.

use rayloom_gpu::{Gpu, GpuOptions};
use rayloom_measure::verify::{Axis, Case, Extent, Study, study};

use crate::args::VerifyArgs;
use crate::failure::Failure;
use crate::print;
use crate::progress::Line;

/// Refines steps, voxels and pixels and returns a table of the orders that were observed, and where the files are.
///
/// # Errors
/// The device fails, a file cannot be written, or a method has not the order that it should have.
pub fn run(args: &VerifyArgs) -> Result<String, Failure> {
    let extent = if args.quick { Extent::Quick } else { Extent::Full };
    let gpu = Gpu::new(&GpuOptions::default())?;
    let line = Line::new("verifying");
    let found = study(&gpu, extent, &|what, share| line.share(what, share))?;
    drop(line);
    let mut text = table(&found);
    if let Some(folder) = &args.report {
        text += &found.write(folder)?.iter().map(|file| format!("{}\n", file.display())).collect::<String>();
    }
    let failed = found.cases.iter().filter(|case| !case.passed()).count();
    if failed == 0 {
        return Ok(text);
    }
    print(&text)?;
    Err(Failure::new(format!(
        "{failed} of {} methods have another order on this device than they should; the errors with --report FOLDER say from \
         where on",
        found.cases.len()
    )))
}

/// A line a case.
fn table(study: &Study) -> String {
    let mut text = format!("{}\n{:<12}{:<38}{:>9}{:>10}\n", study.adapter, "refined", "method", "expected", "observed");
    for axis in Axis::ALL {
        for case in study.cases.iter().filter(|case| case.axis == axis) {
            let Case { name, expected, order, .. } = case;
            let verdict = if case.passed() { "passed" } else { "FAILED" };
            text += &format!("{:<12}{name:<38}{expected:>9}{order:>10.2}  {verdict}\n", axis.id());
        }
    }
    text
}
