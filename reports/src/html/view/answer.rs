//! The questions a reader comes with, and what this run answers.

use crate::claims::meaning;
use crate::plots::Figure;
use crate::results::Results;
use serde::Serialize;

/// A question and its answer. A question without data is not asked.
#[derive(Serialize)]
pub(crate) struct Answer {
    /// What a reader wants to know.
    question: String,
    /// The answer in a few words.
    headline: String,
    /// Why, and what to do about it.
    text: String,
    /// Verdict that colours the answer, or empty.
    verdict: String,
    /// Id of the part of the page that shows the evidence.
    link: String,
}

/// Whether each claim holds and why, what 1 % costs, and how far the hard cases are from breaking: `margins` says so
/// where some were run.
pub(super) fn answers(results: &Results, costs: &[Figure], margins: Option<&str>) -> Vec<Answer> {
    claims(results).chain(cost(costs)).chain(margins.map(stability)).collect()
}

/// The claims under test first, then our own, which answer them.
fn claims(results: &Results) -> impl Iterator<Item = Answer> {
    let mut claims: Vec<_> = results.cases.iter().flat_map(|c| &c.claims).collect();
    claims.sort_by_key(|c| c.own);
    claims.into_iter().map(|c| Answer {
        question: c.statement.clone(),
        headline: meaning::headline(c),
        text: meaning::paragraph(c),
        verdict: c.verdict.to_string(),
        link: format!("claim-{}", c.id),
    })
}

fn cost(costs: &[Figure]) -> Option<Answer> {
    let told = costs.iter().filter(|f| !f.note.is_empty());
    let sentences: Vec<String> = told.map(|f| format!("{}: {}", f.title, f.note)).collect();
    (!sentences.is_empty()).then(|| Answer {
        question: "What does an error of 1 % cost?".to_owned(),
        headline: String::new(),
        text: sentences.join("\n\n"),
        verdict: String::new(),
        link: "cost".to_owned(),
    })
}

fn stability(margins: &str) -> Answer {
    Answer {
        question: "How far are the hard cases from breaking?".to_owned(),
        headline: String::new(),
        text: margins.to_owned(),
        verdict: String::new(),
        link: "stability".to_owned(),
    }
}
