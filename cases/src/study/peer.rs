//! What other codes made of the scene, read by the scene's own probes.

use super::reference::Reference;
use super::richardson::Estimate;
use crate::error::{Error, Result};
use crate::export::{self, Code};
use crate::file::SceneFile;
use crate::model::{self, Built};
use crate::observe::curve::Curve;
use crate::observe::field::Field;
use crate::observe::probes::{Moment, Observer, Reading};
use crate::observe::supports::Supports;
use crate::result::{Agreement, ReferenceKind};
use crate::scene::peer::Peer;
use crate::scene::probe::{Probe, Read};
use seam_references::{Dataset, Problem, find};
use seam_solver::model::Numbering;
use std::collections::BTreeMap;
use std::sync::Arc;

/// What a code computed, and which code it was.
pub struct Answer {
    /// Readings of the probes that it can answer.
    pub reference: Arc<Reference>,
    /// Code, version and date; the network is the peer's.
    pub agreement: Agreement,
}

/// Answers of all peers, and notes on those that do not apply: a scene with keys set to other values is not what the
/// code was given.
///
/// # Errors
/// References that are missing or altered, or out of date for the scene as it is written.
pub fn all(file: &SceneFile) -> Result<(BTreeMap<String, Answer>, Vec<String>)> {
    let (mut answers, mut notes) = (BTreeMap::new(), Vec::new());
    for (name, peer) in &file.scene.peers {
        match answer(file, name, peer) {
            Ok(answer) => {
                answers.insert(name.clone(), answer);
            }
            Err(Error::Reference { source, .. })
                if matches!(*source, Problem::OutOfDate { .. }) && !file.overrides().is_empty() =>
            {
                notes.push(format!("{}: not compared, since the scene is not what it was given", peer.about));
            }
            Err(error) => return Err(error),
        }
    }
    Ok((answers, notes))
}

fn answer(file: &SceneFile, name: &str, peer: &Peer) -> Result<Answer> {
    let refuse = |problem| Error::Reference { case: file.scene.id.clone(), source: Box::new(problem) };
    let code = Code::of(peer.code).ok_or_else(|| Error::Study {
        case: file.scene.id.clone(),
        message: format!("peers.{name}: no other code"),
    })?;
    let source = format!("{name}-{}", code.name());
    let data = find(&file.scene.id, &source).and_then(|r| r.open()).map_err(refuse)?;
    let mut reference = match peer.code {
        ReferenceKind::Calculix => along_a_line(file, &data).map_err(refuse)?,
        _ => {
            let export = export::of_peer(file, name, code)?;
            data.made_from(&export.hashes()).map_err(refuse)?;
            let file = file.with(&super::variants(file, &peer.variants))?;
            let built = model::build(&file)?;
            let table = Table::new(&built, &data).map_err(refuse)?;
            match file.scene.dynamics {
                None => at_rest(&file, &built, &table)?,
                Some(_) => in_motion(&file, &built, &table)?,
            }
        }
    };
    let p = &data.provenance;
    let title = code.title();
    reference.about = format!("{}: {title} {}, run on {} ({})", peer.about, p.version, p.date, p.machine);
    let agreement = Agreement {
        code: title.to_owned(),
        version: p.version.clone(),
        date: p.date.to_string(),
        model: peer.about.clone(),
        ..Agreement::default()
    };
    Ok(Answer { reference: Arc::new(reference), agreement })
}

/// Displacements and rotations of particles, row by row.
struct Table<'a> {
    /// Time, and particle, of each row where there are several times.
    at: Option<(&'a [f64], &'a [f64])>,
    /// One column per unknown of a particle.
    columns: Vec<&'a [f64]>,
    rows: usize,
}

impl<'a> Table<'a> {
    fn new(built: &Built, data: &'a Dataset) -> std::result::Result<Self, Problem> {
        let names: &[&str] = match built.model.space.dim() {
            2 => &["ux", "uy", "rz"],
            _ => &["ux", "uy", "uz", "rx", "ry", "rz"],
        };
        let unit = |name: &str| if name.starts_with('u') { "m" } else { "rad" };
        let columns = names.iter().map(|name| data.column(name, unit(name)));
        let at = match data.provenance.columns.contains_key("t") {
            true => Some((data.column("t", "s")?, data.column("particle", "1")?)),
            false => None,
        };
        Ok(Table { at, columns: columns.collect::<std::result::Result<_, _>>()?, rows: data.rows() })
    }

    /// Puts a row in the place of its particle.
    fn fill(&self, row: usize, numbering: &Numbering, u: &mut [f64]) {
        let particle = self.at.map_or(row, |(_, particle)| particle[row] as usize);
        let first = numbering.unknown(0, particle, 0);
        // Particles that are not there are caught by the hashes of what was exported.
        for (c, column) in self.columns.iter().enumerate() {
            if let Some(place) = u.get_mut(first + c) {
                *place = column[row];
            }
        }
    }
}

/// Whether displacements of particles answer a probe.
fn answers(probe: &Probe) -> bool {
    matches!(probe.read, Read::Ux | Read::Uy | Read::Uz | Read::SecantRotation | Read::SectionRotation)
}

