//! The cases that come with Seam, inside the binary.

use crate::error::{Error, Result};
use crate::file::SceneFile;
use crate::folder::Folder;
use crate::names::hint;
use crate::overrides::Override;
use crate::scene::Tier;
use serde::Serialize;

/// `(id, case.toml, page.md)` of every folder of `cases/catalogue`, by id; listed by `build.rs`.
const CASES: &[(&str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/catalogue.rs"));

/// One line of the list of cases.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Entry {
    /// Id.
    pub id: String,
    /// One line.
    pub title: String,
    /// Words to filter by.
    pub tags: Vec<String>,
    /// When it runs.
    pub tiers: Vec<Tier>,
    /// Effects it simulates, as far as its text tells.
    pub effects: Vec<String>,
    /// Ids of the claims it answers.
    pub claims: Vec<String>,
    /// Threads it can use.
    pub threads: usize,
    /// Memory of the full tier, in MB.
    pub mem_mb: usize,
    /// Wall time of the full tier, in minutes.
    pub minutes: f64,
}

/// Ids of all cases, in alphabetical order.
pub fn ids() -> impl Iterator<Item = &'static str> + Clone {
    CASES.iter().map(|(id, _, _)| *id)
}

/// A case with some keys set to other values.
///
/// # Errors
/// No such case; an override that does not fit.
pub fn case(id: &str, changes: &[Override]) -> Result<SceneFile> {
    let (_, text, _) = find(id)?;
    SceneFile::read(&format!("cases/catalogue/{id}/case.toml"), text, Folder::Catalogue, changes)
}

/// The page of a case: description, sketch, equations (Markdown).
///
/// # Errors
/// No such case.
pub fn page(id: &str) -> Result<&'static str> {
    find(id).map(|(_, _, page)| *page)
}

fn find(id: &str) -> Result<&'static (&'static str, &'static str, &'static str)> {
    let found = CASES.iter().find(|(known, _, _)| *known == id);
    found.ok_or_else(|| Error::UnknownCase { id: id.to_owned(), hint: hint(id, ids()) })
}

/// All cases.
///
/// # Errors
/// A case file that does not read.
pub fn list() -> Result<Vec<Entry>> {
    ids().map(|id| case(id, &[]).map(|file| entry(&file))).collect()
}

/// The line of one scene.
pub fn entry(file: &SceneFile) -> Entry {
    let scene = &file.scene;
    Entry {
        id: scene.id.clone(),
        title: scene.title.clone(),
        tags: scene.tags.clone(),
        tiers: scene.tiers.clone(),
        effects: scene.simulated_effects(),
        claims: scene.claims.keys().cloned().collect(),
        threads: scene.needs.threads,
        mem_mb: scene.needs.mem_mb,
        minutes: scene.needs.minutes,
    }
}
