//! Which elements are to become particles.
//!
//! - *Stress*: largest principal value of the stress averaged over a length, over the strength. A point value would follow
//!   the mesh into every corner; averaged over two particle diameters it is what particles can resolve.
//! - *Error*: the element's share of the estimated error in energy (Zienkiewicz & Zhu 1987): `η_e² = ∫(σ*−σ_h):C⁻¹:(σ*−σ_h) dV` with the
//!   recovered, continuous stress σ*, over the share `√((‖u‖² + ‖e‖²)/N)` that every element would have of the energy.
//!
//! What fires is widened by a buffer of at least the elements around it. What has fired stays, or goes back below a release value.

use super::region::{centre, measure};
use crate::dem::block::Block;
use crate::dem::grid::{Boundary, Grid};
use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::fem::quadrature::tensor_gauss;
use crate::fem::stress::{Stress, nodal_stress, stress_at};
use crate::space::Vec3;
use nalgebra::{Matrix3, Vector6};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// What is measured in each element.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Indicator {
    /// Largest principal stress over strength.
    Stress {
        /// Tensile strength, in Pa.
        #[serde(rename = "strength_Pa")]
        strength_pa: Option<f64>,
        /// Diameter over which the stress is averaged, in m.
        length_m: f64,
    },
    /// Recovery-based error estimate, relative to the error of an even share.
    Error,
}

/// What becomes of elements whose indicator falls again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Memory {
    /// Once chosen, always chosen.
    Irreversible,
    /// Chosen until the indicator falls below this value, lower than the trigger.
    Release(f64),
}

/// When elements are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Criterion {
    /// What is measured.
    pub indicator: Indicator,
    /// Elements with an indicator of at least this fire.
    pub trigger: f64,
    /// Elements closer than this to one that fired are chosen too, in m; those that share a node with it always.
    pub buffer_m: f64,
    /// What becomes of them later.
    pub memory: Memory,
}

impl Criterion {
    /// # Errors
    /// A stress criterion without strength; a trigger, length or buffer out of range; a release value above the trigger.
    pub fn check(&self) -> Result<()> {
        let refuse = |message: String| Err(Error::Switch { what: "criterion".to_owned(), message });
        if let Indicator::Stress { strength_pa, length_m } = self.indicator {
            let Some(strength) = strength_pa else {
                return refuse(
                    "it compares stress with a strength that is not given; set strength_Pa".to_owned(),
                );
            };
            if !(strength.is_finite() && strength > 0.0) {
                return refuse(format!("strength_Pa = {strength}; give a positive strength"));
            }
            if !(length_m.is_finite() && length_m >= 0.0) {
                return refuse(format!(
                    "length_m = {length_m}; give the length to average over, zero for none"
                ));
            }
        }
        if !(self.trigger.is_finite() && self.trigger > 0.0) {
            return refuse(format!(
                "trigger = {}; give a positive number, 0.4 to 0.7 for stress",
                self.trigger
            ));
        }
        if !(self.buffer_m.is_finite() && self.buffer_m >= 0.0) {
            return refuse(format!(
                "buffer_m = {}; give a length, zero for one ring of elements",
                self.buffer_m
            ));
        }
        match self.memory {
            Memory::Release(release) if !(0.0..self.trigger).contains(&release) => refuse(format!(
                "release = {release}; give a value from zero to below the trigger {}",
                self.trigger
            )),
            _ => Ok(()),
        }
    }

    /// The indicator of every element, `displacement` (m) over all degrees of freedom of the body.
    ///
    /// # Errors
    /// As [`Criterion::check`]; an inverted element.
    pub fn values(&self, body: &Continuum, displacement: &[f64]) -> Result<Vec<f64>> {
        self.check()?;
        match self.indicator {
            Indicator::Stress { strength_pa, length_m } => {
                let strength = strength_pa.unwrap_or(f64::INFINITY);
                let averaged = averaged_stress(body, displacement, length_m)?;
                Ok(averaged.into_iter().map(|stress| stress.largest() / strength).collect())
            }
            Indicator::Error => error_shares(body, displacement),
        }
    }

    /// The elements to choose now; `chosen` are those chosen before.
    ///
    /// # Errors
    /// As [`Criterion::values`].
    pub fn choose(
        &self,
        body: &Continuum,
        displacement: &[f64],
        chosen: &BTreeSet<usize>,
    ) -> Result<BTreeSet<usize>> {
        let values = self.values(body, displacement)?;
        let fired: Vec<usize> = (0..values.len()).filter(|&c| values[c] >= self.trigger).collect();
        let mut next = buffered(body, &fired, self.buffer_m);
        next.extend(chosen.iter().copied().filter(|&c| match self.memory {
            Memory::Irreversible => true,
            Memory::Release(release) => values.get(c).is_some_and(|v| *v >= release),
        }));
        Ok(next)
    }
}

