//! Lists the pairs `data/<case>/<source>.{csv,toml}`, so that a new reference is two new files and nothing else.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = Path::new(&env::var("CARGO_MANIFEST_DIR").unwrap_or_default()).join("data");
    println!("cargo::rerun-if-changed={}", root.display());
    let mut list = String::from("&[\n");
    for case in sorted(&root)?.iter().filter(|path| path.is_dir()) {
        let is_ours = |path: &PathBuf| path.extension().is_some_and(|e| e == "csv" || e == "toml");
        let files = sorted(case)?.into_iter().filter(is_ours);
        let stems: BTreeSet<PathBuf> = files.map(|file| file.with_extension("")).collect();
        for stem in stems {
            // A CSV without its provenance, or the other way round, fails here: include_*! names it.
            let _ = writeln!(
                list,
                "({:?}, {:?}, include_bytes!({:?}), include_str!({:?})),",
                case.file_name().unwrap_or_default().to_string_lossy(),
                stem.file_name().unwrap_or_default().to_string_lossy(),
                stem.with_extension("csv"),
                stem.with_extension("toml"),
            );
        }
    }
    list.push(']');
    fs::write(Path::new(&env::var("OUT_DIR").unwrap_or_default()).join("references.rs"), list)
}

fn sorted(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths =
        fs::read_dir(folder)?.map(|entry| entry.map(|e| e.path())).collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}
