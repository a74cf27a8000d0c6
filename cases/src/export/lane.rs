//! Seam's own lane of a race: reads the folder that the other codes read.

use crate::error::{Error, Result};
use seam_solver::dem::kernel::locality::{order, renumber};
use seam_solver::dem::kernel::vibration::Vibration;
use seam_solver::dem::network::Network;
use seam_solver::dem::network_csv::read;
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::forces::Rotations;
use seam_solver::model::{Model, Part};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use std::path::Path;
use std::time::Instant;

/// How long it took, and where every particle or node ended.
pub struct Finish {
    /// Seconds, without reading and preparing.
    pub seconds: f64,
    /// Displacements, in m.
    pub displacement: Vec<Vec3>,
}

/// Lets the network of a folder vibrate freely.
///
/// # Errors
/// Files that are not those of [`super::race::Vibrating::export`].
pub fn vibrate(folder: &Path, threads: usize) -> Result<Finish> {
    let Start { network, order, v, step_s, steps } = Start::read(folder)?;
    let mut vibration = Vibration::new(&network, "cube", threads).map_err(refuse)?;
    drop(network);
    vibration.set(&vec![0.0; v.len()], &v);
    let start = Instant::now();
    vibration.advance(step_s, steps);
    let seconds = start.elapsed().as_secs_f64();
    Ok(Finish { seconds, displacement: in_order(&vibration.get().0, &order) })
}

/// The same with bonds for finite rotations, on one thread.
///
/// # Errors
/// As [`vibrate`].
pub fn turn(folder: &Path) -> Result<Finish> {
    let Start { network, order, v, step_s, steps } = Start::read(folder)?;
    let body = Part::Discrete { name: "cube".to_owned(), network };
    let model = Model {
        space: Space::Solid,
        parts: vec![body],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    // No forces act yet: velocities half a step before are those at the start.
    let state = State { v, ..State::at_rest(order.len() * Space::Solid.dofs_per_particle()) };
    let options = Options { step_s, rotations: Rotations::Finite, ..Options::default() };
    let mut motion = Explicit::new(&model, options, &state).map_err(refuse)?;
    drop(model);
    let start = Instant::now();
    motion.advance(steps as u64).map_err(refuse)?;
    let seconds = start.elapsed().as_secs_f64();
    Ok(Finish { seconds, displacement: in_order(motion.u(), &order) })
}

fn refuse(source: seam_solver::error::Error) -> Error {
    Error::Solver { case: "race".to_owned(), source }
}

/// A network with its particles in an order for speed.
struct Start {
    network: Network,
    /// Place in the file of each particle.
    order: Vec<usize>,
    /// Velocities and spins, in the new order.
    v: Vec<f64>,
    step_s: f64,
    steps: usize,
}

impl Start {
    fn read(folder: &Path) -> Result<Self> {
        let network =
            read(Space::Solid, &folder.join("particles.csv"), &folder.join("bonds.csv")).map_err(refuse)?;
        let (step_s, steps) = run(&folder.join("run.toml"))?;
        let velocity = velocities(&folder.join("velocities.csv"))?;
        let per = Space::Solid.dofs_per_particle();
        let order = order(&network);
        let mut v = vec![0.0; per * order.len()];
        for (new, &old) in order.iter().enumerate() {
            let at = velocity.get(old).copied().unwrap_or_default();
            v[per * new..per * new + 3].copy_from_slice(at.as_slice());
        }
        Ok(Start { network: renumber(&network, &order), order, v, step_s, steps })
    }
}

/// Displacements in the order of the file.
fn in_order(u: &[f64], order: &[usize]) -> Vec<Vec3> {
    let per = Space::Solid.dofs_per_particle();
    let mut displacement = vec![Vec3::zeros(); order.len()];
    for (new, &old) in order.iter().enumerate() {
        displacement[old] = Vec3::from_column_slice(&u[per * new..per * new + 3]);
    }
    displacement
}

/// Solves a model at rest.
///
/// # Errors
/// What the solver refuses.
pub fn load(model: &Model) -> Result<Finish> {
    let start = Instant::now();
    let solution = statics::solve(model).map_err(refuse)?;
    let seconds = start.elapsed().as_secs_f64();
    let nodes = 0..model.parts[0].positions().len();
    Ok(Finish { seconds, displacement: nodes.map(|k| solution.displacement(model, 0, k)).collect() })
}

fn unreadable(path: &Path, what: impl ToString) -> Error {
    Error::File { path: path.display().to_string(), source: std::io::Error::other(what.to_string()) }
}

/// Step (s) and number of steps.
fn run(path: &Path) -> Result<(f64, usize)> {
    let text = std::fs::read_to_string(path).map_err(|e| unreadable(path, e))?;
    let table: toml::Table = text.parse().map_err(|e| unreadable(path, e))?;
    let step = table.get("step_s").and_then(toml::Value::as_float);
    let steps = table.get("steps").and_then(toml::Value::as_integer).and_then(|n| usize::try_from(n).ok());
    step.zip(steps).ok_or_else(|| unreadable(path, "step_s or steps is missing; export the network again"))
}

fn velocities(path: &Path) -> Result<Vec<Vec3>> {
    let mut reader = csv::Reader::from_path(path).map_err(|e| unreadable(path, e))?;
    let rows = reader.deserialize::<(usize, f64, f64, f64)>();
    rows.map(|row| row.map(|(_, x, y, z)| Vec3::new(x, y, z)).map_err(|e| unreadable(path, e))).collect()
}
