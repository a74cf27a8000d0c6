//! Ties, supports and loads.

use super::place::{self, part_of};
use super::{Context, Refusal};
use crate::error::Fault;
use crate::scene::connection::{Load, Multipliers, TieMethod};
use crate::scene::number::Number;
use seam_solver::coupling::{self, Tie};
use seam_solver::fem::loads::facet_loads;
use seam_solver::model::{Part, PointValue};
use seam_solver::space::{Space, Vec3};

/// The ties of the scene.
pub fn ties(context: &Context) -> Result<Vec<Tie>, Refusal> {
    let side = |face: &str| {
        let (body, boundary) = face.split_once('.').unwrap_or((face, ""));
        (part_of(context, body), boundary.to_owned())
    };
    let tie = |(name, tie): (&String, &crate::scene::connection::Tie)| Tie {
        name: name.clone(),
        first: side(&tie.faces[0]),
        second: side(&tie.faces[1]),
        method: method(tie.method),
        multipliers: multipliers(tie.multipliers),
        rotations: tie.rotations,
    };
    Ok(context.scene.ties.iter().map(tie).collect())
}

/// The solver's name of a tie's method.
pub fn method(method: TieMethod) -> coupling::Method {
    match method {
        TieMethod::Pointwise => coupling::Method::Pointwise,
        TieMethod::Mortar => coupling::Method::Mortar,
    }
}

/// The solver's name of the side that carries the multipliers.
pub fn multipliers(side: Multipliers) -> coupling::Multipliers {
    match side {
        Multipliers::Auto => coupling::Multipliers::Auto,
        Multipliers::First => coupling::Multipliers::First,
        Multipliers::Second => coupling::Multipliers::Second,
    }
}

/// Component of a support among the unknowns of a point; `None` where the space or part has none.
fn component(space: Space, part: &Part, index: usize) -> Option<usize> {
    if index < 3 {
        return (index < space.dim()).then_some(index);
    }
    let rotation = space.rotation_axes().iter().position(|&axis| axis == index - 3)?;
    matches!(part, Part::Discrete { .. }).then_some(space.dim() + rotation)
}

/// Prescribed displacements and rotations, with the names of their supports. `uz` in the plane and rotations of nodes do not exist and
/// are passed over, so that a scene can change its space or method.
pub fn supports(context: &Context, parts: &[Part]) -> Result<Vec<(String, PointValue)>, Refusal> {
    let mut supports = Vec::new();
    for (name, support) in &context.scene.supports {
        let place = place::find(context, parts, &support.on, &format!("supports.{name}.on"))?;
        let part = &parts[place.part];
        for (index, (key, number)) in support.components().into_iter().enumerate() {
            let (Some(number), Some(component)) = (number, component(context.space, part, index)) else {
                continue;
            };
            for &point in &place.points {
                let key = format!("supports.{name}.{key}");
                let value = number.at(part.positions()[point], context.values, &key)?;
                supports.push((name.clone(), PointValue { part: place.part, point, component, value }));
            }
        }
    }
    Ok(supports)
}

/// Forces.
pub fn loads(context: &Context, parts: &[Part]) -> Result<Vec<PointValue>, Refusal> {
    let mut loads = Vec::new();
    for (name, load) in &context.scene.loads {
        let key = format!("loads.{name}");
        let place = place::find(context, parts, &load.on, &format!("{key}.on"))?;
        let forces = match (&parts[place.part], &place.boundary) {
            (Part::Continuum(body), Some(boundary)) => {
                let facets = &body.mesh.boundaries[boundary];
                let traction = traction(context, parts, &place, load, &key)?;
                facet_loads(body, facets, traction)?
            }
            (part, _) => in_shares(context, part, &place.points, load, &key)?,
        };
        let dim = context.space.dim();
        let per = if matches!(parts[place.part], Part::Continuum(_)) {
            dim
        } else {
            parts[place.part].dofs_per_point()
        };
        loads.extend(forces.into_iter().map(|(dof, value)| PointValue {
            part: place.part,
            point: dof / per,
            component: dof % per,
            value,
        }));
    }
    Ok(loads)
}

type Traction<'a> = Box<dyn Fn(Vec3, Vec3) -> Vec3 + 'a>;

/// The traction of a load on a boundary of elements: the given field, or the resultant over the area.
fn traction<'a>(
    context: &'a Context,
    parts: &[Part],
    place: &place::Place,
    load: &'a Load,
    key: &str,
) -> Result<Traction<'a>, Refusal> {
    if let Some(total) = &load.total_n {
        let total = context.vector(total, &format!("{key}.total_N"))?;
        let (Part::Continuum(body), Some(boundary)) = (&parts[place.part], &place.boundary) else {
            return Ok(Box::new(move |_, _| total));
        };
        // A unit traction along x adds up to the area.
        let unit = facet_loads(body, &body.mesh.boundaries[boundary], |_, _| Vec3::x())?;
        let area: f64 = unit.iter().map(|(_, force)| force).sum();
        return Ok(Box::new(move |_, _| total / area));
    }
    let field: &'a [Number] = load.traction_pa.as_deref().unwrap_or(&[]);
    for (i, number) in field.iter().enumerate().take(context.space.dim()) {
        // One trial shows unknown names with their place; a bad value at some point becomes NaN,
        // which the load refuses.
        for name in number.names() {
            if !["x", "y", "z"].contains(&name) && !context.values.contains_key(name) {
                number.at(Vec3::zeros(), context.values, &format!("{key}.traction_Pa[{i}]"))?;
            }
        }
    }
    let dim = context.space.dim();
    Ok(Box::new(move |x, _| {
        let mut t = Vec3::zeros();
        for i in 0..dim.min(field.len()) {
            t[i] = field[i].at(x, context.values, "").unwrap_or(f64::NAN);
        }
        t
    }))
}

/// A resultant over loose points, in equal shares: `(dof, force)`.
fn in_shares(
    context: &Context,
    part: &Part,
    points: &[usize],
    load: &Load,
    key: &str,
) -> Result<Vec<(usize, f64)>, Refusal> {
    let Some(total) = &load.total_n else {
        let mend = "give total_N, or load a boundary of finite elements";
        return Err(Fault::new(
            format!("{key}.traction_Pa"),
            "a traction needs the facets of elements",
            mend,
        )
        .into());
    };
    let share = context.vector(total, &format!("{key}.total_N"))? / points.len() as f64;
    let per = part.dofs_per_point();
    Ok(points
        .iter()
        .flat_map(|&point| (0..context.space.dim()).map(move |c| (point * per + c, share[c])))
        .collect())
}
