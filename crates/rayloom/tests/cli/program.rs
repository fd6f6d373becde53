//! Running the program.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// What a run of the program gave.
pub struct Ran {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

/// Root folder of the project.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs the program in the root folder, without a user's own snippets.
pub fn rayloom<'a>(arguments: impl IntoIterator<Item = &'a str>) -> Ran {
    // Right in this folder there are no snippets, only in those below.
    rayloom_with_snippets(Path::new("shaders"), arguments)
}

/// The same with the user's own snippets in a folder.
pub fn rayloom_with_snippets<'a>(folder: &Path, arguments: impl IntoIterator<Item = &'a str>) -> Ran {
    run(Command::new(env!("CARGO_BIN_EXE_rayloom")).args(arguments).env("RAYLOOM_SNIPPETS", folder))
}

/// The same where no driver can be found.
pub fn rayloom_without_adapter<'a>(arguments: impl IntoIterator<Item = &'a str>) -> Ran {
    let nowhere = "/no/such/driver.json";
    let mut program = Command::new(env!("CARGO_BIN_EXE_rayloom"));
    run(program
        .args(arguments)
        .env("VK_DRIVER_FILES", nowhere)
        .env("VK_ICD_FILENAMES", nowhere)
        .env("WGPU_BACKEND", "vulkan"))
}

/// The same where there is no display.
pub fn rayloom_without_display<'a>(arguments: impl IntoIterator<Item = &'a str>) -> Ran {
    let mut program = Command::new(env!("CARGO_BIN_EXE_rayloom"));
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        program.env_remove(variable);
    }
    run(program.args(arguments))
}

fn run(program: &mut Command) -> Ran {
    let Output { status, stdout, stderr } = program.current_dir(root()).output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("the program writes text");
    Ran { code: status.code().expect("the program ends by itself"), stdout: text(stdout), stderr: text(stderr) }
}

impl Ran {
    /// The standard output of a run that must succeed.
    pub fn output(self) -> String {
        assert_eq!(self.code, 0, "{}", self.stderr);
        self.stdout
    }

    /// The message of a run that must fail: one, on the standard error, and no word of a panic.
    pub fn error(self) -> String {
        assert_eq!(self.code, 1, "{}\n{}", self.stdout, self.stderr);
        let message = self.stderr.strip_prefix("error: ").unwrap_or_else(|| panic!("no message: {}", self.stderr));
        assert!(!message.contains("panicked") && !message.contains("error: "), "{message}");
        message.to_owned()
    }
}
