//! One folder per case: `result.json`, curves as CSV, fields as VTU.
//!
//! The folder is written beside its place and moved there when it is whole, so a run that stops half-way
//! leaves earlier results as they were.

use crate::error::{Error, Result};
use crate::result::{CaseResult, Plot};
use crate::study::Run;
use serde::Serialize;
use std::fs;
use std::path::{Path, PathBuf};

/// Name of the file that holds the result.
pub const RESULT: &str = "result.json";

/// Name of the folder of the studies: a folder per kind, a file per case.
pub const STUDIES: &str = "studies";

/// Writes a case into `out/<id>` and returns that folder. Fields are written if the run has them.
///
/// # Errors
/// Anything that cannot be written.
pub fn write(out: &Path, run: &Run) -> Result<PathBuf> {
    let id = &run.result.id;
    let place = out.join(id);
    let (fresh, old) = (out.join(format!(".{id}.new")), out.join(format!(".{id}.old")));
    let at = |path: &Path| {
        let path = path.display().to_string();
        move |source| Error::File { path, source }
    };
    for left_over in [&fresh, &old] {
        if left_over.exists() {
            fs::remove_dir_all(left_over).map_err(at(left_over))?;
        }
    }
    fs::create_dir_all(&fresh).map_err(at(&fresh))?;
    fill(&fresh, run)?;
    if place.exists() {
        fs::rename(&place, &old).map_err(at(&place))?;
    }
    fs::rename(&fresh, &place).map_err(at(&fresh))?;
    if old.exists() {
        fs::remove_dir_all(&old).map_err(at(&old))?;
    }
    Ok(place)
}

fn fill(folder: &Path, run: &Run) -> Result<()> {
    let save = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(|source| Error::File { path: path.display().to_string(), source })
    };
    for plot in &run.result.curves {
        save(&format!("{}.csv", plot.id), csv(plot).as_bytes())?;
    }
    if let Some((model, solution)) = &run.fields {
        let case = || run.result.id.clone();
        seam_solver::vtu::write_solution(folder, model, solution)
            .map_err(|source| Error::Solver { case: case(), source })?;
    }
    let json = serde_json::to_string_pretty(&run.result).map_err(|e| Error::File {
        path: folder.join(RESULT).display().to_string(),
        source: std::io::Error::other(e),
    })?;
    save(RESULT, (json + "\n").as_bytes())
}

/// `series,x,y`: one line per point, so that series may have stations of their own.
fn csv(plot: &Plot) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut text = format!("series,{},{}\n", quoted(&plot.x_label), quoted(&plot.y_label));
    for series in &plot.series {
        for (x, y) in series.x.iter().zip(&series.y) {
            text += &format!("{},{x:?},{y:?}\n", quoted(&series.name));
        }
    }
    text
}

/// Where the study of a case lies in the folder of results: apart from the folder of the case, which a run replaces whole.
pub fn study_path(out: &Path, kind: &str, id: &str) -> PathBuf {
    out.join(STUDIES).join(kind).join(format!("{id}.json"))
}

/// Writes what a study of this kind found, whole or not at all, and returns where.
///
/// # Errors
/// Anything that cannot be written.
pub fn write_study(out: &Path, kind: &str, result: &CaseResult) -> Result<PathBuf> {
    let path = study_path(out, kind, &result.id);
    write_whole(&path, result)?;
    Ok(path)
}

/// Writes a value as JSON by way of a file beside it, so that a reader never sees half of it.
pub(crate) fn write_whole(path: &Path, value: &impl Serialize) -> Result<()> {
    let fail = |source| Error::File { path: path.display().to_string(), source };
    let json = serde_json::to_string_pretty(value).map_err(|e| fail(std::io::Error::other(e)))?;
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(fail)?;
    }
    let beside = path.with_added_extension(format!("{}.tmp", std::process::id()));
    fs::write(&beside, json + "\n").and_then(|()| fs::rename(&beside, path)).map_err(|e| {
        // Best effort: the error worth telling is the first one.
        let _ = fs::remove_file(&beside);
        fail(e)
    })
}

/// Reads the result of one case; `folder` is `out/<id>`.
///
/// # Errors
/// No such file, or one that is not a result.
pub fn read(folder: &Path) -> Result<CaseResult> {
    let path = folder.join(RESULT);
    let fail = |source| Error::File { path: path.display().to_string(), source };
    let text = fs::read_to_string(&path).map_err(fail)?;
    serde_json::from_str(&text).map_err(|e| fail(std::io::Error::other(e)))
}
