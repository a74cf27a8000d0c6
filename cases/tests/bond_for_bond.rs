//! Networks against YADE and LAMMPS: they agree, and a change of any part of the network shows.

use seam_cases::catalogue;
use seam_cases::export::{Code, of};
use seam_cases::overrides::Override;
use seam_cases::procedures::run;
use seam_cases::result::ReferenceKind;
use seam_cases::scene::Tier;
use seam_solver::dem::network_csv::parse;
use seam_solver::space::Space;

/// How many quantities there are, and the ids of those outside of what is accepted.
fn outside(id: &str, changes: &[&str]) -> (usize, Vec<String>) {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    let result = run(&catalogue::case(id, &changes).unwrap(), Tier::Quick).unwrap().result;
    let of_a_code = |kind, id: &str| kind != ReferenceKind::Exact || id == "closest-tie";
    assert!(result.quantities.iter().all(|q| of_a_code(q.kind, &q.id)), "a code is named for each");
    let bad = result.quantities.iter().filter(|q| {
        let [low, high] = q.accepted.unwrap();
        !(low <= q.value && q.value <= high)
    });
    (result.quantities.len(), bad.map(|q| q.id.clone()).collect())
}

#[test]
fn networks_at_rest_agree() {
    assert_eq!(outside("bond-for-bond-static", &[]), (18, Vec::new()));
}

#[test]
fn networks_in_motion_agree() {
    assert_eq!(outside("bond-for-bond-dynamic", &[]), (9, Vec::new()));
}

/// One part in a thousand of a load or of torsion is seen, and only where it acts.
#[test]
fn a_changed_network_shows() {
    let (_, load) = outside("bond-for-bond-static", &["parameters.square_N.value=0.05005"]);
    let of_square = |code: &str, what: &str| format!("square-{code}-{what}");
    let expected = ["yade", "lammps"].map(|c| [of_square(c, "displacement"), of_square(c, "rotation")]);
    assert_eq!(load, expected.concat());
    let (_, torsion) = outside("bond-for-bond-static", &["parameters.poisson.value=0.252"]);
    assert!(!torsion.is_empty());
    assert!(torsion.iter().all(|id| id.starts_with("hexagonal") || id.starts_with("random")), "{torsion:?}");
    let (_, step) = outside("bond-for-bond-dynamic", &["parameters.ramp_step_s.value=2.499e-5"]);
    assert!(step.contains(&"ramp-yade-displacement".to_owned()), "{step:?}");
}

/// What is exported is the network, and reads back; its hashes are those of the references.
#[test]
fn exports_are_what_the_references_were_made_from() {
    let file = catalogue::case("bond-for-bond-static", &[]).unwrap();
    let exports = of(&file, Code::Yade).unwrap();
    assert_eq!(exports.len(), 5);
    for export in exports {
        let space = if export.files["run.toml"].contains("plane") { Space::Plane } else { Space::Solid };
        let bytes = |name: &str| export.files[name].as_bytes().to_vec();
        let (particles, bonds) = (bytes("particles.csv"), bytes("bonds.csv"));
        let network = parse(space, ("particles.csv", &particles), ("bonds.csv", &bonds)).unwrap();
        assert_eq!(network.bonds.len() + 1, export.files["bonds.csv"].lines().count());
        let (case, source) =
            export.reference().split_once('/').map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
        seam_references::find(&case, &source).unwrap().open().unwrap().made_from(&export.hashes()).unwrap();
    }
}

/// What YADE was given for a beam of the catalogue is what Seam exports; of a changed beam there is nothing to compare.
#[test]
fn a_peer_is_compared_only_with_what_it_was_given() {
    for id in ["clamped-beam-rotation", "ramp-transfer"] {
        let exports = of(&catalogue::case(id, &[]).unwrap(), Code::Yade).unwrap();
        let [beam] = &exports[..] else { panic!("{id}: {} exports", exports.len()) };
        let reference = seam_references::find(id, "beam-yade").unwrap().open().unwrap();
        reference.made_from(&beam.hashes()).unwrap();
        let other = catalogue::case(id, &[Override::parse("parameters.rows.value=4").unwrap()]).unwrap();
        assert!(reference.made_from(&of(&other, Code::Yade).unwrap()[0].hashes()).is_err(), "{id}");
    }
}

/// Some per cent of strength, or a row of the notch, is seen; pulled and bent.
#[test]
fn bonds_break_as_in_yade_and_a_changed_network_shows() {
    for (id, strength, notch_rows) in
        [("breaking-bonds", "1.02e5", "3.5"), ("breaking-bend", "1.02e5", "4.5")]
    {
        assert_eq!(outside(id, &[]), (5, Vec::new()), "{id}");
        let (_, strength) = outside(id, &[&format!("parameters.strength_Pa.value={strength}")]);
        assert_eq!(strength, ["peak-force", "peak-displacement", "force"], "{id}");
        let (_, notch) = outside(id, &[&format!("parameters.notch_rows.value={notch_rows}")]);
        assert!(notch.contains(&"same-bonds".to_owned()), "{id}: {notch:?}");
    }
}

/// Every criterion and every force that YADE was given is what Seam exports.
#[test]
fn specimens_are_those_that_yade_broke() {
    for id in ["breaking-bonds", "breaking-bend"] {
        let exports = of(&catalogue::case(id, &[]).unwrap(), Code::Yade).unwrap();
        let [specimen] = &exports[..] else { panic!("{id}: {} exports", exports.len()) };
        let reference = seam_references::find(id, "yade").unwrap().open().unwrap();
        reference.made_from(&specimen.hashes()).unwrap();
    }
}

#[test]
fn a_scene_is_exported_if_it_is_one_body_of_the_right_kind() {
    let coupled = catalogue::case("patch-coupled", &[]).unwrap();
    let refusal = of(&coupled, Code::Yade).unwrap_err().to_string();
    assert!(refusal.contains("yade takes one body of particles") && refusal.contains("--set"), "{refusal}");
    let lattice = of(&catalogue::case("patch-lattice", &[]).unwrap(), Code::Lammps).unwrap();
    assert_eq!(lattice[0].reference(), "patch-lattice/lammps");
    assert!(lattice[0].files["particles.csv"].lines().count() > 10);
    let mesh = of(&catalogue::case("cook-membrane", &[]).unwrap(), Code::Calculix).unwrap();
    assert!(mesh[0].files["run.toml"].contains("element = \"CPS4\""), "{:?}", mesh[0].files["run.toml"]);
    assert!(of(&catalogue::case("cook-membrane", &[]).unwrap(), Code::Lammps).is_err());
}
