//! Internal forces of all parts: a sparse matrix for elements, the bond kernel for particles.

use crate::dem::corotational::Corotational;
use crate::dem::kernel::Kernel;
use crate::dem::kernel::locality::{Detour, better_order, renumber};
use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::fem;
use crate::fem::continuum::Continuum;
use crate::model::{Model, Numbering, Part};
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::work::Work;
use nalgebra::UnitQuaternion;
use std::ops::Range;

/// How far particles may turn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Rotations {
    /// Small rotations: linear bonds.
    #[default]
    Small,
    /// Any angle: [`crate::dem::corotational`]. Particles only; the elements are linear.
    Finite,
}

/// Internal forces, part by part: `K u`, or the gradient of the energy of bonds under finite rotations.
///
/// Particles that are numbered without regard to where they are get a better order in here; nobody outside sees it.
#[derive(Debug, Clone)]
pub struct InternalForces {
    parts: Vec<ElasticPart>,
    /// Element and bond updates of one evaluation.
    per_call: Work,
}

#[derive(Debug, Clone)]
struct ElasticPart {
    unknowns: Range<usize>,
    elastic: Elastic,
    /// To the order that `elastic` is in, if it is not the public one.
    detour: Option<Detour>,
}

#[derive(Debug, Clone)]
enum Elastic {
    Elements(SymmetricMatrix),
    Bonds(Kernel),
    Turning(Corotational),
}

impl Elastic {
    fn add(&self, u: &[f64], f: &mut [f64]) {
        match self {
            Elastic::Elements(k) => k.multiply_add(u, f),
            Elastic::Bonds(kernel) => kernel.add_internal(u, f),
            Elastic::Turning(bonds) => bonds.add_internal(u, f),
        }
    }
}

impl InternalForces {
    /// Prepares all parts of a model.
    ///
    /// # Errors
    /// Bad elements or bonds; finite rotations asked of a model with finite elements.
    pub fn new(model: &Model, numbering: &Numbering, rotations: Rotations) -> Result<Self> {
        let mut forces = InternalForces { parts: Vec::new(), per_call: Work::default() };
        for (p, part) in model.parts.iter().enumerate() {
            let first = numbering.offset(p);
            let unknowns = first..first + part.dofs_per_point() * part.positions().len();
            let mut detour = None;
            let elastic = match part {
                Part::Continuum(body) if rotations == Rotations::Finite => {
                    let message = "its elements know small strains and rotations only; \
                                   take small rotations, or replace it by particles";
                    return Err(Error::Formulation { body: body.name.clone(), message: message.to_owned() });
                }
                Part::Continuum(body) => {
                    forces.per_call.element_updates += body.mesh.cell_count() as u64;
                    Elastic::Elements(stiffness(body)?)
                }
                Part::Discrete { name, network } => {
                    let order = better_order(network, name)?;
                    let renumbered = order.as_ref().map(|order| renumber(network, order));
                    let local = renumbered.as_ref().unwrap_or(network);
                    let elastic = match rotations {
                        Rotations::Small => Elastic::Bonds(Kernel::new(local, name)?),
                        Rotations::Finite => Elastic::Turning(Corotational::new(local, name)?),
                    };
                    detour = order.map(|order| Detour::new(order, part.dofs_per_point()));
                    forces.per_call.bond_updates +=
                        network.bonds.weight.iter().filter(|w| **w > 0.0).count() as u64;
                    elastic
                }
            };
            forces.parts.push(ElasticPart { unknowns, elastic, detour });
        }
        Ok(forces)
    }

    /// `f += f_int(u)`, in N and N m.
    pub fn add(&self, u: &[f64], f: &mut [f64], work: &mut Work) {
        *work += self.per_call;
        for ElasticPart { unknowns, elastic, detour } in &self.parts {
            let (u, f) = (&u[unknowns.clone()], &mut f[unknowns.clone()]);
            match detour {
                None => elastic.add(u, f),
                Some(detour) => detour.add(u, f, |u, f| elastic.add(u, f)),
            }
        }
    }

    /// Gives a bond of a part under small rotations the weight that it has in `network`.
    pub fn set_weight(&mut self, part: usize, network: &Network, bond: usize) {
        let ElasticPart { elastic: Elastic::Bonds(kernel), detour, .. } = &mut self.parts[part] else {
            return;
        };
        let place = |p: usize| detour.as_ref().map_or(p, |detour| detour.place(p));
        kernel.set_weight(network, bond, network.bonds.ends[bond].map(place));
    }

    /// Strain energy (J) at `u`, where the internal forces are `f`.
    pub fn energy(&self, u: &[f64], f: &[f64]) -> f64 {
        let of_part = |ElasticPart { unknowns, elastic, detour }: &ElasticPart| {
            let (u, f) = (&u[unknowns.clone()], &f[unknowns.clone()]);
            match (elastic, detour) {
                (Elastic::Turning(bonds), None) => bonds.energy(u),
                (Elastic::Turning(bonds), Some(detour)) => detour.read(u, |u| bonds.energy(u)),
                (Elastic::Elements(_) | Elastic::Bonds(_), _) => {
                    0.5 * u.iter().zip(f).map(|(u, f)| u * f).sum::<f64>()
                }
            }
        };
        self.parts.iter().map(of_part).sum()
    }

