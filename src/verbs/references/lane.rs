//! Seam's own lane of a race, in a process of its own like the others, so that its memory is its own.

use crate::args::Lane;
use anyhow::Result;
use seam_cases::export::{lane, race};
use seam_reports::exit::Exit;
use std::fmt::Write;
use std::path::Path;

/// Runs one lane and writes `time.toml` and `final.csv`, as `report` of `references/generators/exported.py` does.
pub fn lane(words: &Lane) -> Result<Exit> {
    let finish = match words.what.parse::<usize>() {
        Ok(nodes) => {
            rayon::ThreadPoolBuilder::new().num_threads(words.threads).build_global()?;
            lane::load(&race::clamped_bar(nodes)?)?
        }
        Err(_) if words.finite => lane::turn(Path::new(&words.what))?,
        Err(_) => lane::vibrate(Path::new(&words.what), words.threads)?,
    };
    std::fs::create_dir_all(&words.out)?;
    let version = env!("CARGO_PKG_VERSION");
    let time =
        format!("seconds = {:?}\nmemory_mb = {:?}\nversion = {version}\n", finish.seconds, memory_mb());
    std::fs::write(words.out.join("time.toml"), time)?;
    let mut text = String::from("ux,uy,uz\n");
    for u in &finish.displacement {
        let _ = writeln!(text, "{:?},{:?},{:?}", u.x, u.y, u.z);
    }
    std::fs::write(words.out.join("final.csv"), text)?;
    Ok(Exit::Pass)
}

/// Largest memory of this process so far; NaN where the system does not say.
fn memory_mb() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}
