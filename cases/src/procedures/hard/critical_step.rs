//! Steps just below and just beyond the critical one: bounded below, refused beyond, and never wrong without a word.
//!
//! Critical is `2/ω_max` of the untied parts by power iteration. The bound that the solver refuses by is below it; how far a run
//! could go beyond the bound before it blows up is the margin. Implicit steps have no critical one: the margin is how large they may
//! become before energy is lost.

use super::super::compared::within;
use super::super::{Setting, rounding};
use super::bodies::{SPACES, Sandwich, alone, bonded, close_packed, distorted, hypothesis};
use super::two_rates::{Setup, fate};
use super::unrefused::Unrefused;
use crate::error::Result;
use crate::map::Cell;
use crate::margin::{ROUNDING, Search};
use crate::result::CaseResult;
use seam_solver::coupling::Method as Tying;
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dynamics::State;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::multirate::Method;
use seam_solver::dynamics::multirate::side::Stepping;
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::error::Error;
use seam_solver::fem::elasticity::Elasticity;
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::Space;
use seam_solver::work::Work;

const ROW: &str = "Δt = 0.99 / 1.01 of critical";
/// Steps over the bound at which two rates are asked for: silence anywhere here is a fault.
const BESIDE: [f64; 7] = [0.99, 1.001, 1.01, 1.05, 1.1, 1.2, 1.5];

struct Body {
    id: String,
    name: String,
    model: Model,
}

/// All bodies, explicitly, implicitly and at two rates.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let steps = setting.count_of_tier("steps", 100)?;
    let searched = setting.count("searched_steps", 100)?;
    let mut refused = 0;
    let bodies = bodies(setting)?;
    for body in &bodies {
        let refuse = |e| setting.solver(e);
        let bound = critical::bound(&body.model).map_err(refuse)?.step_s;
        let mut run = Unrefused::new(&body.model).map_err(refuse)?;
        let exact = run.critical_step(2000);
        let below = run.growth(0.99 * exact, steps).map_err(refuse)?;
        result.quantities.push(within(
            [&format!("bounded-{}", body.id), &format!("Growth over {steps} steps of 0.99 critical, {}", body.name), "1"],
            below,
            // The start is on the way, so that the largest is at least itself.
            [1.0, 1.05 / (1.0 - 0.99f64.powi(2)).sqrt()],
            ["The exact invariant allows 1/√(1 − 0.99²) = 7.1; power iteration overestimates the step by a little.",
             "½ v₊ᵀ(M − ¼Δt²K)v₊ + ½ ūᵀKū is constant, ū the mean of two steps"],
        ));
        result.quantities.push(within(
            [&format!("tight-{}", body.id), &format!("Critical step over its bound, {}", body.name), "1"],
            exact / bound,
            [1.0, 2.0],
            [
                "Below one it would be unsafe; above two it would waste steps.",
                "power iteration against the bound by elements and bonds",
            ],
        ));
        let admitted = |factor: f64| admit(&body.model, factor * exact);
        refused += usize::from(matches!(admitted(1.01), Err(Error::UnstableStep { .. })));
        let search = Search { from: 0.5, to: 4.0, tolerance: 1e-3 };
        let found = search.largest(|factor| run.bounded(factor * bound, searched).map_err(refuse))?;
        result.margins.push(found.margin(
            [ROW, "a run without the refusal stays bounded, so that every step that is admitted is safe"],
            [
                &format!("step-{}", body.id),
                &format!("{}, explicit", body.name),
                "step over the bound it is refused by",
            ],
            1.0,
        ));
        result.work += run.work;
    }
    let why = "One refusal per body, by the typed error that names step, bound and place.";
    let label = "Bodies whose explicit run at 1.01 of critical is refused";
    let count = bodies.len() as f64;
    result.quantities.push(within(
        ["refused", label, "1"],
        refused as f64,
        [count, count],
        [why, "the solver's own error"],
    ));
    for (space, id) in SPACES {
        two_rates(setting, space, id, result)?;
        implicit(setting, space, id, result)?;
    }
    Ok(())
}

fn admit(model: &Model, step_s: f64) -> seam_solver::error::Result<()> {
    let rest = State::at_rest(Numbering::new(model).len());
    Explicit::new(model, Options { step_s, ..Options::default() }, &rest).map(|_| ())
}

