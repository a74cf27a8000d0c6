//! A bond breaks: the energy that is gone is the bond's, and momentum does not notice.
//!
//! In motion: a free block vibrates; at a step the weight of its most loaded bond becomes zero. `½vᵀMv + ½uᵀKu` falls by the energy
//! `½ u_b·K_b u_b` of the bond and by nothing else, before and after over the whole run. Central differences keep
//! `½v₋ᵀMv₊ + ½uᵀKu`, which is `(Δt²/8) aᵀMa` below it. In statics: a driven block breaks bond by bond to the end.

use super::super::compared::within;
use super::super::{Setting, rounding};
use super::bodies::{SPACES, bonded, close_packed_of};
use crate::error::Result;
use crate::margin::{Margin, ROUNDING, Search};
use crate::observe::curve::nan_max;
use crate::result::CaseResult;
use seam_solver::cracking::{Cracking, Options as Cracks};
use seam_solver::dem::bond::for_each_stiffness;
use seam_solver::dem::network::Network;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::{Semidiscrete, lumped};
use seam_solver::error::Result as Solved;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::strength::Strength;
use seam_solver::failure::{Failure, FailureLaw, FailureRecipe, Place};
use seam_solver::model::{Model, Numbering, Part, PointValue};
use seam_solver::space::Space;
use seam_solver::transfer::momentum::Momentum;
use seam_solver::work::Work;

const ROW: &str = "one bond breaks";
const CLOSED: f64 = 1e-10;

/// What a break leaves open, relative.
#[derive(Debug, Clone, Copy, Default)]
struct Open {
    energy: f64,
    momentum: f64,
    /// Share of the energy that the bond took with it.
    share: f64,
}

/// Explicit, implicit and by events, plane and solid.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let steps = setting.count("steps", 10)? as u64;
    for (space, id) in SPACES {
        let refuse = |e| setting.solver(e);
        let network = close_packed_of(setting, space)?;
        type Break = fn(&Network, u64, f64, &mut Work) -> Solved<Open>;
        for (code, name, breaking) in
            [("explicit", "explicit", explicit as Break), ("implicit", "trapezoidal rule", implicit)]
        {
            let open = breaking(&network, steps, 0.9, &mut result.work).map_err(refuse)?;
            let source = "energy ½ u_b·K_b u_b of the bond itself";
            let why = "Exact in theory; hundreds of steps add up their rounding.";
            let label =
                format!("Energy that neither the bodies nor the broken bond account for, {name}, {id}");
            result.quantities.push(rounding(
                &format!("energy-{code}-{id}"),
                &label,
                open.energy,
                CLOSED,
                why,
                source,
            ));
            let label = format!("Change of linear and angular momentum, {name}, {id}");
            let why =
                "Forces and moments of each bond balance; relative to Σ m|v| and the size of the block.";
            result.quantities.push(rounding(
                &format!("momentum-{code}-{id}"),
                &label,
                open.momentum,
                1e-12,
                why,
                "balance of each bond",
            ));
            let label = format!("Share of the energy that the bond took with it, {name}, {id}");
            let why = ["A check of the check: a bond without energy would close any ledger.", source];
            result.quantities.push(within(
                [&format!("share-{code}-{id}"), &label, "1"],
                open.share,
                [1e-3, 1.0],
                why,
            ));
            let search = match code {
                "explicit" => Search { from: 0.1, to: 1.0, tolerance: 0.01 },
                _ => Search { from: 0.1, to: setting.number("implicit_to")?, tolerance: ROUNDING },
            };
            let found = search.largest(|share| {
                let open = breaking(&network, steps, share, &mut result.work).map_err(refuse)?;
                Ok(open.energy <= CLOSED && open.momentum <= 1e-12)
            })?;
            result.margins.push(found.margin(
                [ROW, "the energy ledger closes to 1e-10 and momentum stays to 1e-12"],
                [
                    &format!("step-{code}-{id}"),
                    &format!("lattice, {id}, {name}"),
                    "step over the bound on the explicit one",
                ],
                0.9,
            ));
        }
        let margin = events(setting, space, id, result)?;
        result.margins.push(margin);
    }
    Ok(())
}

