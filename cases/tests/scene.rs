//! Scene files: what is accepted, and what an error says.

use seam_cases::catalogue;
use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_cases::overrides::Override;

const BEAM: &str = r#"id = "beam"
title = "A beam"

[parameters]
height_m = { value = 0.1, unit = "m" }
rows = 4

[materials.steel]
young_Pa = 210e9
poisson = 0.3

[bodies.beam]
method = "fe"
material = "steel"
box = { min = [0, 0], max = [1, "height_m"] }
fe = { divisions = ["10*rows", "rows"] }

[supports.clamp]
on = "beam.left"
ux = 0
uy = 0

[loads.tip]
on = "beam.right"
total_N = [0, -1000]
"#;

fn read(text: &str, changes: &[&str]) -> Result<SceneFile, String> {
    let changes: Result<Vec<_>, _> = changes.iter().map(|c| Override::parse(c)).collect();
    changes
        .and_then(|changes| SceneFile::read("beam.toml", text, Folder::Catalogue, &changes))
        .map_err(|e| e.to_string())
}

fn error(from: &str, to: &str) -> String {
    assert!(BEAM.contains(from), "{from}");
    read(&BEAM.replacen(from, to, 1), &[]).unwrap_err()
}

#[test]
fn the_catalogue_reads() {
    let list = catalogue::list().unwrap();
    assert!(list.iter().any(|e| e.id == "clamped-beam-rotation"));
    for entry in list {
        let page = catalogue::page(&entry.id).unwrap();
        assert!(
            page.starts_with("# ") && page.contains(&format!("`seam run {}`", entry.id)),
            "the page of {} lacks its heading or its command",
            entry.id
        );
    }
}

#[test]
fn an_error_shows_the_line_and_the_mend() {
    assert_eq!(
        error("poisson = 0.3", "poison = 0.3"),
        "beam.toml:10:1: unknown key 'poison'\n   = key: materials.steel.poison\n10 | poison = 0.3\n   | ^^^^^^\n   = mend: did you mean 'poisson'?"
    );
}

#[test]
fn errors_name_place_key_and_mend() {
    for (from, to, expected) in [
        (
            "method = \"fe\"",
            "method = \"fem\"",
            ["13:10: unknown value 'fem'", "key: bodies.beam.method", "did you mean 'fe'?"],
        ),
        ("poisson = 0.3\n", "", ["8:1: missing key 'poisson'", "key: materials.steel", "add it"]),
        (
            "210e9",
            "-210e9",
            [
                "9:12: expected a positive number, found -210000000000",
                "key: materials.steel.young_Pa",
                "above zero",
            ],
        ),
        ("210e9", "nan", ["9:12: expected a finite number, found NaN", "key: materials.steel.young_Pa", ""]),
        ("poisson = 0.3", "poisson = 0.5", ["10:11: Poisson's ratio 0.5 is outside", "", ""]),
        (
            "\"steel\"",
            "\"stel\"",
            ["14:12: there is no material 'stel'", "bodies.beam.material", "did you mean 'steel'?"],
        ),
        (
            "\"height_m\"]",
            "\"heigth_m\"]",
            ["15:33: ", "unknown name 'heigth_m'; did you mean 'height_m'?", "bodies.beam.box.max[1]"],
        ),
        (
            "\"height_m\"]",
            "\"1/(rows-4)\"]",
            ["15:33: ", "column 2: division by zero", "bodies.beam.box.max[1]"],
        ),
        (
            "\"height_m\"]",
            "-1]",
            ["15:33: the box is flat or inside out", "bodies.beam.box.max[1]", "max larger than min"],
        ),
        (
            "\"10*rows\"",
            "\"10*rows/3\"",
            ["16:21: expected a whole number of at least 1, found 13.3", "", ""],
        ),
        ("\"10*rows\", ", "", ["16:20: expected 2 components, found 1", "bodies.beam.fe.divisions", ""]),
        (
            "\"beam.left\"",
            "\"beam.lft\"",
            ["19:6: body 'beam' has no boundary 'lft'", "supports.clamp.on", "did you mean 'left'?"],
        ),
        (
            "\"beam.left\"",
            "\"root\"",
            ["19:6: there is no set 'root'", "supports.clamp.on", "there are none here"],
        ),
        ("ux = 0\nuy = 0\n", "", ["18:1: the support holds nothing", "", ""]),
        ("rows = 4", "x = 4", ["'x' already has a meaning", "parameters.x", ""]),
        ("rows = 4", "rows = \"2*rows\"", ["6:8: these parameters need each other", "", ""]),
        ("rows = 4", "rows = 4\nrows = 5", ["7:1: duplicate key", "", "rename"]),
        ("rows = 4", "rows = ", ["6:", "", ""]),
        ("[parameters]", "tiers = []\n[parameters]", ["the case would never run", "key: tiers", ""]),
    ] {
        let message = error(from, to);
        for part in expected {
            assert!(message.contains(part), "expected '{part}' in:\n{message}");
        }
    }
}

