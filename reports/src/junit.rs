//! JUnit XML, for the test page of a CI service: one suite per case, one test per number, curve, claim and cost.

use crate::failure::{Failure, LOOSENED, NOT_MEASURED, failures};
use crate::results::{CaseJudgement, Results, ResultsError, write_whole};
use crate::verdict::Verdict;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::path::Path;
use std::time::Duration;

/// Writes the XML, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write(results: &Results, path: &Path) -> Result<(), ResultsError> {
    write_whole(path, &xml(results)?)
}

/// The XML. Numbers that are shown and not judged are no tests; a failure that is expected is a skipped one.
///
/// # Errors
/// None in practice: the text is written to memory.
pub fn xml(results: &Results) -> Result<String, ResultsError> {
    let mut report = Report::new("seam");
    let failures = failures(results);
    for case in &results.cases {
        report.add_test_suite(suite(case, &failures));
    }
    report.to_string().map_err(|e| ResultsError::View { view: "junit.xml", message: e.to_string() })
}

fn suite(case: &CaseJudgement, failures: &[Failure]) -> TestSuite {
    let mut suite = TestSuite::new(case.id.clone());
    suite.set_time(Duration::try_from_secs_f64(case.seconds).unwrap_or_default());
    let mut names: Vec<(&str, Option<&str>)> = Vec::new();
    for q in case.quantities.iter().filter(|q| q.verdict.is_some() || q.value.is_none()) {
        let known = (q.verdict == Some(Verdict::Fail)).then_some(q.expected_failure.as_deref()).flatten();
        names.push((&q.id, known));
    }
    names.extend(case.curves.iter().map(|c| (c.plot.as_str(), None)));
    names.extend(case.claims.iter().map(|c| (c.id.as_str(), None)));
    names.push(("work", None));
    // What failed without being one of these, such as a tolerance of a number that is judged no more.
    let own: Vec<(&str, &Failure)> = failures.iter().filter_map(|f| Some((item(case, f)?, f))).collect();
    for (name, _) in &own {
        if !names.iter().any(|(known, _)| known == name) {
            names.push((name, None));
        }
    }
    for (name, known) in names {
        let of = |(_, f): &&(&str, &Failure)| f.class != LOOSENED;
        let mine: Vec<&(&str, &Failure)> = own.iter().filter(|(n, _)| *n == name).collect();
        let worst = mine.iter().copied().find(of).or(mine.first().copied());
        suite.add_test_case(test(&case.id, name, known, worst.map(|(_, f)| *f)));
    }
    suite
}

/// Name of a failure within a case, if it is of this one.
fn item<'a>(case: &CaseJudgement, failure: &'a Failure) -> Option<&'a str> {
    if failure.place == case.id {
        return Some("measured");
    }
    failure.place.strip_prefix(case.id.as_str())?.strip_prefix(" / ")
}

fn test(case: &str, name: &str, known: Option<&str>, failure: Option<&Failure>) -> TestCase {
    let status = match (failure, known) {
        (Some(f), _) => {
            let kind = if f.class == NOT_MEASURED { NonSuccessKind::Error } else { NonSuccessKind::Failure };
            let mut status = TestCaseStatus::non_success(kind);
            status.set_type(f.class).set_message(f.meaning.clone()).set_description(format!(
                "measured: {}\nbound: {}\nmeaning: {}\nrerun: {}",
                f.measured, f.bound, f.meaning, f.rerun
            ));
            status
        }
        (None, Some(why)) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(format!("fails as expected: {why}"));
            status
        }
        (None, None) => TestCaseStatus::success(),
    };
    let mut test = TestCase::new(name, status);
    test.set_classname(format!("seam.{case}"));
    test
}
