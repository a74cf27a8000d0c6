//! Running cases side by side, each into its own folder.

use crate::args::{Choice, Running, Tier};
use crate::progress::Progress;
use crate::{message, results, select};
use anyhow::{Result, anyhow, bail};
use rayon::prelude::*;
use seam_cases::checkpoint::Checkpoints;
use seam_cases::file::SceneFile;
use seam_cases::overrides::Override;
use seam_cases::result::CaseResult;
use seam_cases::{catalogue, procedures, scene, write};
use seam_reports::judge::judge_case;
use seam_reports::record::Recorded;
use std::num::NonZeroUsize;
use std::path::Path;

/// The scenes of some words that a filter keeps, and with `--failed` only those that have no result to be proud of.
///
/// # Errors
/// No such case; overrides that do not fit; nothing left.
pub fn selected(
    words: &[String],
    overrides: &[String],
    (choice, running, out): (&Choice, &Running, &Path),
    recorded: &Recorded,
) -> Result<Vec<SceneFile>> {
    let mut files = scenes(words, overrides, running.tier)?;
    select::keep(&mut files, &choice.filter)?;
    if choice.failed {
        files.retain(|file| !is_green(file, out, running.tier, recorded));
    }
    Ok(files)
}

/// The scenes named by ids and paths; without any, the whole catalogue of the tier.
pub fn scenes(words: &[String], overrides: &[String], tier: Tier) -> Result<Vec<SceneFile>> {
    let changes = overrides.iter().map(|o| Override::parse(o)).collect::<Result<Vec<_>, _>>()?;
    if words.is_empty() {
        if !changes.is_empty() {
            bail!("--set needs a case to apply to: seam run ID --set {}", overrides[0]);
        }
        let all = catalogue::ids().map(|id| catalogue::case(id, &[]));
        let all = all.collect::<Result<Vec<_>, _>>()?;
        return Ok(all.into_iter().filter(|f| f.scene.tiers.contains(&tier.into())).collect());
    }
    let open = |word: &String| match word.ends_with(".toml") {
        true => SceneFile::open(Path::new(word), &changes),
        false => catalogue::case(word, &changes),
    };
    let files = words.iter().map(open).collect::<Result<Vec<_>, _>>()?;
    for (k, file) in files.iter().enumerate() {
        if files[..k].iter().any(|other| other.scene.id == file.scene.id) {
            bail!(
                "two cases have the id '{}' and would share one folder; run them into different --out folders",
                file.scene.id
            );
        }
    }
    Ok(files)
}

impl From<Tier> for scene::Tier {
    fn from(tier: Tier) -> Self {
        match tier {
            Tier::Quick => scene::Tier::Quick,
            Tier::Full => scene::Tier::Full,
        }
    }
}

/// A case that could not be run.
pub struct Failed {
    /// Its id.
    pub id: String,
    /// Why.
    pub error: anyhow::Error,
}

/// Runs scenes into `out` and gives those that failed; a failure leaves the others, and the case's own
/// earlier result, whole. `checkpoints` of a case are found by its id.
pub fn run(
    files: &[SceneFile],
    out: &Path,
    running: &Running,
    checkpoints: &(dyn Fn(&str) -> Checkpoints + Sync),
) -> Result<Vec<Failed>> {
    // Before anything is computed that could not be kept.
    std::fs::create_dir_all(out)
        .map_err(|e| anyhow!("--out {}: {e}; name a folder that can be written", out.display()))?;
    let pool = pool(running)?;
    let progress = Progress::new(files.len(), running.quiet);
    // The heaviest first, so that none is left alone at the end.
    let mut order: Vec<&SceneFile> = files.iter().collect();
    order.sort_by(|a, b| b.scene.needs.minutes.total_cmp(&a.scene.needs.minutes));
    let failure = |file: &&SceneFile| {
        let error = one(file, out, running, (&checkpoints(&file.scene.id), &progress)).err()?;
        Some(Failed { id: file.scene.id.clone(), error })
    };
    let failed = pool.install(|| order.par_iter().with_max_len(1).filter_map(failure).collect());
    progress.finish();
    Ok(failed)
}

/// As many threads as were asked for, else one per core.
pub fn pool(running: &Running) -> Result<rayon::ThreadPool> {
    let threads = running.jobs.map_or(0, NonZeroUsize::get);
    Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?)
}

/// Prints all failures but the first, which is returned.
pub fn none_failed(failed: Vec<Failed>) -> Result<()> {
    let mut errors = failed.into_iter().map(|f| f.error);
    let Some(first) = errors.next() else { return Ok(()) };
    errors.for_each(|error| eprintln!("seam: {}", message::of(&error)));
    Err(first)
}

fn one(
    file: &SceneFile,
    out: &Path,
    running: &Running,
    (checkpoints, progress): (&Checkpoints, &Progress),
) -> Result<()> {
    let id = &file.scene.id;
    if running.resume && is_current(file, out, running.tier) {
        progress.done(id, "kept");
        return Ok(());
    }
    progress.begin(id);
    let run = procedures::run_keeping(file, running.tier.into(), checkpoints)
        .inspect_err(|_| progress.done(id, "failed"))?;
    write::write(out, &run)?;
    progress.done(id, &format!("{:.1} s", run.result.seconds));
    Ok(())
}

/// Whether there is a result of the same scene and tier.
fn is_current(file: &SceneFile, out: &Path, tier: Tier) -> bool {
    current(file, out, tier).is_some()
}

/// Whether there is one that keeps no gate from being green.
fn is_green(file: &SceneFile, out: &Path, tier: Tier, recorded: &Recorded) -> bool {
    current(file, out, tier).is_some_and(|result| !judge_case(&result, recorded).is_red(true))
}

/// The result of the same scene and tier.
fn current(file: &SceneFile, out: &Path, tier: Tier) -> Option<CaseResult> {
    let place = out.join(&file.scene.id).join(write::RESULT);
    let result = place.is_file().then(|| results::read(&place).ok()).flatten()?;
    let same = result.scene_hash == file.hash() && result.tier == scene::Tier::from(tier).name();
    same.then_some(result)
}
