//! An error and its causes as one message.

/// The message of an error, then each cause that it does not tell already.
///
/// Errors of the libraries quote their cause; those of the system and of `anyhow` do not.
pub fn of(error: &anyhow::Error) -> String {
    let mut told = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !told.ends_with(&cause) {
            told += &format!(": {cause}");
        }
    }
    told
}

#[cfg(test)]
mod tests {
    use super::of;
    use seam_cases::error::Error;

    #[test]
    fn a_cause_is_told_once() {
        let system = || std::io::Error::other("disk full");
        let quoting = Error::File { path: "p.csv".to_owned(), source: system() };
        assert_eq!(of(&quoting.into()), "p.csv: disk full");
        assert_eq!(of(&anyhow::Error::new(system()).context("p.csv")), "p.csv: disk full");
    }
}
