//! Damping as an option.

use super::system::System;
use crate::error::{Error, Result};

/// How motion is damped.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Damping {
    /// Not at all.
    #[default]
    None,
    /// `−α M v`: a mode of circular frequency ω gets the ratio `α/2ω`.
    MassProportional {
        /// α, in 1/s.
        rate: f64,
    },
    /// `−α |F| sign(v)` on every unknown, `F` the unbalanced force: Cundall's local non-viscous damping
    /// (Cundall 1987), which vanishes in equilibrium. `F` includes the forces of the ties.
    NonViscous {
        /// α, dimensionless, below one.
        share: f64,
    },
}

impl Damping {
    /// Checks the coefficient.
    ///
    /// # Errors
    /// A negative or infinite rate; a share outside [0, 1).
    pub fn check(&self) -> Result<()> {
        let (name, value, good, mend) = match *self {
            Damping::None => return Ok(()),
            Damping::MassProportional { rate } => {
                ("rate", rate, rate.is_finite() && rate >= 0.0, "give a finite rate, zero or positive")
            }
            Damping::NonViscous { share } => {
                ("share", share, (0.0..1.0).contains(&share), "give a share from 0 to below 1")
            }
        };
        if good { Ok(()) } else { Err(Error::Material { what: "damping".to_owned(), name, value, mend }) }
    }

    /// Factor on the critical step. Where the local damping opposes a motion that `F` opposes too, it adds up to `α F`:
    /// stiffness grows by at most `1 + α`, frequency by its root. The viscous force is taken at `t_n` and costs nothing.
    pub(crate) fn step_factor(&self) -> f64 {
        match self {
            Damping::NonViscous { share } => 1.0 / (1.0 + share).sqrt(),
            _ => 1.0,
        }
    }

    /// Rate α of mass-proportional damping, in 1/s.
    pub(crate) fn rate(&self) -> f64 {
        match self {
            Damping::MassProportional { rate } => *rate,
            _ => 0.0,
        }
    }

    /// Local non-viscous forces (N, N m), written into `drag`, where the unbalanced forces took `before` to `after` in `dt`;
    /// `None` for other kinds.
    pub(super) fn drag<'a>(
        &self,
        dt: f64,
        (before, after): (&[f64], &[f64]),
        system: &System,
        drag: &'a mut Vec<f64>,
    ) -> Option<&'a [f64]> {
        let Damping::NonViscous { share } = self else { return None };
        let drag_of = |i: usize| {
            let unbalanced = system.mass[i] * (after[i] - before[i]) / dt;
            let v = before[i] + after[i];
            // sign(0) = 0: a body at rest is not pushed.
            let sign = if v == 0.0 { 0.0 } else { v.signum() };
            if system.is_prescribed(i) { 0.0 } else { -share * unbalanced.abs() * sign }
        };
        drag.clear();
        drag.extend((0..before.len()).map(drag_of));
        Some(drag)
    }

    /// Power of the damping forces on the velocities `w`, in W; `drag` as returned by [`Damping::drag`], the viscous
    /// force acting on the mean of `before` and `after`.
    pub(super) fn power(
        &self,
        drag: Option<&[f64]>,
        before: &[f64],
        after: &[f64],
        w: &[f64],
        system: &System,
    ) -> f64 {
        match self {
            Damping::None => 0.0,
            Damping::MassProportional { rate } => {
                let force = |i: usize| -0.5 * rate * system.mass[i] * (before[i] + after[i]);
                (0..w.len()).filter(|&i| !system.is_prescribed(i)).map(|i| force(i) * w[i]).sum()
            }
            Damping::NonViscous { .. } => drag.into_iter().flatten().zip(w).map(|(d, w)| d * w).sum(),
        }
    }
}
