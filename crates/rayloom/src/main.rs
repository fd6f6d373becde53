//! The command line of Rayloom: renders saved networks, checks them, says what they can be made of, opens the studio.

mod adapter;
mod args;
mod check;
mod environment;
mod explain;
mod explain_settings;
mod failure;
mod info;
mod list;
mod measure;
mod network_file;
mod open;
mod probe;
mod problems;
mod progress;
mod reference;
mod render;
mod shader;
mod stats;
mod target;
mod tune;
mod verify;

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use failure::Failure;

fn main() -> ExitCode {
    environment::quieten_drivers();
    // Does not return where the command line cannot be understood: exit code 2.
    let command = Cli::parse().command;
    match run(command.as_ref()).and_then(|text| print(&text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure(message)) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Does what is asked and returns what belongs on the standard output.
fn run(command: Option<&Command>) -> Result<String, Failure> {
    let Some(command) = command else { return open::run(None, None) };
    match command {
        Command::Render(args) => render::run(args),
        Command::Measure(args) => measure::run(args),
        Command::Explain(args) => explain::run(args),
        Command::Verify(args) => verify::run(args),
        Command::Tune(args) => tune::run(args),
        Command::Check { network } => check::run(network),
        Command::List(args) => list::run(args),
        Command::Shader { network, processor, set } => shader::run(network, processor, set),
        Command::Probe(args) => probe::run(args),
        Command::Info { volume } => info::run(volume),
        Command::Adapter => adapter::run(),
        Command::Open { network, mode } => open::run(Some(network), *mode),
    }
}

/// Writes to the standard output. A reader that has seen enough, such as `head`, is no failure.
fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("the standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}
