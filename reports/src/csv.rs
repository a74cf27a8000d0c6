//! Tables as CSV: the errors of all quantities, the margins of the hard cases, the members of each family. Curves are written where a case is run.

use crate::results::{Results, ResultsError, write_whole};
use crate::terminal::kind_name;
use seam_cases::result::{CaseResult, CostDiagram, Family};
use std::path::Path;

/// Writes `errors.csv`, `margins.csv` and, per case, `<case>/family-<claim>.csv` and `<case>/cost-<diagram>.csv`.
///
/// # Errors
/// A file cannot be written.
pub fn write(results: &Results, cases: &[CaseResult], folder: &Path) -> Result<(), ResultsError> {
    write_whole(&folder.join("errors.csv"), &errors(results)?)?;
    write_whole(&folder.join("margins.csv"), &margins(results)?)?;
    for case in cases {
        let folder = folder.join(file_name(&case.id));
        for diagram in &case.costs {
            let file = format!("cost-{}.csv", file_name(&diagram.id));
            write_whole(&folder.join(file), &points(diagram)?)?;
        }
        for family in &case.families {
            write_whole(&folder.join(format!("family-{}.csv", file_name(&family.claim))), &members(family)?)?;
        }
    }
    Ok(())
}

/// One row per quantity. Missing numbers are empty fields; the error is a fraction.
///
/// # Errors
/// None in practice: the text is written to memory.
pub fn errors(results: &Results) -> Result<String, ResultsError> {
    let header =
        "case,quantity,unit,value,reference,kind,error,u_num,u_ref,accepted_lo,accepted_hi,headroom,verdict";
    let rows = results.cases.iter().flat_map(|c| {
        c.quantities.iter().map(|q| {
            let [lo, hi] = q.accepted.unwrap_or([None, None]);
            let mut row =
                vec![c.id.clone(), q.id.clone(), q.unit.clone(), number(q.value), number(q.reference)];
            row.push(q.reference.map_or(String::new(), |_| kind_name(q).to_owned()));
            row.extend([q.error, q.u_num, q.u_ref, lo, hi, q.headroom].map(number));
            row.push(q.verdict.map_or(String::new(), |v| v.to_string()));
            row
        })
    });
    text(header.split(',').map(str::to_owned).collect(), rows)
}

/// One row per margin. Missing numbers are empty fields.
///
/// # Errors
/// None in practice: the text is written to memory.
pub fn margins(results: &Results) -> Result<String, ResultsError> {
    let header = "case,margin,row,label,axis,unit,value,open,needed,recorded,tolerance,verdict";
    let rows = results.cases.iter().flat_map(|c| {
        c.margins.iter().map(|m| {
            let words = [&c.id, &m.id, &m.row, &m.label, &m.axis, &m.unit].map(String::clone);
            let mut row = words.to_vec();
            row.extend([number(m.value), m.open.to_string()]);
            row.extend([Some(m.needed), m.recorded, Some(m.tolerance)].map(number));
            row.push(m.verdict.to_string());
            row
        })
    });
    text(header.split(',').map(str::to_owned).collect(), rows)
}

/// One row per member: axes, seed, particles, counted work, u, error under each reading, why it failed.
///
/// # Errors
/// None in practice: the text is written to memory.
pub fn members(family: &Family) -> Result<String, ResultsError> {
    let readings: Vec<&String> = family.readings.keys().collect();
    let mut header: Vec<String> = family.axes.keys().cloned().collect();
    header.extend(["seed", "particles", "work", "u"].map(str::to_owned));
    header.extend(readings.iter().map(|r| format!("error {r}")));
    header.push("failed".to_owned());
    let rows = family.members.iter().map(|m| {
        let mut row: Vec<String> =
            family.axes.keys().map(|a| m.settings.get(a).cloned().unwrap_or_default()).collect();
        row.push(m.seed.map_or(String::new(), |s| s.to_string()));
        row.extend([m.particles.to_string(), m.work.total().to_string(), m.u.to_string()]);
        row.extend(readings.iter().map(|r| number(m.errors.get(*r).copied())));
        row.push(m.failed.clone().unwrap_or_default());
        row
    });
    text(header, rows)
}

/// One row per point of a cost diagram: error, spread over packings, size, counted work, seconds, memory, why it is a gap.
///
/// # Errors
/// None in practice: the text is written to memory.
pub fn points(diagram: &CostDiagram) -> Result<String, ResultsError> {
    let header = "setting,level,error,error_lo,error_hi,particles,unknowns,work,run_work,calibration_work,steps,seconds,seconds_lo,\
                  seconds_hi,memory_mb,failed";
    let rows = diagram.settings.iter().flat_map(|s| {
        s.points.iter().map(|p| {
            let [lo, hi] = p.spread.map_or([None, None], |spread| spread.map(Some));
            let mut row = vec![s.name.clone(), p.level.clone(), number(p.error), number(lo), number(hi)];
            row.extend([p.particles, p.unknowns].map(|n| n.to_string()));
            row.extend([p.work.total(), p.run_work, p.calibration_work, p.work.steps].map(|n| n.to_string()));
            let [shortest, longest] = p.seconds_spread;
            row.extend([Some(p.seconds), Some(shortest), Some(longest), p.memory_mb].map(number));
            row.push(p.failed.clone().unwrap_or_default());
            row
        })
    });
    text(header.split(',').map(str::to_owned).collect(), rows)
}

/// An id as part of a file name: it must not lead out of the folder.
fn file_name(id: &str) -> String {
    id.chars().map(|c| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' }).collect()
}

fn number(v: Option<f64>) -> String {
    // Debug writes the shortest digits that read back the same, with an exponent where that is shorter.
    v.map_or(String::new(), |v| format!("{v:?}"))
}

fn text(header: Vec<String>, rows: impl Iterator<Item = Vec<String>>) -> Result<String, ResultsError> {
    let fail = |message: String| ResultsError::View { view: "csv", message };
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in std::iter::once(header).chain(rows) {
        writer.write_record(&row).map_err(|e| fail(e.to_string()))?;
    }
    let bytes = writer.into_inner().map_err(|e| fail(e.to_string()))?;
    String::from_utf8(bytes).map_err(|e| fail(e.to_string()))
}
