//! A convex polygon around the origin, cut by half-planes.

use super::convex::Convex;
use crate::space::Vec3;

/// A corner, and what lies behind the side from it to the next one, counter-clockwise.
#[derive(Debug, Clone, Copy)]
struct Corner<T> {
    x: [f64; 2],
    behind: T,
}

/// A convex polygon; a cut is a half-plane seen from the origin.
#[derive(Debug, Clone)]
pub struct Polygon<T> {
    corners: Vec<Corner<T>>,
    /// What a cut leaves, before it takes the place of `corners`.
    kept: Vec<Corner<T>>,
    /// Corners closer than this to a cutting line count as lying on it.
    on_line: f64,
}

impl<T: Copy> Convex<T> for Polygon<T> {
    fn cuboid(low: Vec3, high: Vec3, behind: impl Fn(usize, usize) -> T) -> Self {
        let corners = vec![
            Corner { x: [low.x, low.y], behind: behind(1, 0) },
            Corner { x: [high.x, low.y], behind: behind(0, 1) },
            Corner { x: [high.x, high.y], behind: behind(1, 1) },
            Corner { x: [low.x, high.y], behind: behind(0, 0) },
        ];
        // Rounding of a cut is some 1e-16 of the size; lattices have many lines through one corner.
        Polygon { corners, kept: Vec::new(), on_line: 1e-12 * (high.xy() - low.xy()).norm() }
    }

    fn cut(&mut self, n: Vec3, d: f64, behind: T) -> bool {
        let side = |x: [f64; 2]| n.x * x[0] + n.y * x[1] - d;
        let outside = |s: f64| s > self.on_line;
        if !self.corners.iter().any(|c| outside(side(c.x))) {
            return true;
        }
        self.kept.clear();
        for (k, a) in self.corners.iter().enumerate() {
            let b = &self.corners[(k + 1) % self.corners.len()];
            let (of_a, of_b) = (side(a.x), side(b.x));
            let crossing = || {
                let t = of_a / (of_a - of_b);
                [a.x[0] + t * (b.x[0] - a.x[0]), a.x[1] + t * (b.x[1] - a.x[1])]
            };
            match (outside(of_a), outside(of_b)) {
                (false, false) => self.kept.push(*a),
                // The new side begins where the old one leaves: at the corner itself if it lies on the line.
                (false, true) if of_a >= -self.on_line => self.kept.push(Corner { x: a.x, behind }),
                (false, true) => self.kept.extend([*a, Corner { x: crossing(), behind }]),
                (true, false) if of_b < -self.on_line => {
                    self.kept.push(Corner { x: crossing(), behind: a.behind });
                }
                (true, _) => {}
            }
        }
        std::mem::swap(&mut self.corners, &mut self.kept);
        self.corners.len() >= 3
    }

    fn reach(&self) -> f64 {
        self.corners.iter().map(|c| c.x[0] * c.x[0] + c.x[1] * c.x[1]).fold(0.0, f64::max).sqrt()
    }

    /// Area, as the sum of the triangles over the sides from the origin, wherever it is: areas have signs.
    fn measure(&self) -> f64 {
        self.sides().map(|(a, b)| 0.5 * (a.x[0] * b.x[1] - a.x[1] * b.x[0])).sum()
    }

    fn facets(&self) -> impl Iterator<Item = (T, f64)> {
        self.sides().map(|(a, b)| (a.behind, (b.x[0] - a.x[0]).hypot(b.x[1] - a.x[1])))
    }
}

impl<T> Polygon<T> {
    fn sides(&self) -> impl Iterator<Item = (&Corner<T>, &Corner<T>)> {
        self.corners.iter().zip(self.corners.iter().cycle().skip(1))
    }
}
