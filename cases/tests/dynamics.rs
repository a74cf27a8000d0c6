//! Scenes that move: what is accepted, and what an error says.

use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_cases::overrides::Override;

const BEAM: &str = include_str!("scenes/switched-beam.toml");

fn read(text: &str, changes: &[&str]) -> Result<SceneFile, String> {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    SceneFile::read("beam.toml", text, Folder::Catalogue, &changes).map_err(|e| e.to_string())
}

#[test]
fn a_scene_that_moves_reads() {
    let file = read(BEAM, &[]).unwrap();
    assert!(file.scene.dynamics.is_some() && file.scene.switches.contains_key("middle"));
    // A switch that is off may still be named by probes.
    let off = read(BEAM, &["switches.middle.enabled=false"]).unwrap();
    assert!(off.scene.switches.is_empty() && off.scene.probes.contains_key("energy-jump"));
}

#[test]
fn none_takes_an_optional_key_away() {
    let changes = ["dynamics.stepping=explicit", "dynamics.step_share=0.8"];
    let twice = read(BEAM, &changes).unwrap_err();
    assert!(twice.contains("given twice"), "{twice}");
    let once = read(BEAM, &[changes[0], changes[1], "dynamics.step_s=none"]).unwrap();
    assert_eq!(once.scene.dynamics.as_ref().unwrap().step_s, None);
    let damped = ["dynamics.damping={ rate_per_s = 1 }", "dynamics.damping=none"];
    assert_eq!(read(BEAM, &damped).unwrap().scene.dynamics.unwrap().damping, None);
    let typo = read(BEAM, &["dynamics.damping={ rate = 1 }"]).unwrap_err();
    assert!(typo.contains("key: dynamics.damping.rate") && typo.contains("did you mean"), "{typo}");
}

#[test]
fn faults_name_key_and_mend() {
    for (changes, expected) in [
        (&["dynamics.step_s=none"][..], ["the time step is missing", "key: dynamics", "give step_s"]),
        (&["dynamics.step_s=1"], ["longer than the run", "dynamics.step_s", "shorten"]),
        (&["dynamics.end_s=0"], ["expected a positive number", "dynamics.end_s", ""]),
        (&["dynamics.outputs=0"], ["at least 1", "dynamics.outputs", ""]),
        (&["dynamics.alpha=-0.5"], ["makes HHT unstable", "dynamics.alpha", "-1/3"]),
        (
            &["dynamics.stepping=quasi-static", "dynamics.alpha=0"],
            ["quasi-static stepping does not know `alpha`", "dynamics.alpha", "stepping = \"implicit\""],
        ),
        (
            &["dynamics.method=gravouil-combescure"],
            ["implicit stepping does not know `method`", "dynamics.method", "two-rates"],
        ),
        (&["dynamics.step_share=0.5"], ["does not know `step_share`", "dynamics.step_share", "explicit"]),
        (&["dynamics.stepping=two-rates"], ["missing, or given twice", "dynamics", "fine_s, fine_share"]),
        (
            &["dynamics.stepping=two-rates", "dynamics.fine_share=1.2"],
            ["unstable", "dynamics.fine_share", "at most 1"],
        ),
        (&["dynamics.damping={}"], ["exactly one way", "dynamics.damping", "ratio with period_s"]),
        (&["dynamics.damping={ ratio = 0.1 }"], ["exactly one way", "dynamics.damping", ""]),
        (
            &["dynamics.damping={ share = 0.7 }"],
            ["implicit stepping does not know local damping", "dynamics.damping.share", "explicit"],
        ),
        (&["dynamics.damping={ rate_per_s = -1 }"], ["feed energy in", "dynamics.damping.rate_per_s", ""]),
        (
            &["dynamics.stepping=quasi-static", "dynamics.damping={ rate_per_s = 1 }"],
            ["does not know `damping`", "dynamics.damping", "remove"],
        ),
        (&["dynamics.loads.ramp.start_s=1"], ["the run ends at", "dynamics.loads.ramp.start_s", "earlier"]),
        (&["dynamics.loads.ramp.rise_s=0"], ["expected a positive number", "dynamics.loads.ramp.rise_s", ""]),
        (&["dynamics.loads={ table = [] }"], ["the table is empty", "dynamics.loads.table", ""]),
        (&["dynamics.loads={ table = [[0, 0], [0, 1]] }"], ["not later", "dynamics.loads.table[1]", "sort"]),
        (&["dynamics.loads=suden"], ["unknown value 'suden'", "dynamics.loads", "did you mean 'sudden'?"]),
        (&["dynamics.rotations=finite"], ["explicit", "dynamics.rotations", ""]),
        (
            &["dynamics.stepping=explicit", "dynamics.rotations=finite"],
            ["body 'beam' has finite elements", "dynamics.rotations", "small"],
        ),
        (&["switches.middle.at_s=0.001"], ["exactly one way", "switches.middle", "at_s, at_load, criterion"]),
        (&["switches.middle.at_load=1.5"], ["never gets to 1.5", "switches.middle.at_load", ""]),
        (&["switches.middle.body=baem"], ["no body 'baem'", "switches.middle.body", "did you mean 'beam'?"]),
        (&["switches.middle.box.max[0]=0"], ["flat or inside out", "switches.middle.box.max[0]", ""]),
        (
            &["switches.middle.de.arrangement=fcc"],
            ["does not exist in the space", "switches.middle.de.arrangement", ""],
        ),
        (
            &["switches.middle.fields=everything"],
            ["unknown value 'everything'", "switches.middle.fields", ""],
        ),
        (&["probes.energy-jump.switch=left"], ["no switch 'left'", "probes.energy-jump.switch", ""]),
        (
            &["probes.root.support=clmp"],
            ["no support 'clmp'", "probes.root.support", "did you mean 'clamp'?"],
        ),
        (
            &["probes.root.support=clamp", "probes.root.point=[0, 0]"],
            ["where", "probes.root", "give `support` alone"],
        ),
        (&["quantities.tip.take=largest"], ["one value only", "quantities.tip.take", ""]),
        (&["quantities.tip.zone=de"], ["zone does not fit", "quantities.tip.zone", "after-switch"]),
        (&["quantities.mid-line.zone=end"], ["zone does not fit", "quantities.mid-line.zone", "whole or de"]),
        (&["parameters.t=1"], ["unknown key 't'", "", ""]),
    ] {
        let message = read(BEAM, changes).unwrap_err();
        for part in expected {
            assert!(message.contains(part), "{changes:?}: expected '{part}' in:\n{message}");
        }
    }
}

