//! Elements, particles, elements as a cantilever: implicit coarse steps outside, explicit fine steps inside.
//!
//! Both methods at several ratios of the steps. Prakash & Hjelmstad (2004): the interface takes no algorithmic energy;
//! Gravouil & Combescure (2001): it never gives any. The physical work of the interface and the gap are another matter:
//! they are shown.

use super::compared::{plot, series, within};
use super::straight::{hold, plane, rectangle};
use super::{Setting, rounding};
use crate::error::Result;
use crate::result::{CaseResult, Observation, Role};
use rayon::prelude::*;
use seam_solver::coupling::{Method as Tying, Multipliers, Tie};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::bonding::{BondRecipe, bond_network};
use seam_solver::dem::lattice::{LatticeKind, lattice};
use seam_solver::dem::section::Section;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate::side::Stepping;
use seam_solver::dynamics::multirate::{Ledger, Method, Multirate, Rates};
use seam_solver::dynamics::newmark::start;
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;
use std::f64::consts::PI;

const RATIOS: [usize; 6] = [1, 2, 5, 10, 50, 100];
const METHODS: [(Method, &str, &str); 2] = [
    (Method::PrakashHjelmstad, "ph", "Prakash–Hjelmstad"),
    (Method::GravouilCombescure, "gc", "Gravouil–Combescure"),
];

/// What a run leaves.
struct Outcome {
    ledger: Ledger,
    /// Largest algorithmic energy, in J/s².
    largest: f64,
    /// Largest gain of algorithmic energy from the interface in one step.
    gain: f64,
    /// Largest gap in displacement, in m.
    gap: f64,
    /// Largest displacement, in m.
    size: f64,
    /// Kinetic and strain energy at the end, in J.
    energy: f64,
    work: Work,
}

/// Both methods at all ratios.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let (fine_step, end) = (setting.number("fine_step_s")?, setting.number("end_s")?);
    let rise = setting.number("rise_s")?;
    let model = sandwich(setting)?;
    let runs: Vec<(usize, usize)> = (0..2).flat_map(|m| RATIOS.map(|ratio| (m, ratio))).collect();
    let outcomes = runs
        .par_iter()
        .map(|&(m, ratio)| one(&model, METHODS[m].0, ratio, fine_step, [rise, end]))
        .collect::<seam_solver::error::Result<Vec<_>>>()
        .map_err(|e| setting.solver(e))?;
    for (&(m, ratio), outcome) in runs.iter().zip(&outcomes) {
        result.work += outcome.work;
        result.quantities.extend(judged(METHODS[m], ratio, outcome));
    }
    let line = |m: usize, of: fn(&Outcome) -> f64| {
        let own = runs.iter().zip(&outcomes).filter(|(r, _)| r.0 == m);
        series(METHODS[m].2, Role::Model, own.map(|(r, o)| (r.1 as f64, of(o))).collect::<Vec<_>>())
    };
    let both = |of: fn(&Outcome) -> f64| vec![line(0, of), line(1, of)];
    let x = "fine steps per coarse step (1)";
    result.curves = vec![
        plot(
            ["physical-work", "Physical work of the interface", x, "|work| / energy (1)"],
            [true, true],
            both(|o| o.ledger.physical_interface.abs() / o.energy),
        ),
        plot(
            ["gap", "Largest gap of the ties", x, "gap / largest displacement (1)"],
            [true, true],
            both(|o| o.gap / o.size),
        ),
        plot(
            ["algorithmic", "Algorithmic energy lost at the interface", x, "loss / largest energy (%)"],
            [true, false],
            both(|o| -100.0 * o.ledger.interface / o.largest),
        ),
    ];
    Ok(())
}

fn judged((method, id, name): (Method, &str, &str), ratio: usize, outcome: &Outcome) -> Vec<Observation> {
    let Outcome { ledger, largest, gain, energy, .. } = outcome;
    let closure = (ledger.algorithmic - ledger.external - ledger.interface).abs() / largest;
    let share = ledger.interface / largest;
    let label = |what: &str| format!("{what}, {name}, {ratio} to 1");
    let mut all = vec![rounding(
        &format!("balance-{id}-{ratio}"),
        &label("Algorithmic energy that neither loads nor interface account for"),
        closure,
        1e-8,
        "The balance is exact; thousands of steps with implicit solves stay far below 1e-8.",
        "Hughes (1983), energy of Newmark's method for γ = ½",
    )];
    if method == Method::PrakashHjelmstad {
        all.push(rounding(
            &format!("interface-{id}-{ratio}"),
            &label("Algorithmic energy from the interface"),
            share.abs(),
            1e-8,
            "Exactly zero in theory; thousands of steps with implicit solves stay far below 1e-8.",
            "Prakash and Hjelmstad (2004), §5",
        ));
    } else {
        all.push(within(
            [&format!("gain-{id}-{ratio}"), &label("Largest gain of algorithmic energy in a step"), "1"],
            gain / largest,
            [-1.0, 1e-10],
            [
                "Never positive in theory; rounding of one step. It cannot lose more than there is.",
                "Gravouil and Combescure (2001), §4",
            ],
        ));
        let lost = if ratio == 1 {
            ([-1e-10, 1e-10], "Equal steps lose nothing but rounding.")
        } else {
            ([-1.0, -1e-8], "Subcycling dissipates: it must be seen, and cannot take more than there is.")
        };
        all.push(within(
            [&format!("interface-{id}-{ratio}"), &label("Algorithmic energy from the interface"), "1"],
            share,
            lost.0,
            [lost.1, "Gravouil and Combescure (2001), §4"],
        ));
    }
    let mut physical = rounding(
        &format!("physical-{id}-{ratio}"),
        &label("Physical work of the interface over the energy"),
        ledger.physical_interface / energy,
        0.0,
        "Shown, not judged: no theorem bounds it.",
        "−Σ ½(λ_n + λ_{n+1})·L[u] of both sides",
    );
    physical.accepted = None;
    all.push(physical);
    all
}

