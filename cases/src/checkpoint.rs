//! Checkpoints of a scene's own run in time: what the run and its probes need to go on later, in one file.
//!
//! Families, budgets and the like start from the beginning in any case: they are many short runs.

use crate::error::{Error, Result};
use crate::file::SceneFile;
use crate::observe::guard::{Guard, Seen};
use crate::observe::history::Histories;
use seam_solver::checkpoint::{open, seal};
use seam_solver::files::write_atomically;
use seam_solver::simulation::Snapshot;
use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// Where a run is kept, and what it goes on from.
#[derive(Debug, Clone, Default)]
pub struct Checkpoints {
    /// After every so many outputs, into this file.
    pub keep: Option<(NonZeroUsize, PathBuf)>,
    /// From this file.
    pub from: Option<PathBuf>,
}

/// What is in a file.
#[derive(Serialize, Deserialize)]
pub(crate) struct Kept {
    case: String,
    /// Hash of the scene, overrides included.
    scene: String,
    pub histories: Histories,
    /// What was watched for effects that were left out.
    pub seen: Seen,
    /// The solver's own checkpoint.
    pub run: Vec<u8>,
}

impl Checkpoints {
    /// Whether there is nothing to do.
    pub fn is_off(&self) -> bool {
        self.keep.is_none() && self.from.is_none()
    }

    /// What the run goes on from; `None` to start at the beginning.
    ///
    /// # Errors
    /// A file that cannot be read, is damaged, or is of another scene.
    pub(crate) fn kept(&self, file: &SceneFile) -> Result<Option<Kept>> {
        let Some(path) = &self.from else { return Ok(None) };
        let refuse = |message: String| refusal(path, &message);
        let bytes = std::fs::read(path).map_err(|e| refuse(format!("{e}; check the path")))?;
        let kept: Kept = open(&bytes).map_err(|e| refuse(e.to_string()))?;
        let id = &file.scene.id;
        if kept.case != *id {
            let other = &kept.case;
            return Err(refuse(format!(
                "it is a checkpoint of case '{other}', not of '{id}'; restart '{other}' from it, or start '{id}' again"
            )));
        }
        if kept.scene != file.hash() {
            return Err(refuse(format!(
                "the scene '{id}' has changed since; take the scene and the --set of that run, or start again"
            )));
        }
        Ok(Some(kept))
    }

    /// Keeps a run at an output, where it is due.
    ///
    /// # Errors
    /// A file that cannot be written; an earlier one is then as before.
    pub(crate) fn keep(
        &self,
        file: &SceneFile,
        (histories, guard): (&Histories, &Guard),
        snapshot: &Snapshot,
    ) -> Result<()> {
        let Some((every, path)) = &self.keep else { return Ok(()) };
        // The first output is the start.
        let outputs = histories.energies.len() - 1;
        if outputs == 0 || !outputs.is_multiple_of(every.get()) {
            return Ok(());
        }
        let kept = Kept {
            case: file.scene.id.clone(),
            scene: file.hash(),
            histories: histories.clone(),
            seen: guard.seen,
            run: snapshot.checkpoint(),
        };
        write_atomically(path, &seal(&kept)).map_err(|e| file.solver(e))
    }
}

/// The refusal of a file.
pub(crate) fn refusal(path: &Path, message: &str) -> Error {
    Error::Checkpoint { path: path.display().to_string(), message: message.to_owned() }
}