/// The explicit side just beside its critical step: no run may go wrong without a word.
fn two_rates(setting: &Setting, space: Space, id: &str, result: &mut CaseResult) -> Result<()> {
    let refuse = |e| setting.solver(e);
    let model = Sandwich::of(setting, space)?.cantilever(1.0).map_err(refuse)?;
    let exact = Unrefused::new(&alone(model.parts[1].clone())).map_err(refuse)?.critical_step(2000);
    let steps = setting.count("searched_steps", 100)?;
    let mut fates = Vec::new();
    for method in [Method::GravouilCombescure, Method::PrakashHjelmstad] {
        for beside in BESIDE {
            let setup =
                Setup { method, coarse: Stepping::Implicit, ratio: 5, fine_step: beside * exact, steps };
            fates.push((beside, fate(&model, setup, &mut result.work).map_err(refuse)?));
        }
    }
    let count = |wanted: &dyn Fn(&(f64, Cell)) -> bool| fates.iter().filter(|f| wanted(f)).count() as f64;
    let source = "elements implicit, particles explicit, five steps to one, both methods";
    let silent = count(&|(_, cell)| *cell == Cell::Silent);
    let why = "A run beyond its critical step has to be refused or stopped; whatever else it gives must be bounded.";
    let label = format!("Runs at two rates from 0.99 to 1.5 of critical that go wrong without a word, {id}");
    result.quantities.push(rounding(&format!("silent-{id}"), &label, silent, 0.0, why, source));
    let caught = count(&|(beside, cell)| *beside > 1.005 && matches!(cell, Cell::Refused | Cell::Stopped));
    let label = format!("Runs at two rates from 1.01 of critical on that are refused or stopped, {id}");
    let all = count(&|(beside, _)| *beside > 1.005);
    let why = ["All of them: ties take freedom away, but not from the modes inside the particles.", source];
    result.quantities.push(within([&format!("caught-{id}"), &label, "1"], caught, [all, all], why));
    let kept = count(&|(beside, cell)| *beside < 1.0 && *cell == Cell::Bounded);
    let label = format!("Runs at two rates at 0.99 of critical that are run and stay bounded, {id}");
    let why = ["Both methods: a refusal below the critical step would be a nuisance.", source];
    result.quantities.push(within([&format!("kept-{id}"), &label, "1"], kept, [2.0, 2.0], why));
    Ok(())
}

/// The trapezoidal rule keeps `½vᵀMv + ½uᵀKu` at any step.
fn implicit(setting: &Setting, space: Space, id: &str, result: &mut CaseResult) -> Result<()> {
    let steps = setting.count("implicit_steps", 1)?;
    let (work, mut counted) = (&mut Work::default(), Work::default());
    let model = Sandwich::of(setting, space)?.cantilever(1.0).map_err(|e| setting.solver(e))?;
    let mut lost = |factor: f64| -> seam_solver::error::Result<f64> {
        let system = Semidiscrete::new(&model, work)?;
        let step = factor * critical::bound(&model)?.step_s;
        let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, work)?;
        // Released from the static answer of its load.
        let standing = seam_solver::solve::statics::solve(&model)?;
        let u: Vec<f64> = system.free.iter().map(|&i| standing.u[i]).collect();
        let v = vec![0.0; u.len()];
        let (mut motion, _) = start(&system, (u, v), 0.0, 0.0, 0.0, work)?;
        let energy = system.strain(&motion.u);
        let mut worst = 0.0f64;
        for _ in 0..steps {
            newmark.step(&mut motion, [0.0; 2], work)?;
            let now = system.kinetic(&motion.v) + system.strain(&motion.u);
            worst = crate::observe::curve::nan_max(worst, (now / energy - 1.0).abs());
        }
        Ok(worst)
    };
    let search = Search { from: 1.0, to: setting.number("implicit_to")?, tolerance: ROUNDING };
    let found =
        search.largest(|factor| lost(factor).map(|lost| lost <= 1e-8).map_err(|e| setting.solver(e)))?;
    counted += *work;
    result.work += counted;
    result.margins.push(found.margin(
        [ROW, "undamped implicit steps keep their energy to 1e-8"],
        [
            &format!("implicit-{id}"),
            &format!("elements and particles, {id}, trapezoidal rule"),
            "step over the explicit bound",
        ],
        100.0,
    ));
    Ok(())
}

fn bodies(setting: &Setting) -> Result<Vec<Body>> {
    let (young_pa, density) = (setting.number("young_Pa")?, setting.number("density_kg_m3")?);
    let (side, thickness_m) = (setting.number("side_m")?, setting.number("thickness_m")?);
    let rows = setting.count("rows", 2)?;
    let material = BondMaterial { young_pa, poisson: setting.number("poisson")? };
    let ratio = setting.number("radius_ratio")?;
    let elasticity = Elasticity { young_pa, poisson: setting.number("poisson")?, density };
    let mut all = Vec::new();
    for (space, id) in SPACES {
        let made = || -> seam_solver::error::Result<Vec<(&str, &str, Model)>> {
            let matter = Matter { density, thickness_m };
            let few = if space == Space::Plane { rows } else { rows.div_ceil(2) };
            let lattice = bonded(close_packed(space, side, few, material, ratio, matter)?);
            let kind = (hypothesis(space, thickness_m), Formulation::Incompatible);
            let elements = alone(Part::Continuum(distorted(space, side, few, elasticity, kind, 0.25)?));
            let sandwich = Sandwich {
                space,
                young_pa,
                density,
                thickness_m,
                side,
                rows: few + 1,
                elements: [few, few + 2],
                tying: Tying::Mortar,
            };
            Ok(vec![
                ("lattice", "lattice", lattice),
                ("elements", "distorted elements", elements),
                ("coupled", "elements and particles", sandwich.model()?),
            ])
        };
        for (kind, name, model) in made().map_err(|e| setting.solver(e))? {
            all.push(Body { id: format!("{kind}-{id}"), name: format!("{name}, {id}"), model });
        }
    }
    Ok(all)
}
