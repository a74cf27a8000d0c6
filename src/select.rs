//! Cases by tag and effect, and results by id: what is left over must not be nothing.

use crate::args::{Filter, Tier};
use anyhow::{Result, bail};
use seam_cases::catalogue::{self, Entry};
use seam_cases::file::SceneFile;
use seam_cases::names::hint;
use seam_cases::result::CaseResult;
use seam_cases::scene;
use std::collections::BTreeSet;

impl Filter {
    /// Whether anything is asked for.
    pub fn is_empty(&self) -> bool {
        self.tags.is_empty() && self.effects.is_empty()
    }

    fn fits<'a>(&self, tags: &[String], mut effects: impl Iterator<Item = &'a String> + Clone) -> bool {
        let tagged = self.tags.is_empty() || self.tags.iter().any(|tag| tags.contains(tag));
        tagged && (self.effects.is_empty() || effects.any(|effect| self.effects.contains(effect)))
    }

    fn entry(&self, entry: &Entry) -> bool {
        self.fits(&entry.tags, entry.effects.iter())
    }

    fn result(&self, case: &CaseResult) -> bool {
        self.fits(&case.tags, case.effects.iter().filter(|e| e.on).map(|e| &e.name))
    }
}

/// Keeps the scenes that fit.
///
/// # Errors
/// None does: the nearest word is named.
pub fn keep(files: &mut Vec<SceneFile>, filter: &Filter) -> Result<()> {
    let all: Vec<Entry> = files.iter().map(catalogue::entry).collect();
    files.retain(|file| filter.entry(&catalogue::entry(file)));
    something(files.is_empty(), filter, &all)
}

/// The entries of the catalogue with these ids (all, if there are none), of this tier, that fit.
///
/// # Errors
/// No such case; none that fits.
pub fn entries(ids: &[String], filter: &Filter, tier: Option<Tier>) -> Result<Vec<Entry>> {
    let mut all = match ids {
        [] => catalogue::list()?,
        ids => {
            let one = |id: &String| catalogue::case(id, &[]).map(|file| catalogue::entry(&file));
            ids.iter().map(one).collect::<Result<Vec<_>, _>>()?
        }
    };
    let wanted = tier.map(scene::Tier::from);
    all.retain(|entry| wanted.is_none_or(|tier| entry.tiers.contains(&tier)));
    let mut fit = all.clone();
    fit.retain(|entry| filter.entry(entry));
    something(fit.is_empty(), filter, &all)?;
    Ok(fit)
}

/// Keeps the results with these ids (all, if there are none), of this tier, that fit.
///
/// # Errors
/// An id without a result; none that fits.
pub fn results(
    mut cases: Vec<CaseResult>,
    ids: &[String],
    filter: &Filter,
    tier: Option<Tier>,
) -> Result<Vec<CaseResult>> {
    if let Some(id) = ids.iter().find(|id| cases.iter().all(|case| case.id != **id)) {
        let known: Vec<&str> = cases.iter().map(|case| case.id.as_str()).collect();
        bail!("there is no result of '{id}'; {}", hint(id, known));
    }
    let wanted = tier.map(|tier| scene::Tier::from(tier).name());
    cases.retain(|case| {
        (ids.is_empty() || ids.contains(&case.id))
            && wanted.is_none_or(|tier| case.tier == tier)
            && filter.result(case)
    });
    if cases.is_empty() {
        bail!("no result is of that tier, tag and effect; run cases of that kind, or ask for others");
    }
    Ok(cases)
}

/// Nothing that fits is a mistake in a word.
fn something(nothing: bool, filter: &Filter, all: &[Entry]) -> Result<()> {
    if !nothing || (filter.is_empty() && all.is_empty()) {
        return Ok(());
    }
    let known = |of: fn(&Entry) -> &Vec<String>| all.iter().flat_map(of).collect::<BTreeSet<_>>();
    let kinds =
        [("tag", &filter.tags, known(|e| &e.tags)), ("effect", &filter.effects, known(|e| &e.effects))];
    for (kind, words, known) in kinds {
        if let Some(word) = words.iter().find(|word| !known.contains(word)) {
            let known: Vec<&str> = known.into_iter().map(String::as_str).collect();
            bail!("no case has the {kind} '{word}'; {}", hint(word, known));
        }
    }
    bail!("no case has such a tag and such an effect at once; ask for one of the two")
}
