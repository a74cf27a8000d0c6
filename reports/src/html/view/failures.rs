//! Failures as the page shows them.

use crate::failure::{Failure, failures};
use crate::results::Results;
use serde::Serialize;

/// One failure.
#[derive(Serialize)]
pub(crate) struct FailureView {
    class: &'static str,
    place: String,
    measured: String,
    bound: String,
    meaning: String,
    rerun: String,
}

/// All failures.
pub(super) fn views(results: &Results) -> Vec<FailureView> {
    let view = |f: Failure| {
        let Failure { class, place, measured, bound, meaning, rerun } = f;
        FailureView { class, place, measured, bound, meaning, rerun }
    };
    failures(results).into_iter().map(view).collect()
}
