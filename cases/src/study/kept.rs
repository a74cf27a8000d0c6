//! Finished parts of a study on disk, so that a study that was stopped goes on where it was.

use crate::error::Result;
use crate::write;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::PathBuf;

/// A folder of finished parts, by key; the key is a hash of all that the part depends on.
pub struct Kept {
    folder: PathBuf,
    /// Whether parts that are there are taken as they are.
    resume: bool,
}

impl Kept {
    /// Parts in a folder that need not be there yet.
    pub fn new(folder: PathBuf, resume: bool) -> Self {
        Self { folder, resume }
    }

    /// The part of this key, and whether it was kept; else it is made now and kept. What cannot be read is made again.
    ///
    /// # Errors
    /// A part that cannot be written.
    pub fn part<T: Serialize + DeserializeOwned>(
        &self,
        key: &str,
        make: impl FnOnce() -> T,
    ) -> Result<(T, bool)> {
        let path = self.folder.join(format!("{key}.json"));
        let text = if self.resume { std::fs::read_to_string(&path).ok() } else { None };
        if let Some(part) = text.and_then(|text| serde_json::from_str(&text).ok()) {
            return Ok((part, true));
        }
        let part = make();
        write::write_whole(&path, &part)?;
        Ok((part, false))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_made_once_and_damage_is_mended() {
        let home = tempfile::tempdir().unwrap();
        let kept = |resume| Kept::new(home.path().join("parts"), resume);
        assert_eq!(kept(true).part("a", || 1).unwrap(), (1, false));
        assert_eq!(kept(true).part("a", || 2).unwrap(), (1, true));
        assert_eq!(kept(true).part("b", || 3).unwrap(), (3, false), "another key is another part");
        assert_eq!(kept(false).part("a", || 4).unwrap(), (4, false), "without resume all is made again");
        std::fs::write(home.path().join("parts/a.json"), "half of it").unwrap();
        assert_eq!(kept(true).part("a", || 5).unwrap(), (5, false));
    }
}
