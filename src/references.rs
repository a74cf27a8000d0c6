//! The references that results rest on: nothing is judged beside an altered one.

use crate::args::ReferencesFolder;
use crate::results::Unmeasured;
use anyhow::Result;
use seam_references::{Reference, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// Verifies every reference and gives the SHA-256 of each of its files.
///
/// # Errors
/// A reference that is missing, altered or incomplete, with its file and the mend.
pub fn verified(words: &ReferencesFolder) -> Result<BTreeMap<String, String>> {
    let built_in = seam_references::all();
    let references = match &words.references {
        Some(folder) => {
            let given = seam_references::from_folder(folder)?;
            complete(&given, &built_in, folder)?;
            given
        }
        None => built_in,
    };
    references.iter().try_for_each(seam_references::verify)?;
    Ok(references.iter().flat_map(hashes).collect())
}

/// A folder that is used instead of the built-in references must not hold fewer of them.
fn complete(given: &[Reference], wanted: &[Reference], folder: &Path) -> Result<(), Unmeasured> {
    let missing = wanted.iter().find(|w| given.iter().all(|g| g.id() != w.id()));
    missing.map_or(Ok(()), |reference| {
        let (folder, id) = (folder.display(), reference.id());
        let mend = format!("put {id}.csv and {id}.toml back, as they are in Seam's references/data");
        Err(Unmeasured(format!("{folder}: the reference '{id}' is missing; {mend}")))
    })
}

fn hashes(reference: &Reference) -> [(String, String); 2] {
    let hash = |bytes: &[u8]| Sha256::of(bytes).to_string();
    [
        (format!("{}.csv", reference.id()), hash(&reference.csv)),
        (format!("{}.toml", reference.id()), hash(reference.provenance.as_bytes())),
    ]
}
