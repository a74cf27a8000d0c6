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
use crate::procedures::{bond_for_bond, breaking_bonds};
use crate::result::ReferenceKind;
use crate::study::variants as variants_of;
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

    /// The code that references of a kind come from; `None` where there is none.
    pub const fn of(kind: ReferenceKind) -> Option<Code> {
        match kind {
            ReferenceKind::Yade => Some(Code::Yade),
            ReferenceKind::Lammps => Some(Code::Lammps),
            ReferenceKind::Calculix => Some(Code::Calculix),
            _ => None,
        }
    }

    /// The kind of references that it makes.
    pub const fn kind(self) -> ReferenceKind {
        match self {
            Code::Yade => ReferenceKind::Yade,
            Code::Lammps => ReferenceKind::Lammps,
            Code::Calculix => ReferenceKind::Calculix,
        }
    }

    /// Name as it is written.
    pub const fn title(self) -> &'static str {
        match self {
            Code::Yade => "YADE",
            Code::Lammps => "LAMMPS",
            Code::Calculix => "CalculiX",
        }
    }

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

/// Whether a case has networks that a code answers: those of its procedure, or peers.
pub fn has_networks(file: &SceneFile, code: Code) -> bool {
    let procedure = &file.scene.procedure;
    let answers = match code {
        Code::Yade => bond_for_bond::answers(procedure) || breaking_bonds::answers(procedure),
        Code::Lammps => bond_for_bond::answers(procedure),
        Code::Calculix => return false,
    };
    answers || peers(file, code).next().is_some()
}

/// Peers of a scene that a code was given.
fn peers(file: &SceneFile, code: Code) -> impl Iterator<Item = &String> {
    file.scene.peers.iter().filter(move |(_, peer)| peer.code == code.kind()).map(|(name, _)| name)
}

/// What a code is given for a peer of a scene.
///
/// # Errors
/// Variants that are not one body of particles, motions that no generator knows, what the solver refuses.
pub fn of_peer(file: &SceneFile, name: &str, code: Code) -> Result<Export> {
    let variants = &file.scene.peers[name].variants;
    let variant = file.with(&variants_of(file, variants))?;
    let model = build(&variant)?.model;
    let [Part::Discrete { network, .. }] = &model.parts[..] else {
        let mend = "name variants that leave one body of particles";
        let key = format!("peers.{name}.variants");
        return Err(file.error(Fault::new(key, "its scene is not one body of particles", mend)));
    };
    let files = network::of_peer(&variant, network, &model)?;
    Ok(Export { case: file.scene.id.clone(), name: name.to_owned(), code, files })
}

/// What a case gives a code: its networks, the one body of its scene, or its peers.
///
/// # Errors
/// A case without bodies, with several or with one of the other kind; what the solver refuses.
pub fn of(file: &SceneFile, code: Code) -> Result<Vec<Export>> {
    if bond_for_bond::answers(&file.scene.procedure) && code != Code::Calculix {
        let tasks = bond_for_bond::tasks(file, code)?;
        return tasks.iter().map(|task| network::of_task(file, code, task)).collect();
    }
    if breaking_bonds::answers(&file.scene.procedure) && code == Code::Yade {
        return Ok(vec![network::of_specimen(file, &breaking_bonds::specimen(file)?)?]);
    }
    let model = build(file)?.model;
    let wanted = if code == Code::Calculix { "finite elements" } else { "particles" };
    let files = match (&model.parts[..], code) {
        ([Part::Continuum(body)], Code::Calculix) => mesh::files(body, &model),
        ([Part::Discrete { network, .. }], Code::Yade | Code::Lammps) => {
            network::of_scene(file, network, &model)?
        }
        _ if has_networks(file, code) => {
            return peers(file, code).map(|name| of_peer(file, name, code)).collect();
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
