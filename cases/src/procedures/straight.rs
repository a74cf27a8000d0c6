//! Straight bodies that several procedures share: chains of particles and bars of elements along x.

use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::error::Result;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::{even, grid};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};

/// Equal bonds between equal particles. The particles at the ends have half the mass and inertia, as lumped linear
/// elements have it.
#[derive(Debug, Clone, Copy)]
pub struct Chain {
    /// Number of bonds; one particle more.
    pub bonds: usize,
    /// Length of a bond, in m.
    pub spacing: f64,
    /// Of each bond.
    pub stiffness: BondStiffness,
    /// Of an inner particle, in kg.
    pub mass: f64,
    /// Of an inner particle, in kg m².
    pub inertia: f64,
}

impl Chain {
    /// A plane network with its first particle at `start`, and the faces `left` and `right`.
    pub fn network(&self, start: Vec3) -> Network {
        let n = self.bonds;
        let share = |i: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
        let radius = 0.5 * self.spacing;
        Network {
            space: Space::Plane,
            particles: Particles {
                position: (0..=n).map(|i| start + Vec3::x() * (i as f64 * self.spacing)).collect(),
                radius: vec![radius; n + 1],
                mass: (0..=n).map(|i| share(i) * self.mass).collect(),
                inertia: (0..=n).map(|i| share(i) * self.inertia).collect(),
            },
            bonds: Bonds {
                ends: (0..n).map(|i| [i, i + 1]).collect(),
                radius: vec![radius; n],
                stiffness: vec![self.stiffness; n],
                weight: vec![1.0; n],
            },
            faces: [("left".to_owned(), vec![0]), ("right".to_owned(), vec![n])].into(),
        }
    }

    /// The same as a body.
    pub fn part(&self) -> Part {
        Part::Discrete { name: "chain".to_owned(), network: self.network(Vec3::zeros()) }
    }
}

/// Elements in plane stress that fill the rectangle from `from` to `to`.
///
/// # Errors
/// A rectangle or divisions that give no grid.
pub fn rectangle(
    name: &str,
    [from, to]: [Vec3; 2],
    divisions: [usize; 2],
    elasticity: Elasticity,
    thickness_m: f64,
    formulation: Formulation,
) -> Result<Continuum> {
    let lines = [even(from.x, to.x, divisions[0])?, even(from.y, to.y, divisions[1])?];
    Ok(Continuum {
        name: name.to_owned(),
        mesh: grid(&lines)?,
        elasticity,
        hypothesis: Hypothesis::PlaneStress { thickness_m },
        formulation,
    })
}

/// A plane model without ties, supports and loads.
pub fn plane(parts: Vec<Part>) -> Model {
    Model { space: Space::Plane, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() }
}

/// Holds all components from `first` on of every point for which `on` holds.
pub fn hold(model: &mut Model, first: usize, on: impl Fn(&Vec3) -> bool) {
    for (part, body) in model.parts.iter().enumerate() {
        for (point, _) in body.positions().iter().enumerate().filter(|(_, x)| on(x)) {
            for component in first..body.dofs_per_point() {
                model.supports.push(PointValue { part, point, component, value: 0.0 });
            }
        }
    }
}
