//! Nested dissection by coordinates (George 1973): an elimination order for solid models.
//!
//! Points are halved at the median of their longest extent; those of one half that touch the
//! other are the separator and go last. Good where positions mirror the graph, as they do for
//! meshes and networks.

use super::sparse::SymmetricMatrix;
use crate::space::Vec3;

/// Sets of at most this many points are not cut further.
const LEAF: usize = 8;

/// Elimination order of the unknowns of `matrix`. `group[i]` is the point unknown `i` belongs to, `positions`
/// holds one position per point.
pub fn nested_dissection(matrix: &SymmetricMatrix, group: &[u32], positions: &[Vec3]) -> Vec<u32> {
    let graph = Graph::new(matrix, group, positions.len());
    let mut points: Vec<u32> = (0..positions.len() as u32).collect();
    let mut order = Vec::with_capacity(points.len());
    let mut side = vec![0u32; positions.len()];
    let mut stamp = 0;
    dissect(&graph, positions, &mut points, &mut side, &mut stamp, &mut order);
    let mut rank = vec![0u32; positions.len()];
    order.iter().enumerate().for_each(|(k, &p)| rank[p as usize] = k as u32);
    let mut unknowns: Vec<u32> = (0..group.len() as u32).collect();
    unknowns.sort_by_key(|&i| (rank[group[i as usize] as usize], i));
    unknowns
}

/// Moves constraint rows, numbered after the unknowns, behind the last of the unknowns in them; others keep their order.
pub fn rows_after_unknowns(order: &[u32], rows: &[Vec<(usize, f64)>]) -> Vec<u32> {
    let unknowns = order.len() - rows.len();
    let mut rank = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &i)| rank[i as usize] = k);
    let key = |&i: &u32| {
        let own = rank[i as usize];
        let last = (i as usize).checked_sub(unknowns).and_then(|k| rows[k].iter().map(|t| rank[t.0]).max());
        last.map_or((own, 0), |last| (last.max(own), own + 1))
    };
    let mut moved = order.to_vec();
    moved.sort_by_cached_key(key);
    moved
}

fn dissect(
    graph: &Graph,
    positions: &[Vec3],
    points: &mut [u32],
    side: &mut [u32],
    stamp: &mut u32,
    order: &mut Vec<u32>,
) {
    if points.len() <= LEAF {
        order.extend_from_slice(points);
        return;
    }
    let (mut lo, mut hi) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    for &p in points.iter() {
        lo = lo.inf(&positions[p as usize]);
        hi = hi.sup(&positions[p as usize]);
    }
    let axis = (hi - lo).imax();
    let middle = points.len() / 2;
    let key = |p: &u32| positions[*p as usize][axis];
    points.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
    let (left, right) = points.split_at_mut(middle);
    // Marks are unique per call, so that they need no clearing.
    *stamp += 1;
    let mark = *stamp;
    right.iter().for_each(|&p| side[p as usize] = mark);
    left.sort_unstable_by_key(|&p| (graph.neighbours(p).iter().any(|&q| side[q as usize] == mark), p));
    let inner = left.partition_point(|&p| !graph.neighbours(p).iter().any(|&q| side[q as usize] == mark));
    let (left, separator) = left.split_at_mut(inner);
    dissect(graph, positions, left, side, stamp, order);
    dissect(graph, positions, right, side, stamp, order);
    order.extend_from_slice(separator);
}

/// Which points share an entry of the matrix.
struct Graph {
    start: Vec<u32>,
    neighbours: Vec<u32>,
}

impl Graph {
    fn new(matrix: &SymmetricMatrix, group: &[u32], points: usize) -> Graph {
        let mut pairs: Vec<u64> = Vec::new();
        let mut last = (u32::MAX, u32::MAX);
        for (r, c, _) in matrix.entries() {
            let pair = (group[r], group[c]);
            if pair.0 != pair.1 && pair != last {
                last = pair;
                pairs.push((u64::from(pair.0) << 32) | u64::from(pair.1));
                pairs.push((u64::from(pair.1) << 32) | u64::from(pair.0));
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut start = vec![0u32; points + 1];
        pairs.iter().for_each(|pair| start[(pair >> 32) as usize + 1] += 1);
        for p in 0..points {
            start[p + 1] += start[p];
        }
        Graph { start, neighbours: pairs.iter().map(|&pair| pair as u32).collect() }
    }

    fn neighbours(&self, p: u32) -> &[u32] {
        &self.neighbours[self.start[p as usize] as usize..self.start[p as usize + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::super::sparse::{Factor, Triplets};
    use super::*;

    /// On a cube of 14³ points nested dissection needs less fill than the natural order.
    #[test]
    fn saves_fill_on_a_cube_and_is_a_permutation() {
        let n = 14;
        let index = |i: usize, j: usize, k: usize| (i * n + j) * n + k;
        let mut t = Triplets::default();
        let mut positions = Vec::new();
        for i in 0..n {
            for j in 0..n {
                for k in 0..n {
                    positions.push(Vec3::new(i as f64, j as f64, k as f64));
                    let p = index(i, j, k);
                    t.push(p, p, 6.5);
                    for (q, inside) in [(p + 1, k + 1 < n), (p + n, j + 1 < n), (p + n * n, i + 1 < n)] {
                        if inside {
                            t.push(q, p, -1.0);
                        }
                    }
                }
            }
        }
        let matrix = SymmetricMatrix::from_triplets(n * n * n, &t);
        let group: Vec<u32> = (0..(n * n * n) as u32).collect();
        let order = nested_dissection(&matrix, &group, &positions);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, group);
        let fill = |order: &[u32]| Factor::new(&matrix, order).expect("positive definite").nonzeros();
        let (dissected, natural) = (fill(&order), fill(&group));
        assert!(2 * dissected < natural, "{dissected} against {natural}");
    }
}
