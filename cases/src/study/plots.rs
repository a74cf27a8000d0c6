//! Curves of the line probes, beside their reference and the exact answer.

use super::Study;
use super::evaluate::{Solved, de_intervals};
use crate::error::Result;
use crate::observe::curve::Curve;
use crate::result::{Plot, Role, Series};
use crate::scene::probe::Probe;
use seam_solver::space::Vec3;

/// One plot per line probe.
pub fn all(study: &Study, solved: &Solved) -> Result<Vec<Plot>> {
    let probes = study.file.scene.probes.iter();
    probes
        .filter_map(|(name, probe)| solved.readings.curve(name).map(|curve| plot(study, name, probe, curve)))
        .collect()
}

fn plot(study: &Study, name: &str, probe: &Probe, curve: &Curve) -> Result<Plot> {
    let series = |name: &str, role, curve: &Curve| Series {
        name: name.to_owned(),
        role,
        x: curve.x.clone(),
        y: curve.y.clone(),
    };
    let mut all = vec![series("coupled", Role::Model, curve)];
    if study.file.scene.reference.is_some() {
        let reference = study.library.of(study.file, study.tally)?;
        if let Some((curve, _)) = reference.curves.get(name) {
            all.push(series("reference", Role::Reference, curve));
        }
    }
    if let Some(exact) = probe.exact.first() {
        let key = format!("probes.{name}.exact[0]");
        let mut theory = Curve { x: curve.x.clone(), y: Vec::new() };
        for &x in &curve.x {
            let y = exact.at(Vec3::new(x, 0.0, 0.0), &study.file.values, &key);
            theory.y.push(y.map_err(|fault| study.file.error(fault))?);
        }
        all.push(series("theory", Role::Reference, &theory));
    }
    let title = if probe.title.is_empty() { name } else { &probe.title };
    Ok(Plot {
        id: name.to_owned(),
        title: title.to_owned(),
        x_label: "x (m)".to_owned(),
        y_label: format!("{} ({})", title.to_lowercase(), probe.read.unit()),
        log: [false; 2],
        band: probe.band,
        shaded: de_intervals(study.file),
        series: all,
    })
}
