//! What a reference must not get away with.

use proptest::prelude::*;
use seam_references::{Kind, Problem, Reference, Sha256, all, find, from_folder, verify};
use std::borrow::Cow;
use std::fs;

const CSV: &str = "x,u\n0.0,0\n1.0,-2.5e-3\n";

/// A whole reference `case/source` with the table `csv`.
fn provenance(csv: &str) -> String {
    format!(
        r#"id = "case/source"
kind = "published"
about = "a table of two columns"
source = "Nobody (1900), table 1"
code = "by hand"
version = "1"
command = "python3 generate.py"
date = 2026-11-23
machine = "x86-64, 2 cores"
csv_sha256 = "{}"
repeat = {{ difference = 0.0, about = "written twice" }}

[inputs]

[columns]
x = {{ unit = "m", about = "place" }}
u = {{ unit = "m", about = "displacement" }}
"#,
        Sha256::of(csv.as_bytes())
    )
}

fn reference(csv: impl Into<Vec<u8>>, provenance: String) -> Reference {
    Reference {
        case: "case".to_owned(),
        source: "source".to_owned(),
        csv_file: "source.csv".to_owned(),
        provenance_file: "source.toml".to_owned(),
        csv: Cow::Owned(csv.into()),
        provenance: Cow::Owned(provenance),
    }
}

fn whole() -> Reference {
    reference(CSV, provenance(CSV))
}

/// The problem of a table whose hash is right.
fn problem_of_table(csv: &str) -> String {
    let problem = verify(&reference(csv, provenance(csv))).unwrap_err();
    assert!(matches!(problem, Problem::Table { .. }), "{problem:?}");
    problem.to_string()
}

/// The problem of a provenance with `from` replaced.
fn problem_of_provenance(from: &str, to: &str) -> String {
    let text = provenance(CSV);
    assert!(text.contains(from));
    let problem = verify(&reference(CSV, text.replace(from, to))).unwrap_err();
    assert!(matches!(problem, Problem::Provenance { .. }), "{problem:?}");
    problem.to_string()
}

#[test]
fn every_reference_that_comes_with_seam_is_whole() {
    let all = all();
    assert!(!all.is_empty());
    for reference in &all {
        verify(reference).unwrap_or_else(|problem| panic!("{problem}"));
    }
    let ids: Vec<String> = all.iter().map(Reference::id).collect();
    assert!(ids.is_sorted() && ids.contains(&"homogenised-packing/prototype".to_owned()), "{ids:?}");
}

#[test]
fn numbers_come_by_name_and_unit() {
    let data = whole().open().unwrap();
    assert_eq!(data.column("u", "m").unwrap(), [0.0, -2.5e-3]);
    assert_eq!(data.rows(), 2);
    let millimetres = data.column("u", "mm").unwrap_err();
    assert!(matches!(millimetres, Problem::OtherUnit { .. }));
    assert!(millimetres.to_string().starts_with("source.csv: column 'u' is in 'm', not in 'mm'"));
    let missing = data.column("v", "m").unwrap_err();
    assert_eq!(missing.to_string(), "source.csv: there is no column 'v'; the columns are: u, x");
}

#[test]
fn the_packing_table_reads_as_noted() {
    let data = find("homogenised-packing", "prototype").unwrap().open().unwrap();
    assert_eq!(data.column("radius_ratio", "1").unwrap(), [0.3, 0.5, 0.71, 0.9]);
    // The affine law is an upper bound of the stiffness.
    let (young, bound) =
        (data.column("young_ratio", "1").unwrap(), data.column("affine_young_ratio", "1").unwrap());
    assert!(young.iter().zip(bound).all(|(e, b)| e < b));
}

#[test]
fn an_unknown_reference_is_told_from_the_known_ones() {
    let problem = find("homogenised-packing", "yade").unwrap_err().to_string();
    assert!(
        problem.starts_with("there is no reference 'homogenised-packing/yade'; known are: "),
        "{problem}"
    );
    assert!(problem.contains("homogenised-packing/prototype"), "{problem}");
}

