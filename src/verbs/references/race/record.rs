//! A race on disk: `race/race.csv` with the medians and `race/race.toml` with how they came about, as any reference.

use super::row::Row;
use crate::args::Race;
use crate::provenance;
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
        "who ran; seam-finite is Seam with bonds for finite rotations, which the others carry too",
    ),
    ("seconds", "s", "wall time, median of the rounds"),
    ("rate", "Hz", "bond updates per second of the network, unknowns per second of the mesh; median"),
    ("rate_min", "Hz", "slowest round"),
    ("rate_max", "Hz", "fastest round"),
    ("times_seam", "1", "wall time over Seam's, median of the rounds"),
    ("memory_mb", "1", "largest memory, in MiB"),
    (
        "difference",
        "1",
        "largest difference of a displacement at the end from Seam's, relative to the largest",
    ),
];

/// Writes both files and reads them back.
pub fn write(
    rows: &[Row],
    words: &Race,
    versions: &BTreeMap<&'static str, String>,
    inputs: &BTreeMap<String, Sha256>,
) -> Result<Dataset> {
    let csv = csv(rows);
    let spread = rows.iter().map(Row::spread).fold(0.0, f64::max);
    let named: Vec<String> = versions.iter().map(|(code, version)| format!("{code} {version}")).collect();
    let list = |numbers: Vec<usize>| numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
    let threads = words.threads.iter().map(|n| n.get()).collect();
    let mut toml = format!(
        "id = \"race/race\"\nkind = \"timing\"\n\
         about = \"Medians of {} rounds, the codes in turn, each in a process of its own; without reading and preparing. The \
         network is a free cube of a face-centred cubic lattice that goes through a bending wave in {} steps, bonds only, no \
         contact search; the mesh is a clamped bar of plain hexahedra, solved at rest.\"\n\
         source = \"Run for Seam by its own command\"\ncode = \"{}\"\nversion = \"{}\"\n\
         command = \"seam references race --particles {} --nodes {} --steps {} --threads {} --rounds {}\"\n\
         date = {}\nmachine = \"{}\"\ncsv_sha256 = \"{}\"\n\
         repeat = {{ difference = {spread:?}, about = \"largest range of the rates of one code over their median\" }}\n\n[inputs]\n",
        words.rounds,
        words.steps,
        versions.keys().copied().collect::<Vec<_>>().join(", "),
        named.join(", "),
        list(words.particles.clone()),
        list(words.nodes.clone()),
        words.steps,
        list(threads),
        words.rounds,
        provenance::today(),
        provenance::machine_class(),
        Sha256::of(csv.as_bytes()),
    );
    for (file, hash) in inputs {
        let _ = writeln!(toml, "\"{file}\" = \"{hash}\"");
    }
    toml += "\n[columns]\n";
    for (name, unit, about) in COLUMNS {
        let _ = writeln!(toml, "{name} = {{ unit = \"{unit}\", about = \"{about}\" }}");
    }
    let folder = words.out.join("race");
    write_whole(&folder.join("race.csv"), &csv)?;
    write_whole(&folder.join("race.toml"), &toml)?;
    let written = in_folder(&words.out, "race", "race")?.context("race.csv is gone")?;
    Ok(written.open()?)
}

fn csv(rows: &[Row]) -> String {
    let mut text = COLUMNS.map(|(name, ..)| name).join(",") + "\n";
    for r in rows {
        let [rate, low, high] = r.rate;
        let _ = writeln!(
            text,
            "{},{},{},{},{:?},{rate:?},{low:?},{high:?},{:?},{:?},{:?}",
            r.what, r.size, r.threads, r.code, r.seconds, r.times_seam, r.memory_mb, r.difference
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
