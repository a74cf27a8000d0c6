//! The probes of a scene on a solution.

use super::curve::{Curve, nan_max};
use super::field::Field;
use super::section;
use crate::error::{Fault, Result};
use crate::file::SceneFile;
use crate::scene::probe::{Line, Probe, Read};
use seam_solver::model::Model;
use seam_solver::solve::statics::Solution;
use seam_solver::space::Vec3;
use std::collections::BTreeMap;

/// What a probe gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// One number.
    Scalar(f64),
    /// A value along a line.
    Curve(Curve),
}

/// Reads every probe of the scene.
///
/// # Errors
/// A probe outside of all bodies, or an expression that cannot be evaluated.
pub fn read(file: &SceneFile, model: &Model, solution: &Solution) -> Result<BTreeMap<String, Reading>> {
    let field = Field::new(model, solution);
    let mut readings = BTreeMap::new();
    for (name, probe) in &file.scene.probes {
        let observer = Observer { file, field: &field, solution, name, probe };
        readings.insert(name.clone(), observer.read()?);
    }
    Ok(readings)
}

struct Observer<'a> {
    file: &'a SceneFile,
    field: &'a Field<'a>,
    solution: &'a Solution,
    name: &'a str,
    probe: &'a Probe,
}

impl Observer<'_> {
    fn read(&self) -> Result<Reading> {
        match (self.probe.read, &self.probe.point, &self.probe.line) {
            (Read::StrainEnergy, ..) => Ok(Reading::Scalar(self.solution.energy)),
            (read, ..) if read.is_error() => self.displacement_error().map(Reading::Scalar),
            (_, Some(point), _) => {
                let x = self.point(point, "point")?;
                self.value(x).map(Reading::Scalar)
            }
            (Read::SecantRotation, _, Some(line)) => self.secant(line).map(Reading::Curve),
            (_, _, Some(line)) => {
                let mut curve = Curve::default();
                for x in self.stations(line)? {
                    curve.x.push(x.x);
                    curve.y.push(self.value(x)?);
                }
                Ok(Reading::Curve(curve))
            }
            (_, None, None) => Err(self.error("the probe does not say where", "give `point` or `line`")),
        }
    }

    fn error(&self, message: impl Into<String>, mend: &str) -> crate::error::Error {
        self.file.error(Fault::new(format!("probes.{}", self.name), message, mend))
    }

    fn point(&self, numbers: &[crate::scene::number::Number], part: &str) -> Result<Vec3> {
        let mut x = Vec3::zeros();
        for i in 0..self.field.space.dim().min(numbers.len()) {
            let key = format!("probes.{}.{part}[{i}]", self.name);
            x[i] = numbers[i].value(&self.file.values, &key).map_err(|fault| self.file.error(fault))?;
        }
        Ok(x)
    }

    fn stations(&self, line: &Line) -> Result<Vec<Vec3>> {
        let (from, to) = (self.point(&line.from, "line.from")?, self.point(&line.to, "line.to")?);
        let n = line.intervals;
        Ok((0..=n).map(|k| from + (to - from) * (k as f64 / n as f64)).collect())
    }

    fn displacement(&self, x: Vec3) -> Result<Vec3> {
        self.field.displacement(x).ok_or_else(|| {
            let [x, y, z] = [x.x, x.y, x.z];
            self.error(format!("({x}, {y}, {z}) lies in no body"), "move the probe into a body")
        })
    }

    fn value(&self, x: Vec3) -> Result<f64> {
        let stress = |component: usize| {
            let found = self.field.stress(x).map_err(|e| self.file.solver(e))?;
            found.map(|stress| stress.voigt[component]).ok_or_else(|| {
                self.error("the point lies in no finite element", "read stress inside finite elements")
            })
        };
        match self.probe.read {
            Read::Ux => Ok(self.displacement(x)?.x),
            Read::Uy => Ok(self.displacement(x)?.y),
            Read::Uz => Ok(self.displacement(x)?.z),
            Read::Sxx => stress(0),
            Read::Syy => stress(1),
            Read::Sxy => stress(3),
            Read::SectionRotation => section::rotation(self.field, x.x).ok_or_else(|| {
                self.error(format!("no section at x = {}", x.x), "move the line into the bodies")
            }),
            Read::SecantRotation
            | Read::DisplacementError
            | Read::DisplacementErrorRms
            | Read::StrainEnergy => Err(self.error("it is not read at a point", "give `line`, or neither")),
        }
    }

    /// `Δu_⊥/Δs` between neighbouring stations, given half-way; `⊥` is to the left of the line in the x–y plane.
    fn secant(&self, line: &Line) -> Result<Curve> {
        let stations = self.stations(line)?;
        let displacements = stations.iter().map(|&x| self.displacement(x)).collect::<Result<Vec<_>>>()?;
        let mut curve = Curve::default();
        for (x, u) in stations.windows(2).zip(displacements.windows(2)) {
            let step = x[1] - x[0];
            let length = step.norm();
            if length == 0.0 {
                return Err(self.error("the line has no length", "give two different points"));
            }
            let across = Vec3::z().cross(&step) / length;
            curve.x.push(0.5 * (x[0].x + x[1].x));
            curve.y.push((u[1] - u[0]).dot(&across) / length);
        }
        Ok(curve)
    }

    /// Distance from the exact displacement over all nodes and particles, as a share of it: in the largest value or
    /// in the root of the sum of squares.
    fn displacement_error(&self) -> Result<f64> {
        let dim = self.field.space.dim();
        let (mut miss, mut size) = (0.0, 0.0);
        let rms = self.probe.read == Read::DisplacementErrorRms;
        let grow = |sum: f64, d: f64| if rms { sum.hypot(d) } else { nan_max(sum, d) };
        for part in &self.field.parts {
            for (&x, u) in part.part.positions().iter().zip(&part.displacement) {
                let mut exact = Vec3::zeros();
                for c in 0..dim {
                    let key = format!("probes.{}.exact[{c}]", self.name);
                    let number = &self.probe.exact[c];
                    exact[c] =
                        number.at(x, &self.file.values, &key).map_err(|fault| self.file.error(fault))?;
                }
                miss = grow(miss, (u - exact).norm());
                size = grow(size, exact.norm());
            }
        }
        if size == 0.0 {
            return Err(
                self.error("the exact displacement is zero everywhere", "give a field to compare with")
            );
        }
        Ok(miss / size)
    }
}
