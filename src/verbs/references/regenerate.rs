//! `seam references regenerate`: the codes run again, beside what is committed.

use super::super::check::print;
use super::scratch::Scratch;
use super::{inputs, tools};
use crate::args::Regenerate;
use crate::results::Unmeasured;
use anyhow::{Context, Result, bail};
use seam_cases::export::{Code, Export};
use seam_references::{Kind, Reference};
use seam_reports::exit::Exit;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Machines round differently: LAMMPS's angles most, by 1e-8 rad of some 1e-3. An order below what the cases accept for it.
const SAME: f64 = 1e-5;

/// What makes a reference again.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Recipe {
    /// A script that is given an exported network.
    Network(Code, String),
    /// A script that writes its own input, and perhaps more than one reference.
    Script(Code, PathBuf),
}

impl Recipe {
    fn code(&self) -> Code {
        match self {
            Recipe::Network(code, _) | Recipe::Script(code, _) => *code,
        }
    }
}

/// Runs what is asked for and shows the differences; with `--accept` puts the new files in place.
pub fn regenerate(words: &Regenerate) -> Result<Exit> {
    let generators = words.home.join("generators");
    if !generators.is_dir() {
        bail!(
            "{}: no generators there; run this in a checkout of Seam, or name its folder 'references' with --home",
            words.home.display()
        );
    }
    let exports = inputs::all()?;
    let committed = seam_references::all();
    let wanted = wanted(words, &exports, &committed)?;
    let scratch = Scratch::new()?;
    let (mut missing, mut done, mut same) = (BTreeSet::new(), 0, true);
    for (recipe, ids) in wanted {
        let code = recipe.code();
        let tool = match tools::find(code) {
            Ok(tool) => tool,
            Err(why) => {
                if missing.insert(code) {
                    print(&format!("{}: {why}\n", code.name()))?;
                }
                continue;
            }
        };
        eprintln!("{} runs: {}", code.name(), ids.join(", "));
        let out = scratch.0.join("data");
        let to = [("SEAM_REFERENCES", out.as_path())];
        match &recipe {
            Recipe::Script(_, script) => drop(tool.run(&words.home.join(script), &[], &to)?),
            Recipe::Network(_, id) => {
                let export = &exports[id];
                let folder = scratch.0.join("input").join(id);
                export.write(&folder)?;
                let script = generators.join(code.name()).join(script_of(export));
                let name = id.split_once('/').map_or("", |(_, name)| name);
                tool.run(&script, &[&folder.display().to_string(), &export.case, name], &to)?;
            }
        }
        for id in ids {
            same &= show(&id, &out, &committed)?;
            if words.accept {
                replace(&id, &out, &words.home.join("data"))?;
            }
            done += 1;
        }
    }
    if done == 0 {
        return Err(Unmeasured("nothing was made: no code that is asked for is installed".to_owned()).into());
    }
    if !words.accept {
        eprintln!("nothing was replaced; --accept does that");
    }
    Ok(if same || words.accept { Exit::Pass } else { Exit::Failed })
}

/// The script that computes what an export asks for.
fn script_of(export: &Export) -> &'static str {
    let asks = |motion: &str| export.files["run.toml"].contains(&format!("motion = \"{motion}\""));
    match () {
        () if asks("history") => "dynamic.py",
        () if asks("breaking") => "breaking.py",
        () => "static.py",
    }
}

/// Recipes with the ids of what they make.
fn wanted(
    words: &Regenerate,
    exports: &BTreeMap<String, Export>,
    committed: &[Reference],
) -> Result<BTreeMap<Recipe, Vec<String>>> {
    let mut recipes: BTreeMap<String, Recipe> =
        exports.iter().map(|(id, export)| (id.clone(), Recipe::Network(export.code, id.clone()))).collect();
    for reference in committed {
        let provenance = reference.open()?.provenance;
        if *provenance.kind.get_ref() == Kind::Calculix
            && let Some(script) = provenance.command.strip_prefix("python3 references/")
        {
            recipes.insert(reference.id(), Recipe::Script(Code::Calculix, script.into()));
        }
    }
    let asked = |id: &str, word: &str| id == word || id.split_once('/').is_some_and(|(case, _)| case == word);
    if let Some(unknown) = words.ids.iter().find(|word| !recipes.keys().any(|id| asked(id, word))) {
        let known: Vec<&str> = recipes.keys().map(String::as_str).collect();
        bail!("no code makes '{unknown}'; what can be made: {}", known.join(", "));
    }
    let code = words.code.map(Code::from);
    let mut wanted: BTreeMap<Recipe, Vec<String>> = BTreeMap::new();
    for (id, recipe) in recipes {
        let named = words.ids.is_empty() || words.ids.iter().any(|word| asked(&id, word));
        if named && code.is_none_or(|code| code == recipe.code()) {
            wanted.entry(recipe).or_default().push(id);
        }
    }
    if wanted.is_empty() {
        bail!("no reference that is asked for is made by that code; see: seam references list");
    }
    Ok(wanted)
}

/// Prints how far the new numbers are from the committed ones; whether they are the same.
fn show(id: &str, out: &Path, committed: &[Reference]) -> Result<bool> {
    let fresh = seam_references::from_folder(out)?;
    let fresh =
        fresh.iter().find(|r| r.id() == id).with_context(|| format!("the script has not made '{id}'"))?;
    let new = fresh.open()?;
    let Some(old) = committed.iter().find(|r| r.id() == id) else {
        print(&format!("{id}: new, {} rows\n", new.rows()))?;
        return Ok(false);
    };
    let (said, same) = match new.difference(&old.open()?) {
        Some(0.0) => ("the same numbers".to_owned(), true),
        Some(d) => (format!("differs by {d:.1e} of the largest number of a column"), d <= SAME),
        None => ("has other rows or columns".to_owned(), false),
    };
    print(&format!("{id}: {said}\n"))?;
    Ok(same)
}

/// Both files or none: the numbers first, so that half a pair is found altered rather than believed.
fn replace(id: &str, out: &Path, data: &Path) -> Result<()> {
    for extension in ["csv", "toml"] {
        let file = format!("{id}.{extension}");
        let place = data.join(&file);
        std::fs::create_dir_all(place.parent().unwrap_or(data))
            .and_then(|()| std::fs::copy(out.join(&file), &place))
            .with_context(|| place.display().to_string())?;
    }
    Ok(())
}
