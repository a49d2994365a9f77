//! Running the real program in a folder of its own.

#![allow(dead_code, reason = "each test program uses its own part")]

use std::ffi::OsStr;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// A scene with one body and one light.
pub(crate) const ONE_BODY: &str =
    "format = \"catoptric/1\"\n[[bodies]]\nshape = \"sphere\"\n[[lights]]\nposition = [0, 5, 5]\n";
/// A scene with nothing in it.
pub(crate) const NOTHING: &str = "format = \"catoptric/1\"\n";
/// A scene with five errors.
pub(crate) const FIVE_ERRORS: &str = "\
format = \"catoptric/1\"
[camera]
fov = 300
[[bodies]]
shape = \"sphre\"
[[bodies]]
shape = \"sphere\"
radius = -1
color = 3
material = \"gold\"
";
/// Where they are.
pub(crate) const FIVE_PLACES: [&str; 5] = ["3:7", "5:9", "8:10", "9:1", "10:12"];

/// A folder to run the program in.
pub(crate) struct Folder {
    folder: TempDir,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: impl AsRef<Path>, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub(crate) fn read(&self, name: impl AsRef<Path>) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    /// The names of all files, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The program, to be run in this folder with these arguments, its streams piped.
    pub(crate) fn command<A: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = A>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_catoptric"));
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).env_remove("NO_COLOR");
        command
    }

    /// Runs the program with the words of `line`.
    pub(crate) fn run(&self, line: &str) -> Ran {
        self.run_with(line.split_whitespace())
    }

    pub(crate) fn run_with<A: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = A>) -> Ran {
        Ran::of(self.command(arguments).output().unwrap())
    }

    /// Runs the program, which must end well and have nothing to say on standard error.
    pub(crate) fn good(&self, line: &str) -> String {
        let ran = self.run(line);
        assert_eq!((ran.status, ran.errors.as_str()), (Some(0), ""), "{line}: {ran:?}");
        ran.output
    }

    /// Runs the program, which must refuse its input on standard error, and returns what it says.
    pub(crate) fn refused(&self, line: &str) -> String {
        let before = self.names();
        let ran = self.run(line);
        assert_eq!((ran.status, ran.output.as_str()), (Some(2), ""), "{line}: {ran:?}");
        assert!(ran.errors.starts_with("error: "), "{line}: {ran:?}");
        assert!(!ran.errors.contains("panicked"), "{line}: {ran:?}");
        assert_eq!(self.names(), before, "{line} left files");
        ran.errors
    }
}

/// How a run ended and what it said.
#[derive(Debug)]
pub(crate) struct Ran {
    pub status: Option<i32>,
    pub output: String,
    pub errors: String,
}

impl Ran {
    pub(crate) fn of(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        Self { status: output.status.code(), output: text(output.stdout), errors: text(output.stderr) }
    }
}

/// Says that a test was not made on this machine, and why.
pub(crate) fn skip(reason: &str) {
    // Unlike what is printed, this is also seen of a test that passes.
    let _ = writeln!(std::io::stderr().lock(), "SKIPPED: {reason}");
}

/// Whether signals can be sent, and this process has not been told to ignore Ctrl-C, which children inherit.
#[cfg(unix)]
pub(crate) fn signals_work() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    if ignored & 0b100_0000_0000_0011 != 0 {
        skip("signals are ignored here, as in a background job");
        return false;
    }
    if Command::new("kill").arg("-l").output().is_err() {
        skip("there is no command `kill`");
        return false;
    }
    true
}

#[cfg(unix)]
pub(crate) fn signal(child: &std::process::Child, name: &str) {
    let sent = Command::new("kill").args([format!("-{name}"), child.id().to_string()]).status();
    assert!(sent.unwrap().success());
}
