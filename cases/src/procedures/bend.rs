//! A notched beam of elements in three-point bending, which procedures share.

use seam_solver::error::{Error, Result};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::energy_release::energy_release_rate;
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::mesh::Mesh;
use seam_solver::fem::notched_beam::{NotchedBeam, NotchedMesh, Through};
use seam_solver::fem::refined::Refinement;
use seam_solver::fem::stress::stress_at;
use seam_solver::fracture_mechanics::plane_modulus;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;

/// A beam on two points at the span S = 4W, loaded at a third by the force P = 1 N in plane stress, 1 m thick.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// Of the beam.
    pub elasticity: Elasticity,
    /// W, in m.
    pub depth: f64,
    /// Beyond each support, in depths.
    pub overhang: f64,
    /// Distance from mid-span within which the grid opens for the notch, in depths.
    pub reach: f64,
}

/// Where forces act.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rollers {
    /// At one node each. The displacement under them grows without bound as the mesh is refined, so none of it is judged.
    Points,
    /// As even tractions over this length, in m, on a beam that floats.
    Patches(f64),
}

/// A bent beam.
pub struct Bent {
    body: Continuum,
    tip: Vec3,
    u: Vec<f64>,
    /// What it took.
    pub work: Work,
}

impl Bend {
    /// S, in m.
    pub fn span(&self) -> f64 {
        4.0 * self.depth
    }

    /// Solves a beam with a notch of depth a = `alpha` W and angle ω (rad).
    ///
    /// # Errors
    /// A notch or refinement that gives no mesh; a solve that fails.
    pub fn solve(&self, alpha: f64, angle: f64, by: Refinement, rollers: Rollers) -> Result<Bent> {
        let (half, w) = (0.5 * self.span(), self.depth);
        let beam = NotchedBeam {
            length: 2.0 * (half + self.overhang * w),
            depth: w,
            notch_depth: alpha * w,
            angle,
            reach: self.reach * w,
        };
        let mut x = vec![-half, half];
        if let Rollers::Patches(width) = rollers {
            x.extend([-half, 0.0, half].iter().flat_map(|c| [c - 0.5 * width, c + 0.5 * width]));
        }
        let NotchedMesh { mesh, tip } = beam.mesh(by, &Through { x, ..Through::default() })?;
        let tip = mesh.nodes[tip[0]];
        let at = |place: Vec3| node(&mesh, place);
        let (load, left, right) =
            (at(Vec3::new(0.0, w, 0.0))?, at(Vec3::new(-half, 0.0, 0.0))?, at(Vec3::new(half, 0.0, 0.0))?);
        let value = |point, component, value| PointValue { part: 0, point, component, value };
        // Patches are in equilibrium by themselves: the same supports hold the beam and carry nothing.
        let supports = vec![value(left, 1, 0.0), value(right, 1, 0.0), value(load, 0, 0.0)];
        let loads = match rollers {
            Rollers::Points => vec![value(load, 1, -1.0)],
            Rollers::Patches(width) => {
                let patches = [("top", 0.0, -1.0), ("bottom", -half, 0.5), ("bottom", half, 0.5)];
                patches
                    .iter()
                    .flat_map(|&(face, centre, force)| patch(&mesh, face, centre, width, force))
                    .map(|(point, force)| value(point, 1, force))
                    .collect()
            }
        };
        let body = Continuum {
            name: "beam".to_owned(),
            mesh,
            elasticity: self.elasticity,
            hypothesis: Hypothesis::PlaneStress { thickness_m: 1.0 },
            formulation: Formulation::Plain,
        };
        let parts = vec![Part::Continuum(body.clone())];
        let model = Model { space: Space::Plane, parts, ties: vec![], supports, loads };
        let solution = statics::solve(&model)?;
        Ok(Bent { body, tip, u: solution.u, work: solution.work })
    }

    /// `f` in `K_I = P S/(B W^{3/2}) f`, from the energy release rate: `K = √(J E')`.
    ///
    /// q falls from one within half the ligament of the tip, or half the crack, to zero at nine tenths of it.
    ///
    /// # Errors
    /// Elements that are inverted.
    pub fn intensity(&self, bent: &Bent) -> Result<f64> {
        let w = self.depth;
        let rim = 0.9 * bent.tip.y.min(w - bent.tip.y);
        let weight = |x: Vec3| ((rim - (x - bent.tip).amax()) / (rim * (1.0 - 0.5 / 0.9))).clamp(0.0, 1.0);
        let j = energy_release_rate(&bent.body, &bent.u, Vec3::y(), weight)?;
        let k = (j * plane_modulus(&self.elasticity, bent.body.hypothesis)).sqrt();
        // P = 1 N, B = 1 m.
        Ok(k * w.powf(1.5) / self.span())
    }
}

impl Bent {
    /// Opening stress `σ_xx` (Pa) at the middle of the cells beside the line ahead of the tip, with their distance from it (m): where
    /// Q4 is most accurate (Barlow 1976).
    ///
    /// # Errors
    /// Elements that are inverted.
    pub fn ahead(&self, within: [f64; 2]) -> Result<Vec<[f64; 2]>> {
        let mesh = &self.body.mesh;
        let mut points = Vec::new();
        for cell in 0..mesh.cell_count() {
            let nodes = mesh.cell(cell).iter().map(|&n| mesh.nodes[n]);
            let beside = nodes.clone().filter(|x| x.x == 0.0 && x.y >= self.tip.y).count() == 2;
            let r = (nodes.sum::<Vec3>() / 4.0 - self.tip).norm();
            if beside && (within[0]..=within[1]).contains(&r) {
                let stress = stress_at(&self.body, &self.u, cell, &[[0.0; 3]])?;
                points.push([r, stress[0].voigt[0]]);
            }
        }
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Ok(points)
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.body.mesh.cell_count()
    }
}

fn node(mesh: &Mesh, place: Vec3) -> Result<usize> {
    mesh.nodes.iter().position(|x| *x == place).ok_or_else(|| Error::Geometry {
        what: "three-point bend".to_owned(),
        message: format!("no node at ({}, {}); let a grid line pass there", place.x, place.y),
    })
}

/// A force spread evenly over the facets of a face within a length: shares of its nodes.
fn patch(mesh: &Mesh, face: &str, centre: f64, width: f64, force: f64) -> Vec<(usize, f64)> {
    let mut shares = Vec::new();
    for facet in mesh.boundaries.get(face).into_iter().flatten() {
        let [a, b] = [facet.nodes[0], facet.nodes[1]];
        let middle = 0.5 * (mesh.nodes[a].x + mesh.nodes[b].x);
        if (middle - centre).abs() < 0.5 * width {
            let share = 0.5 * force * (mesh.nodes[a] - mesh.nodes[b]).norm() / width;
            shares.extend([(a, share), (b, share)]);
        }
    }
    shares
}
