//! Exact reflection of a harmonic wave where a fine chain meets a coarse one, each with its own time step.
//!
//! Chains of springs k and masses m under central differences; each ends with half a mass at the interface. For `e^{iωt}`
//! and `Ω = (2/Δt) sin(ωΔt/2)` a chain that only sends waves away, `u_i = μ^i u₀`, `μ + 1/μ = 2 − mΩ²/k`, `|μ| ≤ 1`, resists the
//! force on its end with `D = f/u₀ = k (1/μ − μ)/2`: that is `iΩZ`, `Z = √(km) √(1−(Ω/ω_c)²)`. Equal steps give
//! `R = (Z₁−Z₂)/(Z₁+Z₂)` (Celep & Bažant 1983).
//!
//! With M fine steps per coarse step the multiplier at fine step j of a coarse one is `Λ_j e^{iωΔT n}`. It drives the M
//! frequencies `ω + 2πp/ΔT` of the fine chain, and only that of p = 0 on the coarse one. What ties them is one row
//! (Prakash & Hjelmstad 2004) or M rows (Gravouil & Combescure 2001) on the velocities `v_n = (u_{n+1} − u_{n−1})/2Δt`.

use nalgebra::{Complex, DMatrix, DVector};
use seam_solver::dynamics::multirate::Method;
use std::f64::consts::{PI, TAU};

type C = Complex<f64>;
const I: C = C { re: 0.0, im: 1.0 };

/// Limiting absorption: a frequency this much (relatively) below the real axis tells waves that leave from those that come.
const ABSORPTION: f64 = 1e-11;

/// A chain of equal masses (kg) and springs (N/m), stepped by central differences of step (s).
#[derive(Debug, Clone, Copy)]
pub struct Lattice {
    /// k.
    pub spring: f64,
    /// m.
    pub mass: f64,
    /// Δt.
    pub step: f64,
}

impl Lattice {
    /// `Ω`.
    fn stepped(&self, omega: C) -> C {
        (omega * (0.5 * self.step)).sin() * (2.0 / self.step)
    }

    /// `D = f/u₀` of a wave that leaves.
    fn resistance(&self, omega: C) -> C {
        let omega2 = self.stepped(omega).powi(2);
        let half = C::from(1.0) - omega2 * (0.5 * self.mass / self.spring);
        let root = (half * half - 1.0).sqrt();
        let mu = [half + root, half - root].into_iter().min_by(|a, b| a.norm().total_cmp(&b.norm()));
        let mu = mu.unwrap_or(half);
        (C::from(1.0) / mu - mu) * (0.5 * self.spring)
    }

    /// `v/u` of a harmonic motion.
    fn rate(&self, omega: C) -> C {
        I * (omega * self.step).sin() / self.step
    }

    /// Wave number times spacing of a propagating wave, `sin(kh/2) = Ω/ω_c`; NaN above the cutoff.
    pub fn phase(&self, omega: f64) -> f64 {
        let stepped = 2.0 / self.step * (0.5 * omega * self.step).sin();
        2.0 * (0.5 * stepped * (self.mass / self.spring).sqrt()).asin()
    }
}

