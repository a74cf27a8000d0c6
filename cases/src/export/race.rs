//! A network and a mesh of any size, to measure codes side by side.

use super::{Code, Export, mesh, network};
use crate::error::{Error, Result};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::network::Network;
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::critical;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::{even, grid};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use std::f64::consts::TAU;
use std::fmt::Write;

/// Distance of neighbours in the network, in m.
const SPACING: f64 = 0.02;
/// Share of the critical step: every code is stable.
const STEP_SHARE: f64 = 0.8;
/// A particle moves by about this share of a side: far enough for LAMMPS's angles, near enough for linear bonds.
const MOVE: f64 = 1e-4;

/// A free cube of a face-centred cubic lattice, and the velocities half a step before it starts, in m/s.
pub struct Vibrating {
    /// The network.
    pub network: Network,
    /// Time step, in s.
    pub step_s: f64,
    /// Velocities, particle by particle.
    pub velocity: Vec<Vec3>,
}

/// About `particles` particles that go through a bending wave in `steps` steps.
///
/// # Errors
/// Too few particles for a lattice.
pub fn vibrating(particles: usize, steps: usize) -> Result<Vibrating> {
    build_network(particles, steps).map_err(refuse)
}

fn refuse(source: seam_solver::error::Error) -> Error {
    Error::Solver { case: "race".to_owned(), source }
}

fn build_network(particles: usize, steps: usize) -> seam_solver::error::Result<Vibrating> {
    // Four particles per cell, and neighbours along half a face diagonal.
    let rows = (particles as f64 / 4.0).cbrt().round().max(2.0);
    let side = rows * SPACING * 2f64.sqrt();
    let block = Block::at_origin(Space::Solid, Vec3::repeat(side))?;
    let matter = Matter { density: 2600.0, thickness_m: 1.0 };
    let lattice = lattice(LatticeKind::FaceCentredCubic, block, rows as usize, matter)?;
    let recipe = BondRecipe {
        material: BondMaterial { young_pa: 1e9, poisson: 0.25 },
        section: Section::Uniform { ratio: 0.5 },
        skin: Skin::Full,
    };
    let mut network = bond_network(&lattice.arrangement, &lattice.pairs, &recipe)?;
    // Equal masses: the mass of a sphere is what LAMMPS keeps, and its cells would be halved in the faces.
    let p = &mut network.particles;
    let mass = p.mass.iter().copied().fold(0.0, f64::max);
    p.inertia = p.radius.iter().map(|r| 0.4 * mass * r * r).collect();
    p.mass.fill(mass);
    let model = free(network.clone());
    let step_s = STEP_SHARE * critical::bound(&model)?.step_s;
    let speed = MOVE * side / (step_s * steps as f64);
    let wave =
        |x: &Vec3| Vec3::new(0.0, speed * (TAU * x.x / side).cos(), 0.5 * speed * (TAU * x.y / side).cos());
    let velocity = network.particles.position.iter().map(wave).collect();
    Ok(Vibrating { network, step_s, velocity })
}

fn free(network: Network) -> Model {
    let body = Part::Discrete { name: "cube".to_owned(), network };
    Model {
        space: Space::Solid,
        parts: vec![body],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    }
}

impl Vibrating {
    /// The same for another code.
    pub fn export(&self, code: Code, steps: usize) -> Export {
        let run = format!("motion = \"free\"\nstep_s = {:?}\nsteps = {steps}\n", self.step_s);
        let mut files = network::free(&self.network, &free(self.network.clone()), &run);
        let mut text = String::from("particle,vx,vy,vz\n");
        for (k, v) in self.velocity.iter().enumerate() {
            let _ = writeln!(text, "{k},{:?},{:?},{:?}", v.x, v.y, v.z);
        }
        files.insert("velocities.csv".to_owned(), text);
        Export { case: "race".to_owned(), name: "network".to_owned(), code, files }
    }
}

/// A bar of about `nodes` nodes of plain hexahedra, clamped at x = 0 and loaded at its other end.
///
/// # Errors
/// Nothing that a user could cause.
pub fn clamped_bar(nodes: usize) -> Result<Model> {
    build_bar(nodes).map_err(refuse)
}

fn build_bar(nodes: usize) -> seam_solver::error::Result<Model> {
    let across = (nodes as f64 / 2.0).cbrt().round().max(2.0) as usize;
    let axes = [even(0.0, 2.0, 2 * across)?, even(0.0, 1.0, across)?, even(0.0, 1.0, across)?];
    let mesh = grid(&axes)?;
    let value = |point, component, value| PointValue { part: 0, point, component, value };
    let on = |name: &str| mesh.boundary_nodes(name).unwrap_or_default();
    let end = on("right");
    let force = -1e6 / end.len() as f64;
    let supports = on("left").into_iter().flat_map(|k| (0..3).map(move |i| value(k, i, 0.0))).collect();
    let loads = end.into_iter().map(|k| value(k, 1, force)).collect();
    let elasticity = Elasticity { young_pa: 70e9, poisson: 0.3, density: 2700.0 };
    let body = Continuum {
        name: "bar".to_owned(),
        mesh,
        elasticity,
        hypothesis: Hypothesis::Solid,
        formulation: Formulation::Plain,
    };
    let parts = vec![Part::Continuum(body)];
    Ok(Model { space: Space::Solid, parts, ties: Vec::new(), supports, loads })
}

/// The bar for CalculiX.
pub fn export_bar(model: &Model) -> Export {
    let files = match &model.parts[..] {
        [Part::Continuum(body)] => mesh::files(body, model),
        _ => Default::default(),
    };
    Export { case: "race".to_owned(), name: "mesh".to_owned(), code: Code::Calculix, files }
}
