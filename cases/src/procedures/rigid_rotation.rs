//! Two full turns of a bonded block about an oblique axis store nothing; the order of a bond's particles means nothing.

use super::hard::bodies::{SPACES, close_packed};
use super::specimen::{block, wave};
use super::{Setting, rounding};
use crate::error::Result;
use crate::margin::Search;
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use nalgebra::Rotation3;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::corotational::Corotational;
use seam_solver::dem::kernel::Kernel;
use seam_solver::dem::network::Network;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;
use std::f64::consts::TAU;

const OBJECTIVE: &str = "objectivity: a rigid motion strains nothing (Crisfield 1990)";
const ROW: &str = "rigid rotation by 720°";

/// Energy and forces on the way through 720°, and the two ways to swap the particles of a bond.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let network = block(setting)?;
    let steps = setting.count("steps", 1)?;
    let scale = Scale::of(&network);
    let refuse = |e| setting.solver(e);
    let [energy, force, small] = turn(&network, &scale, (steps, 2.0), &mut result.work).map_err(refuse)?;
    let why = "Rounding of places of size one, squared and summed over the bonds.";
    let label = "Largest strain energy during 720°, over that of a strain of one";
    result.quantities.push(rounding("energy", label, energy, 1e-12, why, OBJECTIVE));
    let why = "Rounding of places of size one, times the stiffness.";
    let label = "Largest force or moment during 720°, over that of a strain of one";
    result.quantities.push(rounding("force", label, force, 1e-12, why, OBJECTIVE));
    let label = "For contrast: the same energy from small-rotation bonds";
    let mut contrast = rounding("small-rotations", label, small, 1e3, "", "linear bonds are not objective");
    contrast.accepted = Some([1.0, 1e3]);
    contrast.why =
        "A check of the check: linear bonds at angles up to 4π must show strains far above one.".to_owned();
    result.quantities.push(contrast);
    let [swapped, renumbered] =
        swaps(&network, setting.number("amplitude")?, &scale, &mut result.work).map_err(refuse)?;
    let source = "the energy of a bond is symmetric in its two particles";
    let why = "The same numbers in the same order: nothing may change.";
    let label = "Change of a force when each bond names its particles the other way round";
    result.quantities.push(rounding("swapped", label, swapped, 1e-15, why, source));
    let why = "The same sums in another order: rounding of a dozen bonds per particle.";
    let label = "Change of a force when the particles are numbered the other way round";
    result.quantities.push(rounding("renumbered", label, renumbered, 1e-13, why, source));
    let (particles, bonds) = (network.particles.len(), network.bonds.len());
    margins(setting, steps / 2, result)?;
    result.notes.push(format!("face-centred cubic block of {particles} particles and {bonds} bonds"));
    Ok(())
}

/// How many turns store nothing, in the plane and in space.
fn margins(setting: &Setting, steps_per_turn: usize, result: &mut CaseResult) -> Result<()> {
    let (young_pa, poisson) = (setting.number("young_Pa")?, setting.number("poisson")?);
    let matter = Matter { density: setting.number("density_kg_m3")?, thickness_m: 1.0 };
    let (side, ratio) = (setting.number("side_m")?, setting.number("radius_ratio")?);
    for (space, id) in SPACES {
        let material = BondMaterial { young_pa, poisson };
        let network = close_packed(space, side, setting.count("rows", 1)?, material, ratio, matter);
        let network = network.map_err(|e| setting.solver(e))?;
        let scale = Scale::of(&network);
        let search = Search { from: 2.0, to: setting.number("turns_to")?, tolerance: 0.0 };
        let found = search.largest(|turns| {
            let steps = (steps_per_turn * turns as usize, turns);
            let [energy, _, _] =
                turn(&network, &scale, steps, &mut result.work).map_err(|e| setting.solver(e))?;
            Ok(energy <= 1e-12)
        })?;
        let criterion = "the strain energy stays below 1e-12 of that of a strain of one";
        let margin = [&format!("turns-{id}"), &format!("lattice, {id}, finite rotations"), "full turns"];
        result.margins.push(found.margin([ROW, criterion], margin, 2.0));
    }
    Ok(())
}

/// What a strain of one would give.
struct Scale {
    /// `Σ ½ k_n L²`, in J.
    energy: f64,
    /// Largest `k_n L`, in N; times the largest L for moments.
    force: f64,
    length: f64,
    /// Unknowns of a particle, and how many of them are displacements.
    per: usize,
    dim: usize,
}