proptest! {
    #[test]
    fn one_changed_byte_is_found(at in 0..CSV.len(), byte: u8) {
        let mut csv = CSV.as_bytes().to_vec();
        prop_assume!(csv[at] != byte);
        csv[at] = byte;
        let problem = verify(&reference(csv, provenance(CSV))).unwrap_err();
        prop_assert!(matches!(problem, Problem::Altered { .. }), "{problem}");
        prop_assert!(problem.to_string().contains("make it again with: python3 generate.py"));
    }

    #[test]
    fn one_byte_of_an_embedded_reference_is_found(at: prop::sample::Index, flip in 1u8..) {
        for mut reference in all() {
            let at = at.index(reference.csv.len());
            reference.csv.to_mut()[at] ^= flip;
            prop_assert!(matches!(verify(&reference), Err(Problem::Altered { .. })), "{}", reference.id());
        }
    }

    /// Whatever is in the files, the answer is a dataset of finite numbers or a typed problem.
    #[test]
    fn no_table_panics(csv in "(x,u\n)?([0-9a-zNI.,\"\n-]{0,40})") {
        if let Ok(data) = reference(csv.clone(), provenance(&csv)).open() {
            prop_assert!(data.column("u", "m").unwrap().iter().all(|v| v.is_finite()));
        }
    }

    #[test]
    fn no_provenance_panics(text in any::<String>(), cut in 0..400usize) {
        let short: String = provenance(CSV).chars().take(cut).collect();
        prop_assert!(verify(&reference(CSV, text)).is_err());
        prop_assert!(verify(&reference(CSV, short)).is_err());
    }
}

#[test]
fn bad_numbers_name_line_and_column() {
    for bad in ["NaN", "inf", "-inf", "", "zero", "1e999"] {
        let problem = problem_of_table(&format!("x,u\n0.0,0\n1.0,{bad}\n"));
        let expected = format!("source.csv:3: column 'u' '{bad}' is not a finite number");
        assert!(problem.starts_with(&expected), "{problem}");
    }
}

#[test]
fn columns_must_be_the_described_ones() {
    assert!(problem_of_table("x\n0\n").starts_with("source.csv:1: column 'u' is missing"));
    assert!(problem_of_table("x,u,v\n0,0,0\n").starts_with("source.csv:1: column 'v' has no unit"));
    assert!(problem_of_table("x,u,u\n0,0,0\n").starts_with("source.csv:1: column 'u' comes twice"));
    assert!(problem_of_table("x,u\n0,0,0\n").starts_with("source.csv:2: "));
    assert!(problem_of_table("x,u\n").starts_with("source.csv:1: no rows"));
}

#[test]
fn provenance_must_be_complete() {
    for field in [
        "id",
        "kind",
        "about",
        "source",
        "code",
        "version",
        "command",
        "date",
        "machine",
        "csv_sha256",
        "repeat",
    ] {
        let text: String = provenance(CSV)
            .lines()
            .filter(|l| !l.starts_with(&format!("{field} =")))
            .map(|l| format!("{l}\n"))
            .collect();
        let problem = verify(&reference(CSV, text)).unwrap_err();
        assert!(matches!(problem, Problem::Provenance { .. }), "{problem:?}");
        assert!(problem.to_string().contains(&format!("missing field `{field}`")), "{problem}");
    }
    assert!(problem_of_provenance("[inputs]\n", "").contains("missing field `inputs`"));
    let blank = problem_of_provenance("\"by hand\"", "\" \"");
    assert!(blank.starts_with("source.toml:5:8: blank"), "{blank}");
    let typo = problem_of_provenance("machine", "machin");
    assert!(typo.starts_with("source.toml:9:1: unknown field `machin`"), "{typo}");
}

#[test]
fn provenance_must_make_sense() {
    let unit = problem_of_provenance("unit = \"m\", about = \"disp", "unit = \"mm\", about = \"disp");
    assert!(unit.starts_with("source.toml:17:14: 'mm' is no SI unit"), "{unit}");
    let hash = problem_of_provenance("csv_sha256 = \"", "csv_sha256 = \"0");
    assert!(hash.starts_with("source.toml:10:14: '0"), "{hash}");
    let other = problem_of_provenance("case/source", "case/other");
    assert!(other.starts_with("source.toml:1:6: id 'case/other' in the files of 'case/source'"), "{other}");
    let inputs = problem_of_provenance("\"published\"", "\"yade\"");
    assert!(
        inputs.starts_with("source.toml:2:8: a code computed this, but no input is recorded"),
        "{inputs}"
    );
    let repeat = problem_of_provenance("difference = 0.0", "difference = nan");
    assert!(repeat.contains("NaN is no difference"), "{repeat}");
    assert!(problem_of_provenance("\"published\"", "\"rumour\"").starts_with("source.toml:2:8: "));
}

