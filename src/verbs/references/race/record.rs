//! A race on disk: `race/race.csv` with the medians and `race/race.toml` with how they came about, as any reference.

use super::row::Row;
use crate::args::Race;
use crate::provenance::{machine_class, today};
use anyhow::{Context, Result};
use seam_references::{Dataset, Sha256, in_folder};
use seam_reports::results::write_whole;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// Columns: name, unit, what they hold.
const COLUMNS: [(&str, &str, &str); 11] = [
    ("what", "name", "network of particles, or mesh of hexahedra"),
    ("size", "1", "particles of the network, nodes of the mesh"),
    ("threads", "1", "threads, or ranks"),
    (
        "code",
        "name",
        "who ran; seam-finite is Seam with bonds for finite rotations, which the others carry too; bandwidth and arithmetic are \
         what the machine allows Seam",
    ),
    ("seconds", "s", "wall time, median of the rounds"),
    ("rate", "Hz", "bond updates per second of the network, unknowns per second of the mesh; median"),
    ("rate_min", "Hz", "slowest round"),
    ("rate_max", "Hz", "fastest round"),
    ("times_seam", "1", "wall time over Seam's, median of the rounds"),
    ("memory_mb", "1", "largest memory, in MiB; 0 for what the machine allows"),
    (
        "difference",
        "1",
        "largest difference of a displacement at the end, relative to the largest, from Seam's: for a network with finite \
         rotations; 0 for what the machine allows",
    ),
];

/// Writes both files and reads them back.
pub fn write(
    rows: &[Row],
    words: &Race,
    versions: &BTreeMap<&'static str, String>,
    inputs: &BTreeMap<String, Sha256>,
) -> Result<Dataset> {
    let (csv, folder) = (csv(rows), words.out.join("race"));
    write_whole(&folder.join("race.csv"), &csv)?;
    write_whole(&folder.join("race.toml"), &provenance(&csv, rows, words, versions, inputs))?;
    let written = in_folder(&words.out, "race", "race")?.context("race.csv is gone")?;
    Ok(written.open()?)
}

fn provenance(
    csv: &str,
    rows: &[Row],
    words: &Race,
    versions: &BTreeMap<&'static str, String>,
    inputs: &BTreeMap<String, Sha256>,
) -> String {
    let spread = rows.iter().map(Row::spread).fold(0.0, f64::max);
    let codes = joined(versions.keys(), ", ");
    let named = joined(versions.iter().map(|(code, version)| format!("{code} {version}")), ", ");
    let Race { particles, nodes, steps, threads, rounds, .. } = words;
    let (particles, nodes, threads) = (joined(particles, " "), joined(nodes, " "), joined(threads, " "));
    let mut toml = format!(
        "id = \"race/race\"\nkind = \"timing\"\n\
         about = \"Medians of {rounds} rounds, the codes in turn, each in a process of its own; without reading and preparing. The \
         network is a free cube of a face-centred cubic lattice that goes through a bending wave in {steps} steps, bonds only, no \
         contact search; the mesh is a clamped bar of plain hexahedra, solved at rest. What the machine allows is measured in the \
         same rounds: the time in which memory passes each number of Seam's loop for small rotations once per step, and the time of \
         its products and sums. Networks that stay in a cache may beat the memory.\"\n\
         source = \"Run for Seam by its own command\"\ncode = \"{codes}\"\nversion = \"{named}\"\n\
         command = \"seam references race --particles {particles} --nodes {nodes} --steps {steps} --threads {threads} --rounds {rounds}\"\n\
         date = {}\nmachine = \"{}\"\ncsv_sha256 = \"{}\"\n\
         repeat = {{ difference = {spread:?}, about = \"largest range of the rates of one code over their median\" }}\n\n[inputs]\n",
        today(),
        machine_class(),
        Sha256::of(csv.as_bytes()),
    );
    for (file, hash) in inputs {
        let _ = writeln!(toml, "\"{file}\" = \"{hash}\"");
    }
    toml += "\n[columns]\n";
    for (name, unit, about) in COLUMNS {
        let _ = writeln!(toml, "{name} = {{ unit = \"{unit}\", about = \"{about}\" }}");
    }
    toml
}

fn joined(items: impl IntoIterator<Item: ToString>, between: &str) -> String {
    items.into_iter().map(|item| item.to_string()).collect::<Vec<_>>().join(between)
}

fn csv(rows: &[Row]) -> String {
    let mut text = COLUMNS.map(|(name, ..)| name).join(",") + "\n";
    for r in rows {
        let (lane, [rate, low, high]) = (r.lane, r.rate);
        let _ = writeln!(
            text,
            "{},{},{},{},{:?},{rate:?},{low:?},{high:?},{:?},{:?},{:?}",
            lane.what, lane.size, lane.threads, lane.code, r.seconds, r.times_seam, r.memory_mb, r.difference
        );
    }
    text
}

/// Records it: reports without a race of their own show it.
pub fn accept(out: &Path, data: &Path) -> Result<()> {
    for name in ["race.csv", "race.toml"] {
        let (from, to) = (out.join("race").join(name), data.join("race").join(name));
        let text = std::fs::read_to_string(&from).with_context(|| from.display().to_string())?;
        write_whole(&to, &text)?;
        eprintln!("recorded: {}", to.display());
    }
    Ok(())
}
