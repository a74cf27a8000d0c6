//! Bodies and models shared by the tests of the solver; no test uses all of them.
#![allow(dead_code)]

pub mod ramp;

use seam_solver::coupling::{Method, Multipliers, Tie};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};

pub const YOUNG: f64 = 3e7;

/// A box of finite elements without lateral contraction.
pub fn continuum(name: &str, space: Space, min: Vec3, max: Vec3, divisions: [usize; 3]) -> Continuum {
    let axes: Vec<Vec<f64>> =
        (0..space.dim()).map(|i| structured::even(min[i], max[i], divisions[i]).unwrap()).collect();
    let hypothesis = match space {
        Space::Plane => Hypothesis::PlaneStress { thickness_m: 0.5 },
        Space::Solid => Hypothesis::Solid,
    };
    Continuum {
        name: name.to_owned(),
        mesh: structured::grid(&axes).unwrap(),
        elasticity: Elasticity { young_pa: YOUNG, poisson: 0.0, density: 1.0 },
        hypothesis,
        formulation: Formulation::Incompatible,
    }
}

/// A box of square or simple cubic lattice with the same constants: `k_n = k_s` (that is `3 (r/L)² = 1`)
/// makes both isotropic with `E = k_n / t` (plane) or `k_n / a` (solid) and `ν = 0`.
pub fn cubic(space: Space, min: Vec3, max: Vec3, rows: usize, skin: Skin) -> Network {
    let (kind, thickness_m) = match space {
        Space::Plane => (LatticeKind::Square, 0.5),
        Space::Solid => (LatticeKind::SimpleCubic, 1.0),
    };
    let block = Block::new(space, min, max).unwrap();
    let l = lattice(kind, block, rows, Matter { density: 1.0, thickness_m }).unwrap();
    let a = 2.0 * l.arrangement.particles.radius[0];
    let ratio = 2.0 / 3f64.sqrt();
    let area = std::f64::consts::PI * (ratio * 0.5 * a).powi(2);
    let kn = match space {
        Space::Plane => YOUNG * thickness_m,
        Space::Solid => YOUNG * a,
    };
    let material = BondMaterial { young_pa: kn * a / area, poisson: 0.3 };
    let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin };
    bond_network(&l.arrangement, &l.pairs, &recipe).unwrap()
}

/// Three boxes in a row: elements, particles, elements.
pub struct Sandwich {
    pub space: Space,
    pub left: [usize; 3],
    pub rows: usize,
    pub right: [usize; 3],
    pub method: Method,
    pub multipliers: Multipliers,
    pub rotations: bool,
    pub skin: Skin,
}

impl Sandwich {
    pub fn plane(left: usize, rows: usize, right: usize, method: Method) -> Self {
        Sandwich {
            space: Space::Plane,
            left: [2, left, 0],
            rows,
            right: [3, right, 0],
            method,
            multipliers: Multipliers::Auto,
            rotations: false,
            skin: Skin::Weighted,
        }
    }

    pub fn solid(left: usize, rows: usize, right: usize, method: Method) -> Self {
        Sandwich {
            space: Space::Solid,
            left: [2, left, left],
            right: [3, right, right],
            ..Sandwich::plane(left, rows, right, method)
        }
    }

    /// Boxes of unit section and length one each, without supports or loads.
    pub fn model(&self) -> Model {
        let depth = if self.space == Space::Solid { 1.0 } else { 0.0 };
        let corner = |x: f64, upper: f64| Vec3::new(x, upper, upper * depth);
        let left = continuum("left", self.space, corner(0.0, 0.0), corner(1.0, 1.0), self.left);
        let right = continuum("right", self.space, corner(2.0, 0.0), corner(3.0, 1.0), self.right);
        let network = cubic(self.space, corner(1.0, 0.0), corner(2.0, 1.0), self.rows, self.skin);
        let tie = |first: usize, second: usize| Tie {
            name: format!("{first}-{second}"),
            first: (first, "right".to_owned()),
            second: (second, "left".to_owned()),
            method: self.method,
            multipliers: self.multipliers,
            rotations: self.rotations,
        };
        Model {
            space: self.space,
            parts: vec![
                Part::Continuum(left),
                Part::Discrete { name: "middle".to_owned(), network },
                Part::Continuum(right),
            ],
            ties: vec![tie(0, 1), tie(1, 2)],
            supports: Vec::new(),
            loads: Vec::new(),
        }
    }
}

/// Prescribes `field` on every node and particle for which `on` holds.
pub fn prescribe(model: &mut Model, on: impl Fn(&Vec3) -> bool, field: impl Fn(&Vec3) -> Vec3) {
    for (part, body) in model.parts.iter().enumerate() {
        for (point, x) in body.positions().iter().enumerate() {
            if on(x) {
                for component in 0..model.space.dim() {
                    model.supports.push(PointValue { part, point, component, value: field(x)[component] });
                }
            }
        }
    }
}
