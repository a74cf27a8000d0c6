//! The histories of a run: what the probes read at every output, and the energies.

use super::bond_stress;
use super::curve::Curve;
use super::field::Field;
use super::probes::{Moment, Observer};
use super::supports::Supports;
use crate::error::Result;
use crate::file::SceneFile;
use crate::scene::probe::{Probe, Read, Where};
use seam_solver::model::{Model, Part};
use seam_solver::simulation::{Energies, Snapshot};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Writes down every output of a run.
pub struct Recorder<'a> {
    file: &'a SceneFile,
    probes: Vec<(&'a String, &'a Probe)>,
    supports: Supports,
    /// What was written down.
    pub histories: Histories,
}

/// What a run has shown so far.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Histories {
    /// One per probe that gives a history.
    pub curves: BTreeMap<String, Curve>,
    /// Time (s) and energies of each output.
    pub energies: Vec<(f64, Energies)>,
    /// Forces of supports and ties at the last output, in N and N m.
    pub reactions: Vec<f64>,
}

impl<'a> Recorder<'a> {
    /// Nothing yet.
    pub fn new(file: &'a SceneFile, supports: Supports) -> Self {
        let probes: Vec<(&String, &Probe)> =
            file.scene.probes.iter().filter(|(_, probe)| probe.is_history()).collect();
        let curves = probes.iter().map(|(name, _)| ((*name).clone(), Curve::history())).collect();
        Self { file, probes, supports, histories: Histories { curves, ..Histories::default() } }
    }

    /// Reads one output. A second one at the same time takes the place of the first.
    ///
    /// # Errors
    /// A point outside of all bodies.
    pub fn watch(&mut self, snapshot: &Snapshot) -> Result<()> {
        let histories = &mut self.histories;
        let time = snapshot.state.time;
        let again = histories.energies.last().is_some_and(|(last, _)| *last >= time);
        if again {
            histories.energies.pop();
        }
        histories.energies.push((time, snapshot.energies));
        self.supports.follow(snapshot.model, snapshot.switches);
        histories.reactions = snapshot.reactions.to_vec();
        // Finding points in meshes is prepared only where a probe asks for it.
        let at_places = self.probes.iter().any(|(_, probe)| probe.read.place() == Where::Place);
        let field = at_places.then(|| Field::new(snapshot.model, &snapshot.state.u));
        for (name, probe) in &self.probes {
            let value = match (probe.read.place(), &field) {
                (Where::Place | Where::Support, field) => {
                    let moment = Moment {
                        field: field.as_ref(),
                        strain: snapshot.energies.strain,
                        reactions: snapshot.reactions,
                        supports: &self.supports,
                    };
                    Observer { file: self.file, moment: &moment, name, probe }.now()?
                }
                _ => of_run(probe.read, snapshot),
            };
            if let Some(curve) = histories.curves.get_mut(*name) {
                if again {
                    curve.x.pop();
                    curve.y.pop();
                }
                curve.x.push(time);
                curve.y.push(value);
            }
        }
        Ok(())
    }

    /// The supports as they are now.
    pub fn supports(&self) -> &Supports {
        &self.supports
    }
}

/// What is read off the whole run.
fn of_run(read: Read, snapshot: &Snapshot) -> f64 {
    match read {
        Read::StrainEnergy => snapshot.energies.strain,
        Read::KineticEnergy => snapshot.energies.kinetic,
        Read::ExternalWork => snapshot.energies.external,
        Read::EnergyClosure => snapshot.energies.closure(),
        Read::Gap => snapshot.gap,
        Read::LoadFactor => snapshot.factor,
        Read::LargestBondStress => bond_stress::largest(snapshot.model, &snapshot.state.u),
        Read::Losses => snapshot.losses() as f64,
        Read::FractureWork => -snapshot.energies.fracture,
        Read::ContactWork => -snapshot.energies.contact,
        Read::Particles => particles(snapshot.model) as f64,
        _ => f64::NAN,
    }
}

/// Number of particles of all bodies.
fn particles(model: &Model) -> usize {
    let discrete = model.parts.iter().filter(|part| matches!(part, Part::Discrete { .. }));
    discrete.map(|part| part.positions().len()).sum()
}
