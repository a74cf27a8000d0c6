//! A cracked strip in tension and cracked beams in bending, of a triangular lattice whose bonds break.

use super::slit_lattice::{SlitLattice, model, on};
use seam_solver::cracking::{Options, Outcome};
use seam_solver::dem::calibration::isotropy::Moduli;
use seam_solver::dem::lattice::LatticeKind;
use seam_solver::error::Result;
use seam_solver::failure::FailureLaw;
use seam_solver::failure::bond_stress::BondStress;
use seam_solver::failure::strength::Strength;
use seam_solver::fracture_mechanics::{edge_crack_tension, srawley};
use seam_solver::model::Model;
use seam_solver::space::Vec3;
use seam_solver::work::Work;
use std::f64::consts::PI;

/// Material and size of strip and bends.
pub struct Specimen {
    /// E (Pa) and ν.
    pub moduli: Moduli,
    /// `K_Ic`, in Pa√m.
    pub toughness: f64,
    /// W, in m.
    pub depth: f64,
    /// B, in m.
    pub thickness: f64,
    /// Length of the strip over W.
    pub strip: f64,
    /// Breaks that are followed.
    pub events: usize,
}

/// What came of a specimen.
pub struct Broken {
    /// Row intervals over the depth.
    pub rows: usize,
    /// R, in m.
    pub radius: f64,
    /// Depth of the slit, in m.
    pub slit: f64,
    /// Displacement (m) and force (N) at the events.
    pub path: Vec<[f64; 2]>,
    /// Energy without an entry in the ledger, over the largest entry.
    pub closure: f64,
    /// What it took.
    pub work: Work,
    /// Length the crack has gained before the peak, in rows: half a row with every break.
    pub grown: f64,
    /// Largest force, in N.
    peak: f64,
    depth: f64,
    thickness: f64,
    /// S of a bend, in m; `None` of a strip.
    span: Option<f64>,
}

impl Broken {
    /// `K_I` at the peak, in Pa√m, of a crack that is `longer` rows deeper than the slit: `P S/(B W^{3/2}) f(a/W)` in bending,
    /// `σ√(πa) F(a/W)` in tension.
    ///
    /// # Errors
    /// A crack that leaves the body.
    pub fn intensity(&self, longer: f64) -> Result<f64> {
        let a = self.slit + longer * self.depth / self.rows as f64;
        let alpha = a / self.depth;
        Ok(match self.span {
            Some(span) => self.peak * span / (self.thickness * self.depth.powf(1.5)) * srawley(alpha)?,
            None => self.peak / (self.thickness * self.depth) * (PI * a).sqrt() * edge_crack_tension(alpha)?,
        })
    }
}

impl Specimen {
    /// A slit between the columns, a quarter of the spacing beside the middle, where it crosses a bond at every half row. It ends half way
    /// between the last bond it cuts and the first it leaves: `a = (m + ½)/2` rows.
    fn lattice(&self, rows: usize, cells: usize, alpha: f64) -> SlitLattice {
        let halves = (2.0 * alpha * rows as f64 - 0.5).round();
        let mut lattice = SlitLattice {
            kind: LatticeKind::TriangularZigzag,
            rows,
            cells,
            depth: self.depth,
            thickness: self.thickness,
            moduli: self.moduli,
            slit: 0.0,
            notch: 0.0,
        };
        lattice.slit = 0.25 * lattice.spacing();
        lattice.notch = 0.5 * (halves + 0.5) * lattice.row();
        lattice
    }

    fn law(&self, factor: f64) -> FailureLaw {
        let tensile = Strength::Toughness { toughness_pa_sqrt_m: self.toughness, factor };
        FailureLaw::BondStress(BondStress::Normal { tensile })
    }

