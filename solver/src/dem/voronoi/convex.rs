//! What a cell is cut from: a polygon in the plane, a polyhedron in the solid.

use crate::space::Vec3;

/// A convex body around the origin; behind each of its facets lies a `T`.
pub trait Convex<T>: Sized {
    /// The box between two corners (m); `behind(axis, end)` lies behind its faces, end 0 being the lower one.
    fn cuboid(low: Vec3, high: Vec3, behind: impl Fn(usize, usize) -> T) -> Self;

    /// Keeps `n·x ≤ d` for a unit vector `n`; `false` if nothing is left.
    fn cut(&mut self, n: Vec3, d: f64, behind: T) -> bool;

    /// Largest distance of a corner from the origin (m).
    fn reach(&self) -> f64;

    /// Area (m²) of a polygon, volume (m³) of a polyhedron.
    fn measure(&self) -> f64;

    /// What lies behind each facet, with its length (m) or area (m²).
    fn facets(&self) -> impl Iterator<Item = (T, f64)>;
}
