//! Defects of foreign numbers: a reference that is not what its provenance says, or not what it was.

use super::{Seeded, Spoil, Trial};
use seam_cases::defect::Defect;
use seam_references::{Reference, Sha256};
use seam_reports::exit::Exit;

const CALCULIX: Trial = Trial::of("calculix-elements");

pub const DEFECTS: &[Seeded] = &[
    seeded("alter-a-reference", "one digit of a reference is another", altered, Exit::Unmeasured, "altered"),
    seeded(
        "alter-a-hash",
        "the recorded hash is that of another file",
        other_hash,
        Exit::Unmeasured,
        "altered",
    ),
    seeded("millimetres", "a column is declared in mm", millimetres, Exit::Unmeasured, "no SI unit"),
    seeded("another-unit", "a displacement is declared in rad", radians, Exit::Unmeasured, "not in 'm'"),
    seeded(
        "wrong-unit",
        "displacements in mm are passed off as m, hash and all",
        thousandfold,
        Exit::Failed,
        "calculix-elements / q4",
    ),
    seeded(
        "lose-provenance",
        "nobody knows where a reference comes from",
        nameless,
        Exit::Unmeasured,
        "calculix.toml",
    ),
    seeded(
        "nan-in-a-reference",
        "a number of a reference is none",
        nan,
        Exit::Unmeasured,
        "not a finite number",
    ),
    seeded(
        "truncate-a-reference",
        "half of the rows of a reference are lost",
        half,
        Exit::Unmeasured,
        "altered",
    ),
];

const fn seeded(
    name: &'static str,
    about: &'static str,
    spoil: fn(&mut Reference),
    exit: Exit,
    by: &'static str,
) -> Seeded {
    Seeded { name, about, trial: CALCULIX, spoil: Spoil::Run(Defect::Reference(spoil)), exit, by }
}

fn provenance(reference: &mut Reference, change: impl Fn(&str) -> String) {
    reference.provenance = change(&reference.provenance).into();
}

/// Changes the numbers and lets the recorded hash follow.
fn numbers(reference: &mut Reference, change: impl Fn(&str) -> String) {
    let before = Sha256::of(&reference.csv).to_string();
    reference.csv = change(&String::from_utf8_lossy(&reference.csv)).into_bytes().into();
    let after = Sha256::of(&reference.csv).to_string();
    provenance(reference, |text| text.replace(&before, &after));
}

fn altered(reference: &mut Reference) {
    if let Some(digit) = reference.csv.to_mut().iter_mut().rev().find(|byte| byte.is_ascii_digit()) {
        *digit = if *digit == b'0' { b'1' } else { b'0' };
    }
}

fn other_hash(reference: &mut Reference) {
    let (own, other) = (Sha256::of(&reference.csv).to_string(), Sha256::of(b"").to_string());
    provenance(reference, |text| text.replace(&own, &other));
}

fn millimetres(reference: &mut Reference) {
    provenance(reference, |text| text.replace("ux = { unit = \"m\"", "ux = { unit = \"mm\""));
}

fn radians(reference: &mut Reference) {
    provenance(reference, |text| text.replace("ux = { unit = \"m\"", "ux = { unit = \"rad\""));
}

fn thousandfold(reference: &mut Reference) {
    numbers(reference, |csv| {
        let mut lines = csv.lines();
        let header = lines.next().unwrap_or_default();
        let named: Vec<bool> = header.split(',').map(|name| name.starts_with('u')).collect();
        let field = |(name, field): (&bool, &str)| match field.parse::<f64>() {
            Ok(metres) if *name => (1e3 * metres).to_string(),
            _ => field.to_owned(),
        };
        let row =
            |line: &str| named.iter().zip(line.split(',')).map(field).collect::<Vec<_>>().join(",") + "\n";
        format!("{header}\n") + &lines.map(row).collect::<String>()
    });
}

fn nameless(reference: &mut Reference) {
    provenance(reference, |text| {
        text.lines().filter(|line| !line.starts_with("source")).collect::<Vec<_>>().join("\n")
    });
}

fn nan(reference: &mut Reference) {
    numbers(reference, |csv| {
        let at = csv.rfind(',').map_or(0, |at| at + 1);
        format!("{}nan\n", &csv[..at])
    });
}

fn half(reference: &mut Reference) {
    let half = reference.csv.len() / 2;
    reference.csv.to_mut().truncate(half);
}
