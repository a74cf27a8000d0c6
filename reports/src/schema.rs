//! JSON Schema of `results.json`.

use crate::results::Results;

/// The schema as JSON text, ending in a newline; published as `reports/results.schema.json`.
pub fn results_schema() -> String {
    let mut schema = schemars::schema_for!(Results);
    schema.insert("title".to_owned(), crate::results::SCHEMA.into());
    format!("{schema:#}\n", schema = schema.as_value())
}

#[cfg(test)]
mod tests {
    use super::results_schema;

    #[test]
    fn the_published_schema_is_current() {
        let published = concat!(env!("CARGO_MANIFEST_DIR"), "/results.schema.json");
        if std::env::var_os("SEAM_BLESS").is_some() {
            std::fs::write(published, results_schema()).unwrap();
        }
        let text = std::fs::read_to_string(published).unwrap_or_default();
        assert!(
            text == results_schema(),
            "results.schema.json is stale: set SEAM_BLESS=1 and run this test again"
        );
    }
}