/// A load that rises and then stays.
fn one(
    model: &Model,
    method: Method,
    ratio: usize,
    fine_step: f64,
    [rise_s, end]: [f64; 2],
) -> seam_solver::error::Result<Outcome> {
    let mut work = Work::default();
    let system = Semidiscrete::new(model, &mut work)?;
    let still = vec![0.0; system.mass.len()];
    let (rest, lambda) = start(&system, (still.clone(), still), 0.0, 0.0, 0.0, &mut work)?;
    let coarse_step = fine_step * ratio as f64;
    let rates = Rates {
        method,
        coarse_step,
        ratio,
        coarse: Stepping::Implicit,
        fine: Stepping::Explicit,
        fine_parts: vec![1],
    };
    let mut run = Multirate::new(model, &system, &rates, (&rest, lambda), &mut work)?;
    let load = LoadFactor::Ramp { start_s: 0.0, rise_s };
    let (mut largest, mut gain, mut last) = (0.0f64, f64::NEG_INFINITY, 0.0);
    let (mut gap, mut size) = (0.0f64, 0.0f64);
    for _ in 0..(end / coarse_step).round() as usize {
        run.step(|t| load.at(t), &mut work)?;
        let ledger = run.ledger();
        largest = largest.max(ledger.algorithmic);
        gain = gain.max(ledger.interface - last);
        last = ledger.interface;
        gap = gap.max(ledger.gap);
        size = run.motion().u.iter().fold(size, |m, u| m.max(u.abs()));
    }
    let motion = run.motion();
    let energy = system.kinetic(&motion.v) + system.strain(&motion.u);
    Ok(Outcome { ledger: run.ledger(), largest, gain, gap, size, energy, work })
}

/// Three squares in a row, held at the left, loaded across at the right: elements, a square lattice of the same constants, elements.
///
/// A square lattice with `k_n = k_s` (that is `3(r/L)² = 1`) is isotropic with `E = k_n/t` and ν = 0.
fn sandwich(setting: &Setting) -> Result<Model> {
    let (young_pa, thickness_m) = (setting.number("young_Pa")?, setting.number("thickness_m")?);
    let (density, side) = (setting.number("density_kg_m3")?, setting.number("side_m")?);
    let (rows, force) = (setting.count("rows", 2)?, setting.number("force_N")?);
    let built = || -> seam_solver::error::Result<Model> {
        let corner = |x: f64, y: f64| Vec3::new(x * side, y * side, 0.0);
        let elasticity = Elasticity { young_pa, poisson: 0.0, density };
        let square = |name: &str, x: f64, columns: usize| {
            let corners = [corner(x, 0.0), corner(x + 1.0, 1.0)];
            rectangle(name, corners, [columns, rows], elasticity, thickness_m, Formulation::Incompatible)
        };
        let block = Block::new(Space::Plane, corner(1.0, 0.0), corner(2.0, 1.0))?;
        let particles = lattice(LatticeKind::Square, block, rows, Matter { density, thickness_m })?;
        let a = 2.0 * particles.arrangement.particles.radius[0];
        let ratio = 2.0 / 3f64.sqrt();
        let area = PI * (0.5 * ratio * a).powi(2);
        let material = BondMaterial { young_pa: young_pa * thickness_m * a / area, poisson: 0.3 };
        let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin: Skin::Weighted };
        let network = bond_network(&particles.arrangement, &particles.pairs, &recipe)?;
        let middle = Part::Discrete { name: "middle".to_owned(), network };
        let mut model = plane(vec![
            Part::Continuum(square("left", 0.0, 2)?),
            middle,
            Part::Continuum(square("right", 2.0, 3)?),
        ]);
        for (first, second) in [(0, 1), (1, 2)] {
            model.ties.push(Tie {
                name: format!("{first}-{second}"),
                first: (first, "right".to_owned()),
                second: (second, "left".to_owned()),
                method: Tying::Pointwise,
                multipliers: Multipliers::Auto,
                rotations: false,
            });
        }
        hold(&mut model, 0, |x| x.x < 1e-9 * side);
        let end = model.parts[2].face("right").unwrap_or_default();
        let value = -force / end.len() as f64;
        let load = |point| PointValue { part: 2, point, component: 1, value };
        model.loads = end.into_iter().map(load).collect();
        Ok(model)
    };
    built().map_err(|e| setting.solver(e))
}
