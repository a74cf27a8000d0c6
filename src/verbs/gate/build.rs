//! The other program: one that is there, or a commit built in a folder of its own.

use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// Another `seam`, and the folder that it was built in.
pub struct Other {
    name: String,
    program: PathBuf,
    /// Goes with it.
    worktree: Option<Worktree>,
}

impl Other {
    /// One that is there.
    ///
    /// # Errors
    /// There is no such file.
    pub fn at(program: &Path) -> Result<Self> {
        let name = program.display().to_string();
        let program = program.canonicalize().with_context(|| format!("--binary {name}"))?;
        Ok(Other { name, program, worktree: None })
    }

    /// Builds a commit of the repository of the present folder, optimised, beside it and without touching it.
    ///
    /// # Errors
    /// No repository, no such commit, or one that does not build.
    pub fn build(commit: &str) -> Result<Self> {
        let worktree = Worktree::of(commit)?;
        eprintln!("building {commit} in {}", worktree.path().display());
        let mut cargo = Command::new("cargo");
        cargo.args(["build", "--release", "--locked", "--bin", "seam"]).current_dir(worktree.path());
        // A target folder of its own: the present one holds what is being compared.
        cargo.env("CARGO_TARGET_DIR", worktree.path().join("target"));
        run(&mut cargo, "cargo build")?;
        let program = worktree.path().join("target/release/seam");
        Ok(Other { name: commit.to_owned(), program, worktree: Some(worktree) })
    }

    /// How the user named it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The file to run.
    pub fn program(&self) -> &Path {
        &self.program
    }
}

impl Drop for Other {
    fn drop(&mut self) {
        if let Some(worktree) = &self.worktree {
            // Best effort: git forgets a worktree that is gone by itself, at its next pruning.
            let _ = git(&["worktree", "remove", "--force"]).arg(worktree.path()).output();
        }
    }
}

/// A detached checkout in a temporary folder.
struct Worktree(TempDir);

impl Worktree {
    fn of(commit: &str) -> Result<Self> {
        let named = format!("{commit}^{{commit}}");
        run(&mut git(&["rev-parse", "--quiet", "--verify", "--end-of-options", &named]), "git rev-parse")
            .with_context(|| {
                format!("--against {commit}: no such commit in the repository of this folder")
            })?;
        let folder = tempfile::tempdir()?;
        let place = folder.path().join("seam");
        run(git(&["worktree", "add", "--detach", "--quiet"]).arg(&place).arg(commit), "git worktree add")?;
        Ok(Worktree(folder))
    }

    fn path(&self) -> PathBuf {
        self.0.path().join("seam")
    }
}

fn git(words: &[&str]) -> Command {
    let mut git = Command::new("git");
    git.args(words);
    git
}

/// Runs a tool; what it says is shown only if it fails.
fn run(command: &mut Command, what: &str) -> Result<()> {
    let output = command.output().with_context(|| format!("{what} cannot be started"))?;
    if !output.status.success() {
        bail!("{what} failed: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(())
}
