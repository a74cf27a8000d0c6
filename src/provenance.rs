//! What produced a result: version, commit, command, machine.

use seam_reports::results::{Machine, Provenance};
use std::collections::BTreeMap;
use std::time::{SystemTime, UNIX_EPOCH};

/// Provenance of this process, with the hashes of the references it judges beside.
pub fn here(references: BTreeMap<String, String>) -> Provenance {
    let versions = [
        ("random generator", seam_solver::dem::packing::ALGORITHM),
        ("scene format", seam_cases::result::SCHEMA),
    ];
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("SEAM_COMMIT").map(str::to_owned),
        command: command_line(),
        versions: versions.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect(),
        references,
        machine: Machine {
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            processor: processor(),
            threads: rayon::current_num_threads(),
            started: now(),
        },
    }
}

/// Today, UTC, ISO 8601.
pub fn today() -> String {
    now().split('T').next().unwrap_or_default().to_owned()
}

/// Class of this machine: processor, cores and system, but not its name.
pub fn machine_class() -> String {
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    format!("{}, {cores} cores, {}, {}", std::env::consts::ARCH, processor(), std::env::consts::OS)
}

/// The words that were given, without the path of the program.
fn command_line() -> String {
    std::iter::once("seam".to_owned()).chain(std::env::args().skip(1)).collect::<Vec<_>>().join(" ")
}

fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix("model name")?.split_once(':'));
    line.map_or_else(|| "unknown".to_owned(), |(_, name)| name.trim().to_owned())
}

/// UTC as ISO 8601, from days since the epoch (Hinnant 2013, `civil_from_days`).
fn now() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let (days, rest) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * of_year + 2) / 153;
    let day = of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}T{:02}:{:02}:{:02}Z", rest / 3600, rest / 60 % 60, rest % 60)
}
