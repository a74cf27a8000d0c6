//! Contact right after breaking: nothing is ejected, and a rebound is what the law says.
//!
//! Two particles that overlap in the reference state, as bonded ones may, lose their bond: at rest they stay at rest; squeezed, they come apart
//! with no more than the energy of the contact; thrown at each other they rebound with the restitution e of the law.

use super::super::Setting;
use super::super::compared::within;
use super::super::rounding;
use super::bodies::SPACES;
use crate::error::Result;
use crate::margin::Search;
use crate::result::CaseResult;
use seam_solver::contact::Contacts;
use seam_solver::contact::law::{ContactLaw, Normal};
use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::error::Result as Solved;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;
use std::f64::consts::PI;

const ROW: &str = "contact right after breaking";
/// What a rebound may be away from the law.
const RESTITUTION: f64 = 0.02;

/// One way to begin.
#[derive(Debug, Clone, Copy)]
enum Start {
    Rest,
    /// Squeezed by a share of the reference distance.
    Squeezed(f64),
    /// Approaching, in m/s.
    Thrown(f64),
}

/// What became of the pair.
struct End {
    /// Relative speed along the line of centres over that of the start (m/s), positive apart.
    speed: f64,
    /// Kinetic energy, in J.
    kinetic: f64,
    /// Energy in the contact when the bond went, in J.
    stored: f64,
    /// Momentum that is not the start's, over m v.
    momentum: f64,
}

/// Linear and Hertzian contacts, plane and solid.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let restitution = setting.number("restitution")?;
    let laws = [
        ("linear", Normal::Linear { stiffness_n_m: setting.number("stiffness_N_m")? }),
        ("hertz", Normal::Hertz { young_pa: setting.number("young_Pa")?, poisson: 0.25 }),
    ];
    let speed = setting.number("speed_m_s")?;
    for (space, id) in SPACES {
        for (name, normal) in laws {
            if space == Space::Plane && name == "hertz" {
                // Spheres touch in a point; discs do not.
                continue;
            }
            let law = ContactLaw { normal, restitution, friction: 0.0, stiffness_ratio: 0.0 };
            let mut pair =
                |start: Start, step: f64| collide(setting, space, law, start, step, &mut result.work);
            let refuse = |e| setting.solver(e);
            let code = format!("{name}-{id}");
            let what = format!("{name} contact, {id}");
            let fine = setting.number("step")?;
            let rest = pair(Start::Rest, fine).map_err(refuse)?;
            let squeezed = pair(Start::Squeezed(1e-2), fine).map_err(refuse)?;
            let thrown = pair(Start::Thrown(speed), fine).map_err(refuse)?;
            let source = "the state at the break";
            let why = "A pair at its reference distance has no overlap: nothing may move, to the last bit.";
            let label = format!("Speed after the bond of an overlapping pair at rest breaks, {what}");
            result.quantities.push(rounding(
                &format!("rest-{code}"),
                &label,
                rest.speed.abs(),
                0.0,
                why,
                source,
            ));
            let label = format!(
                "Kinetic energy of a squeezed pair after it came apart, over that of the contact, {what}"
            );
            let why = [
                "It leaves with what the contact stored less its damping: never more, and not nothing.",
                source,
            ];
            result.quantities.push(within(
                [&format!("squeezed-{code}"), &label, "1"],
                squeezed.kinetic / squeezed.stored,
                [0.1, 1.0],
                why,
            ));
            let label = format!("Restitution of a pair that meets again, {what}");
            let why = [
                "Some hundred steps in contact; the damping lags by half of one.",
                "the law's own restitution (Schwager and Pöschel 2007)",
            ];
            let accepted = [restitution - RESTITUTION, restitution + RESTITUTION];
            result.quantities.push(within(
                [&format!("restitution-{code}"), &label, "1"],
                thrown.speed / speed,
                accepted,
                why,
            ));
            let label = format!("Change of momentum, {what}");
            let why = "Equal and opposite forces: rounding.";
            result.quantities.push(rounding(
                &format!("momentum-{code}"),
                &label,
                thrown.momentum.max(squeezed.momentum),
                1e-12,
                why,
                "balance of the pair",
            ));
            let found = Search { from: 1e-3, to: 2.0, tolerance: 0.01 }.largest(|step| {
                let (rest, squeezed, thrown) = (
                    pair(Start::Rest, step),
                    pair(Start::Squeezed(1e-2), step),
                    pair(Start::Thrown(speed), step),
                );
                let (rest, squeezed, thrown) =
                    (rest.map_err(refuse)?, squeezed.map_err(refuse)?, thrown.map_err(refuse)?);
                let follows = (thrown.speed / speed - restitution).abs() <= RESTITUTION;
                Ok(rest.speed == 0.0 && squeezed.kinetic <= squeezed.stored && follows)
            })?;
            result.margins.push(found.margin(
                [ROW, "nothing is ejected and the restitution is met within 0.02"],
                [&format!("step-{code}"), &what, "time step over √(m/k) of the pair"],
                0.02,
            ));
        }
    }
    Ok(())
}