/// Energy of each bond at displacements `u`, in J.
fn bond_energies(network: &Network, u: &[f64]) -> Solved<Vec<f64>> {
    let mut energies = Vec::with_capacity(network.bonds.len());
    for_each_stiffness(network, "block", |dofs, k| {
        let n = dofs.len();
        let of_row = |r: usize| (0..n).map(|c| k[r * n + c] * u[dofs[c]]).sum::<f64>() * u[dofs[r]];
        energies.push(0.5 * (0..n).map(of_row).sum::<f64>());
    })?;
    Ok(energies)
}

/// The network without the bond that stores most, and the energy of that bond.
fn without_the_most_loaded(network: &Network, u: &[f64]) -> Solved<(Network, f64)> {
    let energies = bond_energies(network, u)?;
    let most = (0..energies.len()).max_by(|&a, &b| energies[a].total_cmp(&energies[b])).unwrap_or(0);
    let mut broken = network.clone();
    broken.bonds.weight[most] = 0.0;
    Ok((broken, energies[most]))
}

/// A strained, moving start: smooth, without symmetry.
fn first(network: &Network) -> State {
    let per = network.space.dofs_per_particle();
    let dim = network.space.dim();
    let n = per * network.particles.len();
    let length = network.bond_length(0);
    let size = |i: usize| if i % per < dim { 1e-3 * length } else { 1e-3 };
    let wave = |i: usize, phase: f64| (2.3 * i as f64 + phase).sin();
    State { u: (0..n).map(|i| size(i) * wave(i, 0.4)).collect(), ..State::at_rest(n) }
}

/// What is compared: energy `½vᵀMv + ½uᵀKu` and momentum.
struct Books {
    mass: Vec<f64>,
    size: f64,
}

impl Books {
    fn of(model: &Model) -> Solved<Self> {
        let mass = lumped(model, &Numbering::new(model))?;
        let size = model.parts[0].positions().iter().map(|x| x.norm()).fold(0.0, f64::max);
        Ok(Books { mass, size })
    }

    fn kinetic(&self, v: &[f64]) -> f64 {
        0.5 * self.mass.iter().zip(v).map(|(m, v)| m * v * v).sum::<f64>()
    }

    /// Change of momentum over `Σ m|v|`, of angular momentum over that times the size.
    fn moved(&self, model: &Model, before: &[f64], after: &[f64]) -> f64 {
        let scale: f64 = self.mass.iter().zip(before).map(|(m, v)| (m * v).abs()).sum();
        let change = Momentum::of(model, &self.mass, after) - Momentum::of(model, &self.mass, before);
        (change.linear.norm() / scale).max(change.angular.norm() / (scale * self.size))
    }
}

fn explicit(network: &Network, steps: u64, share: f64, work: &mut Work) -> Solved<Open> {
    let whole = bonded(network.clone());
    let books = Books::of(&whole)?;
    let step_s = share * critical::bound(&whole)?.step_s;
    let options = Options { step_s, ..Options::default() };
    // ½v₋ᵀMv₊ at the time of v is (Δt²/8) aᵀMa below ½vᵀMv.
    let lowered = |a: &[f64]| step_s * step_s / 4.0 * books.kinetic(a);
    let mut run = Explicit::new(&whole, options.clone(), &first(network))?;
    run.advance(steps)?;
    let at = run.observe()?;
    let before = at.ledger.energy() + lowered(&at.state.a);
    *work += run.work();
    let (network, energy) = without_the_most_loaded(network, &at.state.u)?;
    let broken = bonded(network);
    let mut run = Explicit::new(&broken, options, &at.state)?;
    let begin = run.observe()?;
    let after = begin.ledger.energy() + lowered(&begin.state.a);
    let mut open =
        Open { energy: ((before - after - energy) / before).abs(), momentum: 0.0, share: energy / before };
    for _ in 0..10 {
        run.advance(steps / 10)?;
        let seen = run.observe()?;
        open.energy = nan_max(open.energy, ((seen.ledger.energy() - begin.ledger.energy()) / before).abs());
        open.momentum = nan_max(open.momentum, books.moved(&broken, &at.state.v, &seen.state.v));
    }
    *work += run.work();
    Ok(open)
}

