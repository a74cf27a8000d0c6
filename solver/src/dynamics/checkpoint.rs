//! What explicit steps carry from one to the next, to go on later bit by bit.

use super::explicit::Explicit;
use crate::checkpoint::{from_bytes, to_bytes};
use crate::error::Result;
use nalgebra::{Quaternion, UnitQuaternion};

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
