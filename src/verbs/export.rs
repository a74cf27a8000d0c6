//! `seam export`: the network or mesh of a case, for another code.

use crate::args::{Code, Export, Tier};
use crate::running;
use anyhow::Result;
use seam_cases::export;
use seam_reports::exit::Exit;

/// Writes one folder per network or mesh.
pub fn export(words: &Export) -> Result<Exit> {
    let case = std::slice::from_ref(&words.case);
    for file in running::scenes(case, &words.overrides, Tier::Quick)? {
        for export in export::of(&file, words.code.into())? {
            let folder = words.out.join(&export.name);
            export.write(&folder)?;
            let names: Vec<&str> = export.files.keys().map(String::as_str).collect();
            eprintln!("{}: {}", folder.display(), names.join(", "));
        }
    }
    Ok(Exit::Pass)
}

impl From<Code> for export::Code {
    fn from(code: Code) -> Self {
        match code {
            Code::Yade => export::Code::Yade,
            Code::Lammps => export::Code::Lammps,
            Code::Calculix => export::Code::Calculix,
        }
    }
}
