//! What two rates carry from one coarse step to the next, to go on later bit by bit.

use super::Multirate;
use crate::checkpoint::{from_bytes, to_bytes};
use crate::error::Result;

impl Multirate<'_> {
    /// All that changes from step to step.
    pub(crate) fn freeze(&self) -> Vec<u8> {
        to_bytes(&(&self.coarse_motion, &self.fine_motion, &self.lambda, self.time, self.ledger))
    }

    /// Puts back what [`Multirate::freeze`] gave for the same model and rates.
    ///
    /// # Errors
    /// Bytes of something else.
    pub(crate) fn thaw(&mut self, bytes: &[u8]) -> Result<()> {
        (self.coarse_motion, self.fine_motion, self.lambda, self.time, self.ledger) = from_bytes(bytes)?;
        Ok(())
    }
}
