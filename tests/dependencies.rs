//! What the program is made of: licences that may be combined with ours, and each library once. Offline, from the lock file.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// Licences that ask for no more than a notice.
const ALLOWED: [&str; 9] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "Zlib",
    "Unlicense",
    "CC0-1.0",
    "Unicode-3.0",
];

/// Libraries that are there twice, each with the reason.
const TWICE: &[(&str, &str)] = &[
    ("equator", "faer and the gemm below it move to the new one in turn"),
    ("equator-macro", "as equator"),
    ("hashbrown", "spade is behind indexmap"),
    ("syn", "derive macros move to the new one in turn; it is not in the program"),
];

/// `cargo tree` of all that goes into the program, one package a line in the given format.
fn tree(format: &str) -> BTreeSet<String> {
    let words =
        ["tree", "--workspace", "--edges", "normal", "--prefix", "none", "--locked", "--offline", "--format"];
    let mut cargo = Command::new(env!("CARGO"));
    let output = cargo.args(words).arg(format).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines()
        .map(|line| line.trim_end_matches(" (*)").to_owned())
        .filter(|line| !line.is_empty())
        .collect()
}

/// Whether an SPDX expression leaves a choice that is allowed. Parentheses occur around choices only.
fn allowed(licence: &str) -> bool {
    let choice = |text: &str| {
        let any = text.trim_matches(['(', ')']).replace('/', " OR ");
        any.split(" OR ").any(|one| ALLOWED.contains(&one.trim()))
    };
    licence.split(" AND ").all(choice)
}

#[test]
fn every_licence_may_be_combined_with_ours() {
    assert!(
        allowed("MIT/Apache-2.0")
            && allowed("(MIT OR GPL-3.0) AND Unicode-3.0")
            && !allowed("MIT AND GPL-3.0")
    );
    let all = tree("{p}|{l}");
    assert!(all.len() > 50, "this is not all: {all:?}");
    let bad: Vec<&String> =
        all.iter().filter(|line| !allowed(line.rsplit('|').next().unwrap_or(""))).collect();
    assert!(bad.is_empty(), "licences outside of the list: {bad:?}");
}

#[test]
fn no_library_is_there_twice() {
    let mut versions: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for line in tree("{p}") {
        let mut words = line.split(' ');
        let (name, version) = (words.next().unwrap().to_owned(), words.next().unwrap().to_owned());
        versions.entry(name).or_default().push(version);
    }
    let twice: Vec<&str> =
        versions.iter().filter(|(_, v)| v.len() > 1).map(|(name, _)| name.as_str()).collect();
    let known: Vec<&str> = TWICE.iter().map(|(name, _)| *name).collect();
    assert_eq!(twice, known, "remove one of the two, or say why both are needed");
}
