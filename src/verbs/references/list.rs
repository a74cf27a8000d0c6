//! `seam references list`: one line per reference.

use super::super::check::print;
use super::{inputs, tools};
use anyhow::Result;
use seam_cases::export::Code;
use seam_reports::exit::Exit;

/// Prints kind, code and date of every reference, those that nobody has made yet, and the codes.
pub fn list() -> Result<Exit> {
    let references = seam_references::all();
    let mut lines = Vec::new();
    for reference in &references {
        let data = reference.open()?;
        let p = &data.provenance;
        lines.push([
            reference.id(),
            format!("{:?}", p.kind.get_ref()).to_lowercase(),
            p.version.clone(),
            p.date.to_string(),
            format!("{} rows, {}", data.rows(), repeats(p.repeat.difference)),
        ]);
    }
    for (id, export) in inputs::all()? {
        if references.iter().all(|r| r.id() != id) {
            let how = format!("seam references regenerate {id} --accept");
            lines.push([id, export.code.name().to_owned(), "not made yet".to_owned(), how, String::new()]);
        }
    }
    print(&table(&lines))?;
    for code in Code::ALL {
        let state = tools::find(code).map_or_else(|missing| missing.to_string(), |_| "installed".to_owned());
        print(&format!("{}: {state}\n", code.name()))?;
    }
    Ok(Exit::Pass)
}

fn repeats(difference: f64) -> String {
    if difference == 0.0 { "repeats exactly".to_owned() } else { format!("repeats to {difference:.0e}") }
}

fn table(lines: &[[String; 5]]) -> String {
    let width = |c: usize| lines.iter().map(|line| line[c].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..4).map(width).collect();
    let mut text = String::new();
    for line in lines {
        for (cell, width) in line.iter().zip(&widths) {
            text += &format!("{cell:<width$}  ");
        }
        text += &format!("{}\n", line[4]);
    }
    text
}
