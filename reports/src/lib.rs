//! From measured results to verdicts, and from verdicts to tables, plots and the report page.
//!
//! [`judge::judge`] turns [`seam_cases::result::CaseResult`]s into [`results::Results`], the only source
//! of every view: [`results::Results::write`] (`results.json`), [`terminal::table`], [`csv`],
//! [`markdown`] and [`html`].

pub mod ablation;
pub mod activity;
pub mod baseline;
pub mod bless;
pub mod claims;
pub mod compare;
pub mod cost;
pub mod counted;
pub mod csv;
pub mod exit;
pub mod failure;
pub mod format;
pub mod growth;
pub mod html;
pub mod judge;
pub mod junit;
pub mod loosened;
pub mod margins;
pub mod markdown;
pub mod plots;
pub mod race;
pub mod record;
pub mod results;
pub mod schema;
pub mod statistics;
pub mod terminal;
pub mod validation;
pub mod verdict;
