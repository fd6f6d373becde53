//! The command line of Rayloom: renders saved networks, checks them, and says what they can be made of.

mod adapter;
mod args;
mod check;
mod environment;
mod failure;
mod info;
mod list;
mod network_file;
mod problems;
mod progress;
mod render;
mod shader;
mod stats;
mod target;

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use failure::Failure;

fn main() -> ExitCode {
    environment::quieten_drivers();
    // Does not return where the command line cannot be understood: exit code 2.
    let command = Cli::parse().command;
    match run(&command).and_then(|text| print(&text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure(message)) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Does what is asked and returns what belongs on the standard output.
fn run(command: &Command) -> Result<String, Failure> {
    match command {
        Command::Render(args) => render::run(args),
        Command::Check { network } => check::run(network),
        Command::List(args) => list::run(args),
        Command::Shader { network, processor, set } => shader::run(network, processor, set),
        Command::Info { volume } => info::run(volume),
        Command::Adapter => adapter::run(),
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
