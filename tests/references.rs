//! References: whole ones are named with their hashes, an altered one stops the judging.

mod common;

use common::{call, pass};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A copy of the built-in references, and a folder with one result.
fn home() -> (tempfile::TempDir, PathBuf) {
    let home = tempfile::tempdir().unwrap();
    let references = home.path().join("references");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("references/data");
    for (file, bytes) in common::files(&data) {
        let copy = references.join(file.strip_prefix(&data).unwrap());
        fs::create_dir_all(copy.parent().unwrap()).unwrap();
        fs::write(copy, bytes).unwrap();
    }
    pass(&["run", "bond-matrix", "--out"], &home.path().join("out"));
    (home, references)
}

fn hashes(home: &Path) -> Value {
    let text = fs::read_to_string(home.join("out/results.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["provenance"]["references"].clone()
}

/// Judges beside changed references: exit code 4, nothing written, and each of `parts` in the message.
fn refused(change: impl Fn(&Path), parts: &[&str]) {
    let (home, references) = home();
    change(&references);
    let folder = references.to_str().unwrap();
    for verb in ["check", "report"] {
        let outcome = call(&[verb, "--references", folder, "--from"], &home.path().join("out"));
        assert_eq!(outcome.code, Some(4), "{}{}", outcome.stdout, outcome.stderr);
        for part in parts {
            assert!(outcome.stderr.contains(part), "'{part}' is not in: {}", outcome.stderr);
        }
        assert!(!home.path().join("out/results.json").exists(), "{verb} judged all the same");
    }
}

#[test]
fn the_hashes_of_whole_references_are_recorded() {
    let (home, references) = home();
    let out = home.path().join("out");
    pass(&["check", "--from"], &out);
    let built_in = hashes(home.path());
    let files = common::files(&references);
    assert_eq!(built_in.as_object().unwrap().len(), files.len());
    for (file, bytes) in files {
        let name = file.strip_prefix(&references).unwrap().to_str().unwrap();
        assert_eq!(built_in[name], seam_references::Sha256::of(&bytes).as_str(), "{name}");
    }
    pass(&["check", "--references", references.to_str().unwrap(), "--from"], &out);
    assert_eq!(hashes(home.path()), built_in, "a copy is as good as the built-in files");
}

#[test]
fn an_altered_number_is_4_and_names_the_generator() {
    refused(
        |references| {
            let csv = references.join("calculix-cpe4/calculix.csv");
            let text = fs::read_to_string(&csv).unwrap();
            fs::write(&csv, text + "\n").unwrap();
        },
        &["calculix-cpe4/calculix.csv: altered", "restore the file", "python3 references/generators/"],
    );
}

#[test]
fn a_number_without_its_provenance_is_4() {
    refused(
        |references| fs::remove_file(references.join("calculix-c3d8/calculix.toml")).unwrap(),
        &["calculix-c3d8/calculix.csv: ", "calculix.toml is missing", "run the generator again"],
    );
}

#[test]
fn a_missing_reference_is_4_and_says_what_to_put_back() {
    refused(
        |references| fs::remove_dir_all(references.join("calculix-c3d8")).unwrap(),
        &["the reference 'calculix-c3d8/calculix' is missing", "put calculix-c3d8/calculix.csv and"],
    );
}

#[test]
fn an_empty_folder_is_4() {
    let (home, references) = home();
    fs::remove_dir_all(&references).unwrap();
    fs::create_dir(&references).unwrap();
    let words = ["check", "--references", references.to_str().unwrap(), "--from"];
    let outcome = call(&words, &home.path().join("out"));
    assert_eq!(outcome.code, Some(4));
    assert!(outcome.stderr.contains("no references; put them there"), "{}", outcome.stderr);
}

/// `seam references …` where only `tools` is on the search path, and no LAMMPS.
fn references(tools: &Path, words: &[&str]) -> (Option<i32>, String) {
    let output = common::seam()
        .arg("references")
        .args(words)
        .env("PATH", tools)
        .env("SEAM_LAMMPS", tools.join("lammps"))
        .output()
        .unwrap();
    let said = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    (output.status.code(), said)
}

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("references")
}

#[test]
fn the_list_names_codes_and_how_to_install_them() {
    let empty = tempfile::tempdir().unwrap();
    let (code, said) = references(empty.path(), &["list"]);
    assert_eq!(code, Some(0), "{said}");
    for part in [
        "bond-for-bond-static/random-yade",
        "prototype",
        "yade: not installed",
        "references/install/lammps.sh",
    ] {
        assert!(said.contains(part), "'{part}' is not in:\n{said}");
    }
}

#[test]
fn verify_passes_what_is_whole_and_refuses_what_is_not() {
    let (home, folder) = home();
    let verify = || references(home.path(), &["verify", "--references", folder.to_str().unwrap()]);
    let (code, said) = verify();
    assert_eq!(code, Some(0), "{said}");
    let csv = folder.join("bond-for-bond-static/chain-yade.csv");
    let whole = fs::read(&csv).unwrap();
    let mut altered = whole.clone();
    let digit = altered.iter_mut().rev().find(|byte| byte.is_ascii_digit()).unwrap();
    *digit = if *digit == b'0' { b'1' } else { b'0' };
    fs::write(&csv, &altered).unwrap();
    let (code, said) = verify();
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("chain-yade.csv: altered"), "{said}");
    fs::write(&csv, whole).unwrap();
    let toml = folder.join("bond-for-bond-static/chain-yade.toml");
    let text = fs::read_to_string(&toml).unwrap();
    let (before, after) = text.split_once("\"bonds.csv\" = \"").unwrap();
    fs::write(&toml, format!("{before}\"bonds.csv\" = \"{}{}", "0".repeat(8), &after[8..])).unwrap();
    let (code, said) = verify();
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("out of date: its input 'bonds.csv'") && said.contains("--with yade"), "{said}");
}

