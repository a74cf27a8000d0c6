//! The probes of a scene at one moment: an equilibrium, or an output of a run.

use super::curve::{Curve, nan_max};
use super::field::Field;
use super::section;
use super::supports::Supports;
use crate::error::{Fault, Result};
use crate::file::SceneFile;
use crate::scene::probe::{Line, Probe, Read};
use seam_solver::space::{Space, Vec3};

/// What a probe gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    /// One number.
    Scalar(f64),
    /// A value along a line or over time.
    Curve(Curve),
}

/// A model in some state.
pub struct Moment<'a> {
    /// Its fields; `None` where no probe asks for them.
    pub field: Option<&'a Field<'a>>,
    /// Strain energy, in J.
    pub strain: f64,
    /// Forces of supports and ties on each unknown, in N and N m.
    pub reactions: &'a [f64],
    /// The supports, as they are in this model.
    pub supports: &'a Supports,
}

/// One probe at one moment.
pub struct Observer<'a> {
    /// The scene.
    pub file: &'a SceneFile,
    /// The moment.
    pub moment: &'a Moment<'a>,
    /// Name of the probe.
    pub name: &'a str,
    /// The probe.
    pub probe: &'a Probe,
}

impl Observer<'_> {
    /// Reads the probe.
    ///
    /// # Errors
    /// A place outside of all bodies, or an expression that cannot be evaluated.
    pub fn read(&self) -> Result<Reading> {
        match (self.probe.read, &self.probe.line) {
            (read, _) if read.is_error() => self.displacement_error().map(Reading::Scalar),
            (Read::SecantRotation, Some(line)) => self.secant(line).map(Reading::Curve),
            (_, Some(line)) => {
                let mut curve = Curve::default();
                for x in self.stations(line)? {
                    curve.x.push(x.x);
                    curve.y.push(self.value(x)?);
                }
                Ok(Reading::Curve(curve))
            }
            (_, None) => self.now().map(Reading::Scalar),
        }
    }

    /// The one number of a probe that is not read along a line.
    ///
    /// # Errors
    /// As [`Observer::read`].
    pub fn now(&self) -> Result<f64> {
        let reaction = |axis: usize| {
            let support = self.probe.support.as_deref().unwrap_or_default();
            self.moment.supports.reaction(support, axis, self.moment.reactions)
        };
        match (self.probe.read, &self.probe.point) {
            (Read::StrainEnergy, _) => Ok(self.moment.strain),
            (Read::ReactionX, _) => Ok(reaction(0)),
            (Read::ReactionY, _) => Ok(reaction(1)),
            (Read::ReactionZ, _) => Ok(reaction(2)),
            (_, Some(point)) => {
                let x = self.point(point, "point")?;
                self.value(x)
            }
            (_, None) => Err(self.error("the probe does not say where", "give `point` or `line`")),
        }
    }

    fn field(&self) -> Result<&Field<'_>> {
        self.moment.field.ok_or_else(|| self.error("there is no field to read", "give a `point` or `line`"))
    }

    fn space(&self) -> Space {
        self.file.scene.hypothesis.space()
    }

    fn error(&self, message: impl Into<String>, mend: &str) -> crate::error::Error {
        self.file.error(Fault::new(format!("probes.{}", self.name), message, mend))
    }

    fn point(&self, numbers: &[crate::scene::number::Number], part: &str) -> Result<Vec3> {
        let mut x = Vec3::zeros();
        for i in 0..self.space().dim().min(numbers.len()) {
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
        self.field()?.displacement(x).ok_or_else(|| {
            let [x, y, z] = [x.x, x.y, x.z];
            self.error(format!("({x}, {y}, {z}) lies in no body"), "move the probe into a body")
        })
    }

    fn value(&self, x: Vec3) -> Result<f64> {
        let stress = |component: usize| {
            let found = self.field()?.stress(x).map_err(|e| self.file.solver(e))?;
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
            Read::SectionRotation => section::rotation(self.field()?, x.x).ok_or_else(|| {
                self.error(format!("no section at x = {}", x.x), "move the line into the bodies")
            }),
            _ => Err(self.error("it is not read at a point", "give `line`, or neither")),
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
        let dim = self.space().dim();
        let (mut miss, mut size) = (0.0, 0.0);
        let rms = self.probe.read == Read::DisplacementErrorRms;
        let grow = |sum: f64, d: f64| if rms { sum.hypot(d) } else { nan_max(sum, d) };
        for part in &self.field()?.parts {
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
