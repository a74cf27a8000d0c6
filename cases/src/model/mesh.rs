//! Finite-element bodies.

use super::{Context, Refusal};
use crate::error::Fault;
use crate::scene::body::{Body, NotchedBeam};
use crate::scene::check_notched_beam;
use crate::scene::fe::{self, Fe};
use crate::scene::number::Number;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::mesh::Mesh;
use seam_solver::fem::notched_beam::Through;
use seam_solver::fem::refined::Refinement;
use seam_solver::fem::structured::{elliptic_sector, even, graded, grid, jiggle, quadrilateral};
use seam_solver::space::Space;
use std::f64::consts::FRAC_PI_2;

/// The body, meshed.
pub fn continuum(context: &Context, name: &str, body: &Body) -> Result<Continuum, Refusal> {
    // `check` has made sure of the section.
    let Some(fe) = &body.fe else {
        return Err(Fault::new(format!("bodies.{name}"), "the section `fe` is missing", "add it").into());
    };
    let mut mesh = mesh(context, name, body, fe)?;
    if let Some(distortion) = &fe.distortion {
        let key = format!("bodies.{name}.fe.distortion.amplitude");
        jiggle(&mut mesh, distortion.amplitude.value(context.values, &key)?, distortion.seed);
    }
    let continuum = Continuum {
        name: name.to_owned(),
        mesh,
        elasticity: context.elasticity(body)?,
        hypothesis: context.hypothesis,
        formulation: fe.formulation.into(),
    };
    continuum.check()?;
    Ok(continuum)
}

fn mesh(context: &Context, name: &str, body: &Body, fe: &Fe) -> Result<Mesh, Refusal> {
    let key = format!("bodies.{name}");
    if let Some(path) = &body.gmsh {
        return Ok(seam_solver::fem::gmsh::read_gmsh(&context.file.folder.file(path)?)?);
    }
    if let Some(beam) = &body.notched_beam {
        return notched(context, &key, beam, fe);
    }
    let lines = |axis: usize, low: f64, high: f64| -> Result<Vec<f64>, Refusal> {
        let n = fe.divisions[axis].count(context.values, 1, &format!("{key}.fe.divisions[{axis}]"))?;
        let ratio = match fe.grading.get(axis) {
            Some(number) => number.value(context.values, &format!("{key}.fe.grading[{axis}]"))?,
            None => 1.0,
        };
        Ok(graded(low, high, n, ratio)?)
    };
    if let Some(shape) = &body.quadrilateral {
        let mut corners = [Default::default(); 4];
        for (i, corner) in corners.iter_mut().enumerate() {
            *corner = context.vector(&shape.corners[i], &format!("{key}.quadrilateral.corners[{i}]"))?;
        }
        return Ok(quadrilateral(corners, &lines(0, 0.0, 1.0)?, &lines(1, 0.0, 1.0)?)?);
    }
    if let Some(shape) = &body.sector {
        let axes = |numbers, part: &str| context.vector(numbers, &format!("{key}.sector.{part}"));
        let (inner, outer) = (axes(&shape.inner, "inner")?, axes(&shape.outer, "outer")?);
        let (s, t) = (lines(0, 0.0, 1.0)?, lines(1, 0.0, FRAC_PI_2)?);
        return Ok(elliptic_sector([inner.x, inner.y], [outer.x, outer.y], &s, &t)?);
    }
    let Some(shape) = &body.cuboid else {
        return Err(Fault::new(key, "the shape is missing", "give a box").into());
    };
    let min = context.vector(&shape.min, &format!("{key}.box.min"))?;
    let max = context.vector(&shape.max, &format!("{key}.box.max"))?;
    let axes = (0..context.space.dim()).map(|i| lines(i, min[i], max[i])).collect::<Result<Vec<_>, _>>()?;
    Ok(grid(&axes)?)
}

fn notched(context: &Context, key: &str, beam: &NotchedBeam, fe: &Fe) -> Result<Mesh, Refusal> {
    let shape = check_notched_beam::shape(beam, context.values, key)?;
    // `check` has made sure of it.
    let Some(refinement) = &fe.refinement else {
        return Err(Fault::new(format!("{key}.fe"), "the refinement is missing", "add it").into());
    };
    let key = |name: &str| format!("{key}.fe.refinement.{name}");
    let number = |number: &Number, name: &str| number.value(context.values, &key(name));
    let by = Refinement {
        finest: number(&refinement.finest_m, "finest_m")?,
        growth: number(&refinement.growth, "growth")?,
        coarsest: number(&refinement.coarsest_m, "coarsest_m")?,
    };
    let lines = |numbers: &[Number], name: &str| {
        numbers.iter().map(|n| number(n, name)).collect::<Result<Vec<f64>, Fault>>()
    };
    let z = match context.space {
        Space::Plane => Vec::new(),
        Space::Solid => {
            let layers = refinement.layers.count(context.values, 1, &key("layers"))?;
            even(0.0, context.scene.thickness_m.value(context.values, "thickness_m")?, layers)?
        }
    };
    let through = Through {
        x: lines(&refinement.through_x_m, "through_x_m")?,
        y: lines(&refinement.through_y_m, "through_y_m")?,
        z,
    };
    Ok(shape.mesh(by, &through)?.mesh)
}

impl From<fe::Formulation> for Formulation {
    fn from(formulation: fe::Formulation) -> Self {
        match formulation {
            fe::Formulation::Plain => Self::Plain,
            fe::Formulation::Incompatible => Self::Incompatible,
            fe::Formulation::BBar => Self::BBar,
        }
    }
}
