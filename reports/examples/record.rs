//! Accepts the verdicts, values and counted work of a run: `cargo run -p seam-reports --example record -- out`.
//!
//! Prints what changes in `reports/recorded.toml` before it writes it. References are never touched.

use seam_reports::record::Recorded;
use seam_reports::results::{Results, write_whole};
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("name the folder of a run, e.g. out")?;
    let results = Results::read(&Path::new(&folder).join("results.json"))?;
    let old = Recorded::project()?;
    let new = old.updated(&results);
    for (tier, claims) in &new.claims {
        for (id, claim) in claims {
            let before = old.claim(tier, id);
            if before != Some(claim) {
                let was = before
                    .map_or("unrecorded".to_owned(), |b| format!("{} ({:.0} %)", b.verdict, 100.0 * b.share));
                println!("{tier} {id}: {was} → {} ({:.0} %)", claim.verdict, 100.0 * claim.share);
            }
        }
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("recorded.toml");
    write_whole(&file, &new.to_toml()?)?;
    println!("wrote {}; build again, since the records are part of the command", file.display());
    Ok(())
}