/// `|R|` on the fine side for the frequency ω (rad/s); the coarse step is a whole multiple of the fine one.
///
/// Forces: −λ on the fine end, λ on the coarse end. The fine end moves by `2 − Σ_p λ̂_p/D_p` for an incident wave of one.
pub fn reflection(fine: Lattice, coarse: Lattice, method: Method, omega: f64) -> f64 {
    let ratio = (coarse.step / fine.step).round() as usize;
    let m = ratio as f64;
    let omega = C::new(omega, -ABSORPTION * omega);
    let alias = |p: usize| omega + TAU * p as f64 / coarse.step;
    let turn = |angle: f64| (I * angle).exp();
    let mobility: Vec<C> = (0..ratio).map(|p| fine.rate(alias(p)) / fine.resistance(alias(p))).collect();
    // Velocity of the fine end at its step j due to a unit Λ_l, and λ̂_0 due to it.
    let phase = |j: usize| (I * omega * (fine.step * j as f64)).exp();
    let share = |l: usize| C::from(1.0 / m) / phase(l);
    let response = |j: usize, l: usize| -> C {
        let of = |p: usize| mobility[p] * turn(TAU * p as f64 * (j as f64 - l as f64) / m);
        -phase(j) * share(l) * (0..ratio).map(of).sum::<C>()
    };
    let free = |j: usize| phase(j) * fine.rate(omega) * 2.0;
    let coarse_mobility = coarse.rate(omega) / coarse.resistance(omega);
    let z = (I * omega * coarse.step).exp();
    let between = |j: usize| C::from(1.0 - j as f64 / m) + z * (j as f64 / m);
    let multipliers: Vec<C> = match method {
        // Λ_j = (1−j/M) λ + (j/M) z λ; velocities agree at j = 0.
        Method::PrakashHjelmstad => {
            let fine_mobility: C = (0..ratio).map(|l| response(0, l) * between(l)).sum();
            let lambda = free(0) / (coarse_mobility - fine_mobility);
            (0..ratio).map(|l| lambda * between(l)).collect()
        }
        // The coarse velocity without its link, cλ with c = ΔT/2 over half a mass, is interpolated; then each Λ_j adds its own.
        Method::GravouilCombescure => {
            let link = C::from(coarse.step / coarse.mass);
            let h = DMatrix::from_fn(ratio, ratio, |j, l| {
                let interpolated = if l == 0 { between(j) * (coarse_mobility - link) } else { C::from(0.0) };
                let own = if l == j { link } else { C::from(0.0) };
                interpolated + own - response(j, l)
            });
            let solved = h.lu().solve(&DVector::from_fn(ratio, |j, _| free(j)));
            solved.map_or_else(|| vec![C::from(f64::NAN); ratio], |x| x.as_slice().to_vec())
        }
    };
    let mean: C = (0..ratio).map(|l| multipliers[l] * share(l)).sum();
    (C::from(1.0) - mean / fine.resistance(omega)).norm()
}

/// `|R| = |(Z₁−Z₂)/(Z₁+Z₂)|` for equal steps; one above the coarse cutoff.
pub fn equal_steps(fine: Lattice, coarse: Lattice, omega: f64) -> f64 {
    let impedance = |side: Lattice| {
        let cutoff = 2.0 * (side.spring / side.mass).sqrt();
        let stepped = 2.0 / side.step * (0.5 * omega * side.step).sin();
        (side.spring * side.mass).sqrt() * (1.0 - (stepped / cutoff).powi(2)).max(0.0).sqrt()
    };
    let [a, b] = [fine, coarse].map(impedance);
    ((a - b) / (a + b)).abs()
}

/// Circular frequency of a wave of length λ at the speed c.
pub fn frequency(speed: f64, wavelength: f64) -> f64 {
    2.0 * PI * speed / wavelength
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(coarse_step: f64) -> [Lattice; 2] {
        [Lattice { spring: 1.0, mass: 1.0, step: 0.9 }, Lattice { spring: 0.5, mass: 2.0, step: coarse_step }]
    }

    /// The general scattering problem at ratio one is the closed form; known values to their last digit.
    #[test]
    fn equal_steps_give_the_closed_form() {
        let [fine, coarse] = pair(0.9);
        for (elements, known) in
            [(20.0, 0.00469), (10.0, 0.01959), (8.0, 0.0317), (6.0, 0.0609), (4.0, 0.182), (2.5, 1.0)]
        {
            let omega = frequency(1.0, 2.0 * elements);
            let closed = equal_steps(fine, coarse, omega);
            assert!((closed / known - 1.0).abs() < 3e-3, "{elements}: {closed}");
            for method in [Method::PrakashHjelmstad, Method::GravouilCombescure] {
                let solved = reflection(fine, coarse, method, omega);
                // Limiting absorption, over a small difference of impedances.
                assert!((solved / closed - 1.0).abs() < 1e-7, "{elements} {method:?}: {solved} {closed}");
            }
        }
    }
}