/// Follows a pair until it has come apart or enough time has gone by; `step` in units of `√(m/k)`.
fn collide(
    setting: &Setting,
    space: Space,
    law: ContactLaw,
    start: Start,
    step: f64,
    work: &mut Work,
) -> Solved<End> {
    let number = |name: &str| setting.number(name).unwrap_or(f64::NAN);
    let (radius, mass) = (number("radius_m"), number("mass_kg"));
    let distance = 1.8 * radius;
    let direction = if space == Space::Plane { Vec3::new(0.6, 0.8, 0.0) } else { Vec3::new(0.6, 0.48, 0.64) };
    let position = vec![Vec3::zeros(), direction * distance];
    let particles = Particles {
        position,
        radius: vec![radius; 2],
        mass: vec![mass; 2],
        inertia: vec![0.4 * mass * radius * radius; 2],
    };
    let stiffness = BondStiffness { kn: 1.0, ks: 1.0, kb: 1.0, kt: 1.0 };
    let bonds = Bonds {
        ends: vec![[0, 1]],
        radius: vec![0.5 * radius],
        stiffness: vec![stiffness],
        weight: vec![1.0],
    };
    let network = Network { space, particles, bonds, faces: Default::default() };
    let mut contacts = Contacts::new(law, &network)?;
    contacts.bond_lost([0, 1]);
    let (per, dim) = (space.dofs_per_particle(), space.dim());
    let (mut u, mut v) = (vec![0.0; 2 * per], vec![0.0; 2 * per]);
    let along = |x: &[f64]| (0..dim).map(|c| (x[per + c] - x[c]) * direction[c]).sum::<f64>();
    // Stiffness at a depth that the start leads to.
    let (speed, squeeze) = match start {
        Start::Rest => (0.0, 0.0),
        Start::Squeezed(share) => (0.0, share * distance),
        Start::Thrown(speed) => (speed, 0.0),
    };
    let k = match law.normal {
        Normal::Linear { stiffness_n_m } => stiffness_n_m,
        Normal::Hertz { young_pa, poisson } => {
            let constant = 4.0 / 3.0 * young_pa / (2.0 * (1.0 - poisson * poisson)) * (0.5 * radius).sqrt();
            // Depth at which ½ m v² is stored: 0.4 k δ^{5/2}.
            let depth =
                (0.25 * mass * speed * speed / (0.4 * constant)).powf(0.4).max(squeeze).max(1e-6 * radius);
            1.5 * constant * depth.sqrt()
        }
    };
    let unit = (0.5 * mass / k).sqrt();
    let dt = step * unit;
    for c in 0..dim {
        // A gap that takes a few steps to close; without one the first step would begin inside.
        let gap = if speed > 0.0 { 3.3 * speed * dt } else { -squeeze };
        u[per + c] = gap * direction[c];
        v[per + c] = -0.5 * speed * direction[c];
        v[c] = 0.5 * speed * direction[c];
    }
    let mut stored: Option<f64> = None;
    for _ in 0..(8.0 * PI / step).ceil() as usize {
        let mut f = vec![0.0; 2 * per];
        contacts.add_forces(&u, &v, dt, &mut f, work);
        stored.get_or_insert(contacts.energy().stored);
        for i in 0..f.len() {
            let m = if i % per < dim { mass } else { 0.4 * mass * radius * radius };
            v[i] += dt * f[i] / m;
            u[i] += dt * v[i];
        }
        work.steps += 1;
    }
    let kinetic = 0.5 * mass * (0..2 * per).filter(|i| i % per < dim).map(|i| v[i] * v[i]).sum::<f64>();
    let total = (0..dim).map(|c| mass * (v[c] + v[per + c])).map(|p| p * p).sum::<f64>().sqrt();
    let scale = mass * (2.0 * kinetic / mass).sqrt();
    let momentum = if scale > 0.0 { total / scale } else { total };
    Ok(End { speed: along(&v), kinetic, stored: stored.unwrap_or(0.0), momentum })
}