/// Every probe that displacements answer, as particles lie at rest.
fn at_rest(file: &SceneFile, built: &Built, table: &Table) -> Result<Reference> {
    let numbering = Numbering::new(&built.model);
    let mut u = vec![0.0; numbering.len()];
    (0..table.rows).for_each(|row| table.fill(row, &numbering, &mut u));
    let mut reference = Reference::default();
    for (name, probe) in file.scene.probes.iter().filter(|(_, probe)| answers(probe)) {
        match look(file, built, &u, (name, probe), |observer| observer.read())? {
            Reading::Scalar(value) => reference.scalar(name, value),
            Reading::Curve(curve) => {
                reference.curves.insert(name.clone(), (curve, 0.0));
            }
        }
    }
    Ok(reference)
}

/// The histories of displacements at points, from the particles around them.
fn in_motion(file: &SceneFile, built: &Built, table: &Table) -> Result<Reference> {
    let numbering = Numbering::new(&built.model);
    let mut u = vec![0.0; numbering.len()];
    let (times, _) = table.at.unwrap_or_default();
    let histories = || file.scene.probes.iter().filter(|(_, probe)| answers(probe) && probe.is_history());
    let mut curves: BTreeMap<String, (Curve, f64)> =
        histories().map(|(name, _)| (name.clone(), (Curve::history(), 0.0))).collect();
    for row in 0..table.rows {
        table.fill(row, &numbering, &mut u);
        if times.get(row + 1) == Some(&times[row]) {
            continue;
        }
        for (name, probe) in histories() {
            let value = look(file, built, &u, (name, probe), |observer| observer.now())?;
            if let Some((curve, _)) = curves.get_mut(name) {
                curve.x.push(times[row]);
                curve.y.push(value);
            }
        }
    }
    Ok(Reference { curves, ..Reference::default() })
}

fn look<T>(
    file: &SceneFile,
    built: &Built,
    u: &[f64],
    (name, probe): (&str, &Probe),
    read: impl FnOnce(&Observer) -> Result<T>,
) -> Result<T> {
    let field = Field::new(&built.model, u);
    let supports = Supports::new(built);
    let moment = Moment { field: Some(&field), strain: f64::NAN, reactions: &[], supports: &supports };
    read(&Observer { file, moment: &moment, name, probe })
}

/// Deflections along a line: the probes `uy` and `secant-rotation` at its stations, and `uy` at its points.
///
/// The half of what a refinement changed is taken as the standard uncertainty.
fn along_a_line(file: &SceneFile, data: &Dataset) -> std::result::Result<Reference, Problem> {
    let column = |name: &str, unit: &str| data.column(name, unit);
    let line = |y: &[f64], x: &[f64]| Curve { x: x.to_vec(), y: y.to_vec(), ..Curve::default() };
    let x = column("x", "m")?;
    let [fine, coarse] = [line(column("uy", "m")?, x), line(column("uy_coarse", "m")?, x)];
    let mut reference = Reference::default();
    for (name, probe) in &file.scene.probes {
        let stations = |line: &crate::scene::probe::Line| -> Option<Vec<f64>> {
            let end =
                |numbers: &[crate::scene::number::Number]| numbers.first()?.value(&file.values, "").ok();
            let (from, to) = (end(&line.from)?, end(&line.to)?);
            let n = line.intervals;
            Some((0..=n).map(|k| from + (to - from) * (k as f64 / n as f64)).collect())
        };
        let read = |curve: &Curve| -> Option<Reading> {
            match (probe.read, &probe.line, &probe.point) {
                (Read::Uy, None, Some(point)) => {
                    let x = point.first()?.value(&file.values, "").ok()?;
                    curve.at(x).map(Reading::Scalar)
                }
                (Read::Uy, Some(line), _) => {
                    let x = stations(line)?;
                    let y = x.iter().map(|&x| curve.at(x)).collect::<Option<_>>()?;
                    Some(Reading::Curve(Curve { x, y, ..Curve::default() }))
                }
                (Read::SecantRotation, Some(line), _) => {
                    let x = stations(line)?;
                    let u = x.iter().map(|&x| curve.at(x)).collect::<Option<Vec<f64>>>()?;
                    let pairs = || x.windows(2).zip(u.windows(2));
                    let y = pairs().map(|(x, u)| (u[1] - u[0]) / (x[1] - x[0])).collect();
                    let x = pairs().map(|(x, _)| 0.5 * (x[0] + x[1])).collect();
                    Some(Reading::Curve(Curve { x, y, ..Curve::default() }))
                }
                _ => None,
            }
        };
        match (read(&fine), read(&coarse)) {
            (Some(Reading::Scalar(value)), Some(Reading::Scalar(before))) => {
                let estimate = Estimate { value, order: None, u: 0.5 * (value - before).abs() };
                reference.scalars.insert(name.clone(), estimate);
            }
            (Some(Reading::Curve(curve)), Some(Reading::Curve(before))) => {
                let largest = |y: &mut dyn Iterator<Item = f64>| y.fold(0.0f64, |m, y| m.max(y.abs()));
                let change = largest(&mut curve.y.iter().zip(&before.y).map(|(a, b)| a - b));
                let u = 0.5 * change / largest(&mut curve.y.iter().copied());
                reference.curves.insert(name.clone(), (curve, u));
            }
            _ => {}
        }
    }
    Ok(reference)
}
