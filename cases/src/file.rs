//! A scene with its text, its folder and the values of its parameters.

use crate::defect::Defect;
use crate::error::{Error, Fault, Result};
use crate::expression::Values;
use crate::folder::Folder;
use crate::overrides::{self, Override};
use crate::scene::{Scene, check, quantity};
use crate::source::Source;
use std::path::Path;

/// Larger than any scene a person writes.
const LARGEST_FILE: u64 = 4 << 20;

/// A scene that has passed every check that needs no solver.
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// Values of its parameters.
    pub values: Values,
    /// Where its own files are.
    pub folder: Folder,
    source: Source,
    /// What is wrong with it on purpose.
    pub(crate) defect: Option<Defect>,
}

impl SceneFile {
    /// Reads a scene from disk.
    ///
    /// # Errors
    /// No such file, or anything wrong in it.
    pub fn open(path: &Path, changes: &[Override]) -> Result<Self> {
        let fail = |source| Error::File { path: path.display().to_string(), source };
        let size = std::fs::metadata(path).map_err(fail)?.len();
        if size > LARGEST_FILE {
            let message = format!("{size} bytes are too much for a scene (limit {LARGEST_FILE})");
            return Err(fail(std::io::Error::other(message)));
        }
        let text = std::fs::read_to_string(path).map_err(fail)?;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Self::read(&path.display().to_string(), &text, Folder::Disk(folder.to_owned()), changes)
    }

    /// Reads a scene from its text.
    ///
    /// # Errors
    /// Anything wrong in it.
    pub fn read(file: &str, text: &str, folder: Folder, changes: &[Override]) -> Result<Self> {
        let source = Source {
            file: file.to_owned(),
            text: overrides::apply(text, changes)?,
            overrides: changes.iter().map(Override::text).collect(),
        };
        let mut scene = source.parse()?;
        scene.drop_disabled();
        quantity::spread(&mut scene.quantities).map_err(|fault| source.error(fault))?;
        scene.apply_effects().map_err(|fault| source.error(fault))?;
        let values = scene.values().map_err(|fault| source.error(fault))?;
        check::check(&scene, &values).map_err(|fault| source.error(fault))?;
        Ok(Self { scene, values, folder, source, defect: None })
    }

    /// The same scene with some keys set to other values, on top of earlier changes.
    ///
    /// # Errors
    /// A key that is not there, or a value that does not fit.
    pub fn with(&self, changes: &[Override]) -> Result<Self> {
        let mut changed = Self::read(&self.source.file, &self.source.text, self.folder.clone(), changes)?;
        let earlier = self.source.overrides.iter().cloned();
        changed.defect = self.defect;
        changed.source.overrides = earlier.chain(changes.iter().map(Override::text)).collect();
        Ok(changed)
    }

    /// The error for a fault found later, e.g. while the model is built.
    pub fn error(&self, fault: Fault) -> Error {
        self.source.error(fault)
    }

    /// What the solver refused, with the case.
    pub fn solver(&self, source: seam_solver::error::Error) -> Error {
        Error::Solver { case: self.scene.id.clone(), source }
    }

    /// The text as it is run, overrides included.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Blake3 of the text as it was run, overrides included.
    pub fn hash(&self) -> String {
        blake3::hash(self.source.text.as_bytes()).to_hex().to_string()
    }

    /// File as the user named it.
    pub fn name(&self) -> &str {
        &self.source.file
    }

    /// Whether it was read from disk, and not from the catalogue.
    pub fn on_disk(&self) -> bool {
        matches!(self.folder, Folder::Disk(_))
    }

    /// Overrides that were applied, as `key=value`.
    pub fn overrides(&self) -> &[String] {
        &self.source.overrides
    }
}