#[test]
fn without_a_code_nothing_is_made_and_one_line_says_how_to_install_it() {
    let empty = tempfile::tempdir().unwrap();
    let home = repository();
    let (code, said) =
        references(empty.path(), &["regenerate", "--with", "yade", "--home", home.to_str().unwrap()]);
    assert_eq!(code, Some(4), "{said}");
    assert_eq!(said.matches("sh references/install/yade.sh").count(), 1, "{said}");
    let (code, said) = references(empty.path(), &["regenerate", "--home", empty.path().to_str().unwrap()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("--home"), "{said}");
    let (code, said) = references(empty.path(), &["regenerate", "nothing", "--home", home.to_str().unwrap()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("no code makes 'nothing'"), "{said}");
}

/// A stand-in for YADE that hands back what is committed, changed by `edit` (a sed command) and hashed anew.
#[cfg(unix)]
fn stand_in(folder: &Path, edit: &str) {
    use std::os::unix::fs::PermissionsExt;
    let data = repository().join("data");
    let script = format!(
        "#!/bin/sh\nPATH=/usr/bin:/bin\ncase=$6 name=$7\nmkdir -p $SEAM_REFERENCES/$case\n\
         sed '{edit}' {data}/$case/$name.csv > $SEAM_REFERENCES/$case/$name.csv\n\
         hash=$(sha256sum $SEAM_REFERENCES/$case/$name.csv | cut -d' ' -f1)\n\
         sed \"s/^csv_sha256.*/csv_sha256 = \\\"$hash\\\"/\" {data}/$case/$name.toml > $SEAM_REFERENCES/$case/$name.toml\n",
        data = data.display()
    );
    let file = folder.join("yade");
    fs::write(&file, script).unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
}

/// The same numbers pass; others are red and replace nothing, until they are accepted.
#[cfg(unix)]
#[test]
fn only_accepted_numbers_replace_what_is_committed() {
    let tools = tempfile::tempdir().unwrap();
    let home = tools.path().join("references");
    for (file, bytes) in common::files(&repository()) {
        let copy = home.join(file.strip_prefix(repository()).unwrap());
        fs::create_dir_all(copy.parent().unwrap()).unwrap();
        fs::write(copy, bytes).unwrap();
    }
    let id = "bond-for-bond-static/chain-yade";
    let words = ["regenerate", id, "--home", home.to_str().unwrap()];
    let committed = || fs::read(home.join(format!("data/{id}.csv"))).unwrap();
    let before = committed();
    stand_in(tools.path(), "");
    let (code, said) = references(tools.path(), &words);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("chain-yade: the same numbers"), "{said}");
    stand_in(tools.path(), "$ s/^-/-9/");
    let (code, said) = references(tools.path(), &words);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("chain-yade: differs by"), "{said}");
    assert_eq!(committed(), before, "replaced without being accepted");
    let (code, said) = references(tools.path(), &[&words[..], &["--accept"]].concat());
    assert_eq!(code, Some(0), "{said}");
    assert_ne!(committed(), before);
    fs::write(tools.path().join("yade"), "#!/bin/sh\necho out of particles\nexit 3\n").unwrap();
    let (code, said) = references(tools.path(), &words);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("static.py failed") && said.contains("out of particles"), "{said}");
}

