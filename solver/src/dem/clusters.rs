//! Which particles hang together.

/// Disjoint sets of particles, each known by its smallest member.
#[derive(Debug, Clone)]
pub struct Clusters {
    parent: Vec<usize>,
}

impl Clusters {
    /// Every one of `n` particles alone.
    pub fn new(n: usize) -> Self {
        Self { parent: (0..n).collect() }
    }

    /// Clusters of `n` particles with the given bonds.
    pub fn of(n: usize, ends: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let mut clusters = Self::new(n);
        for [i, j] in ends {
            clusters.join(i, j);
        }
        clusters
    }

    /// The smallest member of a particle's cluster.
    pub fn root(&mut self, mut p: usize) -> usize {
        while self.parent[p] != p {
            self.parent[p] = self.parent[self.parent[p]];
            p = self.parent[p];
        }
        p
    }

    /// Makes one cluster of two; `false` if they were one.
    pub fn join(&mut self, i: usize, j: usize) -> bool {
        let (a, b) = (self.root(i), self.root(j));
        self.parent[a.max(b)] = a.min(b);
        a != b
    }

    /// Members of the largest cluster of two or more; of equally large ones the first. Empty if there is none.
    pub fn largest(&mut self) -> Vec<usize> {
        let root: Vec<usize> = (0..self.parent.len()).map(|p| self.root(p)).collect();
        let mut size = vec![0usize; root.len()];
        root.iter().for_each(|&r| size[r] += 1);
        let most = size.iter().copied().max().unwrap_or(0);
        let first = size.iter().position(|&s| s == most && s > 1);
        (0..root.len()).filter(|&p| Some(root[p]) == first).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonds_join_clusters() {
        let mut clusters = Clusters::of(7, [[5, 4], [2, 6], [4, 6]]);
        assert_eq!(clusters.largest(), [2, 4, 5, 6]);
        assert_eq!(clusters.root(5), 2);
        assert!(!clusters.join(2, 5));
        assert!(clusters.join(0, 1));
        assert!(Clusters::new(3).largest().is_empty());
    }
}
