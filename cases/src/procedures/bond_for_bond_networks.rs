//! The networks that other codes solve bond for bond: cantilevers, clamped at their left end, loaded at their right.

use super::Setting;
use crate::error::Result;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::Bonding;
use seam_solver::dem::grid::Boundary;
use seam_solver::dem::network::{Bonds, Network, Particles};
use seam_solver::dem::packing::{PackingRecipe, pack};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Ends are this share of the spacing deep: both kinds of rows of a staggered lattice, one layer of the others.
const END: f64 = 0.6;

/// What all networks of a case share.
pub struct Kit {
    spacing: f64,
    density: f64,
    /// Bond radius over half the spacing.
    ratio: f64,
    material: BondMaterial,
}

impl Kit {
    /// Reads the parameters of a case.
    pub fn new(setting: &Setting) -> Result<Self> {
        Ok(Kit {
            spacing: setting.number("spacing_m")?,
            density: setting.number("density_kg_m3")?,
            ratio: setting.number("radius_ratio")?,
            material: BondMaterial {
                young_pa: setting.number("young_Pa")?,
                poisson: setting.number("poisson")?,
            },
        })
    }

    /// Micro material of the bonds.
    pub fn material(&self) -> BondMaterial {
        self.material
    }

    /// Particles in one line.
    pub fn chain(&self, count: usize) -> Network {
        let sites = (0..count).map(|i| Vec3::new(i as f64, 0.0, 0.0));
        self.neighbours(Space::Plane, sites.collect(), 1.1)
    }

    /// Square lattice with both diagonals of every cell.
    pub fn square(&self, columns: usize, rows: usize) -> Network {
        let site = |k: usize| Vec3::new((k % columns) as f64, (k / columns) as f64, 0.0);
        self.neighbours(Space::Plane, (0..columns * rows).map(site).collect(), 1.5)
    }

    /// Triangular lattice, rows along x.
    pub fn triangular(&self, columns: usize, rows: usize) -> Network {
        let site = |k: usize| {
            let (i, j) = (k % columns, k / columns);
            Vec3::new(i as f64 + 0.5 * (j % 2) as f64, 0.75f64.sqrt() * j as f64, 0.0)
        };
        self.neighbours(Space::Plane, (0..columns * rows).map(site).collect(), 1.1)
    }

    /// The same, each particle moved by up to half of `share` spacings along each axis, so that no two bonds are alike.
    ///
    /// Moves follow the sequence `frac(k/p), frac(k/p²)` with the plastic number p (Roberts 2018): no seed, no two near each other.
    pub fn triangular_shaken(&self, columns: usize, rows: usize, share: f64) -> Network {
        const PLASTIC: f64 = 1.324_717_957_244_746;
        let mut network = self.triangular(columns, rows);
        let shift = |k: usize, ratio: f64| share * self.spacing * ((k as f64 / ratio).fract() - 0.5);
        for (k, x) in network.particles.position.iter_mut().enumerate() {
            x.x += shift(k, PLASTIC);
            x.y += shift(k, PLASTIC * PLASTIC);
        }
        self.bond(Space::Plane, network.particles.position, network.bonds.ends, 0.5 * self.spacing)
    }

    /// Hexagonal close packing: layers A, B, A … along z.
    pub fn hexagonal(&self, n: [usize; 3]) -> Network {
        let site = |s: usize| {
            let (i, j, k) = (s % n[0], s / n[0] % n[1], s / n[0] / n[1]);
            let aside = (k % 2) as f64;
            let x = i as f64 + 0.5 * ((j + k) % 2) as f64;
            Vec3::new(x, 0.75f64.sqrt() * (j as f64 + aside / 3.0), (2f64 / 3.0).sqrt() * k as f64)
        };
        self.neighbours(Space::Solid, (0..n.iter().product()).map(site).collect(), 1.1)
    }

