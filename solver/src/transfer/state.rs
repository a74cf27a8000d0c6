//! The state after a switch: copied where bodies stay, interpolated where particles came.

use super::fields::{self, Mode, PointMotion};
use super::momentum::{Momentum, rigid_velocity};
use super::substitution::{Origin, Switch};
use crate::dynamics::State;
use crate::dynamics::semidiscrete::lumped;
use crate::error::Result;
use crate::model::{Model, Numbering, Part};
use crate::space::{Space, Vec3};

/// The state on the unknowns of the new model.
pub(super) fn map_state(
    model: &Model,
    state: &State,
    new: &Model,
    origins: &[Origin],
    switch: &Switch,
    discrete: usize,
) -> Result<State> {
    let (old_numbering, numbering) = (Numbering::new(model), Numbering::new(new));
    let mut mapped = State { time: state.time, ..State::at_rest(numbering.len()) };
    for (p, (part, origin)) in new.parts.iter().zip(origins).enumerate() {
        for point in 0..part.positions().len() {
            let (old_part, old_point) = match origin {
                Origin::Kept(old) => (*old, point),
                Origin::Piece { part, nodes } => (*part, nodes[point]),
                Origin::Filled => continue,
            };
            for c in 0..part.dofs_per_point() {
                let (i, j) = (numbering.unknown(p, point, c), old_numbering.unknown(old_part, old_point, c));
                (mapped.u[i], mapped.v[i], mapped.a[i]) = (state.u[j], state.v[j], state.a[j]);
            }
        }
    }
    fill_state(model, state, new, &mut mapped, switch, discrete)?;
    Ok(mapped)
}

/// Writes the motion of the elements that go into the particles, and gives back the momentum that interpolation lost.
fn fill_state(
    model: &Model,
    state: &State,
    new: &Model,
    mapped: &mut State,
    switch: &Switch,
    discrete: usize,
) -> Result<()> {
    let (Part::Continuum(body), Part::Discrete { network, .. }) =
        (&model.parts[switch.part], &new.parts[discrete])
    else {
        return Ok(());
    };
    let first = Numbering::new(model).offset(switch.part);
    let own = |field: &'_ [f64]| field[first..first + body.dof_count()].to_vec();
    let (u, v, a) = (own(&state.u), own(&state.v), own(&state.a));
    let positions = &network.particles.position;
    let numbering = Numbering::new(new);
    let motions = fields::at_points(body, [&u, &v, &a], positions, switch.finite)?;
    for (particle, motion) in motions.iter().enumerate() {
        write(new.space, &numbering, mapped, (discrete, particle), motion, switch.mode);
    }
    if switch.mode < Mode::Velocity {
        return Ok(());
    }
    let (old_mass, mass) = (lumped(model, &Numbering::new(model))?, lumped(new, &numbering)?);
    let wanted = Momentum::of(model, &old_mass, &state.v);
    // The second pass removes the rounding of the first.
    for _ in 0..2 {
        let missing = wanted - Momentum::of(new, &mass, &mapped.v);
        let (c, omega, centre) = rigid_velocity(new.space, &network.particles, missing);
        for (particle, x) in positions.iter().enumerate() {
            let v = c + omega.cross(&(x - centre));
            add_velocity(new.space, &numbering, &mut mapped.v, (discrete, particle), v, omega);
        }
    }
    Ok(())
}

fn write(
    space: Space,
    numbering: &Numbering,
    state: &mut State,
    (part, particle): (usize, usize),
    motion: &PointMotion,
    mode: Mode,
) {
    let dim = space.dim();
    for c in 0..dim {
        let i = numbering.unknown(part, particle, c);
        state.u[i] = motion.u[c];
        if mode >= Mode::Velocity {
            (state.v[i], state.a[i]) = (motion.v[c], motion.a[c]);
        }
    }
    for (k, &axis) in space.rotation_axes().iter().enumerate() {
        let i = numbering.unknown(part, particle, dim + k);
        if mode >= Mode::Rotation {
            state.u[i] = motion.theta[axis];
        }
        if mode >= Mode::Velocity {
            (state.v[i], state.a[i]) = (motion.spin[axis], motion.alpha[axis]);
        }
    }
}

fn add_velocity(
    space: Space,
    numbering: &Numbering,
    velocities: &mut [f64],
    (part, particle): (usize, usize),
    v: Vec3,
    spin: Vec3,
) {
    let dim = space.dim();
    (0..dim).for_each(|c| velocities[numbering.unknown(part, particle, c)] += v[c]);
    for (k, &axis) in space.rotation_axes().iter().enumerate() {
        velocities[numbering.unknown(part, particle, dim + k)] += spin[axis];
    }
}
