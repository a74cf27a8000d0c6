//! Elements, particles, elements as a cantilever: implicit coarse steps outside, explicit fine steps inside.
//!
//! Both methods at several ratios of the steps. Prakash & Hjelmstad (2004): the interface takes no algorithmic energy;
//! Gravouil & Combescure (2001): it never gives any. The physical work of the interface and the gap are another matter:
//! they are shown.

use super::compared::{plot, series, within};
use super::hard::bodies::{SPACES, Sandwich};
use super::{Setting, rounding};
use crate::error::Result;
use crate::margin::Search;
use crate::result::{CaseResult, Observation, Role};
use rayon::prelude::*;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate::side::Stepping;
use seam_solver::dynamics::multirate::{Ledger, Method, Multirate, Rates};
use seam_solver::dynamics::newmark::start;
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::model::Model;
use seam_solver::space::Space;
use seam_solver::work::Work;

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
    let force = setting.number("force_N")?;
    let model = Sandwich::of(setting, Space::Plane)?.cantilever(force).map_err(|e| setting.solver(e))?;
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
    for (space, where_) in SPACES {
        // Two rows will do: the statements hold for any mesh.
        let few = Sandwich { rows: 2, elements: [2, 2], ..Sandwich::of(setting, space)? };
        let model = few.cantilever(force).map_err(|e| setting.solver(e))?;
        for (method, id, name) in METHODS {
            let search = Search { from: 25.0, to: setting.number("ratio_to")?, tolerance: 0.0 };
            let found = search.largest(|ratio| {
                let outcome = one(&model, method, ratio as usize, fine_step, [rise, end]);
                let outcome = outcome.map_err(|e| setting.solver(e))?;
                result.work += outcome.work;
                Ok(holds(method, &outcome))
            })?;
            let criterion = "the energy balance closes to 1e-8 and the interface takes no algorithmic energy (Prakash–Hjelmstad, 1e-8) or never gives any (Gravouil–Combescure)";
            let margin = [
                &format!("ratio-{id}-{where_}"),
                &format!("{name}, {where_}, implicit and explicit"),
                "fine steps per coarse step",
            ];
            result.margins.push(found.margin(["subcycling 1, 2, 5, 10, 50, 100", criterion], margin, 100.0));
        }
    }
    Ok(())
}

/// What theory says of the algorithmic energy.
fn holds(method: Method, Outcome { ledger, largest, gain, .. }: &Outcome) -> bool {
    let closure = (ledger.algorithmic - ledger.external - ledger.interface).abs();
    let kept = match method {
        Method::PrakashHjelmstad => ledger.interface.abs() <= 1e-8 * largest,
        Method::GravouilCombescure => *gain <= 1e-10 * largest,
    };
    closure <= 1e-8 * largest && kept
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