/// Faults that no override can make: keys that are missing.
#[test]
fn faults_of_the_text_name_key_and_mend() {
    let at = "at_load = 0.5";
    let place = "box = { min = [\"length_m/3\", 0], max = [\"2*length_m/3\", \"height_m\"] }";
    let criterion = |inside: &str| format!("criterion = {{ {inside} }}");
    let whole = "trigger = 1, every_s = 1e-4";
    for (from, to, expected) in [
        (at, String::new(), ["exactly one way", "switches.middle", ""]),
        (at, "at_s = 1".to_owned(), ["outside of the run", "switches.middle.at_s", "switch earlier"]),
        (place, String::new(), ["does not say where", "switches.middle", "box"]),
        (
            at,
            criterion(&format!("error = {{}}, {whole}")),
            ["finds its own place", "switches.middle.box", "remove"],
        ),
        (
            &format!("{at}\n{place}"),
            criterion(whole),
            ["exactly one indicator", "switches.middle.criterion", "stress, error"],
        ),
        (
            &format!("{at}\n{place}"),
            criterion(&format!("stress = {{}}, {whole}")),
            ["strength that is not given", "criterion.stress", "strength_Pa"],
        ),
        (
            &format!("{at}\n{place}"),
            criterion(&format!("error = {{}}, release = 2, {whole}")),
            ["below the trigger", "criterion.release", ""],
        ),
        (
            "method = \"fe\"",
            "method = \"de\"\nde = { arrangement = \"square\", rows = 2, bond = {} }".to_owned(),
            ["no finite elements to switch", "switches.middle.body", ""],
        ),
        (
            &BEAM[BEAM.find("[dynamics]").unwrap()..BEAM.find("[switches.middle]").unwrap()],
            String::new(),
            ["stands still", "switches.middle", "[dynamics]"],
        ),
    ] {
        assert!(BEAM.contains(from), "{from}");
        let message = read(&BEAM.replacen(from, &to, 1), &[]).unwrap_err();
        for part in expected {
            assert!(message.contains(part), "{to}: expected '{part}' in:\n{message}");
        }
    }
    // Without a switch and without a run there is no history to read either.
    let still = &BEAM[BEAM.find("[dynamics]").unwrap()..BEAM.find("[probes.tip]").unwrap()];
    let message = read(&BEAM.replacen(still, "", 1), &[]).unwrap_err();
    assert!(message.contains("read in a run in time"), "{message}");
}
