//! Defects seeded on purpose: each must turn the gate red, by the check that is there to find it.
//!
//! A defect is one entry of a list: [`mechanics`], [`foreign`] (numbers of other codes) or [`judged`] (what is done to
//! results). Every trial is run sound first, must be green, and becomes the record that spoiled runs are judged beside.

mod changes;
mod foreign;
// One signature for all defects of results: some clear the whole list.
#[allow(clippy::ptr_arg)]
mod judged;
mod mechanics;

use crate::message;
use crate::provenance;
use anyhow::{Result, anyhow, bail};
use rayon::prelude::*;
use seam_cases::catalogue;
use seam_cases::defect::Defect;
use seam_cases::names::hint;
use seam_cases::overrides::Override;
use seam_cases::procedures;
use seam_cases::result::CaseResult;
use seam_cases::scene::Tier;
use seam_reports::exit::Exit;
use seam_reports::failure::failures;
use seam_reports::judge::judge;
use seam_reports::record::Recorded;
use seam_reports::verdict::ClaimVerdict;
use std::collections::BTreeMap;

/// A case of the catalogue, perhaps made smaller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Trial {
    /// Its id.
    case: &'static str,
    /// Keys set to other values, as with `--set`.
    sets: &'static [&'static str],
    /// What of it is run.
    part: Part,
}

/// How much of a case is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    /// Everything.
    Whole,
    /// These quantities, without studies.
    Quantities(&'static [&'static str]),
    /// The claims, without quantities.
    Claims,
}

impl Trial {
    /// A whole case.
    const fn of(case: &'static str) -> Self {
        Trial { case, sets: &[], part: Part::Whole }
    }

    fn run(&self, defect: Option<Defect>) -> Result<CaseResult> {
        let sets = self.sets.iter().map(|set| Override::parse(set)).collect::<Result<Vec<_>, _>>()?;
        let mut file = catalogue::case(self.case, &sets)?;
        file = match self.part {
            Part::Whole => file,
            Part::Quantities(names) => file.trimmed(names, false),
            Part::Claims => file.trimmed(&[], true),
        };
        if let Some(defect) = defect {
            file = file.with_defect(defect);
        }
        Ok(procedures::run(&file, Tier::Quick)?.result)
    }
}

/// What is spoiled.
enum Spoil {
    /// The run.
    Run(Defect),
    /// What a sound run gave.
    Results(fn(&mut Vec<CaseResult>)),
}

/// A defect, where it is put, and how it must show.
pub struct Seeded {
    /// Its name.
    pub name: &'static str,
    /// What is wrong.
    pub about: &'static str,
    trial: Trial,
    spoil: Spoil,
    /// The exit code that it must lead to.
    exit: Exit,
    /// The check that must catch it: part of its place or of its message.
    pub by: &'static str,
}

/// How a defect showed.
pub struct Shown {
    /// The defect.
    pub seeded: &'static Seeded,
    /// The exit code.
    pub exit: Exit,
    /// The checks that caught it, the expected one first; empty if nothing did.
    pub by: Vec<String>,
    /// Whether exit code and check are the expected ones.
    pub as_expected: bool,
}

/// All defects.
pub fn all() -> impl Iterator<Item = &'static Seeded> + Clone {
    mechanics::DEFECTS.iter().chain(foreign::DEFECTS).chain(judged::DEFECTS)
}

/// The defects of these names; all, if there are none.
pub fn named(names: &[String]) -> Result<Vec<&'static Seeded>> {
    if let Some(name) = names.iter().find(|name| all().all(|d| d.name != **name)) {
        bail!("there is no defect '{name}'; {}", hint(name, all().map(|d| d.name)));
    }
    Ok(all().filter(|d| names.is_empty() || names.iter().any(|name| name == d.name)).collect())
}

/// Seeds defects, each into a run of its own.
///
/// # Errors
/// A trial that is not green without a defect: it could show nothing.
pub fn run(defects: &[&'static Seeded]) -> Result<Vec<Shown>> {
    let mut trials: Vec<Trial> = defects.iter().map(|d| d.trial).collect();
    trials.sort_unstable();
    trials.dedup();
    let sound = trials.par_iter().with_max_len(1).map(|trial| Ok((*trial, sound(trial)?)));
    let sound = sound.collect::<Result<BTreeMap<Trial, (CaseResult, Recorded)>>>()?;
    Ok(defects.par_iter().with_max_len(1).map(|seeded| shown(seeded, &sound[&seeded.trial])).collect())
}

/// A trial without a defect, and the record that it leaves.
fn sound(trial: &Trial) -> Result<(CaseResult, Recorded)> {
    let result = trial.run(None)?;
    let judged =
        judge(std::slice::from_ref(&result), provenance::here(BTreeMap::new()), &Recorded::default());
    if judged.exit(true) != Exit::Pass {
        let first = failures(&judged).first().map_or(String::new(), |f| format!(": {} {}", f.class, f.place));
        return Err(anyhow!(
            "{} is red without any defect{first}; see: seam run {0}, seam check",
            trial.case
        ));
    }
    Ok((result, Recorded::default().updated(&judged)))
}

fn shown(seeded: &'static Seeded, (sound, recorded): &(CaseResult, Recorded)) -> Shown {
    let run = match &seeded.spoil {
        Spoil::Run(defect) => seeded.trial.run(Some(*defect)).map(|result| vec![result]),
        Spoil::Results(spoil) => {
            let mut results = vec![sound.clone()];
            spoil(&mut results);
            Ok(results)
        }
    };
    let (exit, mut by) = match run {
        // As in `seam validate`: what did not run was not measured.
        Err(error) => (Exit::Unmeasured, vec![message::of(&error).replace('\n', " ")]),
        Ok(results) => verdict(&results, recorded),
    };
    let expected = by.iter().position(|check| check.contains(seeded.by));
    if let Some(at) = expected {
        by.swap(0, at);
    }
    Shown { seeded, exit, by, as_expected: expected.is_some() && exit == seeded.exit }
}

/// The exit code of some results, and what is red in them.
fn verdict(results: &[CaseResult], recorded: &Recorded) -> (Exit, Vec<String>) {
    let judged = judge(results, provenance::here(BTreeMap::new()), recorded);
    let mut by: Vec<String> = failures(&judged).into_iter().map(|f| f.place).collect();
    for case in &judged.cases {
        let open = case.claims.iter().filter(|c| c.own && c.verdict == ClaimVerdict::Undetermined);
        by.extend(open.map(|c| format!("{} / {}", case.id, c.id)));
    }
    if judged.cases.is_empty() {
        by.push("no cases".to_owned());
    }
    (judged.exit(true), by)
}
