//! Agreement with other codes: one row per code and model, with what was compared in it.

use crate::failure::interval;
use crate::format::{self, significant};
use crate::results::{QuantityResult, Results};
use seam_cases::result::Agreement;
use serde::Serialize;

/// Comparisons on the very same model, and of other models of the same body.
#[derive(Serialize)]
pub(crate) struct Agreements {
    same: Vec<Row>,
    other: Vec<Row>,
}

/// One code and model.
#[derive(Serialize)]
struct Row {
    case: String,
    model: String,
    code: String,
    version: String,
    date: String,
    displacement: Vec<Cell>,
    rotation: Vec<Cell>,
    more: Vec<Cell>,
}

/// One number.
#[derive(Serialize)]
struct Cell {
    what: String,
    difference: String,
    accepted: String,
    why: String,
    verdict: String,
}

/// Collects what was compared with other codes.
pub(super) fn view(results: &Results) -> Agreements {
    let mut all = Agreements { same: Vec::new(), other: Vec::new() };
    for case in &results.cases {
        for q in &case.quantities {
            if let Some(agreement) = &q.agreement {
                let rows = if agreement.same_model { &mut all.same } else { &mut all.other };
                add(rows, &case.id, q, agreement);
            }
        }
    }
    all
}

fn add(rows: &mut Vec<Row>, case: &str, q: &QuantityResult, a: &Agreement) {
    let is_row = |row: &Row| row.case == case && row.model == a.model && row.code == a.code;
    let place = rows.iter().position(is_row).unwrap_or_else(|| {
        rows.push(Row {
            case: case.to_owned(),
            model: a.model.clone(),
            code: a.code.clone(),
            version: a.version.clone(),
            date: a.date.clone(),
            displacement: Vec::new(),
            rotation: Vec::new(),
            more: Vec::new(),
        });
        rows.len() - 1
    });
    let row = &mut rows[place];
    let column = match (a.same_model, a.compared.as_str()) {
        (true, "displacement") => &mut row.displacement,
        (true, "rotation") => &mut row.rotation,
        _ => &mut row.more,
    };
    column.push(cell(q, a));
}

/// A difference as it is, a value beside that of the code as their relative difference.
fn cell(q: &QuantityResult, a: &Agreement) -> Cell {
    let difference = match (q.error, q.value) {
        (Some(error), _) => significant(error, 2),
        (None, Some(value)) => format::with_unit(value, &q.unit),
        (None, None) => "not measured".to_owned(),
    };
    Cell {
        what: if a.same_model { a.compared.clone() } else { q.label.clone() },
        difference,
        accepted: accepted(q),
        why: q.why.clone(),
        verdict: q.verdict.map_or("shown".to_owned(), |v| v.to_string()),
    }
}

/// `≤ 1e-5` for a difference, `± 1 %` beside a reference.
fn accepted(q: &QuantityResult) -> String {
    match (q.accepted, q.reference) {
        (Some([Some(0.0), Some(high)]), None) => format!("≤ {}", significant(high, 2)),
        (Some([Some(low), Some(high)]), Some(reference)) if reference != 0.0 => {
            format!("± {}", significant(0.5 * (high - low) / reference.abs(), 2))
        }
        _ => interval(q).unwrap_or("–".to_owned()),
    }
}
