//! The `seam` command: words in, exit code out. All else is in the libraries.

mod args;
mod memory;
mod message;
mod progress;
mod provenance;
mod references;
mod results;
mod running;
mod select;
mod selftest;
mod verbs;

use args::{Command, Verb};
use clap::Parser;
use seam_reports::exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    let command = Command::parse();
    let done = match command.verb.unwrap_or(Verb::Validate(command.validate)) {
        Verb::Validate(words) => verbs::validate(&words),
        Verb::List(words) => verbs::list(&words),
        Verb::Show(words) => verbs::show(&words),
        Verb::Run(words) => verbs::run(&words),
        Verb::Study(words) => verbs::study(&words),
        Verb::Check(words) => verbs::check(&words),
        Verb::Report(words) => verbs::report(&words),
        Verb::Bless(words) => verbs::bless(&words),
        Verb::Gate(words) => verbs::gate(&words),
        Verb::Selftest(words) => verbs::selftest(&words),
        Verb::New(words) => verbs::new(&words),
        Verb::Schema(words) => verbs::schema(&words),
        Verb::Completions(words) => verbs::completions(&words),
        Verb::Export(words) => verbs::export(&words),
        Verb::References(words) => verbs::references(&words),
    };
    let exit = done.unwrap_or_else(|error| {
        eprintln!("seam: {}", message::of(&error));
        exit_of(&error)
    });
    ExitCode::from(exit as u8)
}

/// What could not be measured is 4; everything else a user can mend is 2.
fn exit_of(error: &anyhow::Error) -> Exit {
    use seam_cases::error::Error::{Reference, Study};
    let unmeasured = error.is::<results::Unmeasured>()
        || error.is::<seam_references::Problem>()
        || matches!(error.downcast_ref(), Some(Study { .. } | Reference { .. }));
    if unmeasured { Exit::Unmeasured } else { Exit::Usage }
}