#[test]
fn a_folder_is_read_in_pairs() {
    let folder = tempfile::tempdir().unwrap();
    let empty = from_folder(folder.path()).unwrap_err();
    assert!(matches!(empty, Problem::Empty { .. }), "{empty:?}");
    let case = folder.path().join("case");
    fs::create_dir(&case).unwrap();
    fs::write(case.join("source.csv"), CSV).unwrap();
    fs::write(case.join("notes.md"), "not a reference").unwrap();
    let unpaired = from_folder(folder.path()).unwrap_err();
    assert!(matches!(unpaired, Problem::Unpaired { .. }), "{unpaired:?}");
    assert!(unpaired.to_string().contains("source.toml is missing"), "{unpaired}");
    fs::write(case.join("source.toml"), provenance(CSV)).unwrap();
    let references = from_folder(folder.path()).unwrap();
    assert_eq!(references.iter().map(Reference::id).collect::<Vec<_>>(), ["case/source"]);
    verify(&references[0]).unwrap();
    let missing = from_folder(&folder.path().join("nowhere")).unwrap_err();
    assert!(matches!(missing, Problem::Unreadable { .. }), "{missing:?}");
}

#[test]
fn a_changed_input_is_told() {
    let text =
        provenance(CSV).replace("[inputs]\n", &format!("[inputs]\n\"a.csv\" = \"{}\"\n", Sha256::of(b"a")));
    let data = reference(CSV, text).open().unwrap();
    let inputs = |a: &[u8]| [("a.csv".to_owned(), Sha256::of(a))].into();
    data.made_from(&inputs(b"a")).unwrap();
    let problem = data.made_from(&inputs(b"b")).unwrap_err();
    assert!(problem.to_string().starts_with("source.toml: out of date: its input 'a.csv'"), "{problem}");
    assert!(data.made_from(&Default::default()).is_err(), "an input that is gone");
    let more = [("a.csv".to_owned(), Sha256::of(b"a")), ("b.csv".to_owned(), Sha256::of(b"b"))].into();
    assert!(data.made_from(&more).is_err(), "an input that is new");
}

#[test]
fn a_difference_is_relative_to_its_column() {
    let of = |csv: &str| reference(csv, provenance(csv)).open().unwrap();
    let data = of(CSV);
    assert_eq!(data.difference(&data), Some(0.0));
    let off = of("x,u\n0.0,5e-4\n1.0,-2.5e-3\n").difference(&data).unwrap();
    assert!((off - 0.2).abs() < 1e-15, "{off}");
    assert_eq!(of("x,u\n0.0,0\n").difference(&data), None);
}

/// A reference of another code was made by that code, by way of a generator of its own.
#[test]
fn nothing_that_seam_produced_counts_as_another_code() {
    for reference in all() {
        let p = reference.open().unwrap().provenance;
        let (name, folder) = match p.kind.get_ref() {
            Kind::Yade => ("YADE", "yade"),
            Kind::Lammps => ("LAMMPS", "lammps"),
            Kind::Calculix => ("CalculiX", "calculix"),
            _ => continue,
        };
        let id = reference.id();
        assert!(p.code.contains(name) && !p.code.contains("Seam"), "{id}: {}", p.code);
        assert!(p.command.contains(folder), "{id}: {}", p.command);
    }
}

#[test]
fn a_column_of_names_holds_words_and_no_numbers() {
    let csv = "x,u\n0.0,left\n1.0,right\n";
    let toml = provenance(csv).replace("u = { unit = \"m\"", "u = { unit = \"name\"");
    let data = reference(csv, toml).open().unwrap();
    assert_eq!(data.words("u").unwrap(), ["left", "right"]);
    assert_eq!(data.rows(), 2);
    assert!(matches!(data.column("u", "name"), Err(Problem::NoColumn { .. })));
    assert!(matches!(data.words("x"), Err(Problem::NoColumn { .. })));
}
