//! The same mesh of plane-strain quadrilaterals in Seam and, where it is installed, in CalculiX.
//!
//! `cargo bench -p seam-solver --bench against_calculix`. CalculiX is timed as a whole process (it reads its input
//! and writes one line), Seam without reading a file: on these sizes reading takes CalculiX a few per cent.

use criterion::{Criterion, criterion_group, criterion_main};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::Space;
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};

/// Elements along and across a cantilever of 2 m × 0.4 m.
const DIVISIONS: [usize; 2] = [500, 100];
const YOUNG_PA: f64 = 70e9;
const POISSON: f64 = 0.3;

fn cantilever() -> Model {
    let axes = [(2.0, DIVISIONS[0]), (0.4, DIVISIONS[1])];
    let axes: Vec<_> =
        axes.iter().map(|&(length, n)| structured::even(0.0, length, n).expect("a line")).collect();
    let body = Continuum {
        name: "cantilever".to_owned(),
        mesh: structured::grid(&axes).expect("a grid"),
        elasticity: Elasticity { young_pa: YOUNG_PA, poisson: POISSON, density: 2700.0 },
        hypothesis: Hypothesis::PlaneStrain { thickness_m: 1.0 },
        formulation: Formulation::Plain,
    };
    let at = |point: usize, component: usize, value: f64| PointValue { part: 0, point, component, value };
    let clamped = body.mesh.boundary_nodes("left").expect("a boundary");
    let loaded = body.mesh.boundary_nodes("right").expect("a boundary");
    Model {
        space: Space::Plane,
        supports: clamped.iter().flat_map(|&p| [at(p, 0, 0.0), at(p, 1, 0.0)]).collect(),
        loads: loaded.iter().map(|&p| at(p, 1, -1e4)).collect(),
        parts: vec![Part::Continuum(body)],
        ties: Vec::new(),
    }
}

/// The same model as input for CalculiX, whose numbers have at most 20 characters; it prints one node, so that
/// writing results costs nothing.
fn deck(model: &Model) -> String {
    let Part::Continuum(body) = &model.parts[0] else { unreachable!("the cantilever is a continuum") };
    let mut text = "*NODE, NSET=ALL\n".to_owned();
    let line = |text: &mut String, words: std::fmt::Arguments| {
        text.write_fmt(words).and_then(|()| text.write_char('\n')).expect("a string takes everything");
    };
    for (i, x) in body.mesh.nodes.iter().enumerate() {
        line(&mut text, format_args!("{},{:.12e},{:.12e},0.", i + 1, x.x, x.y));
    }
    line(&mut text, format_args!("*ELEMENT, TYPE=CPE4, ELSET=BODY"));
    for i in 0..body.mesh.cell_count() {
        let c = body.mesh.cell(i);
        line(&mut text, format_args!("{},{},{},{},{}", i + 1, c[0] + 1, c[1] + 1, c[2] + 1, c[3] + 1));
    }
    line(&mut text, format_args!("*MATERIAL, NAME=M\n*ELASTIC\n{YOUNG_PA:e},{POISSON}"));
    line(&mut text, format_args!("*SOLID SECTION, ELSET=BODY, MATERIAL=M\n1.\n*BOUNDARY"));
    for s in &model.supports {
        line(&mut text, format_args!("{},{},{},{}", s.point + 1, s.component + 1, s.component + 1, s.value));
    }
    let tip = model.loads[0].point + 1;
    line(&mut text, format_args!("*NSET, NSET=TIP\n{tip}\n*STEP\n*STATIC\n*CLOAD"));
    for l in &model.loads {
        line(&mut text, format_args!("{},{},{}", l.point + 1, l.component + 1, l.value));
    }
    line(&mut text, format_args!("*NODE PRINT, NSET=TIP\nU\n*END STEP"));
    text
}

fn ccx(folder: &Path) -> bool {
    let mut command = Command::new("ccx");
    command.arg("cantilever").current_dir(folder).env("OMP_NUM_THREADS", "1");
    command.stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok_and(|s| s.success())
}

fn the_same_mesh(c: &mut Criterion) {
    let model = cantilever();
    let mut group = c.benchmark_group("plane-strain quadrilaterals, 101k unknowns");
    group.sample_size(10);
    group
        .bench_function("seam", |b| b.iter(|| black_box(statics::solve(&model).expect("well posed").energy)));
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("cantilever.inp"), deck(&model)).expect("the input can be written");
    if ccx(folder.path()) {
        group.bench_function("calculix", |b| b.iter(|| assert!(ccx(folder.path()), "ccx failed")));
    } else {
        eprintln!("CalculiX is not installed (Debian: apt-get install calculix-ccx); timed Seam alone");
    }
    group.finish();
}

criterion_group!(benches, the_same_mesh);
criterion_main!(benches);
