//! The folder of a scene: files next to it can be read, everything else cannot.

use crate::error::{Error, Result};
use std::io;
use std::path::{Component, Path, PathBuf};

/// Where a scene's own files are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Folder {
    /// On disk.
    Disk(PathBuf),
    /// In the catalogue inside the binary; its cases bring no further files.
    Catalogue,
}

impl Folder {
    /// Path of a file that the scene names.
    ///
    /// # Errors
    /// A path that is absolute or leaves the folder (also through a link), or no such file.
    pub fn file(&self, relative: &str) -> Result<PathBuf> {
        let fail = |kind, message: &str| {
            let source = io::Error::new(kind, message.to_owned());
            Err(Error::File { path: relative.to_owned(), source })
        };
        if !Path::new(relative).components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir)) {
            let message = "a scene may only read files in its own folder; give a path below it";
            return fail(io::ErrorKind::PermissionDenied, message);
        }
        let Self::Disk(folder) = self else {
            return fail(io::ErrorKind::NotFound, "a case of the catalogue has no files of its own");
        };
        let path = folder.join(relative);
        let at = |path: &Path| path.canonicalize();
        match (at(folder), at(&path)) {
            (Ok(folder), Ok(file)) if file.starts_with(&folder) => Ok(path),
            (Ok(_), Ok(_)) => {
                fail(io::ErrorKind::PermissionDenied, "the link leads out of the folder of the scene")
            }
            (Ok(_), Err(missing)) if missing.kind() == io::ErrorKind::NotFound => {
                let message = "no such file; put it next to the scene, or correct the name in the scene";
                fail(missing.kind(), message)
            }
            (Err(source), _) | (_, Err(source)) => {
                Err(Error::File { path: path.display().to_string(), source })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_below_the_scene_are_found() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::Disk(home.path().join("scene"));
        std::fs::create_dir_all(home.path().join("scene/data")).unwrap();
        std::fs::write(home.path().join("scene/data/p.csv"), "").unwrap();
        std::fs::write(home.path().join("secret.csv"), "").unwrap();
        assert!(folder.file("data/p.csv").is_ok());
        assert!(folder.file("./data/p.csv").is_ok());
        for path in ["../secret.csv", "/etc/hostname", "data/../../secret.csv", "missing.csv"] {
            assert!(folder.file(path).is_err(), "{path}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_folder_is_refused() {
        let home = tempfile::tempdir().unwrap();
        std::fs::create_dir(home.path().join("scene")).unwrap();
        std::fs::write(home.path().join("secret.csv"), "").unwrap();
        std::os::unix::fs::symlink("../secret.csv", home.path().join("scene/link.csv")).unwrap();
        let error = Folder::Disk(home.path().join("scene")).file("link.csv").unwrap_err();
        assert!(error.to_string().contains("leads out"), "{error}");
    }
}
