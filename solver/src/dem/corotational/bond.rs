//! One bond: energy and its gradient.

use super::swing::swing;
use crate::dem::network::BondStiffness;
use crate::space::Vec3;
use nalgebra::{Matrix3, UnitQuaternion};

/// Below this ratio the arc tangent of the half twist is a series: no call to the library.
const SMALL_TWIST: f64 = 0.03;

/// Reference chord and stiffnesses, weight included.
#[derive(Debug, Clone, Copy)]
pub(super) struct FiniteBond {
    /// Reference direction, lower to higher particle.
    n: Vec3,
    length: f64,
    kn: f64,
    kt: f64,
    /// `S + k_b` and `S − k_b`: `∂U/∂β_i = (S + k_b) β_i + (S − k_b) β_j`.
    sum: f64,
    difference: f64,
}

/// Internal force on the higher particle (the lower one has its opposite) and the moments on both.
pub(super) struct Loads {
    pub force: Vec3,
    pub moments: [Vec3; 2],
}

type Turned<'a> = (&'a UnitQuaternion<f64>, &'a Matrix3<f64>);

impl FiniteBond {
    pub fn new(d: Vec3, k: BondStiffness, weight: f64) -> Self {
        let length = d.norm();
        let shear = 0.25 * k.ks * weight * length * length;
        let kb = k.kb * weight;
        FiniteBond {
            n: d / length,
            length,
            kn: k.kn * weight,
            kt: k.kt * weight,
            sum: shear + kb,
            difference: shear - kb,
        }
    }

    /// Reference length, in m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// `stretch` is `u₂ − u₁`.
    ///
    /// With `G_i = ∂U/∂β_i`, `b_i = e × t_i`, `β_i = ρ(c_i) b_i`, `c_i = e·t_i`:
    /// the moments are `m_i = t_i × ∂U/∂t_i` ([`End::moment`]).
    #[inline(always)]
    pub fn loads(&self, stretch: Vec3, turned: [Turned; 2]) -> Loads {
        let d = self.n * self.length + stretch;
        let length = d.norm();
        let inverse = 1.0 / length;
        let e = d * inverse;
        // Both ends written out, and products with d rather than e: they need not wait for the root.
        let (t1, t2) = (turned[0].1 * self.n, turned[1].1 * self.n);
        let (end1, end2) = (End::new(&d, inverse, &t1), End::new(&d, inverse, &t2));
        let m1 = end1.moment(&e, &t1, end1.beta * self.sum + end2.beta * self.difference);
        let m2 = end2.moment(&e, &t2, end2.beta * self.sum + end1.beta * self.difference);
        let axial = e * (self.kn * (length - self.length));
        let shear = e.cross(&(m1 + m2)) * inverse;
        let (tau, gradient) = self.twist(turned, t1);
        let twist = gradient * (self.kt * tau);
        Loads { force: axial + shear, moments: [m1 - twist, m2 + twist] }
    }

    /// `τ` and its gradient with respect to `φ₂ − φ₁`, in fixed axes. With `Q₂ Q₁* = (w, P)`, `s = P·t`, `t = Q₁ n`:
    /// `τ = 2 atan x`, `x = s/w`; `∂τ/∂φ = (t + (P/w) × t + x P/w)/(1 + x²)`.
    #[inline(always)]
    fn twist(&self, [(q1, _), (q2, _)]: [Turned; 2], t: Vec3) -> (f64, Vec3) {
        let (a, b) = (q1.as_vector(), q2.as_vector());
        let (a_v, b_v) = (Vec3::new(a.x, a.y, a.z), Vec3::new(b.x, b.y, b.z));
        let w = a.w * b.w + a_v.dot(&b_v);
        let p = (b_v * a.w - a_v * b.w + a_v.cross(&b_v)) * (1.0 / w);
        let x = p.dot(&t);
        (2.0 * arc_tangent(x), (t + p.cross(&t) + p * x) * (1.0 / (1.0 + x * x)))
    }

    /// Energy at the same deformation, in J.
    pub fn energy(&self, stretch: Vec3, turned: [Turned; 2]) -> f64 {
        let d = self.n * self.length + stretch;
        let length = d.norm();
        let t = turned.map(|(_, frame)| frame * self.n);
        let [b1, b2] = t.map(|t| End::new(&d, 1.0 / length, &t).beta);
        let (tau, _) = self.twist(turned, t[0]);
        // ½ (S + k_b)(β₁² + β₂²) + (S − k_b) β₁·β₂.
        0.5 * self.kn * (length - self.length).powi(2)
            + 0.5 * self.kt * tau * tau
            + 0.5 * self.sum * (b1.norm_squared() + b2.norm_squared())
            + self.difference * b1.dot(&b2)
    }
}

/// Swing of the chord `e = d/L` onto the direction `t` of one end.
struct End {
    /// `b = e × t`.
    b: Vec3,
    /// `c = e·t`.
    c: f64,
    rho: f64,
    slope: f64,
    /// `β = ρ b`.
    beta: Vec3,
}

impl End {
    #[inline(always)]
    fn new(d: &Vec3, inverse: f64, t: &Vec3) -> Self {
        let (b, c) = (d.cross(t) * inverse, d.dot(t) * inverse);
        let (rho, slope) = swing(c);
        End { b, c, rho, slope, beta: b * rho }
    }

    /// `m = ρ (c G − (t·G) e) − ρ' (G·b) b`.
    #[inline(always)]
    fn moment(&self, e: &Vec3, t: &Vec3, g: Vec3) -> Vec3 {
        (g * self.c - e * t.dot(&g)) * self.rho - self.b * (self.slope * g.dot(&self.b))
    }
}

/// `atan x` in (−π/2, π/2): quaternions of either sign are the same rotation.
#[inline(always)]
fn arc_tangent(x: f64) -> f64 {
    if x.abs() < SMALL_TWIST {
        // x − x³/3 + … : the next term, x¹³/13, is below rounding.
        let x2 = x * x;
        x * (1.0 + x2 * (-1.0 / 3.0 + x2 * (0.2 + x2 * (-1.0 / 7.0 + x2 * (1.0 / 9.0 - x2 / 11.0)))))
    } else {
        x.atan()
    }
}
