//! Running scenes: patches, families, references, folders of results.

use seam_cases::catalogue;
use seam_cases::file::SceneFile;
use seam_cases::folder::Folder;
use seam_cases::overrides::Override;
use seam_cases::procedures::run;
use seam_cases::result::CaseResult;
use seam_cases::scene::Tier;
use seam_cases::write;

fn changed(id: &str, changes: &[&str]) -> CaseResult {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    run(&catalogue::case(id, &changes).unwrap(), Tier::Quick).unwrap().result
}

fn outside(result: &CaseResult) -> Vec<String> {
    let bad = |q: &&seam_cases::result::Observation| {
        let [low, high] = q.accepted.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        !(low <= q.value && q.value <= high)
    };
    result.quantities.iter().filter(bad).map(|q| q.id.clone()).collect()
}

#[test]
fn exact_cases_are_exact() {
    for id in [
        "bond-matrix",
        "lattice-constants",
        "patch-fe",
        "patch-solid",
        "patch-lattice",
        "patch-lattice-solid",
        "patch-coupled",
        "patch-coupled-solid",
        "fe-fe-fe",
        "timoshenko-goodier",
    ] {
        let result = changed(id, &[]);
        assert!(!result.quantities.is_empty() && result.work.total() > 0, "{id}");
        assert_eq!(outside(&result), Vec::<String>::new(), "{id}");
    }
}

/// Breaking what a patch guards turns it red.
#[test]
fn a_broken_patch_shows() {
    let full = changed("patch-lattice", &["bodies.block.de.skin=full"]);
    assert_eq!(outside(&full), ["tension-and-shear"]);
    let locked = changed("patch-fe", &["supports.top.uy=a*(x/3 - y/5)"]);
    assert!(!outside(&locked).is_empty());
    let ratio = changed(
        "patch-coupled",
        &["bodies.middle.de.bond.calibrate=young", "bodies.middle.de.bond.radius_ratio=0.6"],
    );
    // Tension does not see the shear stiffness of the lattice, shear does.
    assert_eq!(outside(&ratio), ["shear-mortar", "shear-nested"]);
}

/// The clamped beam with small families.
fn beam(changes: &[&str]) -> CaseResult {
    let small = [
        "families.settings.quick=[{ rows = [4], skin = [\"full\", \"weighted\"] }, { network = [\"lattice\"], rows = [4] }]",
        "families.settings.seeds.quick=[1, 2]",
        "budgets.paper-like.parts=[]",
        "costs.rotation.levels.values=[4]",
    ];
    changed("clamped-beam-rotation", &[&small[..], changes].concat())
}

#[test]
fn a_family_runs_in_the_order_of_its_blocks_and_repeats_bit_for_bit() {
    let (first, second) = (beam(&[]), beam(&[]));
    let family = first.families.iter().find(|f| f.claim == "rotation-7-percent").unwrap();
    assert!(!family.complete);
    let who: Vec<(String, Option<u64>)> =
        family.members.iter().map(|m| (m.settings["skin"].clone(), m.seed)).collect();
    let named = |skin: &str, seed| (skin.to_owned(), seed);
    assert_eq!(
        who,
        [
            named("full", Some(1)),
            named("full", Some(2)),
            named("weighted", Some(1)),
            named("weighted", Some(2)),
            named("full", None)
        ]
    );
    for member in &family.members {
        assert_eq!(member.errors.len(), family.readings.len(), "{:?}", member.failed);
        assert!(member.errors.values().all(|e| e.is_finite() && *e > 0.0) && member.particles > 50);
    }
    let bits = |result: &CaseResult| {
        let members = result.families.iter().flat_map(|f| &f.members);
        members.flat_map(|m| m.errors.values().map(|e| e.to_bits())).collect::<Vec<_>>()
    };
    assert_eq!(bits(&first), bits(&second));
    assert_eq!(first.quantities, second.quantities);
}

#[test]
fn parts_of_a_budget_add_up_to_the_total() {
    let result = beam(&[]);
    for budget in &result.budgets {
        let sum: f64 = budget.parts.iter().map(|p| p.value).sum();
        assert!((sum - budget.total).abs() < 1e-15, "{}", budget.id);
        assert_eq!(budget.parts.last().unwrap().name, "unexplained");
    }
    let fine = &result.budgets.iter().find(|b| b.id == "pointwise-fine-mesh").unwrap().parts;
    let part = |name: &str| fine.iter().find(|p| p.name == name).unwrap().value;
    // Full skin stiffens, pointwise ties to a finer mesh soften: the two cancel in part.
    assert!(part("skin") < -0.03 && part("mesh ratio") > 0.01);
}

