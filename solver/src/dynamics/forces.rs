//! Internal forces of all parts: a sparse matrix for elements, the bond kernel for particles.

use crate::dem::kernel::Kernel;
use crate::error::Result;
use crate::fem;
use crate::fem::continuum::Continuum;
use crate::model::{Model, Numbering, Part};
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::work::Work;
use std::ops::Range;

/// `K u`, part by part.
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
}

impl InternalForces {
    /// Prepares all parts of a model.
    ///
    /// # Errors
    /// Bad elements or bonds.
    pub fn new(model: &Model, numbering: &Numbering) -> Result<Self> {
        let mut forces = InternalForces { parts: Vec::new(), per_call: Work::default() };
        for (p, part) in model.parts.iter().enumerate() {
            let first = numbering.offset(p);
            let unknowns = first..first + part.dofs_per_point() * part.positions().len();
            let elastic = match part {
                Part::Continuum(body) => {
                    forces.per_call.element_updates += body.mesh.cell_count() as u64;
                    Elastic::Elements(stiffness(body)?)
                }
                Part::Discrete { name, network } => {
                    let kernel = Kernel::new(network, name)?;
                    forces.per_call.bond_updates += kernel.bond_count() as u64;
                    Elastic::Bonds(kernel)
                }
            };
            forces.parts.push((unknowns, elastic));
        }
        Ok(forces)
    }

    /// `f += K u`, in N and N m.
    pub fn add(&self, u: &[f64], f: &mut [f64], work: &mut Work) {
        *work += self.per_call;
        for (unknowns, elastic) in &self.parts {
            let (u, f) = (&u[unknowns.clone()], &mut f[unknowns.clone()]);
            match elastic {
                Elastic::Elements(k) => k.multiply_add(u, f),
                Elastic::Bonds(kernel) => kernel.add_internal(u, f),
            }
        }
    }
}

fn stiffness(body: &Continuum) -> Result<SymmetricMatrix> {
    let mut triplets = Triplets::default();
    fem::assembly::for_each_stiffness(body, |dofs, k| triplets.push_block(dofs, k))?;
    Ok(SymmetricMatrix::from_triplets(body.dof_count(), &triplets))
}
