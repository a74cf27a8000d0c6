//! Curves of the probes along lines and over time, beside their reference and the exact answer, and the energies of a run.

use super::Study;
use super::evaluate::{Course, Solved, de_intervals};
use crate::error::Result;
use crate::observe::crack::Cracked;
use crate::observe::curve::{Axis, Curve};
use crate::result::{Plot, ReferenceKind, Role, Series};
use crate::scene::probe::Probe;
use seam_solver::simulation::Energies;
use seam_solver::space::Vec3;
use std::collections::BTreeMap;

/// One plot per curve, and the energies of a run.
pub fn all(study: &Study, solved: &Solved) -> Result<Vec<Plot>> {
    let mut plots = Vec::new();
    for (name, probe) in &study.file.scene.probes {
        if let Some(curve) = solved.readings.curve(name) {
            plots.push(plot(study, solved, name, (probe, curve))?);
        }
    }
    plots.extend(solved.course.as_ref().map(energies));
    plots.extend(solved.cracked.as_ref().map(path));
    Ok(plots)
}

/// What is discrete: a part of the line, or the time from the first switch on.
fn shaded(study: &Study, solved: &Solved, curve: &Curve) -> Vec<[f64; 2]> {
    match curve.axis {
        Axis::Position => de_intervals(study.file),
        Axis::Displacement | Axis::Places => Vec::new(),
        Axis::Time => {
            let first = solved.course.as_ref().and_then(Course::first_switch);
            first.zip(curve.x.last()).map(|(first, last)| [first, *last]).into_iter().collect()
        }
    }
}

fn plot(study: &Study, solved: &Solved, name: &str, (probe, curve): (&Probe, &Curve)) -> Result<Plot> {
    let series = |name: &str, role, curve: &Curve| Series {
        name: name.to_owned(),
        role,
        x: curve.x.clone(),
        y: curve.y.clone(),
    };
    let own = match curve.axis {
        Axis::Displacement => "this scene",
        Axis::Places => "broken bonds",
        _ if study.file.scene.switches.is_empty() => "coupled",
        _ => "switched",
    };
    // Places follow no order that a line could show.
    let [role, of_reference] = match curve.axis {
        Axis::Places => [Role::Data; 2],
        _ => [Role::Model, Role::Reference],
    };
    let mut all = vec![series(own, role, curve)];
    let mut against = ReferenceKind::Exact;
    for (source, curve) in own_runs(study, name)? {
        all.push(series(&source, of_reference, &curve));
        against = ReferenceKind::OwnRun;
    }
    if study.file.scene.reference.is_some() && probe.read.has_counterpart() {
        let reference = study.library.of(study.file, study.tally)?;
        if let Some((curve, _)) = reference.curves.get(name) {
            all.push(series("reference", Role::Reference, curve));
            against = ReferenceKind::OwnFem;
        }
    }
    for (legend, names) in &probe.beside {
        let file = study.file.with(&study.variants(names))?;
        let other = study.library.own_run(&file, legend, study.tally)?;
        if let Some((curve, _)) = other.curves.get(name) {
            all.push(series(legend, Role::Model, curve));
        }
    }
    for answer in study.peers.values() {
        if let Some((curve, _)) = answer.reference.curves.get(name) {
            let title = format!("{}, {}", answer.agreement.code, answer.agreement.model);
            all.push(series(&title, Role::Reference, curve));
        }
    }
    if let Some(exact) = probe.exact.first() {
        let key = format!("probes.{name}.exact[0]");
        let mut theory = Curve { axis: curve.axis, x: curve.x.clone(), y: Vec::new() };
        for &x in &curve.x {
            let y = match curve.axis {
                Axis::Position => exact.at(Vec3::new(x, 0.0, 0.0), &study.file.values, &key),
                Axis::Time => exact.at_time(x, &study.file.values, &key),
                // Neither a place nor a time: the expression's x is the displacement.
                Axis::Displacement | Axis::Places => {
                    exact.at(Vec3::new(x, 0.0, 0.0), &study.file.values, &key)
                }
            };
            theory.y.push(y.map_err(|fault| study.file.error(fault))?);
        }
        all.push(series("theory", Role::Reference, &theory));
    }
    let title = if probe.title.is_empty() { name } else { &probe.title };
    Ok(Plot {
        id: name.to_owned(),
        title: title.to_owned(),
        x_label: curve.axis.label().to_owned(),
        y_label: format!("{} ({})", title.to_lowercase(), probe.read.unit()),
        log: [false; 2],
        band: probe.band,
        against,
        shaded: shaded(study, solved, curve),
        series: all,
    })
}

/// Curves of a probe in the other runs that its quantities are compared with, by what they are.
fn own_runs(study: &Study, probe: &str) -> Result<BTreeMap<String, Curve>> {
    let mut curves = BTreeMap::new();
    let scene = &study.file.scene;
    let now = scene.quantities.values().filter(|q| q.tiers.contains(&study.tier));
    for quantity in now.filter(|q| q.probe == probe && q.variants.is_empty() && q.norm.is_some()) {
        let Some((names, source)) =
            quantity.reference.as_ref().and_then(|r| Some((r.variants.as_ref()?, &r.source)))
        else {
            continue;
        };
        let file = study.file.with(&study.variants(names))?;
        let run = study.library.own_run(&file, source, study.tally)?;
        curves.extend(run.curves.get(probe).map(|(curve, _)| (source.clone(), curve.clone())));
    }
    Ok(curves)
}

/// Force against displacement along the whole path, and what displacement control sees of it.
fn path(cracked: &Cracked) -> Plot {
    let series =
        |name: &str, role, curve: Curve| Series { name: name.to_owned(), role, x: curve.x, y: curve.y };
    Plot {
        id: "path".to_owned(),
        title: "Path through the failures".to_owned(),
        x_label: Axis::Displacement.label().to_owned(),
        y_label: "force (N)".to_owned(),
        series: vec![
            series("failure by failure", Role::Model, cracked.path()),
            series("under displacement control", Role::Reference, cracked.envelope()),
        ],
        ..Plot::default()
    }
}

/// Entries of the energy balance: name in the plot, and where it is kept.
type Entry = (&'static str, fn(&Energies) -> f64);
const ENTRIES: [Entry; 8] = [
    ("kinetic", |e| e.kinetic),
    ("strain", |e| e.strain),
    ("external work", |e| e.external),
    ("damping", |e| e.damping),
    ("interface", |e| e.interface),
    ("transfer", |e| e.transfer),
    ("contact", |e| e.contact),
    ("fracture", |e| e.fracture),
];

/// The entries of the energy balance over time.
fn energies(course: &Course) -> Plot {
    let times: Vec<f64> = course.energies.iter().map(|(t, _)| *t).collect();
    let series = |(name, of): &Entry| Series {
        name: (*name).to_owned(),
        role: Role::Model,
        x: times.clone(),
        y: course.energies.iter().map(|(_, energies)| of(energies)).collect(),
    };
    let end = times.last().copied().unwrap_or_default();
    Plot {
        id: "energy-balance".to_owned(),
        title: "Energies".to_owned(),
        x_label: Axis::Time.label().to_owned(),
        y_label: "energy (J)".to_owned(),
        shaded: course.first_switch().map(|first| [first, end]).into_iter().collect(),
        // Contact and fracture are shown where there are any.
        series: ENTRIES
            .iter()
            .map(series)
            .enumerate()
            .filter(|(k, s)| *k < 6 || s.y.iter().any(|y| *y != 0.0))
            .map(|(_, s)| s)
            .collect(),
        ..Plot::default()
    }
}
