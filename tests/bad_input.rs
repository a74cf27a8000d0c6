//! Bad input: exit code 2, a message with the place and the mend, and earlier results untouched.

mod common;

use common::{call, files, pass, scenes};

/// Runs a bad scene where the same id has a good result, and looks for each of `parts` in the message.
fn refused(scene: &str, parts: &[&str]) {
    let home = tempfile::tempdir().unwrap();
    let good = std::fs::read_to_string(scenes().join("own-beam.toml")).unwrap();
    let earlier = home.path().join("earlier.toml");
    std::fs::write(&earlier, good.replace("id = \"own-beam\"", &format!("id = \"{scene}\""))).unwrap();
    let out = home.path().join("out");
    pass(&["run", earlier.to_str().unwrap(), "--out"], &out);
    let before = files(&out);
    assert!(before.contains_key(&out.join(scene).join("result.json")), "nothing to lose in {scene}");

    let outcome = call(&["run", &format!("{scene}.toml"), "--quiet", "--out"], &out);
    let message = &outcome.stderr;
    assert_eq!(outcome.code, Some(2), "{message}");
    for part in parts {
        assert!(message.contains(part), "'{part}' is not in: {message}");
        assert_eq!(message.matches(part).count(), 1, "'{part}' is told twice in: {message}");
    }
    assert!(!message.contains("panicked"), "{message}");
    assert!(files(&out) == before, "{scene}: the earlier result has changed");
}

#[test]
fn an_unknown_key() {
    refused(
        "unknown-key",
        &[
            "unknown-key.toml:13:1: unknown key 'materiel'",
            "bodies.block.materiel",
            "did you mean 'material'?",
        ],
    );
}

#[test]
fn a_wrong_type() {
    refused("wrong-type", &["wrong-type.toml:15:20: ", "string \"two\"", "bodies.block.fe.divisions"]);
}

#[test]
fn a_negative_modulus() {
    refused(
        "negative-modulus",
        &["negative-modulus.toml:8:12: ", "materials.solid.young_Pa", "mend: give it a value above zero"],
    );
}

/// A few bytes that ask for more memory than there is: refused before it is taken.
#[test]
fn a_huge_model_from_a_small_file() {
    let home = tempfile::tempdir().unwrap();
    let own = scenes().join("own-beam.toml");
    for (set, key, part) in [
        ("bodies.clamped.fe.divisions=[1000000, 1000000]", "bodies.clamped.fe.divisions", "1.000e12 nodes"),
        (
            "bodies.free.de.rows=900000000",
            "bodies.free.de.rows",
            "particles are more than the limit of 200000",
        ),
        ("bodies.free.box.max=[1e9, 0.1]", "bodies.free.de.rows", "raise limits.particles"),
    ] {
        let set = format!("--set={set}");
        let outcome = call(&["run", own.to_str().unwrap(), &set, "--out"], &home.path().join("out"));
        let message = outcome.stderr;
        assert_eq!(outcome.code, Some(2), "{set}: {message}");
        assert!(message.contains(key) && message.contains(part), "{set}: {message}");
    }
}

