//! One file per verb.

mod bless;
mod check;
mod completions;
mod export;
mod gate;
mod list;
mod new;
mod references;
mod report;
mod run;
mod schema;
mod selftest;
mod show;
mod study;
mod validate;

pub use bless::bless;
pub use check::check;
pub use completions::completions;
pub use export::export;
pub use gate::gate;
pub use list::list;
pub use new::new;
pub use references::references;
pub use report::report;
pub use run::run;
pub use schema::schema;
pub use selftest::selftest;
pub use show::show;
pub use study::study;
pub use validate::validate;
