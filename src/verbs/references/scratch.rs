//! A folder for what need not stay.

use anyhow::{Context, Result};
use std::path::PathBuf;

/// A folder that goes when it is no longer needed.
pub struct Scratch(pub PathBuf);

impl Scratch {
    /// A folder of this process's own.
    pub fn new() -> Result<Self> {
        let folder = std::env::temp_dir().join(format!("seam-references-{}", std::process::id()));
        std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        Ok(Self(folder))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
