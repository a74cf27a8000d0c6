//! The table of random packings: moduli by periodic homogenisation against the reference `homogenised-packing`.

use super::Setting;
use crate::error::Result;
use crate::result::{CaseResult, Observation, Plot, ReferenceKind, Role, Series};
use seam_solver::dem::calibration::specimen::packing_table;

/// Bond radii, and the moduli they are compared with, are the rows of the reference.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    let count = setting.count_of_tier("particles", 50)?;
    let first = setting.count("first_seed", 0)? as u64;
    let seeds: Vec<u64> = (first..).take(setting.count_of_tier("seeds", 2)?).collect();
    let data = setting.dataset("homogenised-packing", "prototype")?;
    let column = |name: &str| data.column(name, "1").map_err(|problem| setting.reference(problem));
    let (ratios, young, poisson) = (column("radius_ratio")?, column("young_ratio")?, column("poisson")?);
    let table = packing_table(count, &seeds, ratios, &mut result.work).map_err(|e| setting.solver(e))?;
    let tolerance = setting.number("tolerance")?;
    // Standard error of the mean over the seeds.
    let of_mean = |scatter: f64| scatter / (seeds.len() as f64).sqrt();
    for (k, row) in table.iter().enumerate() {
        let ratio = row.radius_ratio;
        let moduli = [
            ("young", "E/E_μ", row.homogenised.young_pa, row.scatter.young_pa, young[k]),
            ("poisson", "ν", row.homogenised.poisson, row.scatter.poisson, poisson[k]),
        ];
        for (name, symbol, value, scatter, reference) in moduli {
            result.quantities.push(Observation {
                id: format!("{name}-{}", k + 1),
                label: format!("{symbol} at r̃ = {ratio}"),
                unit: "1".to_owned(),
                value,
                reference: Some(reference),
                kind: ReferenceKind::Prototype,
                source: data.provenance.source.clone(),
                u_num: of_mean(scatter),
                accepted: Some([reference * (1.0 - tolerance), reference * (1.0 + tolerance)]),
                why: "Protocols of packing and bonding differ between codes by 2 %; single packings scatter by 1 %.".to_owned(),
                ..Observation::default()
            });
        }
    }
    let curve = |name: &str, role, y: Vec<f64>| Series { name: name.to_owned(), role, x: ratios.to_vec(), y };
    result.curves.push(Plot {
        id: "young".to_owned(),
        title: "Young's modulus of random packings over that of their bonds".to_owned(),
        x_label: "bond radius over particle radius (1)".to_owned(),
        y_label: "E / E_μ (1)".to_owned(),
        series: vec![
            curve("homogenised", Role::Model, table.iter().map(|row| row.homogenised.young_pa).collect()),
            curve("recorded", Role::Data, young.to_vec()),
            curve("affine law", Role::Reference, table.iter().map(|row| row.affine.young_pa).collect()),
        ],
        ..Plot::default()
    });
    result.notes.push(format!(
        "{count} spheres per packing, seeds {seeds:?}; periodic cube, radii uniform in ±20 %, solid fraction 0.64, bonds by ascending gap until 6.2 per sphere"
    ));
    Ok(())
}