impl Scale {
    fn of(network: &Network) -> Self {
        let bonds = &network.bonds;
        let each = |b: usize| (bonds.weight[b] * bonds.stiffness[b].kn, network.bond_length(b));
        let all = || (0..bonds.len()).map(each);
        Scale {
            energy: all().map(|(kn, l)| 0.5 * kn * l * l).sum(),
            force: all().map(|(kn, l)| kn * l).fold(0.0, f64::max),
            length: all().map(|(_, l)| l).fold(0.0, f64::max),
            per: network.space.dofs_per_particle(),
            dim: network.space.dim(),
        }
    }

    /// Largest force or moment, relative.
    fn largest(&self, f: &[f64]) -> f64 {
        let relative = |(i, f): (usize, &f64)| {
            f.abs() / if i % self.per < self.dim { self.force } else { self.force * self.length }
        };
        f.iter().enumerate().map(relative).fold(0.0, nan_max)
    }
}

/// Largest energy and force, and the largest energy of linear bonds at the same displacements and rotations.
fn turn(
    network: &Network,
    scale: &Scale,
    (steps, turns): (usize, f64),
    work: &mut Work,
) -> seam_solver::error::Result<[f64; 3]> {
    let axis = if network.space == Space::Plane { Vec3::z() } else { Vec3::new(1.0, 2.0, -0.5).normalize() };
    let step = turns * TAU / steps as f64;
    let mut bonds = Corotational::new(network, "block")?;
    let linear = Kernel::new(network, "block")?;
    let spin: Vec<f64> = particles(network, |_| [Vec3::zeros(), axis * step]);
    let mut largest = [0.0; 3];
    for k in 1..=steps {
        bonds.turn(&spin, 1.0);
        let angle = step * k as f64;
        let rotation = Rotation3::from_scaled_axis(axis * angle);
        let u = particles(network, |x| [rotation * x - x, axis * angle]);
        let (mut f, mut f_linear) = (vec![0.0; u.len()], vec![0.0; u.len()]);
        bonds.add_internal(&u, &mut f);
        linear.add_internal(&u, &mut f_linear);
        let of_linear = 0.5 * u.iter().zip(&f_linear).map(|(u, f)| u * f).sum::<f64>();
        let now = [bonds.energy(&u).abs() / scale.energy, scale.largest(&f), of_linear / scale.energy];
        largest.iter_mut().zip(now).for_each(|(largest, now)| *largest = nan_max(*largest, now));
        work.bond_updates += 3 * network.bonds.len() as u64;
        work.steps += 1;
    }
    Ok(largest)
}

/// Largest relative change of a force in a deformed, turned state: bonds swapped, particles renumbered.
fn swaps(
    network: &Network,
    amplitude: f64,
    scale: &Scale,
    work: &mut Work,
) -> seam_solver::error::Result<[f64; 2]> {
    let (n, per) = (network.particles.len(), scale.per);
    let size = |i: usize| if i % per < scale.dim { amplitude * scale.length } else { amplitude };
    let u: Vec<f64> = (0..per * n).map(|i| wave(i, size(i))).collect();
    let forces = |network: &Network, u: &[f64]| -> seam_solver::error::Result<Vec<f64>> {
        let mut bonds = Corotational::new(network, "block")?;
        bonds.turn(u, 1.0);
        let mut f = vec![0.0; u.len()];
        bonds.add_internal(u, &mut f);
        Ok(f)
    };
    let reversed = |q: &[f64]| -> Vec<f64> { q.chunks(per).rev().flatten().copied().collect() };
    let there = forces(network, &u)?;
    let mut swapped = network.clone();
    swapped.bonds.ends.iter_mut().for_each(|ends| ends.reverse());
    let mut renumbered = network.clone();
    renumbered.particles.position.reverse();
    renumbered.bonds.ends.iter_mut().for_each(|ends| *ends = ends.map(|p| n - 1 - p));
    let back = [forces(&swapped, &u)?, reversed(&forces(&renumbered, &reversed(&u))?)];
    work.bond_updates += 3 * network.bonds.len() as u64;
    let size = scale.largest(&there);
    let off = |other: &Vec<f64>| {
        let difference: Vec<f64> = other.iter().zip(&there).map(|(a, b)| a - b).collect();
        scale.largest(&difference) / size
    };
    Ok([off(&back[0]), off(&back[1])])
}

/// Displacement and rotation of each particle from its place.
fn particles(network: &Network, of: impl Fn(&Vec3) -> [Vec3; 2]) -> Vec<f64> {
    let plane = network.space == Space::Plane;
    let all = network.particles.position.iter().map(of);
    all.flat_map(|[u, w]| if plane { vec![u.x, u.y, w.z] } else { vec![u.x, u.y, u.z, w.x, w.y, w.z] })
        .collect()
}
