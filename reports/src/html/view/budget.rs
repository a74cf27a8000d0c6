//! Error budgets: a waterfall, and which two runs each part is the difference of.

use crate::format::{percent, signed_percent, typeset};
use crate::plots::{self, Figure};
use seam_cases::result::{Budget, BudgetPart};
use serde::Serialize;

/// A budget as the page shows it.
#[derive(Serialize)]
pub(crate) struct BudgetView {
    pub(super) figure: Figure,
    case: String,
    parts: Vec<[String; 4]>,
}

/// A budget in words and a figure; `None` without parts.
pub(super) fn view(case: &str, b: &Budget) -> Option<BudgetView> {
    let part = |p: &BudgetPart| {
        let scatter = p.scatter.map_or(String::new(), |s| format!("± {}", percent(s)));
        [p.name.clone(), typeset(&signed_percent(p.value)), scatter, p.how.clone()]
    };
    let figure = plots::budget::waterfall(b)?;
    Some(BudgetView { figure, case: case.to_owned(), parts: b.parts.iter().map(part).collect() })
}
