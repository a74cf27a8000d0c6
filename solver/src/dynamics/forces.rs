//! Internal forces of all parts: a sparse matrix for elements, the bond kernel for particles.

use crate::dem::corotational::Corotational;
use crate::dem::kernel::Kernel;
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
#[derive(Debug, Clone)]
pub struct InternalForces {
    parts: Vec<(Range<usize>, Elastic)>,
    /// Element and bond updates of one evaluation.
    per_call: Work,
}

#[derive(Debug, Clone)]
enum Elastic {
    Elements(SymmetricMatrix),
    Bonds(Kernel),
    Turning(Corotational),
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
                    let elastic = match rotations {
                        Rotations::Small => Elastic::Bonds(Kernel::new(network, name)?),
                        Rotations::Finite => Elastic::Turning(Corotational::new(network, name)?),
                    };
                    forces.per_call.bond_updates +=
                        network.bonds.weight.iter().filter(|w| **w > 0.0).count() as u64;
                    elastic
                }
            };
            forces.parts.push((unknowns, elastic));
        }
        Ok(forces)
    }

    /// `f += f_int(u)`, in N and N m.
    pub fn add(&self, u: &[f64], f: &mut [f64], work: &mut Work) {
        *work += self.per_call;
        for (unknowns, elastic) in &self.parts {
            let (u, f) = (&u[unknowns.clone()], &mut f[unknowns.clone()]);
            match elastic {
                Elastic::Elements(k) => k.multiply_add(u, f),
                Elastic::Bonds(kernel) => kernel.add_internal(u, f),
                Elastic::Turning(bonds) => bonds.add_internal(u, f),
            }
        }
    }

    /// Strain energy (J) at `u`, where the internal forces are `f`.
    pub fn energy(&self, u: &[f64], f: &[f64]) -> f64 {
        let of_part = |(unknowns, elastic): &(Range<usize>, Elastic)| {
            let (u, f) = (&u[unknowns.clone()], &f[unknowns.clone()]);
            match elastic {
                Elastic::Turning(bonds) => bonds.energy(u),
                Elastic::Elements(_) | Elastic::Bonds(_) => {
                    0.5 * u.iter().zip(f).map(|(u, f)| u * f).sum::<f64>()
                }
            }
        };
        self.parts.iter().map(of_part).sum()
    }

    /// Turns the particles that keep an orientation by `dt · v`.
    pub fn turn(&mut self, v: &[f64], dt: f64) {
        for (unknowns, elastic) in &mut self.parts {
            if let Elastic::Turning(bonds) = elastic {
                bonds.turn(&v[unknowns.clone()], dt);
            }
        }
    }

    /// Orientations of all particles that keep one, part after part.
    pub(super) fn orientations(&self) -> impl Iterator<Item = &UnitQuaternion<f64>> {
        self.parts.iter().flat_map(|(_, elastic)| match elastic {
            Elastic::Turning(bonds) => bonds.orientations(),
            Elastic::Elements(_) | Elastic::Bonds(_) => &[],
        })
    }

    /// Puts back what [`InternalForces::orientations`] gave.
    pub(super) fn set_orientations(&mut self, mut all: Vec<UnitQuaternion<f64>>) {
        for (_, elastic) in &mut self.parts {
            if let Elastic::Turning(bonds) = elastic {
                let later = all.split_off(bonds.orientations().len());
                bonds.set_orientations(all);
                all = later;
            }
        }
    }
}

fn stiffness(body: &Continuum) -> Result<SymmetricMatrix> {
    let mut triplets = Triplets::default();
    fem::assembly::for_each_stiffness(body, |dofs, k| triplets.push_block(dofs, k))?;
    Ok(SymmetricMatrix::from_triplets(body.dof_count(), &triplets))
}