#[test]
fn a_member_that_cannot_run_says_why() {
    let result = beam(&[
        "families.improved.axes.rows={ key = \"parameters.poisson\", values = [0.4] }",
        "families.improved.paper_like.rows=0.4",
    ]);
    let own = result.families.iter().find(|f| f.claim == "rotation-07-percent").unwrap();
    let reason = own.members[0].failed.as_ref().unwrap();
    assert!(reason.contains("0.3333") && own.members[0].errors.is_empty(), "{reason}");
}

#[test]
fn a_result_folder_is_replaced_whole() {
    let out = tempfile::tempdir().unwrap();
    let case =
        |changes: &[Override]| run(&catalogue::case("fe-fe-fe", changes).unwrap(), Tier::Quick).unwrap();
    let folder = write::write(out.path(), &case(&[])).unwrap();
    let first = write::read(&folder).unwrap();
    assert_eq!(first.id, "fe-fe-fe");
    for name in ["result.json", "deflection.csv", "left.vtu", "middle.vtu", "right.vtu"] {
        assert!(folder.join(name).is_file(), "{name}");
    }
    std::fs::write(folder.join("stale.csv"), "").unwrap();
    let again = case(&[Override::parse("parameters.rows=2").unwrap()]);
    write::write(out.path(), &again).unwrap();
    assert_ne!(write::read(&folder).unwrap().scene_hash, first.scene_hash);
    assert!(!folder.join("stale.csv").exists());
    assert_eq!(std::fs::read_dir(out.path()).unwrap().count(), 1, "no leftovers beside the folder");
}

const NETWORK: &str = r#"id = "brought-network"
title = "A network from files"
tiers = ["full"]

[materials.any]
young_Pa = 1e9
poisson = 0.0

[bodies.net]
method = "de"
material = "any"
network = { particles = "p.csv", bonds = "b.csv" }

[sets.end]
body = "net"
csv = "end.csv"

[sets.root]
body = "net"
ids = [0]

[supports.clamp]
on = "root"
ux = 0
uy = 0
rz = 0

[loads.pull]
on = "end"
total_N = [100, 0]

[probes.energy]
read = "strain-energy"

[quantities.energy]
label = "Strain energy"
probe = "energy"
reference = { kind = "exact", value = "100^2/(2*1e9*pi*0.1^2)*2", source = "F²L/2EA of two bonds in line" }
accept = { relative = 1e-12, why = "rounding" }
"#;

fn network(changes: &[&str], end: &str) -> Result<CaseResult, String> {
    let home = tempfile::tempdir().unwrap();
    let save = |name: &str, text: &str| std::fs::write(home.path().join(name), text).unwrap();
    save("p.csv", "id,x,y,z,radius,mass\n1,0,0,0,0.5,1\n2,1,0,0,0.5,1\n3,2,0,0,0.5,1\n");
    save("b.csv", "i,j,young_Pa,poisson,radius_m\n1,2,1e9,0,0.1\n2,3,1e9,0,0.1\n");
    save("end.csv", end);
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    let folder = Folder::Disk(home.path().to_owned());
    let file = SceneFile::read("net.toml", NETWORK, folder, &changes).map_err(|e| e.to_string())?;
    run(&file, Tier::Full).map(|run| run.result).map_err(|e| e.to_string())
}

#[test]
fn a_network_is_read_from_files_beside_the_scene() {
    let result = network(&[], "id\n2\n").unwrap();
    assert_eq!(outside(&result), Vec::<String>::new(), "{:?}", result.quantities);
}

#[test]
fn bad_files_and_places_are_named() {
    for (changes, end, expected) in [
        (&[][..], "id\n7\n", "there is no particle 7; body 'net' has 3"),
        (&[], "id\ntwo\n", "end.csv: line 2: 'two' is not an id"),
        (&[], "number\n2\n", "there is no column `id`"),
        (&[], "id\n2\n2\n", "id 2 is listed twice"),
        (&["sets.end.csv=../end.csv"], "id\n2\n", "only read files in its own folder"),
        (&["sets.end.csv=none.csv"], "id\n2\n", "none.csv"),
        (&["bodies.net.network.bonds=nothing.csv"], "id\n2\n", "nothing.csv"),
        (&["supports.clamp.on=net.west"], "id\n2\n", "body 'net' has no boundary 'west'"),
        (&["limits={ particles = 2 }"], "id\n2\n", "body 'net' has 3 particles, the limit is 2"),
        (&["loads.pull.total_N=[0, \"1/0\"]"], "id\n2\n", "division by zero"),
        (&["procedure=static"], "id\n2\n", "did you mean 'statics'?"),
    ] {
        let message = network(changes, end).unwrap_err();
        assert!(message.contains(expected), "expected '{expected}' in:\n{message}");
    }
}
