//! Any bytes are read or refused: mutations of good scenes, meshes and tables, seeded and bounded in time.
//!
//! A stand-in for coverage-guided fuzzing, which needs a nightly compiler: inputs are good files with bytes deleted,
//! doubled, replaced and cut, so that most of them get past the first line of a reader.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use seam_cases::catalogue;
use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_solver::dem::network_csv;
use seam_solver::fem::gmsh::read_gmsh;
use seam_solver::space::Space;
use std::path::{Path, PathBuf};

/// What happens to a file at a place, as a share of its length.
#[derive(Debug, Clone)]
enum Mutation {
    Delete(f64, usize),
    Double(f64, usize),
    Replace(f64, Vec<u8>),
    Cut(f64),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    // Bytes that mean something to one of the readers, and some that mean nothing.
    let telling = prop::sample::select(b"0123456789-+.,eE[]{}\"'=#$\n\r \0\xff".to_vec());
    let bytes = prop::collection::vec(prop_oneof![telling, any::<u8>()], 1..6);
    prop_oneof![
        (0.0..1.0, 1usize..40).prop_map(|(at, n)| Mutation::Delete(at, n)),
        (0.0..1.0, 1usize..200).prop_map(|(at, n)| Mutation::Double(at, n)),
        (0.0..1.0, bytes).prop_map(|(at, b)| Mutation::Replace(at, b)),
        (0.0..1.0).prop_map(Mutation::Cut),
    ]
}

fn mutated(good: &[u8], mutations: &[Mutation]) -> Vec<u8> {
    let mut bytes = good.to_vec();
    for mutation in mutations {
        let place = |at: f64| ((at * bytes.len() as f64) as usize).min(bytes.len());
        match mutation {
            Mutation::Delete(at, n) => drop(bytes.drain(place(*at)..(place(*at) + n).min(bytes.len()))),
            Mutation::Double(at, n) => {
                let at = place(*at);
                let again = bytes[at..(at + n).min(bytes.len())].to_vec();
                bytes.splice(at..at, again);
            }
            Mutation::Replace(at, new) => {
                let at = place(*at);
                bytes.splice(at..(at + new.len()).min(bytes.len()), new.iter().copied());
            }
            Mutation::Cut(at) => bytes.truncate(place(*at)),
        }
    }
    bytes
}

fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

/// Runs a reader on mutations of good files; `read` must not panic.
fn fuzz(cases: u32, good: &[Vec<u8>], read: impl Fn(usize, &[u8])) {
    let strategy = (0..good.len(), prop::collection::vec(mutation(), 1..5));
    let mut runner = proptest::test_runner::TestRunner::new(config(cases));
    let outcome = runner.run(&strategy, |(which, mutations)| {
        read(which, &mutated(&good[which], &mutations));
        Ok(())
    });
    outcome.unwrap();
}

fn data(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    std::fs::read(folder.join(name)).unwrap()
}

/// A file in a folder that goes with the test.
fn file(home: &tempfile::TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = home.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn scenes() {
    let ids = ["patch-coupled", "adaptive-beam", "patch-fe", "random-packing", "ramp-transfer"];
    let good: Vec<Vec<u8>> =
        ids.iter().map(|id| catalogue::case(id, &[]).unwrap().text().as_bytes().to_vec()).collect();
    fuzz(3000, &good, |_, bytes| {
        if let Ok(text) = std::str::from_utf8(bytes) {
            let _ = SceneFile::read("fuzzed.toml", text, Folder::Catalogue, &[]);
        }
    });
}

#[test]
fn gmsh_meshes() {
    let names =
        ["plate_ascii", "plate_binary", "block_ascii", "block_binary", "triangles_ascii", "triangles_binary"];
    let good: Vec<Vec<u8>> =
        names.iter().map(|name| data(&format!("solver/tests/data/{name}.msh"))).collect();
    let home = tempfile::tempdir().unwrap();
    fuzz(3000, &good, |_, bytes| {
        let _ = read_gmsh(&file(&home, "fuzzed.msh", bytes));
    });
}

#[test]
fn networks_from_tables() {
    let good = [data("tests/scenes/particles.csv"), data("tests/scenes/bonds.csv")];
    let home = tempfile::tempdir().unwrap();
    let [particles, bonds] =
        [("p.csv", &good[0]), ("b.csv", &good[1])].map(|(name, bytes)| file(&home, name, bytes));
    fuzz(3000, &good, |which, bytes| {
        let fuzzed = file(&home, "fuzzed.csv", bytes);
        let (particles, bonds) = if which == 0 { (&fuzzed, &bonds) } else { (&particles, &fuzzed) };
        let _ = network_csv::read(Space::Plane, particles, bonds);
    });
}

#[test]
fn references() {
    let all = seam_references::all();
    let reference = all.iter().find(|r| r.id() == "calculix-cpe4/calculix").unwrap();
    let good = [reference.csv.to_vec(), reference.provenance.as_bytes().to_vec()];
    fuzz(2000, &good, |which, bytes| {
        let mut fuzzed = reference.clone();
        match which {
            0 => fuzzed.csv = bytes.to_vec().into(),
            _ => fuzzed.provenance = String::from_utf8_lossy(bytes).into_owned().into(),
        }
        // Other bytes of a table are another hash; a provenance may change in a word that nobody judges.
        let opened = seam_references::verify(&fuzzed);
        assert!(which == 1 || opened.is_err() || bytes == good[0], "an altered table was opened");
    });
}