    /// Up to the middle of the ligament: the crack is unstable long before, and nothing breaks under the load's point.
    fn crack(&self, lattice: &SlitLattice, model: &Model, factor: f64) -> Result<(Outcome, Vec<[f64; 2]>)> {
        let below = 0.5 * (lattice.notch + lattice.depth);
        let mut path = vec![[0.0, 0.0]];
        let options = Options { events: self.events, ..Options::default() };
        let may = |a: Vec3, b: Vec3| a.y.max(b.y) < below && a.x.abs() < lattice.depth;
        let outcome =
            lattice.crack(model, self.law(factor), may, options, |_, force, q| path.push([q, force]))?;
        Ok((outcome, path))
    }

    fn broken(&self, lattice: &SlitLattice, model: &Model, factor: f64, span: Option<f64>) -> Result<Broken> {
        let (outcome, path) = self.crack(lattice, model, factor)?;
        let peak = outcome.peak().map_or(f64::NAN, |p| p[1]);
        let breaks = outcome.events.iter().take_while(|e| e.force < peak).count();
        Ok(Broken {
            rows: lattice.rows,
            radius: 0.5 * lattice.spacing(),
            slit: lattice.notch,
            path,
            closure: outcome.energies().closure(),
            work: outcome.work,
            grown: 0.5 * breaks as f64,
            peak,
            depth: self.depth,
            thickness: self.thickness,
            span,
        })
    }

    /// A strip pulled at its ends by even tractions, its ends free to turn.
    pub fn tension(&self, rows: usize, alpha: f64, factor: f64) -> Result<Broken> {
        let spacing = self.lattice(rows, 2, alpha).spacing();
        let cells = (self.strip * self.depth / spacing).round() as usize;
        let lattice = self.lattice(rows, cells, alpha);
        let network = lattice.network()?;
        let mut loads = Vec::new();
        for row in 0..=rows {
            let y = row as f64 * lattice.row();
            let share = if row == 0 || row == rows { 0.5 } else { 1.0 } / rows as f64;
            // The last particle of a row stands on the face or half a spacing before it.
            let end = 0.5 * (cells as f64 - (row % 2) as f64) * spacing;
            for side in [-1.0, 1.0] {
                loads.push(on(lattice.site(&network, side * end, y)?, 0, side * share));
            }
        }
        let end = 0.5 * cells as f64 * spacing;
        let (left, right) =
            (lattice.site(&network, -end, self.depth)?, lattice.site(&network, end, self.depth)?);
        let supports = vec![on(left, 0, 0.0), on(left, 1, 0.0), on(right, 1, 0.0)];
        let model = model(network, supports, loads);
        self.broken(&lattice, &model, factor, None)
    }

    /// The beam's lattice, half a depth beyond each support.
    fn bend_lattice(&self, rows: usize, alpha: f64) -> SlitLattice {
        let half = self.half_span(rows);
        self.lattice(rows, 2 * (half + rows / 2), alpha)
    }

    /// Cells between mid-span and a support: the nearest to 2 W.
    fn half_span(&self, rows: usize) -> usize {
        (2.0 * rows as f64 * 0.75f64.sqrt()).round() as usize
    }

    /// A beam on two particles, pushed at a third. Its span is that with the moment at the slit, which stands a little beside the load.
    pub fn bend(&self, rows: usize, alpha: f64, factor: f64) -> Result<Broken> {
        let lattice = self.bend_lattice(rows, alpha);
        let half = self.half_span(rows) as f64 * lattice.spacing();
        let network = lattice.network()?;
        let at = |x: f64, y: f64| lattice.site(&network, x, y);
        let (load, left, right) = (at(0.0, self.depth)?, at(-half, 0.0)?, at(half, 0.0)?);
        let supports = vec![on(left, 1, 0.0), on(right, 1, 0.0), on(load, 0, 0.0)];
        let model = model(network, supports, vec![on(load, 1, -1.0)]);
        self.broken(&lattice, &model, factor, Some(2.0 * (half - lattice.slit)))
    }
}
