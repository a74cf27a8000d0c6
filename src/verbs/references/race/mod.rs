//! `seam references race`: the same network and mesh in Seam and in each installed code, in turn.

mod table;

use super::super::check::print;
use super::scratch::Scratch;
use super::tools::{self, Tool};
use crate::args::Race;
use anyhow::{Context, Result};
use seam_cases::export::{Code, race};
use seam_reports::exit::Exit;
use std::path::{Path, PathBuf};
use std::process::Command;
use table::{Finish, Row};

/// Who runs, what they are given, and where they leave it.
struct Lane {
    name: &'static str,
    tool: Option<Tool>,
}

/// What is run.
struct Course {
    what: &'static str,
    /// Particles or nodes.
    size: usize,
    /// Bond updates of one run; for the mesh its unknowns.
    amount: u64,
    folder: PathBuf,
    /// First word of Seam's lane.
    own: String,
}

/// Runs everything, prints the table and writes it.
pub fn race(words: &Race) -> Result<Exit> {
    let scratch = Scratch::new()?;
    let mut rows = Vec::new();
    let networks = lanes(&[Code::Yade, Code::Lammps])?;
    let meshes = lanes(&[Code::Calculix])?;
    for &particles in &words.particles {
        let steps = words.steps.get();
        let start = race::vibrating(particles, steps)?;
        let folder = scratch.0.join(format!("network-{particles}"));
        start.export(Code::Yade, steps).write(&folder)?;
        let course = Course {
            what: "network",
            size: start.network.particles.len(),
            amount: (start.network.bonds.len() * steps) as u64,
            own: folder.display().to_string(),
            folder,
        };
        rows.extend(run(&course, &networks, words, &scratch.0)?);
    }
    for &nodes in &words.nodes {
        let model = race::clamped_bar(nodes)?;
        let folder = scratch.0.join(format!("mesh-{nodes}"));
        race::export_bar(&model).write(&folder)?;
        let size = model.parts[0].positions().len();
        let course = Course { what: "mesh", size, amount: 3 * size as u64, folder, own: nodes.to_string() };
        rows.extend(run(&course, &meshes, words, &scratch.0)?);
    }
    print(&table::text(&rows))?;
    table::write(&rows, words, &words.out)?;
    eprintln!("{}", words.out.join("race.csv").display());
    Ok(Exit::Pass)
}

/// Seam and the codes that are installed; one line for each that is not.
fn lanes(codes: &[Code]) -> Result<Vec<Lane>> {
    let mut lanes = vec![Lane { name: "seam", tool: None }];
    for &code in codes {
        match tools::find(code) {
            Ok(tool) => lanes.push(Lane { name: code.name(), tool: Some(tool) }),
            Err(missing) => print(&format!("{}: {missing}\n", code.name()))?,
        }
    }
    Ok(lanes)
}

/// All lanes on all numbers of threads, round after round, so that a busy moment hits every one of them.
fn run(course: &Course, lanes: &[Lane], words: &Race, scratch: &Path) -> Result<Vec<Row>> {
    let mut rows: Vec<Row> = Vec::new();
    for threads in words.threads.iter().map(|n| n.get()) {
        let mut finishes: Vec<Vec<Finish>> = lanes.iter().map(|_| Vec::new()).collect();
        for round in 1..=words.rounds.get() {
            for (lane, finishes) in lanes.iter().zip(&mut finishes) {
                eprintln!(
                    "{} of {}, {threads} threads, round {round}: {}",
                    course.what, course.size, lane.name
                );
                finishes.push(once(course, lane, threads, words, scratch)?);
            }
        }
        let own = finishes[0].clone();
        for (lane, finishes) in lanes.iter().zip(&finishes) {
            rows.push(Row::new(course.what, course.size, course.amount, threads, lane.name, finishes, &own));
        }
    }
    Ok(rows)
}

fn once(course: &Course, lane: &Lane, threads: usize, words: &Race, scratch: &Path) -> Result<Finish> {
    let out = scratch.join("finish");
    if out.exists() {
        std::fs::remove_dir_all(&out).with_context(|| out.display().to_string())?;
    }
    let (command, script) = match &lane.tool {
        None => {
            let mut command = Command::new(std::env::current_exe()?);
            command.args(["references", "lane", &course.own]).arg(&out).arg(threads.to_string());
            (command, PathBuf::from("seam references lane"))
        }
        Some(tool) => {
            let script = words.home.join("generators").join(lane.name).join("race.py");
            let mut command = tool.command(threads);
            command.arg(&script).arg(&course.folder).arg(&out);
            (command, script)
        }
    };
    tools::run(command, &script)?;
    Finish::read(&out)
}
