//! What a user sees while cases run: a bar on a terminal, plain lines in a pipe, nothing when quiet.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use seam_cases::study::Onlooker;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Shows how far a run has come.
pub enum Progress {
    /// A bar that redraws itself.
    Bar(ProgressBar),
    /// One line per case, with how many are done and how many there are.
    Lines(AtomicUsize, usize),
    /// Nothing.
    Quiet,
}

impl Progress {
    /// The kind that fits standard error.
    pub fn new(cases: usize, quiet: bool) -> Self {
        if quiet {
            return Progress::Quiet;
        }
        if !std::io::stderr().is_terminal() {
            return Progress::Lines(AtomicUsize::new(0), cases);
        }
        let bar = ProgressBar::with_draw_target(Some(cases as u64), ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{bar:24} {pos}/{len} {elapsed} {wide_msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(std::time::Duration::from_millis(200));
        Progress::Bar(bar)
    }

    /// A case begins.
    pub fn begin(&self, id: &str) {
        if let Progress::Bar(bar) = self {
            bar.set_message(id.to_owned());
        }
    }

    /// A case is done.
    pub fn done(&self, id: &str, how: &str) {
        match self {
            Progress::Bar(bar) => {
                bar.inc(1);
                bar.set_message(format!("{id}: {how}"));
            }
            Progress::Lines(done, cases) => {
                let now = done.fetch_add(1, Ordering::Relaxed) + 1;
                eprintln!("{now}/{cases} {id}: {how}");
            }
            Progress::Quiet => {}
        }
    }

    /// All are done.
    pub fn finish(&self) {
        if let Progress::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// The settings of a study are shown as the cases of a run are.
impl Onlooker for Progress {
    fn begin(&self, what: &str) {
        Progress::begin(self, what);
    }

    fn done(&self, what: &str, how: &str) {
        Progress::done(self, what, how);
    }
}
