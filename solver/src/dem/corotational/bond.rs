//! One bond: energy and its gradient.
//!
//! `β_i = ρ_i e × t_i` is `e × p_i`, `p_i = ρ_i s_i`, with the part of `t_i` across the chord, `s_i = t_i − c_i e`, `c_i = e·t_i`.
//! With `g_i = (S + k_b) p_i + (S − k_b) p_j`, `a_i = ρ_i c_i g_i − ρ_i' (g_i·s_i) s_i`, `κ = (S − k_b) e·(p₁ × p₂)` and the torque
//! `T = k_t τ (t₁ + t₂)/(1 + t₁·t₂)`:
//!
//! `f₂ = k_n (L − L₀) e − (a₁ + a₂)/L`; `m₁ = e × a₁ + κ e − T`, `m₂ = e × a₂ − κ e + T`.

use super::swing::{self, swing};
use crate::dem::network::BondStiffness;
use crate::space::Vec3;

/// Below this ratio the arc tangent of the half twist is a series: no call to the library.
const SMALL_TWIST: f64 = 0.03;

/// Reference chord and stiffnesses, weight included.
#[derive(Debug, Clone, Copy, PartialEq)]
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

/// How the functions of the angles are evaluated.
pub(super) trait Angles {
    /// `ρ` and `dρ/dc` of `c = cos α`.
    fn swing(c: f64) -> (f64, f64);
    /// `atan x` in (−π/2, π/2): quaternions of either sign are the same rotation.
    fn arc_tangent(x: f64) -> f64;
}

/// Short series without a branch: several bonds at once.
pub(super) struct Small;
/// Any angle.
pub(super) struct Any;

impl Angles for Small {
    #[inline(always)]
    fn swing(c: f64) -> (f64, f64) {
        swing::near(1.0 - c)
    }

    #[inline(always)]
    fn arc_tangent(x: f64) -> f64 {
        // x − x³/3 + … : the next term, x¹³/13, is below rounding. Products, since quotients are slow.
        let x2 = x * x;
        let tail = -1.0 / 7.0 + x2 * (1.0 / 9.0 - x2 * (1.0 / 11.0));
        x * (1.0 + x2 * (-1.0 / 3.0 + x2 * (0.2 + x2 * tail)))
    }
}

impl Angles for Any {
    fn swing(c: f64) -> (f64, f64) {
        swing(c)
    }

    fn arc_tangent(x: f64) -> f64 {
        if x.abs() < SMALL_TWIST { Small::arc_tangent(x) } else { x.atan() }
    }
}

/// Internal force on the higher particle (the lower one has its opposite) and the moments on both.
pub(super) struct Loads {
    pub force: Vec3,
    pub moments: [Vec3; 2],
    /// Above one the angles are too large for [`Small`].
    pub reach: f64,
}

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

    /// All of it as numbers.
    #[inline(always)]
    pub fn to_numbers(self) -> [f64; 8] {
        [self.n.x, self.n.y, self.n.z, self.length, self.kn, self.kt, self.sum, self.difference]
    }

    #[inline(always)]
    pub fn from_numbers([x, y, z, length, kn, kt, sum, difference]: [f64; 8]) -> Self {
        FiniteBond { n: Vec3::new(x, y, z), length, kn, kt, sum, difference }
    }

    /// Reference length, in m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// `stretch` is `u₂ − u₁`; `turned` holds the quaternions `i, j, k, w` of both particles.
    #[inline(always)]
    pub fn loads<A: Angles>(&self, stretch: Vec3, turned: [[f64; 4]; 2]) -> Loads {
        let d = self.n * self.length + stretch;
        let length = d.norm();
        let inverse = 1.0 / length;
        let e = d * inverse;
        // Written out: `map` is not inlined into a loop over lanes.
        let (t1, t2) = (direction(turned[0], &self.n), direction(turned[1], &self.n));
        let (end1, end2) = (End::new::<A>(&e, &t1), End::new::<A>(&e, &t2));
        let a1 = end1.across(end1.p * self.sum + end2.p * self.difference);
        let a2 = end2.across(end2.p * self.sum + end1.p * self.difference);
        let kappa = self.difference * e.dot(&end1.p.cross(&end2.p));
        let x = self.half_twist(turned);
        let torque = self.kt * (2.0 * A::arc_tangent(x)) / (1.0 + t1.dot(&t2));
        let along = (t1 + t2) * torque - e * kappa;
        let most = f64::max(1.0 - end1.c, 1.0 - end2.c);
        Loads {
            force: e * (self.kn * (length - self.length)) - (a1 + a2) * inverse,
            moments: [e.cross(&a1) - along, e.cross(&a2) + along],
            reach: f64::max(most * (1.0 / swing::NEAR), x.abs() * (1.0 / SMALL_TWIST)),
        }
    }

    /// `tan(τ/2) = P·n / w` with `Q₁* Q₂ = (w, P)`. The gradient of τ with respect to `φ₂ − φ₁`, in fixed axes, is
    /// `(t₁ + t₂)/(1 + t₁·t₂)`.
    #[inline(always)]
    fn half_twist(&self, [q1, q2]: [[f64; 4]; 2]) -> f64 {
        let (v1, v2) = (vector(q1), vector(q2));
        let w = v1.dot(&v2) + q1[3] * q2[3];
        (q1[3] * v2.dot(&self.n) - q2[3] * v1.dot(&self.n) + v2.dot(&v1.cross(&self.n))) / w
    }

    /// Energy at the same deformation, in J.
    pub fn energy(&self, stretch: Vec3, turned: [[f64; 4]; 2]) -> f64 {
        let d = self.n * self.length + stretch;
        let length = d.norm();
        let [p1, p2] = turned.map(|q| End::new::<Any>(&(d / length), &direction(q, &self.n)).p);
        let tau = 2.0 * Any::arc_tangent(self.half_twist(turned));
        // ½ (S + k_b)(β₁² + β₂²) + (S − k_b) β₁·β₂.
        0.5 * self.kn * (length - self.length).powi(2)
            + 0.5 * self.kt * tau * tau
            + 0.5 * self.sum * (p1.norm_squared() + p2.norm_squared())
            + self.difference * p1.dot(&p2)
    }
}

#[inline(always)]
fn vector([x, y, z, _]: [f64; 4]) -> Vec3 {
    Vec3::new(x, y, z)
}

/// `Q n = (2w² − 1) n + 2 (v·n) v + 2w v × n`.
#[inline(always)]
fn direction(q: [f64; 4], n: &Vec3) -> Vec3 {
    let (v, w2) = (vector(q), 2.0 * q[3]);
    n * (w2 * q[3] - 1.0) + v * (2.0 * v.dot(n)) + v.cross(n) * w2
}

/// Swing of the chord `e` onto the direction `t` of one end.
struct End {
    c: f64,
    s: Vec3,
    rho: f64,
    slope: f64,
    p: Vec3,
}

impl End {
    #[inline(always)]
    fn new<A: Angles>(e: &Vec3, t: &Vec3) -> Self {
        let c = e.dot(t);
        let s = t - e * c;
        let (rho, slope) = A::swing(c);
        End { c, s, rho, slope, p: s * rho }
    }

    /// `a = ρ c g − ρ' (g·s) s`.
    #[inline(always)]
    fn across(&self, g: Vec3) -> Vec3 {
        g * (self.rho * self.c) - self.s * (self.slope * g.dot(&self.s))
    }
}
