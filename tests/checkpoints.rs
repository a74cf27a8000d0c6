//! Runs in time that are stopped and restarted.

mod common;

use common::{call, files, pass, scenes};
use serde_json::Value;
use std::path::Path;

/// The result of the ramp, without the clock and the command.
fn result(out: &Path) -> Value {
    let text = std::fs::read_to_string(out.join("ramp/result.json")).unwrap();
    let mut result: Value = serde_json::from_str(&text).unwrap();
    for key in ["seconds", "command"] {
        assert!(result.as_object_mut().unwrap().remove(key).is_some());
    }
    result
}

fn restart(scene: &str, checkpoint: &Path, out: &Path) -> common::Outcome {
    call(&["run", scene, "--restart", checkpoint.to_str().unwrap(), "--quiet", "--out"], out)
}

/// From before the switch and from after it: every number, histories and counted work too.
#[test]
fn a_restarted_run_gives_what_the_whole_run_gives() {
    let home = tempfile::tempdir().unwrap();
    let [whole, again] = ["whole", "again"].map(|name| home.path().join(name));
    for every in ["4", "7"] {
        pass(&["run", "ramp.toml", "--checkpoint-every", every, "--out"], &whole);
        let outcome = restart("ramp.toml", &whole.join("ramp.checkpoint"), &again);
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        assert!(result(&whole) == result(&again), "every {every}");
    }
    let expected = result(&whole);
    assert_eq!(expected["switches"].as_array().unwrap().len(), 1);
    assert_eq!(expected["curves"][1]["series"][0]["x"].as_array().unwrap().len(), 11);
}

#[test]
fn a_checkpoint_of_another_case_is_refused_and_nothing_is_lost() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    pass(&["run", "ramp.toml", "--checkpoint-every", "4", "--out"], &out);
    let checkpoint = out.join("ramp.checkpoint");
    let text = std::fs::read_to_string(scenes().join("ramp.toml")).unwrap();
    let other = home.path().join("other.toml");
    std::fs::write(&other, text.replace("id = \"ramp\"", "id = \"other\"")).unwrap();
    let changed = home.path().join("changed.toml");
    std::fs::write(&changed, text.replace("-1000", "-1001")).unwrap();
    let broken = home.path().join("broken.checkpoint");
    let mut bytes = std::fs::read(&checkpoint).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&broken, bytes).unwrap();
    let before = files(home.path());

    let [other, changed] = [&other, &changed].map(|path| path.to_str().unwrap());
    for (scene, file, parts) in [
        (
            other,
            &checkpoint,
            ["ramp.checkpoint: it is a checkpoint of case 'ramp', not of 'other'", "restart 'ramp' from it"],
        ),
        (changed, &checkpoint, ["ramp.checkpoint: the scene 'ramp' has changed since", "or start again"]),
        ("ramp.toml", &broken, ["broken.checkpoint: checkpoint: it is damaged", "start again"]),
        ("ramp.toml", &home.path().join("none"), ["none: ", "check the path"]),
        ("own-beam.toml", &checkpoint, ["no run in time", "[dynamics]"]),
    ] {
        let outcome = restart(scene, file, &out);
        assert_eq!(outcome.code, Some(2), "{}", outcome.stderr);
        for part in parts {
            assert!(outcome.stderr.contains(part), "'{part}' is not in: {}", outcome.stderr);
        }
    }
    assert!(files(home.path()) == before, "something has changed");
}