fn implicit(network: &Network, steps: u64, share: f64, work: &mut Work) -> Solved<Open> {
    let whole = bonded(network.clone());
    let books = Books::of(&whole)?;
    let step = share * critical::bound(&whole)?.step_s;
    let State { u, v, .. } = first(network);
    let system = Semidiscrete::new(&whole, work)?;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work)?;
    let (mut motion, _) = start(&system, (u, v), 0.0, 0.0, 0.0, work)?;
    for _ in 0..steps / 10 {
        newmark.step(&mut motion, [0.0; 2], work)?;
    }
    let before = system.kinetic(&motion.v) + system.strain(&motion.u);
    let at = motion.v.clone();
    let (network, energy) = without_the_most_loaded(network, &motion.u)?;
    let broken = bonded(network);
    let system = Semidiscrete::new(&broken, work)?;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work)?;
    let (mut motion, _) = start(&system, (motion.u, motion.v), 0.0, 0.0, 0.0, work)?;
    let mut open = Open { share: energy / before, ..Open::default() };
    for _ in 0..steps / 10 {
        let now = system.kinetic(&motion.v) + system.strain(&motion.u);
        open.energy = nan_max(open.energy, ((before - energy - now) / before).abs());
        open.momentum = nan_max(open.momentum, books.moved(&broken, &at, &motion.v));
        newmark.step(&mut motion, [0.0; 2], work)?;
    }
    Ok(open)
}

/// Pulled apart until nothing holds: how many breaks in a row close to 1e-10, each for itself and all together.
fn events(setting: &Setting, space: Space, id: &str, result: &mut CaseResult) -> Result<Margin> {
    let mut model = bonded(close_packed_of(setting, space)?);
    let strength_pa = setting.number("strength_Pa")?;
    let law = FailureLaw::BondStress(BondStress::Normal { tensile: Strength::Stress { strength_pa } });
    let Part::Discrete { network, name } = &model.parts[0] else {
        unreachable!("a network is a body of particles")
    };
    let place = Place { network, body: name, breakable: None, area_m2: None };
    let failure =
        Failure::new(&FailureRecipe { law, weibull: None }, &place).map_err(|e| setting.solver(e))?;
    let far = network.particles.position.iter().map(|x| x.x).fold(0.0, f64::max);
    let mut supports = Vec::new();
    for (point, x) in network.particles.position.iter().enumerate() {
        let end = if x.x < 1e-9 * far {
            0.0
        } else if x.x > far * (1.0 - 1e-9) {
            1e-3 * far
        } else {
            continue;
        };
        for component in 0..space.dofs_per_particle() {
            let value = if component == 0 { end } else { 0.0 };
            supports.push(PointValue { part: 0, point, component, value });
        }
    }
    model.supports = supports;
    let all = network.bonds.len();
    let outcome = Cracking::new(&model, vec![(0, failure)], Cracks::default())
        .and_then(Cracking::run)
        .map_err(|e| setting.solver(e))?;
    result.work += outcome.work;
    let closes = |event: &seam_solver::cracking::Event| {
        let before = 0.5 * event.force * event.displacement;
        (event.energy_released - event.fracture_energy - event.radiated_energy).abs() <= CLOSED * before
    };
    let closing = outcome.events.iter().take_while(|e| closes(e)).count();
    let label = format!("Energy of the whole path that no entry accounts for, by events, {id}");
    let why = "Each break is exact; the path adds up the rounding of its solves.";
    let source = "work of the support against strain, fracture and radiated energy";
    result.quantities.push(rounding(
        &format!("ledger-{id}"),
        &label,
        outcome.energies().closure(),
        CLOSED,
        why,
        source,
    ));
    Ok(Margin {
        id: format!("events-{id}"),
        row: ROW.to_owned(),
        label: format!("lattice of {all} bonds, {id}, by events"),
        axis: "breaks in a row whose energy closes".to_owned(),
        unit: "1".to_owned(),
        value: closing as f64,
        needed: 1.0,
        tolerance: 0.0,
        open: closing == outcome.events.len(),
        criterion: "the energy of each break closes to 1e-10".to_owned(),
        how: format!(
            "counted along one path of {} breaks that ends with: {:?}",
            outcome.events.len(),
            outcome.stop
        ),
    })
}
