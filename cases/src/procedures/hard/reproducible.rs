//! The same bits from one thread and from several, and after a restart from a checkpoint.

use super::super::Setting;
use super::super::rounding;
use super::bodies::{SPACES, Sandwich, bonded, close_packed_of};
use crate::error::{Error, Result};
use crate::margin::Search;
use crate::result::CaseResult;
use seam_solver::dem::kernel::vibration::Vibration;
use seam_solver::dem::network::Network;
use seam_solver::dynamics::State;
use seam_solver::dynamics::checkpoint;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::forces::Rotations;
use seam_solver::error::Result as Solved;
use seam_solver::model::{Model, Numbering};
use seam_solver::solve::statics;
use seam_solver::space::Space;
use seam_solver::work::Work;
use std::path::Path;

const ROW: &str = "1 and 2 threads, restart from a checkpoint";

/// Threads of the particle kernel and of the solver, restarts of three kinds of runs.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let steps = setting.count("steps", 10)?;
    let folder = std::env::temp_dir().join(format!("seam-checkpoint-{}", std::process::id()));
    std::fs::create_dir_all(&folder)
        .map_err(|source| Error::File { path: folder.display().to_string(), source })?;
    let done = SPACES.iter().try_for_each(|(space, id)| all(setting, (*space, id), steps, &folder, result));
    // Best effort: an error worth telling is the first one.
    let _ = std::fs::remove_dir_all(&folder);
    done
}

fn all(
    setting: &Setting,
    (space, id): (Space, &str),
    steps: usize,
    folder: &Path,
    result: &mut CaseResult,
) -> Result<()> {
    let refuse = |e| setting.solver(e);
    let network = close_packed_of(setting, space)?;
    let alone = vibrate(&network, 1, steps, &mut result.work).map_err(refuse)?;
    let most = network.particles.len().min(setting.count("threads_to", 2)?);
    let found = Search { from: 1.0, to: most as f64, tolerance: 0.0 }.largest(|threads| {
        let together = vibrate(&network, threads as usize, steps, &mut result.work).map_err(refuse)?;
        Ok(together == alone)
    })?;
    result.margins.push(found.margin(
        [ROW, "the state after a run is the same to the last bit"],
        [&format!("threads-{id}"), &format!("particle kernel, {id}"), "threads"],
        2.0,
    ));
    let coupled = Sandwich::of(setting, space)?.cantilever(1.0).map_err(refuse)?;
    let standing = |threads: usize| -> Result<Vec<f64>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|e| Error::Study {
            case: setting.file.scene.id.clone(),
            message: format!("{threads} threads: {e}"),
        })?;
        let solution = pool.install(|| statics::solve(&coupled)).map_err(refuse)?;
        Ok(solution.u)
    };
    let [one, two] = [standing(1)?, standing(2)?];
    let why = "The same sums in the same order, whatever the number of threads.";
    let label = format!("Unknowns of a coupled equilibrium that differ between 1 and 2 threads, {id}");
    let differ = one.iter().zip(&two).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    result.quantities.push(rounding(
        &format!("statics-{id}"),
        &label,
        differ as f64,
        0.0,
        why,
        "the same solve in a pool of one thread",
    ));
    let free = bonded(network);
    for (code, name, model, rotations) in [
        ("coupled", "elements and particles", &coupled, Rotations::Small),
        ("small", "linear bonds", &free, Rotations::Small),
        ("finite", "finite rotations", &free, Rotations::Finite),
    ] {
        let differ =
            restarted(model, rotations, steps as u64, &folder.join(format!("{code}-{id}")), &mut result.work);
        let label = format!("Numbers that differ after a restart in the middle, {name}, {id}");
        let why = "A checkpoint keeps every bit of the motion.";
        result.quantities.push(rounding(
            &format!("restart-{code}-{id}"),
            &label,
            differ.map_err(refuse)? as f64,
            0.0,
            why,
            "the same run without a restart",
        ));
    }
    Ok(())
}

fn shaken(n: usize) -> Vec<f64> {
    (0..n).map(|i| 1e-3 * (2.3 * i as f64 + 0.4).sin()).collect()
}

/// State after some steps of the particle kernel.
fn vibrate(network: &Network, threads: usize, steps: usize, work: &mut Work) -> Solved<Vec<u64>> {
    let mut run = Vibration::new(network, "block", threads)?;
    let n = network.space.dofs_per_particle() * network.particles.len();
    run.set(&shaken(n), &vec![0.0; n]);
    let step_s = 0.5 * critical::bound(&bonded(network.clone()))?.step_s;
    run.advance(step_s, steps);
    work.steps += steps as u64;
    work.bond_updates += (steps * network.bonds.len()) as u64;
    let (u, v) = run.get();
    Ok(u.iter().chain(&v).map(|x| x.to_bits()).collect())
}

/// Numbers of state and ledger that differ between a run and the same run stopped and resumed half-way.
fn restarted(model: &Model, rotations: Rotations, steps: u64, file: &Path, work: &mut Work) -> Solved<usize> {
    let n = Numbering::new(model).len();
    let start = State { v: shaken(n), ..State::at_rest(n) };
    let options = Options { step_s: 0.5 * critical::bound(model)?.step_s, rotations, ..Options::default() };
    let mut whole = Explicit::new(model, options.clone(), &start)?;
    whole.advance(steps / 2)?;
    checkpoint::write(file, model, &whole)?;
    let mut resumed = checkpoint::resume(file, model, options)?;
    whole.advance(steps - steps / 2)?;
    resumed.advance(steps - steps / 2)?;
    *work += whole.work();
    let (one, two) = (whole.observe()?, resumed.observe()?);
    let numbers = |o: &seam_solver::dynamics::explicit::Observation| -> Vec<u64> {
        let ledger = [o.ledger.kinetic, o.ledger.strain, o.ledger.work.total(), o.ledger.initial, o.gap];
        o.state.u.iter().chain(&o.state.v).chain(&o.state.a).chain(&ledger).map(|x| x.to_bits()).collect()
    };
    Ok(numbers(&one).iter().zip(&numbers(&two)).filter(|(a, b)| a != b).count())
}