/// Whatever a scene says, everything it writes is below `--out`, in the folder of its id.
#[test]
fn nothing_is_written_outside_of_out() {
    let home = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(scenes().join("own-beam.toml")).unwrap();
    for id in ["../outside", "/tmp/outside", "a/b", "..", "a\\b"] {
        let scene = home.path().join("scene.toml");
        std::fs::write(&scene, text.replace("\"own-beam\"", &format!("{id:?}"))).unwrap();
        let outcome = call(&["run", scene.to_str().unwrap(), "--out"], &home.path().join("out"));
        assert!(outcome.code == Some(2) && outcome.stderr.contains("is not an id"), "{}", outcome.stderr);
    }
    // Names of bodies and probes become names of files.
    for (name, bad) in [("free", "../../free"), ("free", "/tmp/free"), ("end", "../../end")] {
        let scene = home.path().join("scene.toml");
        let line = "[probes.end]\nread = \"uy\"\nline = { from = [0, 0.05], to = [1, 0.05], intervals = 4 }\nexact = [\"x\"]\n[probes.tip]\nread";
        let text = text.replace("probe = \"end\"", "probe = \"tip\"").replace("[probes.end]\nread", line);
        let renamed = text
            .replace(&format!("[bodies.{name}]"), &format!("[bodies.{bad:?}]"))
            .replace(&format!("[probes.{name}]"), &format!("[probes.{bad:?}]"))
            .replace(&format!("\"{name}."), &format!("\"{bad}."));
        std::fs::write(&scene, renamed).unwrap();
        let outcome = call(&["run", scene.to_str().unwrap(), "--out"], &home.path().join("deep/out"));
        assert_eq!(outcome.code, Some(2), "{bad}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("is not a name"), "{bad}: {}", outcome.stderr);
    }
    let left: Vec<_> = files(home.path()).into_keys().collect();
    assert_eq!(left, [home.path().join("scene.toml")]);
}

#[test]
fn a_missing_file() {
    refused("missing-file", &["bonds-that-are-lost.csv", "put it next to the scene"]);
}

#[test]
fn a_path_that_leaves_the_folder() {
    refused("leaving-the-folder", &["../scenes/particles.csv", "give a path below it"]);
}

#[test]
fn an_inverted_element() {
    refused("inverted-element", &["body 'bowtie': element 2 is inverted", "check the order and position"]);
}

#[test]
fn overlapping_subdomains() {
    refused("overlap", &["'first' and 'second' overlap by 2.500e-1 m", "they may only share a face"]);
}

#[test]
fn an_empty_interface() {
    refused(
        "empty-interface",
        &["tie 'joint': empty interface", "do not lie in one plane", "tie flat faces that touch"],
    );
}

#[test]
fn a_mechanism() {
    refused("mechanism", &["body 'block' is free to move along y", "add supports"]);
}

#[test]
fn disconnected_particles() {
    refused("disconnected", &["body 'net': 1 particle(s) not connected", "[3]", "bond them, tie them"]);
}

#[test]
fn duplicate_ids_in_a_table() {
    refused("duplicate-ids", &["duplicate-particles.csv:4: column 'id'", "give each its own id"]);
}

#[test]
fn nan_in_a_table() {
    refused("nan-in-csv", &["nan-bonds.csv:3: column 'young_Pa'", "'NaN' is not a finite number"]);
}

#[test]
fn a_step_above_the_critical_one() {
    refused(
        "step-above-critical",
        &[
            "time step 1.000000e-4 s is beyond the critical",
            "of body 'beam'",
            "take at most the critical step",
        ],
    );
}

#[test]
fn a_switch_region_without_elements() {
    refused(
        "switch-without-elements",
        &[
            "region in body 'beam'",
            "no element has its centre between [0.7, 0.0] and [0.8, 0.1]",
            "widen the box",
        ],
    );
}

#[test]
fn a_criterion_without_strength() {
    refused(
        "criterion-without-strength",
        &[
            "criterion-without-strength.toml:34:",
            "stress is compared with a strength that is not given",
            "key: switches.zone.criterion.stress",
            "mend: give strength_Pa",
        ],
    );
}

#[test]
fn a_load_after_the_end() {
    refused(
        "load-after-end",
        &[
            "load-after-end.toml:30:",
            "the loads begin at 0.02 s, the run ends at 0.01 s",
            "key: dynamics.loads.ramp.start_s",
            "mend: begin them earlier, or run longer",
        ],
    );
}

#[test]
fn finite_rotations_of_a_coupled_scene() {
    refused(
        "finite-rotation-coupled",
        &[
            "body 'clamped' has finite elements, which know small rotations only",
            "key: dynamics.rotations",
            "or compute every body with particles",
        ],
    );
}
