//! Networks and meshes for other codes: the very ones that Seam solves, as CSV and TOML.
//!
//! A network is `particles.csv` and `bonds.csv` ([`seam_solver::dem::network_csv`]), a mesh `nodes.csv` and `elements.csv`;
//! `supports.csv` and `loads.csv` name points and components; `run.toml` says what is to be computed. The
//! scripts in `references/generators` read such a folder and nothing else.

pub mod lane;
mod mesh;
mod network;
pub mod race;

use crate::error::{Error, Fault, Result};
use crate::file::SceneFile;
use crate::model::build;
use crate::procedures::bond_for_bond;
use seam_references::Sha256;
use seam_solver::model::{Model, Part, PointValue};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// A code that can be given a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Code {
    /// YADE: bonded particles.
    Yade,
    /// LAMMPS with the BPM package: bonded particles.
    Lammps,
    /// CalculiX: finite elements.
    Calculix,
}

impl Code {
    /// All of them.
    pub const ALL: [Code; 3] = [Code::Yade, Code::Lammps, Code::Calculix];

    /// Name, as in `references/generators`.
    pub const fn name(self) -> &'static str {
        match self {
            Code::Yade => "yade",
            Code::Lammps => "lammps",
            Code::Calculix => "calculix",
        }
    }
}

/// Files of one network or mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// Id of the case.
    pub case: String,
    /// Name within the case; empty where the case is one network or mesh.
    pub name: String,
    /// Who it is for.
    pub code: Code,
    /// Content by file name.
    pub files: BTreeMap<String, String>,
}

impl Export {
    /// Name of the reference that the code makes of it: `<case>/<name>-<code>`.
    pub fn reference(&self) -> String {
        let dash = if self.name.is_empty() { "" } else { "-" };
        format!("{}/{}{dash}{}", self.case, self.name, self.code.name())
    }

    /// SHA-256 of each file, by name.
    pub fn hashes(&self) -> BTreeMap<String, Sha256> {
        self.files.iter().map(|(name, text)| (name.clone(), Sha256::of(text.as_bytes()))).collect()
    }

    /// Writes the files into a folder, which is made.
    ///
    /// # Errors
    /// Anything that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        let at = |path: &Path| {
            let path = path.display().to_string();
            move |source| Error::File { path, source }
        };
        std::fs::create_dir_all(folder).map_err(at(folder))?;
        for (name, text) in &self.files {
            let path = folder.join(name);
            std::fs::write(&path, text).map_err(at(&path))?;
        }
        Ok(())
    }
}

/// Whether a case has networks that other codes answer bond for bond.
pub fn has_networks(file: &SceneFile) -> bool {
    bond_for_bond::answers(&file.scene.procedure)
}

/// What a case gives a code: its networks, or the one body of its scene.
///
/// # Errors
/// A case without bodies, with several or with one of the other kind; what the solver refuses.
pub fn of(file: &SceneFile, code: Code) -> Result<Vec<Export>> {
    if has_networks(file) && code != Code::Calculix {
        let tasks = bond_for_bond::tasks(file, code)?;
        return tasks.iter().map(|task| network::of_task(file, code, task)).collect();
    }
    let model = build(file)?.model;
    let wanted = if code == Code::Calculix { "finite elements" } else { "particles" };
    let files = match (&model.parts[..], code) {
        ([Part::Continuum(body)], Code::Calculix) => mesh::files(body, &model),
        ([Part::Discrete { network, .. }], Code::Yade | Code::Lammps) => {
            network::of_scene(file, network, &model)?
        }
        (parts, _) => {
            let bodies: Vec<&str> = parts.iter().map(Part::name).collect();
            let message = format!(
                "{} takes one body of {wanted}; this case has {}",
                code.name(),
                if bodies.is_empty() {
                    "none".to_owned()
                } else {
                    format!("the bodies {}", bodies.join(", "))
                }
            );
            let mend = format!("leave one body of {wanted}, e.g. with --set bodies.NAME.enabled=false");
            return Err(file.error(Fault::new("bodies", message, mend)));
        }
    };
    Ok(vec![Export { case: file.scene.id.clone(), name: String::new(), code, files }])
}

/// `point,component,value`: components by name, `names[component]`. Values on one component add up.
fn point_values(model: &Model, values: &[PointValue], names: [&str; 6], what: &str) -> String {
    let plane = [names[0], names[1], names[5]];
    let name = |component: usize| match model.space.dim() {
        2 => plane[component],
        _ => names[component],
    };
    let mut text = format!("{what},component,value\n");
    for v in values {
        let _ = writeln!(text, "{},{},{:?}", v.point, name(v.component), v.value);
    }
    text
}

const DISPLACEMENTS: [&str; 6] = ["ux", "uy", "uz", "rx", "ry", "rz"];
const FORCES: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];