/// Mean stress of the elements whose centre lies within half of `length` of each element's centre, weighted by their size.
fn averaged_stress(body: &Continuum, displacement: &[f64], length: f64) -> Result<Vec<Stress>> {
    let mesh = &body.mesh;
    let mut own = Vec::with_capacity(mesh.cell_count());
    for cell in 0..mesh.cell_count() {
        let stress = stress_at(body, displacement, cell, &[[0.0; 3]])?[0];
        own.push((centre(mesh, cell), measure(mesh, cell), Vector6::from(stress.voigt)));
    }
    if length == 0.0 {
        return Ok(own.into_iter().map(|(.., stress)| Stress { voigt: stress.into() }).collect());
    }
    // Centres at just this distance count, whatever their rounding.
    let radius = 0.5 * length * (1.0 + 1e-9);
    let centres: Vec<Vec3> = own.iter().map(|(x, ..)| *x).collect();
    let around = |pick: fn(&Vec3, &Vec3) -> Vec3| centres.iter().copied().reduce(|a, b| pick(&a, &b));
    let (Some(min), Some(max)) = (around(|a, b| a.inf(b)), around(|a, b| a.sup(b))) else {
        return Ok(Vec::new());
    };
    let grid = Grid::new(mesh.space, Block { min, max }, Boundary::Closed, &centres, radius);
    let mean = |x: &Vec3| {
        let (mut sum, mut weight) = (Vector6::zeros(), 0.0);
        grid.for_each_within(*x, radius, |near| {
            let (_, volume, stress) = &own[near.point];
            sum += stress * *volume;
            weight += volume;
        });
        Stress { voigt: (sum / weight).into() }
    };
    Ok(centres.iter().map(mean).collect())
}

/// `η_e / √((‖u‖² + ‖e‖²)/N)` of every element.
fn error_shares(body: &Continuum, displacement: &[f64]) -> Result<Vec<f64>> {
    let mesh = &body.mesh;
    let recovered = nodal_stress(body, displacement)?;
    let rule = tensor_gauss(mesh.space.dim(), 2);
    let points: Vec<[f64; 3]> = rule.iter().map(|p| p.0).collect();
    let (mut errors, mut energy) = (Vec::with_capacity(mesh.cell_count()), 0.0);
    for cell in 0..mesh.cell_count() {
        let stresses = stress_at(body, displacement, cell, &points)?;
        let mut error = 0.0;
        for ((xi, w), stress) in rule.iter().zip(&stresses) {
            let sample = mesh.sample(cell, *xi);
            let volume = w * sample.determinant * body.hypothesis.thickness();
            let smooth: Matrix3<f64> =
                mesh.cell(cell).iter().zip(sample.values).map(|(&n, v)| recovered[n].tensor() * v).sum();
            error += volume * complementary(body, &(smooth - stress.tensor()));
            energy += volume * complementary(body, &stress.tensor());
        }
        errors.push(error);
    }
    let even = (energy + errors.iter().sum::<f64>()) / errors.len().max(1) as f64;
    Ok(errors.into_iter().map(|e| if even > 0.0 { (e / even).sqrt() } else { 0.0 }).collect())
}

/// `σ:C⁻¹:σ = ((1+ν) σ:σ − ν (tr σ)²)/E`, in J/m³.
fn complementary(body: &Continuum, stress: &Matrix3<f64>) -> f64 {
    let nu = body.elasticity.poisson;
    ((1.0 + nu) * stress.norm_squared() - nu * stress.trace().powi(2)) / body.elasticity.young_pa
}

/// Cells whose bounding box comes within `distance` (m) of that of a fired cell, and those that share a node with one.
pub(crate) fn buffered(body: &Continuum, fired: &[usize], distance: f64) -> BTreeSet<usize> {
    let mesh = &body.mesh;
    let boxes: Vec<[Vec3; 2]> = (0..mesh.cell_count())
        .map(|c| {
            let nodes = mesh.cell(c).iter().map(|&n| mesh.nodes[n]);
            let empty = [Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)];
            nodes.fold(empty, |[low, high], x| [low.inf(&x), high.sup(&x)])
        })
        .collect();
    let nodes: BTreeSet<usize> = fired.iter().flat_map(|&c| mesh.cell(c).iter().copied()).collect();
    let gap = |a: usize, b: usize| {
        let apart = (boxes[a][0] - boxes[b][1]).sup(&(boxes[b][0] - boxes[a][1]));
        apart.sup(&Vec3::zeros()).norm()
    };
    // A buffer that ends on a line of the mesh does not reach over it by rounding.
    let reach = distance * (1.0 - 1e-9);
    let chosen = |&c: &usize| {
        mesh.cell(c).iter().any(|n| nodes.contains(n)) || fired.iter().any(|&f| gap(c, f) < reach)
    };
    (0..mesh.cell_count()).filter(chosen).collect()
}
