//! Outputs of independent codes, with their provenance.
