//! The step in size in the plane, for information: a triangular lattice meets elements twice as high as its rows.
//!
//! A strip between mirrors, four rows of the lattice or two elements high, tied by a mortar. A wave of pressure (`u_x`, mirrors
//! hold `u_y`) or of shear (`u_y` with `θ = ½ ∂u_y/∂x`, mirrors hold `u_x`) arrives at right angles. Unlike the chain, the
//! lattice has two sublattices, its particles turn, and rotations are not tied: there is no closed form to judge by.

use super::Setting;
use super::straight::{plane, rectangle};
use crate::error::Result;
use rayon::prelude::*;
use seam_solver::coupling::{Method, Multipliers, Tie};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::dem::calibration::stretched;
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::{State, critical};
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Numbering, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;
use std::f64::consts::TAU;

/// Rows of the lattice across the strip, at 1 m; elements are twice as high.
const ROWS: usize = 4;
/// Length of the two sides, place of pulse and station, and the end, in widths of the pulse, as for the chains.
const FINE: f64 = 20.0;
const PULSE: f64 = 10.0;
const STATION: f64 = 5.0;
const COARSE: f64 = 6.0;
const END: f64 = 20.0;

/// A kind of wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wave {
    /// Along its way.
    Pressure,
    /// Across it.
    Shear,
}

impl Wave {
    /// The component that moves.
    fn component(self) -> usize {
        usize::from(self == Wave::Shear)
    }
}

/// |R| at wavelengths over the height of an element, and the work.
pub fn measure(setting: &Setting, wave: Wave, lengths: &[f64]) -> Result<(Vec<f64>, Work)> {
    let elasticity = Elasticity {
        young_pa: setting.number("young_Pa")?,
        poisson: setting.number("plane_poisson")?,
        density: setting.number("density_kg_m3")?,
    };
    let share = setting.number("courant")?;
    let all = lengths
        .par_iter()
        .map(|length| one(&elasticity, wave, 2.0 * length, share))
        .collect::<seam_solver::error::Result<Vec<_>>>()
        .map_err(|e| setting.solver(e))?;
    let mut work = Work::default();
    all.iter().for_each(|(_, done)| work += *done);
    Ok((all.into_iter().map(|(r, _)| r).collect(), work))
}

/// A pulse as wide as its wavelength (m), at a share of the critical step.
fn one(
    elasticity: &Elasticity,
    wave: Wave,
    wavelength: f64,
    share: f64,
) -> seam_solver::error::Result<(f64, Work)> {
    let Elasticity { young_pa: e, poisson: nu, density } = *elasticity;
    // Plane stress: E/(1−ν²) and G.
    let modulus = if wave == Wave::Pressure { e / (1.0 - nu * nu) } else { 0.5 * e / (1.0 + nu) };
    let (speed, width) = ((modulus / density).sqrt(), wavelength);
    let model = strip(elasticity, wave, [FINE * width, COARSE * width])?;
    let numbering = Numbering::new(&model);
    let mut start = State::at_rest(numbering.len());
    let (k, centre) = (TAU / wavelength, -PULSE * width);
    let mut station = (f64::INFINITY, 0);
    for (part, body) in model.parts.iter().enumerate() {
        for (point, x) in body.positions().iter().enumerate() {
            // u = exp(−s²/2) cos(kx − ωt), s = (x − ct)/width, and its derivatives along x.
            let s = (x.x - centre) / width;
            let (sin, cos) = (k * (x.x - centre)).sin_cos();
            let envelope = (-0.5 * s * s).exp();
            let slope = -envelope * (s / width * cos + k * sin);
            let bend =
                envelope * ((s * s - 1.0) / width.powi(2) * cos + 2.0 * s / width * k * sin - k * k * cos);
            let i = numbering.unknown(part, point, wave.component());
            (start.u[i], start.v[i]) = (envelope * cos, -speed * slope);
            if wave == Wave::Shear && body.dofs_per_point() == 3 {
                let turn = numbering.unknown(part, point, 2);
                (start.u[turn], start.v[turn]) = (0.5 * slope, -0.5 * speed * bend);
            }
            let off = (x - Vec3::new(-STATION * width, 0.5 * ROWS as f64, 0.0)).norm();
            if off < station.0 {
                station = (off, i);
            }
        }
    }
    let step_s = share * critical::bound(&model)?.step_s;
    let mut run = Explicit::new(&model, Options { step_s, ..Options::default() }, &start)?;
    let (omega, end) = (speed * k, END * width / speed);
    let mut amplitudes = [[0.0; 2]; 2];
    while run.time() < end {
        run.advance(1)?;
        let which = usize::from(run.time() > 0.5 * end);
        let (sin, cos) = (omega * run.time()).sin_cos();
        amplitudes[which][0] += run.u()[station.1] * cos;
        amplitudes[which][1] += run.u()[station.1] * sin;
    }
    let [incident, reflected] = amplitudes.map(|[a, b]: [f64; 2]| a.hypot(b));
    Ok((reflected / incident, run.work()))
}

/// Particles up to x = 0, elements from there on.
fn strip(elasticity: &Elasticity, wave: Wave, [fine, coarse]: [f64; 2]) -> seam_solver::error::Result<Model> {
    let height = ROWS as f64;
    let matter = Matter { density: elasticity.density, thickness_m: 1.0 };
    let block = Block::new(Space::Plane, Vec3::new(-fine, 0.0, 0.0), Vec3::new(0.0, height, 0.0))?;
    let kind = LatticeKind::Triangular;
    let particles = lattice(kind, block, ROWS, matter)?;
    let spacing = 2.0 * particles.arrangement.particles.radius[0];
    let target = Moduli { young_pa: elasticity.young_pa, poisson: elasticity.poisson };
    let mut work = Work::default();
    let found = stretched::calibrate(kind, spacing, particles.stretch, matter, target, 0.3, &mut work)?;
    let material = BondMaterial { young_pa: found.bond_young_pa, poisson: 0.3 };
    let section = Section::Uniform { ratio: found.radius_ratio };
    // Half of a bond in the mirror is on this side of it.
    let recipe = BondRecipe { material, section, skin: Skin::Weighted };
    let network = bond_network(&particles.arrangement, &particles.pairs, &recipe)?;
    let columns = (0.5 * coarse).ceil();
    let corners = [Vec3::zeros(), Vec3::new(2.0 * columns, height, 0.0)];
    let divisions = [columns as usize, ROWS / 2];
    let body = rectangle("coarse", corners, divisions, *elasticity, 1.0, Formulation::Incompatible)?;
    let particles = Part::Discrete { name: "fine".to_owned(), network };
    let mut model = plane(vec![particles, Part::Continuum(body)]);
    model.ties.push(Tie {
        name: "middle".to_owned(),
        first: (1, "left".to_owned()),
        second: (0, "right".to_owned()),
        method: Method::Mortar,
        multipliers: Multipliers::Auto,
        rotations: false,
    });
    let held = 1 - wave.component();
    for (part, body) in model.parts.iter().enumerate() {
        for (point, x) in body.positions().iter().enumerate() {
            if x.y < 1e-9 || x.y > height - 1e-9 {
                model.supports.push(PointValue { part, point, component: held, value: 0.0 });
            }
        }
    }
    Ok(model)
}
