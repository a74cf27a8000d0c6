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
    /// `m_i = t_i × ∂U/∂t_i = ρ (c_i G_i − (t_i·G_i) e) − ρ' (G_i·b_i) b_i`.
    #[inline(always)]
    pub fn loads(&self, stretch: Vec3, turned: [Turned; 2]) -> Loads {
        let d = self.n * self.length + stretch;
        let length = d.norm();
        let e = d / length;
        let t = turned.map(|(_, frame)| frame * self.n);
        let b = t.map(|t| e.cross(&t));
        let c = t.map(|t| e.dot(&t));
        let [(rho1, slope1), (rho2, slope2)] = c.map(swing);
        let beta = [b[0] * rho1, b[1] * rho2];
        let bend = |i: usize, rho: f64, slope: f64| {
            let g = beta[i] * self.sum + beta[1 - i] * self.difference;
            (g * c[i] - e * t[i].dot(&g)) * rho - b[i] * (slope * g.dot(&b[i]))
        };
        let m = [bend(0, rho1, slope1), bend(1, rho2, slope2)];
        let axial = e * (self.kn * (length - self.length));
        let shear = e.cross(&(m[0] + m[1])) / length;
        let (tau, gradient) = self.twist(turned, t[0]);
        let twist = gradient * (self.kt * tau);
        Loads { force: axial + shear, moments: [m[0] - twist, m[1] + twist] }
    }

    /// `τ` and its gradient with respect to `φ₂ − φ₁`. With `p = Q₁* Q₂ = (w, v)`, `s = v·n`: `τ = 2 atan(s/w)`;
    /// in fixed axes, `P = Q₁ v`, `t = Q₁ n`: `∂τ/∂φ = (w² t + w P × t + s P)/(w² + s²)`.
    #[inline(always)]
    fn twist(&self, [(q1, frame1), (q2, _)]: [Turned; 2], t: Vec3) -> (f64, Vec3) {
        let (a, b) = (q1.as_vector(), q2.as_vector());
        let (a_v, b_v) = (Vec3::new(a.x, a.y, a.z), Vec3::new(b.x, b.y, b.z));
        let w = a.w * b.w + a_v.dot(&b_v);
        let v = b_v * a.w - a_v * b.w - a_v.cross(&b_v);
        let s = v.dot(&self.n);
        let p = frame1 * v;
        let tau = 2.0 * arc_tangent(s, w);
        (tau, (t * (w * w) + p.cross(&t) * w + p * s) / (w * w + s * s))
    }

    /// Energy at the same deformation, in J.
    pub fn energy(&self, stretch: Vec3, turned: [Turned; 2]) -> f64 {
        let d = self.n * self.length + stretch;
        let length = d.norm();
        let e = d / length;
        let t = turned.map(|(_, frame)| frame * self.n);
        let [b1, b2] = t.map(|t| e.cross(&t) * swing(e.dot(&t)).0);
        let (tau, _) = self.twist(turned, t[0]);
        // ½ (S + k_b)(β₁² + β₂²) + (S − k_b) β₁·β₂.
        0.5 * self.kn * (length - self.length).powi(2)
            + 0.5 * self.kt * tau * tau
            + 0.5 * self.sum * (b1.norm_squared() + b2.norm_squared())
            + self.difference * b1.dot(&b2)
    }
}

/// `atan(s/w)` in (−π/2, π/2): quaternions of either sign are the same rotation.
#[inline(always)]
fn arc_tangent(s: f64, w: f64) -> f64 {
    let x = s / w;
    if x.abs() < SMALL_TWIST {
        // x − x³/3 + … : the next term, x¹³/13, is below rounding.
        let x2 = x * x;
        x * (1.0 + x2 * (-1.0 / 3.0 + x2 * (0.2 + x2 * (-1.0 / 7.0 + x2 * (1.0 / 9.0 - x2 / 11.0)))))
    } else {
        x.atan()
    }
}