    /// Turns the particles that keep an orientation by `dt · v`.
    pub fn turn(&mut self, v: &[f64], dt: f64) {
        for ElasticPart { unknowns, elastic, detour } in &mut self.parts {
            let (Elastic::Turning(bonds), v) = (elastic, &v[unknowns.clone()]) else { continue };
            match detour {
                None => bonds.turn(v, dt),
                Some(detour) => detour.read(v, |v| bonds.turn(v, dt)),
            }
        }
    }

    /// Orientations of all particles that keep one, part after part, in the order in here.
    pub(super) fn orientations(&self) -> impl Iterator<Item = &UnitQuaternion<f64>> {
        self.parts.iter().flat_map(|part| match &part.elastic {
            Elastic::Turning(bonds) => bonds.orientations(),
            Elastic::Elements(_) | Elastic::Bonds(_) => &[],
        })
    }

    /// Puts back what [`InternalForces::orientations`] gave.
    pub(super) fn set_orientations(&mut self, mut all: Vec<UnitQuaternion<f64>>) {
        for part in &mut self.parts {
            if let Elastic::Turning(bonds) = &mut part.elastic {
                let later = all.split_off(bonds.orientations().len());
                bonds.set_orientations(all);
                all = later;
            }
        }
    }
}

fn stiffness(body: &Continuum) -> Result<SymmetricMatrix> {
    let mut triplets = Triplets::default();
    fem::assembly::for_each_stiffness(body, |dofs, k| triplets.push_block(0, dofs, k))?;
    Ok(SymmetricMatrix::from_triplets(body.dof_count(), &triplets))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::block::Block;
    use crate::dem::bond::BondMaterial;
    use crate::dem::bonding::{BondRecipe, bond_network};
    use crate::dem::kernel::locality::order;
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;
    use crate::space::Vec3;
    use rand::SeedableRng;
    use rand::seq::SliceRandom;
    use rand_chacha::ChaCha8Rng;

    fn forces(network: &Network, rotations: Rotations) -> InternalForces {
        let part = Part::Discrete { name: "b".to_owned(), network: network.clone() };
        let model = Model {
            space: network.space,
            parts: vec![part],
            ties: Vec::new(),
            supports: Vec::new(),
            loads: Vec::new(),
        };
        InternalForces::new(&model, &Numbering::new(&model), rotations).unwrap()
    }

    /// Particles numbered at random take a detour, those in order none, and both feel the same.
    #[test]
    fn a_better_order_inside_changes_nothing_outside() {
        let block = Block::at_origin(LatticeKind::Triangular.space(), Vec3::new(2.0, 1.0, 0.0)).unwrap();
        let l = lattice(LatticeKind::Triangular, block, 90, Matter::default()).unwrap();
        let recipe = BondRecipe {
            material: BondMaterial { young_pa: 1.0, poisson: 0.3 },
            section: Section::Uniform { ratio: 0.6 },
            skin: Skin::Weighted,
        };
        let network = bond_network(&l.arrangement, &l.pairs, &recipe).unwrap();
        let ordered = renumber(&network, &order(&network));
        let count = ordered.particles.len();
        assert!(count > 10_000, "{count}");
        let mut shuffle: Vec<usize> = (0..count).collect();
        shuffle.shuffle(&mut ChaCha8Rng::seed_from_u64(3));
        let shuffled = renumber(&ordered, &shuffle);
        let u: Vec<f64> = (0..3 * count).map(|i| 1e-4 * (0.3 * i as f64).sin()).collect();
        let mixed =
            |x: &[f64]| -> Vec<f64> { shuffle.iter().flat_map(|&p| x[3 * p..3 * p + 3].to_vec()).collect() };
        for rotations in [Rotations::Small, Rotations::Finite] {
            let evaluate = |network: &Network, u: &[f64], detour: bool| {
                let mut forces = forces(network, rotations);
                assert_eq!(forces.parts[0].detour.is_some(), detour);
                forces.turn(u, 1.0);
                let mut f = vec![0.0; u.len()];
                forces.add(u, &mut f, &mut Work::default());
                let energy = forces.energy(u, &f);
                (f, energy)
            };
            let (f, energy) = evaluate(&ordered, &u, false);
            let (g, other) = evaluate(&shuffled, &mixed(&u), true);
            let scale = f.iter().fold(0.0f64, |m, f| m.max(f.abs()));
            let off = mixed(&f).iter().zip(&g).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            // The same few terms in another order; finite rotations round at unit directions, four digits above the strain.
            assert!(off < 1e-11 * scale, "{rotations:?}: {off:e} of {scale:e}");
            // Sums over 30 000 bonds in another order.
            assert!((other / energy - 1.0).abs() < 1e-10, "{rotations:?}: {other} {energy}");
        }
    }
}
