//! Stopping explicit steps and going on later, bit by bit: what they carry from one to the next, also through a file.

use super::State;
use super::explicit::{Explicit, Options};
use crate::checkpoint::{Fingerprint, from_bytes, open, seal, to_bytes};
use crate::error::{Error, Result};
use crate::files::write_atomically;
use crate::model::{Model, Numbering};
use nalgebra::{Quaternion, UnitQuaternion};
use std::path::Path;

/// Writes the state of a run of `model`.
///
/// # Errors
/// A file that cannot be written; a run that breaks bonds, whose laws are not kept in it.
pub fn write(path: &Path, model: &Model, run: &Explicit) -> Result<()> {
    if run.breaking().is_some() {
        let message = "a run that breaks bonds has no checkpoints; run it through".to_owned();
        return Err(Error::File { file: path.display().to_string(), line: None, message });
    }
    write_atomically(path, &seal(&(Fingerprint::of(&(model, run.options())), run.freeze())))
}

/// Reads a state and goes on from it.
///
/// # Errors
/// A file that cannot be read, is damaged, or belongs to another model or other options; whatever
/// [`Explicit::new`] refuses.
pub fn resume(path: &Path, model: &Model, options: Options) -> Result<Explicit> {
    let refuse = |message: String| Error::File { file: path.display().to_string(), line: None, message };
    let bytes = std::fs::read(path).map_err(|e| refuse(format!("{e}; check the path")))?;
    let (belongs_to, state): (Fingerprint, Vec<u8>) = open(&bytes).map_err(|e| refuse(e.to_string()))?;
    if belongs_to != Fingerprint::of(&(model, &options)) {
        let message =
            "it was written for another model or with other options; resume with those, or start again";
        return Err(refuse(message.to_owned()));
    }
    let mut run = Explicit::new(model, options, &State::at_rest(Numbering::new(model).len()))?;
    run.thaw(&state)?;
    Ok(run)
}

impl Explicit {
    /// All that changes from step to step, counted work included.
    pub(crate) fn freeze(&self) -> Vec<u8> {
        let orientations: Vec<[f64; 4]> = self.forces.orientations().map(|q| q.coords.into()).collect();
        to_bytes(&(&self.motion, self.work, orientations))
    }

    /// Puts back what [`Explicit::freeze`] gave for the same model and options.
    ///
    /// # Errors
    /// Bytes of something else.
    pub(crate) fn thaw(&mut self, bytes: &[u8]) -> Result<()> {
        let orientations: Vec<[f64; 4]>;
        (self.motion, self.work, orientations) = from_bytes(bytes)?;
        let turned = |q: [f64; 4]| UnitQuaternion::new_unchecked(Quaternion::from(q));
        self.forces.set_orientations(orientations.into_iter().map(turned).collect());
        Ok(())
    }
}
