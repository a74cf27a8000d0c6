//! Seam's own lane of a race: reads the folder that the other codes read.

use crate::error::{Error, Result};
use seam_solver::dem::kernel::locality::{order, renumber};
use seam_solver::dem::kernel::vibration::Vibration;
use seam_solver::dem::network_csv::read;
use seam_solver::model::Model;
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
    let refuse = |source| Error::Solver { case: "race".to_owned(), source };
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
    let mut vibration = Vibration::new(&renumber(&network, &order), "cube", threads).map_err(refuse)?;
    drop(network);
    vibration.set(&vec![0.0; v.len()], &v);
    let start = Instant::now();
    vibration.advance(step_s, steps);
    let seconds = start.elapsed().as_secs_f64();
    let (u, _) = vibration.get();
    let mut displacement = vec![Vec3::zeros(); order.len()];
    for (new, &old) in order.iter().enumerate() {
        displacement[old] = Vec3::from_column_slice(&u[per * new..per * new + 3]);
    }
    Ok(Finish { seconds, displacement })
}

/// Solves a model at rest.
///
/// # Errors
/// What the solver refuses.
pub fn load(model: &Model) -> Result<Finish> {
    let start = Instant::now();
    let solution =
        statics::solve(model).map_err(|source| Error::Solver { case: "race".to_owned(), source })?;
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
