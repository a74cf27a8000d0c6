//! From measured results to verdicts, and from verdicts to tables, plots and the report page.