/// A code that ends well and leaves nothing, or half of it, is an error that says what the code said.
#[cfg(unix)]
#[test]
fn a_lane_without_a_whole_result_stops_the_race() {
    use std::os::unix::fs::PermissionsExt;
    let tools = tempfile::tempdir().unwrap();
    let file = tools.path().join("yade");
    let race = |script: &str| {
        fs::write(&file, format!("#!/bin/sh\nPATH=/usr/bin:/bin\n{script}\n")).unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
        let out = tools.path().join("out");
        let words = ["race", "--particles", "100", "--nodes", "100", "--steps", "5", "--rounds", "1"];
        let out = ["--out", out.to_str().unwrap()];
        references(tools.path(), &[&words[..], &out[..]].concat())
    };
    // Its words: -n -x -j1 SCRIPT FOLDER OUT.
    let (code, said) = race("echo the second rank has left >&2");
    assert_eq!(code, Some(2), "{said}");
    for part in ["race.py ended without an error and without a whole result", "the second rank has left"] {
        assert!(said.contains(part), "'{part}' is not in:\n{said}");
    }
    let half = "mkdir -p $6; printf 'seconds = 1.0\\nmemory_mb = 1.0\\nversion = 1\\n' > $6/time.toml; \
                printf 'ux,uy,uz\\n0,0,0\\n' > $6/final.csv";
    let (code, said) = race(half);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("final.csv has 1 rows for"), "{said}");
}

#[test]
fn seam_races_alone_where_nothing_else_is_installed() {
    let empty = tempfile::tempdir().unwrap();
    let out = empty.path().join("out");
    let words = ["race", "--particles", "100", "--nodes", "100", "--steps", "5", "--rounds", "1"];
    let (code, said) = references(empty.path(), &[&words[..], &["--out", out.to_str().unwrap()]].concat());
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("yade: not installed; install it with: sh references/install/yade.sh"), "{said}");
    assert!(said.lines().all(|line| line.starts_with('/') || line.chars().count() <= 80), "{said}");
    assert!(said.contains("/seam: what share of it Seam is"), "{said}");
    let race = out.join("race/race.csv");
    let csv = fs::read_to_string(&race).unwrap();
    let lanes: Vec<&str> = csv.lines().skip(1).map(|l| l.split(',').nth(3).unwrap()).collect();
    let limits = ["bandwidth", "arithmetic"];
    let network = [&["seam", "seam-finite"], &limits[..], &["seam"], &limits[..]].concat();
    assert_eq!(lanes, [&network[..], &["seam"; 2]].concat(), "one and two threads: {csv}");

    pass(&["run", "bond-matrix", "--out"], &out);
    pass(&["report", "--from"], &out);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("What a user would pick instead") && !page.contains("Recorded elsewhere"));
    fs::write(&race, csv + "\n").unwrap();
    let altered = call(&["report", "--from"], &out);
    assert_eq!(altered.code, Some(4), "{}", altered.stderr);
    assert!(altered.stderr.contains("race.csv: altered"), "{}", altered.stderr);
}
