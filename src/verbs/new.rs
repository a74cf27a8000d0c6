//! `seam new`: a scene to begin with, that runs as it is.

use crate::args::New;
use anyhow::{Context, Result, bail};
use seam_cases::catalogue;
use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_reports::exit::Exit;
use std::io::Write;

/// The scene, with its id to be filled in.
const SCENE: &str = include_str!("new.toml");

/// Writes `ID.toml`; never over something.
pub fn new(words: &New) -> Result<Exit> {
    let id = &words.id;
    if catalogue::ids().any(|known| known == id) {
        bail!("the catalogue has a case '{id}' already; choose another id, or look at it: seam show {id}");
    }
    let text = SCENE.replace("ID", id);
    let path = words.folder.join(format!("{id}.toml"));
    // An id that is none is refused before it becomes the name of a file.
    SceneFile::read(&path.display().to_string(), &text, Folder::Disk(words.folder.clone()), &[])?;
    std::fs::create_dir_all(&words.folder).with_context(|| words.folder.display().to_string())?;
    let mut file = std::fs::File::create_new(&path)
        .with_context(|| format!("{}: not written; choose another id or --folder", path.display()))?;
    file.write_all(text.as_bytes())?;
    let path = path.display();
    eprintln!("wrote {path}; run and judge it with: seam run {path} && seam check {id}");
    Ok(Exit::Pass)
}
