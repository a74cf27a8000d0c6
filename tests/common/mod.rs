//! The built command, its scenes, and what it left behind.

use assert_cmd::Command;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The command, ready for arguments, in the folder of the scenes.
pub fn seam() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_seam"));
    command.current_dir(scenes());
    command
}

/// What one call gave.
pub struct Outcome {
    /// Exit code; `None` if a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// Calls the command with words, the last of them often a folder.
pub fn call(words: &[&str], folder: &Path) -> Outcome {
    let output = seam().args(words).arg(folder).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Calls the command and expects success.
#[allow(dead_code, reason = "each test binary compiles this module for itself")]
pub fn pass(words: &[&str], folder: &Path) -> Outcome {
    let outcome = call(words, folder);
    assert_eq!(outcome.code, Some(0), "seam {words:?}\n{}{}", outcome.stdout, outcome.stderr);
    outcome
}

/// `tests/scenes`
pub fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenes")
}

/// All files below a folder with their bytes.
#[allow(dead_code, reason = "each test binary compiles this module for itself")]
pub fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.insert(path.clone(), std::fs::read(&path).unwrap());
        }
    }
    found
}
