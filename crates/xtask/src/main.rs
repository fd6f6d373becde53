//! The chores of the project; the standard library is all they need, so that they build in a moment.

mod adapter;
mod chores;
mod command;
mod licences;
mod packages;
mod unused;
mod window;

use std::process::ExitCode;

const HELP: &str = "\
Chores of the project: cargo xtask CHORE

  start     build, render the flagship network to out/brain.png and say where it is; open it where there is a display
  test      check formatting, lint, check dependencies, run all tests, build the documentation, open a window
  deps      check the licences of dependencies, advisories, and that all are used (part of test)
  fuzz      try damaged files of every kind, 10 minutes a kind; --minutes N for another time
  golden    render the golden images anew (look at the difference before you commit it)
  docs      write docs/processors and docs/snippets anew from the declarations
  tutorial  go through docs/TUTORIAL.md in a window without a screen and renew its pictures
  window    open the flagship network in a window on an X server without a monitor, turn it, close it (part of test)
  bench     run the benches

`start` and `test` need a Vulkan adapter. Where there is none they install Mesa's software driver on Debian and
Ubuntu (saying so first) and print what to install elsewhere. `window` does the same with Xvfb and xdotool.
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["start"] => chores::start(),
        ["test"] => chores::test(),
        ["deps"] => chores::dependencies(),
        ["fuzz"] => chores::fuzz("10"),
        ["fuzz", "--minutes", minutes] => chores::fuzz(minutes),
        ["golden"] => chores::golden(),
        ["docs"] => chores::docs(),
        ["tutorial"] => chores::tutorial(),
        ["window"] => chores::window(),
        ["bench"] => chores::bench(),
        ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprint!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
