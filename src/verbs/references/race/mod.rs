//! `seam references race`: the same network and mesh in Seam and in each installed code, in turn.

mod finish;
mod record;
mod row;

use super::super::check::print;
use super::scratch::Scratch;
use super::tools::{self, Tool};
use crate::args::Race;
use anyhow::{Context, Result};
use finish::Finish;
use row::Row;
use seam_cases::export::{Code, Export, race};
use seam_reports::exit::Exit;
use seam_reports::race::{ARITHMETIC, BANDWIDTH, Race as Recorded, SEAM, SEAM_FINITE as FINITE};
use seam_reports::terminal;
use seam_solver::dem::kernel::per_bond::PerBond;
use seam_solver::limits::{arithmetic, bandwidth};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Who runs. Seam with finite rotations knows one thread.
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
    /// Seam's lane whose end the others are compared with: with finite rotations where they follow them too.
    target: &'static str,
    /// What Seam's faster loop costs per bond update.
    per_bond: Option<PerBond>,
}

/// Runs everything, writes it and prints the table.
pub fn race(words: &Race) -> Result<Exit> {
    let scratch = Scratch::new()?;
    let (mut rows, mut inputs) = (Vec::new(), BTreeMap::new());
    let networks = lanes(&[SEAM, FINITE], &[Code::Yade, Code::Lammps])?;
    let meshes = lanes(&[SEAM], &[Code::Calculix])?;
    let mut versions = BTreeMap::new();
    let mut given = |name: &str, export: &Export, folder: &Path| -> Result<()> {
        let hashes = export.hashes().into_iter();
        inputs.extend(hashes.map(|(file, hash)| (format!("{name}/{file}"), hash)));
        Ok(export.write(folder)?)
    };
    let mut courses = Vec::new();
    for &particles in &words.particles {
        let steps = words.steps.get();
        let start = race::vibrating(particles, steps)?;
        let name = format!("network-{particles}");
        let folder = scratch.0.join(&name);
        given(&name, &start.export(Code::Yade, steps), &folder)?;
        let course = Course {
            what: "network",
            size: start.network.particles.len(),
            amount: (start.network.bonds.len() * steps) as u64,
            own: folder.display().to_string(),
            folder,
            target: FINITE,
            per_bond: Some(PerBond::solid(&start.network)),
        };
        courses.push((course, &networks));
    }
    for &nodes in &words.nodes {
        let model = race::clamped_bar(nodes)?;
        let name = format!("mesh-{nodes}");
        let folder = scratch.0.join(&name);
        given(&name, &race::export_bar(&model), &folder)?;
        let size = model.parts[0].positions().len();
        let course = Course {
            what: "mesh",
            size,
            amount: 3 * size as u64,
            folder,
            own: nodes.to_string(),
            target: SEAM,
            per_bond: None,
        };
        courses.push((course, &meshes));
    }
    for (course, lanes) in &courses {
        rows.extend(run(course, lanes, words, &scratch.0, &mut versions)?);
    }
    let data = record::write(&rows, words, &versions, &inputs)?;
    print(&terminal::race(&Recorded::of(&data, false)?))?;
    eprintln!("{}", words.out.join("race/race.csv").display());
    if words.accept {
        record::accept(&words.out, &words.home.join("data"))?;
    }
    Ok(Exit::Pass)
}

/// Seam and the codes that are installed; one line for each that is not.
fn lanes(own: &[&'static str], codes: &[Code]) -> Result<Vec<Lane>> {
    let mut lanes: Vec<Lane> = own.iter().map(|name| Lane { name, tool: None }).collect();
    for &code in codes {
        match tools::find(code) {
            Ok(tool) => lanes.push(Lane { name: code.name(), tool: Some(tool) }),
            Err(missing) => print(&format!("{}: {missing}\n", code.name()))?,
        }
    }
    Ok(lanes)
}

/// All lanes on all numbers of threads, round after round, so that a busy moment hits every one of them, and the limits too.
fn run(
    course: &Course,
    lanes: &[Lane],
    words: &Race,
    scratch: &Path,
    versions: &mut BTreeMap<&'static str, String>,
) -> Result<Vec<Row>> {
    let own = Lane { name: course.target, tool: None };
    let target = once(course, &own, 1, words, scratch)?;
    let mut rows: Vec<Row> = Vec::new();
    for threads in words.threads.iter().map(|n| n.get()) {
        let lanes: Vec<&Lane> = lanes.iter().filter(|lane| lane.name != FINITE || threads == 1).collect();
        let mut finishes: Vec<Vec<Finish>> = lanes.iter().map(|_| Vec::new()).collect();
        let mut limits = [const { Vec::new() }; 2];
        for round in 1..=words.rounds.get() {
            for (lane, finishes) in lanes.iter().zip(&mut finishes) {
                eprintln!(
                    "{} of {}, {threads} threads, round {round}: {}",
                    course.what, course.size, lane.name
                );
                let finish = once(course, lane, threads, words, scratch)?;
                versions.insert(lane.name, finish.version.clone());
                finishes.push(finish);
            }
            if let Some(PerBond { bytes, operations }) = course.per_bond {
                let amount = course.amount as f64;
                limits[0].push(amount * bytes / bandwidth(threads));
                limits[1].push(amount * operations / arithmetic(threads));
            }
        }
        let lane =
            |code| row::Lane { what: course.what, size: course.size, threads, code, amount: course.amount };
        let seam: Vec<f64> = finishes[0].iter().map(|f| f.seconds).collect();
        for (own, finishes) in lanes.iter().zip(&finishes) {
            rows.push(Row::of_code(lane(own.name), finishes, &seam, &target));
        }
        for (code, times) in [BANDWIDTH, ARITHMETIC].into_iter().zip(&limits).filter(|(_, t)| !t.is_empty()) {
            rows.push(Row::of_limit(lane(code), times, &seam));
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
            command.args((lane.name == FINITE).then_some("--finite"));
            (command, PathBuf::from("seam references lane"))
        }
        Some(tool) => {
            let script = words.home.join("generators").join(lane.name).join("race.py");
            let mut command = tool.command(threads);
            command.arg(&script).arg(&course.folder).arg(&out);
            (command, script)
        }
    };
    let said = tools::run(command, &script)?;
    Finish::read(&out, course.size).with_context(|| {
        let (script, said) = (script.display(), tools::end_of(&said));
        format!("{script} ended without an error and without a whole result; it said:\n{said}")
    })
}
