//! Where references are found: in the binary, or in a folder of the user's.

use crate::problem::{Problem, Result};
use crate::reference::Reference;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

type Embedded = (&'static str, &'static str, &'static [u8], &'static str);

/// `(case, source, CSV, TOML)` of every pair of files in `references/data`; listed by `build.rs`.
const REFERENCES: &[Embedded] = include!(concat!(env!("OUT_DIR"), "/references.rs"));

/// The references that come with Seam, by case and source.
pub fn all() -> Vec<Reference> {
    REFERENCES
        .iter()
        .map(|&(case, source, csv, provenance)| {
            Reference::new("references/data", case, source, csv.into(), provenance.into())
        })
        .collect()
}

/// The reference of a case that comes from a source.
///
/// # Errors
/// No such reference.
pub fn find(case: &str, source: &str) -> Result<Reference> {
    let all = all();
    let known = all.iter().map(Reference::id).collect::<Vec<_>>().join(", ");
    all.into_iter()
        .find(|r| r.case == case && r.source == source)
        .ok_or_else(|| Problem::Unknown { id: format!("{case}/{source}"), known })
}

/// The references in a folder laid out as `<case>/<source>.{csv,toml}`, by case and source. Other files are left alone.
///
/// # Errors
/// No references there, a file that cannot be read, a CSV without its provenance or the other way round.
pub fn from_folder(folder: &Path) -> Result<Vec<Reference>> {
    let mut references = Vec::new();
    for case in entries(folder)?.iter().filter(|path| path.is_dir()) {
        let is_ours = |path: &PathBuf| path.extension().is_some_and(|e| e == "csv" || e == "toml");
        let stems: BTreeSet<PathBuf> =
            entries(case)?.into_iter().filter(is_ours).map(|path| path.with_extension("")).collect();
        for stem in stems {
            references.push(read(folder, case, &stem)?);
        }
    }
    if references.is_empty() {
        return Err(Problem::Empty { folder: folder.display().to_string() });
    }
    Ok(references)
}

/// One pair of files in such a folder; `None` if neither file is there.
///
/// # Errors
/// A file that cannot be read, or one without the other.
pub fn in_folder(folder: &Path, case: &str, source: &str) -> Result<Option<Reference>> {
    let stem = folder.join(case).join(source);
    let there = ["csv", "toml"].iter().any(|extension| stem.with_extension(extension).is_file());
    there.then(|| read(folder, &folder.join(case), &stem)).transpose()
}

fn read(folder: &Path, case: &Path, stem: &Path) -> Result<Reference> {
    let (csv, toml) = (stem.with_extension("csv"), stem.with_extension("toml"));
    for (missing, present) in [(&csv, &toml), (&toml, &csv)] {
        if !missing.is_file() {
            return Err(Problem::Unpaired {
                file: present.display().to_string(),
                missing: missing.display().to_string(),
            });
        }
    }
    let numbers = fs::read(&csv).map_err(|e| unreadable(&csv, e))?;
    let provenance = fs::read_to_string(&toml).map_err(|e| unreadable(&toml, e))?;
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Reference::new(
        &folder.display().to_string(),
        &name(case),
        &name(stem),
        Cow::Owned(numbers),
        Cow::Owned(provenance),
    ))
}

/// What is in a folder, by name: the order of the file system must not reach the output.
fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    let list = fs::read_dir(folder).and_then(|list| list.map(|e| e.map(|e| e.path())).collect());
    let mut paths: Vec<PathBuf> = list.map_err(|e| unreadable(folder, e))?;
    paths.sort();
    Ok(paths)
}

fn unreadable(path: &Path, source: std::io::Error) -> Problem {
    Problem::Unreadable { file: path.display().to_string(), source }
}
