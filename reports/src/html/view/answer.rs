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

/// Whether each claim holds and why, and what 1 % costs.
pub(super) fn answers(results: &Results, costs: &[Figure]) -> Vec<Answer> {
    claims(results).chain(cost(costs)).collect()
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
    let sentence = |f: &Figure| format!("{}: {}", f.title, f.note);
    (!costs.is_empty()).then(|| Answer {
        question: "What does an error of 1 % cost?".to_owned(),
        headline: String::new(),
        text: costs.iter().map(sentence).collect::<Vec<_>>().join(" "),
        verdict: String::new(),
        link: "cost".to_owned(),
    })
}
