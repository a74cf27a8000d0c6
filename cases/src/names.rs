//! Nearest known name, for "did you mean" hints.

/// Most edits between a name and its suggestion: a third of its length, rounded up.
fn tolerance(name: &str) -> usize {
    name.chars().count().div_ceil(3).max(1)
}

/// Number of insertions, deletions and replacements between two words (Levenshtein 1966).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

/// The known name closest to `name`, if one is close enough to be a slip of the finger.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|k| (distance(&name.to_lowercase(), &k.to_lowercase()), k))
        .filter(|&(d, _)| d <= tolerance(name))
        .min_by_key(|&(d, _)| d)
        .map(|(_, k)| k)
}

/// "did you mean 'x'?", or the list of all known names when none is near.
pub fn hint<'a>(name: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    if let Some(near) = nearest(name, known.clone()) {
        return format!("did you mean '{near}'?");
    }
    let all: Vec<&str> = known.into_iter().collect();
    if all.is_empty() { "there are none here".to_owned() } else { format!("known here: {}", all.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_finds_its_name() {
        let known = ["height_m", "length_m", "rows"];
        assert_eq!(nearest("heigth_m", known), Some("height_m"));
        assert_eq!(nearest("row", known), Some("rows"));
        assert_eq!(nearest("poisson", known), None);
        assert_eq!(hint("poisson", known), "known here: height_m, length_m, rows");
    }
}