#[test]
fn overrides_reach_every_kind_of_key() {
    let file =
        read(BEAM, &["parameters.height_m=0.2", "parameters.rows=6", "bodies.beam.box.max[0]=2"]).unwrap();
    assert_eq!(file.values["height_m"], 0.2);
    assert_eq!(file.scene.parameters["height_m"].unit, "m", "the long form keeps its unit");
    let length = &file.scene.bodies["beam"].cuboid.as_ref().unwrap().max[0];
    assert_eq!(length.value(&file.values, "").unwrap(), 2.0);
    let file = read(BEAM, &["bodies.beam.fe.formulation=b-bar", "hypothesis=plane-strain"]).unwrap();
    assert_eq!(serde_json::to_value(&file.scene.bodies["beam"].fe).unwrap()["formulation"], "b-bar");
}

#[test]
fn a_mistyped_override_is_refused() {
    for (change, expected) in [
        ("parameters.row=6", "unknown key 'row'; did you mean 'rows'?"),
        ("bodies.baem.method=de", "unknown key 'baem'; did you mean 'beam'?"),
        ("bodies.beam.box.max[7]=1", "no element [7]; there are 2"),
        ("bodies.beam.method.x=1", "inside a plain value"),
        ("rows", "expected key.path=value"),
        ("bodies.beam.fe.formulatoin=plain", "did you mean 'formulation'?"),
        ("parameters.rows=0", "expected a whole number of at least 1, found 0"),
    ] {
        let message = read(BEAM, &[change]).unwrap_err();
        assert!(message.contains(expected), "{message}");
    }
    let message = read(BEAM, &["parameters.rows=0"]).unwrap_err();
    assert!(message.contains("after the override parameters.rows=0"), "{message}");
}

#[test]
fn the_schema_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scene.schema.json");
    let schema = seam_cases::scene::schema();
    if std::env::var_os("SEAM_BLESS").is_some() {
        std::fs::write(path, &schema).unwrap();
    }
    let kept = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        kept == schema,
        "cases/scene.schema.json is stale; SEAM_BLESS=1 cargo test -p seam-cases writes it anew"
    );
}

proptest::proptest! {
    #[test]
    fn any_text_is_a_scene_or_an_error(at in 0..BEAM.len(), junk in "[\\[\\]{}=\",.a-z0-9\n]{0,6}", skip in 0usize..8) {
        let end = (at + skip).min(BEAM.len());
        let text = format!("{}{junk}{}", &BEAM[..at], &BEAM[end..]);
        let _ = read(&text, &[]);
    }
}

/// The beam of [`BEAM`] with a notch.
fn notched() -> String {
    BEAM.replace(
        "box = { min = [0, 0], max = [1, \"height_m\"] }\nfe = { divisions = [\"10*rows\", \"rows\"] }",
        "notched_beam = { length_m = 1, depth_m = \"height_m\", notch_depth_m = 0.04, notch_angle_deg = 60, reach_m = 0.1 }\n\
         fe = { refinement = { finest_m = \"height_m/50\", growth = 1.5, coarsest_m = \"height_m/4\", through_x_m = [-0.4, 0.4] } }",
    )
}

#[test]
fn a_notched_beam_is_built_in_the_plane_and_in_space() {
    use seam_cases::model::build;
    let plane = build(&read(&notched(), &[]).unwrap()).unwrap();
    let text = notched().replace("total_N = [0, -1000]", "total_N = [0, -1000, 0]");
    let solid = build(&read(&text, &["hypothesis=solid", "thickness_m=0.05"]).unwrap()).unwrap();
    let [plane, solid] = [plane, solid].map(|built| built.model.parts[0].positions().to_vec());
    assert_eq!(2 * plane.len(), solid.len());
    assert!(solid.iter().any(|x| x.z == 0.05));
    assert!(plane.iter().any(|x| x.x == 0.4 && x.y == 0.0));
}

#[test]
fn impossible_notches_are_named_by_their_key() {
    for (from, to, expected) in [
        ("notch_depth_m = 0.04", "notch_depth_m = 0.1", "notched_beam.notch_depth_m"),
        ("notch_depth_m = 0.04", "notch_depth_m = 0", "does not end inside"),
        ("notch_angle_deg = 60", "notch_angle_deg = 180", "notched_beam.notch_angle_deg"),
        ("reach_m = 0.1", "reach_m = 0.02", "half the mouth is 0.0230"),
        ("reach_m = 0.1", "reach_m = 0.6", "half the beam 0.5"),
        ("growth = 1.5", "growth = 0.5", "fe.refinement.growth"),
        ("coarsest_m = \"height_m/4\"", "coarsest_m = 1e-6", "fe.refinement.coarsest_m"),
        ("[-0.4, 0.4]", "[-0.4, 0.6]", "fe.refinement.through_x_m[1]"),
        ("refinement = {", "divisions = [1, 1], refinement = {", "no divisions"),
        ("method = \"fe\"", "method = \"de\"", "the section `de` is missing"),
    ] {
        let text = notched();
        assert!(text.contains(from), "{from}");
        let message = read(&text.replacen(from, to, 1), &[]).unwrap_err();
        assert!(message.contains(expected), "expected '{expected}' in:\n{message}");
    }
    let message = error(
        "divisions = [\"10*rows\", \"rows\"]",
        "divisions = [4, 4], refinement = { finest_m = 0.1, coarsest_m = 1 }",
    );
    assert!(message.contains("only a notched beam has a refinement"), "{message}");
}