    /// Random packing of equal spheres in a box of `lengths` spacings, bonded by ascending gap.
    pub fn random(&self, setting: &Setting, lengths: Vec3, coordination: f64) -> Result<Network> {
        let refuse = |e| setting.solver(e);
        let recipe = PackingRecipe {
            space: Space::Solid,
            block: Block::at_origin(Space::Solid, lengths * self.spacing).map_err(refuse)?,
            boundary: Boundary::Closed,
            mean_radius_m: 0.5 * self.spacing,
            solid_fraction: 0.64,
            radius_spread: 0.0,
            seed: setting.count("seed", 0)? as u64,
        };
        let arrangement = pack(&recipe, Matter::default()).map_err(refuse)?.arrangement;
        let pairs = Bonding::Coordination { z: coordination }.pairs(&arrangement).map_err(refuse)?;
        let radius = arrangement.particles.radius[0];
        let ends = pairs.iter().map(|pair| pair.ends).collect();
        Ok(self.bond(Space::Solid, arrangement.particles.position, ends, radius))
    }

    /// Sites in units of the spacing, bonded up to `reach` spacings.
    fn neighbours(&self, space: Space, sites: Vec<Vec3>, reach: f64) -> Network {
        let near = |i: usize, j: &usize| (sites[*j] - sites[i]).norm() < reach;
        let bonds_of = |i: usize| (i + 1..sites.len()).filter(move |j| near(i, j)).map(move |j| [i, j]);
        let ends = (0..sites.len()).flat_map(bonds_of).collect();
        let position = sites.iter().map(|x| x * self.spacing).collect();
        self.bond(space, position, ends, 0.5 * self.spacing)
    }

    /// Equal spheres, so that the contact point of every code is in the middle of the bond.
    fn bond(&self, space: Space, position: Vec<Vec3>, ends: Vec<[usize; 2]>, radius: f64) -> Network {
        let (count, mass) = (position.len(), self.density * 4.0 / 3.0 * PI * radius * radius * radius);
        let particles = Particles {
            position,
            radius: vec![radius; count],
            mass: vec![mass; count],
            inertia: vec![0.4 * mass * radius * radius; count],
        };
        let bond_radius = self.ratio * radius;
        let mut bonds = Bonds::default();
        for [i, j] in ends {
            let length = (particles.position[j] - particles.position[i]).norm();
            bonds.ends.push([i, j]);
            bonds.radius.push(bond_radius);
            bonds.stiffness.push(self.material.cylinder(bond_radius, length));
            bonds.weight.push(1.0);
        }
        Network { space, particles, bonds, faces: BTreeMap::new() }
    }

    /// Pulled along x: both ends clamped, the right one moved by one metre at load factor one.
    pub fn pulled(&self, network: Network) -> Model {
        let depth = END * self.spacing;
        let x = |p: usize| network.particles.position[p].x;
        let all = || 0..network.particles.len();
        let right = all().map(x).fold(f64::NEG_INFINITY, f64::max);
        let (space, per) = (network.space, network.space.dofs_per_particle());
        let grip = |p: usize| match x(p) {
            x if x < depth => Some(0.0),
            x if x > right - depth => Some(1.0),
            _ => None,
        };
        let components = |(point, pull): (usize, f64)| {
            let value = move |component| if component == 0 { pull } else { 0.0 };
            (0..per).map(move |component| PointValue { part: 0, point, component, value: value(component) })
        };
        let supports = all().filter_map(|p| Some((p, grip(p)?))).flat_map(components).collect();
        let body = Part::Discrete { name: "specimen".to_owned(), network };
        Model { space, parts: vec![body], ties: Vec::new(), supports, loads: Vec::new() }
    }

    /// The cantilever: left end clamped, `force` (N) spread evenly over the right end.
    pub fn cantilever(&self, network: Network, force: Vec3) -> Model {
        let x = |p: &usize| network.particles.position[*p].x;
        let all = || 0..network.particles.len();
        let right = all().map(|p| x(&p)).fold(f64::NEG_INFINITY, f64::max);
        let depth = END * self.spacing;
        let space = network.space;
        let value = |point, component, value| PointValue { part: 0, point, component, value };
        let end: Vec<usize> = all().filter(|p| x(p) > right - depth).collect();
        let supports = all()
            .filter(|p| x(p) < depth)
            .flat_map(|p| (0..space.dofs_per_particle()).map(move |c| value(p, c, 0.0)))
            .collect();
        let share = force / end.len() as f64;
        let loads = end
            .iter()
            .flat_map(|&p| (0..space.dim()).map(move |c| value(p, c, share[c])))
            .filter(|load| load.value != 0.0)
            .collect();
        let body = Part::Discrete { name: "cantilever".to_owned(), network };
        Model { space, parts: vec![body], ties: Vec::new(), supports, loads }
    }
}
