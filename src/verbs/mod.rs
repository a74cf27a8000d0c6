//! One file per verb.

mod check;
mod export;
mod list;
mod references;
mod report;
mod run;
mod show;
mod study;
mod validate;

pub use check::check;
pub use export::export;
pub use list::list;
pub use references::references;
pub use report::report;
pub use run::run;
pub use show::show;
pub use study::study;
pub use validate::validate;
