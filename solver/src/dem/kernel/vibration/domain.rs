//! The share of one thread, and the team of all threads.

use super::super::record::Record;
use super::super::{Rows, sorted_pairs};
use super::barrier::Barrier;
use crate::dem::network::Network;
use crate::error::Result;
use std::ops::Range;
use std::sync::Mutex;

/// Particles of one thread and those it mirrors, in the order of the network.
struct Domain<R, const D: usize> {
    /// Where the own particles lie among the local ones.
    own: Range<usize>,
    /// Number in the network of each local particle.
    global: Vec<usize>,
    rows: Rows<R, D>,
    /// `1/m` and `1/J`.
    inverse: Vec<[f64; 2]>,
    u: Vec<[f64; D]>,
    v: Vec<[f64; D]>,
    f: Vec<[f64; D]>,
    /// Own particles that others mirror, by their local number: what this thread posts.
    outgoing: Vec<usize>,
    /// For each mirrored particle: local number, who posts it, and its place there.
    incoming: Vec<(usize, usize, usize)>,
}

/// What a thread posts: displacements of the particles that others mirror, for even and odd steps, so
/// that one barrier per step is enough.
type Post<const D: usize> = [Mutex<Vec<[f64; D]>>; 2];

/// All domains of a network.
pub(super) struct Team<R, const D: usize> {
    domains: Vec<Domain<R, D>>,
    count: usize,
}

impl<R: Record<D>, const D: usize> Domain<R, D> {
    /// `pairs`: bonds with an end in `own`, as `(lower, higher, bond)`, sorted.
    fn new(network: &Network, own: Range<usize>, pairs: &[(u32, u32, usize)]) -> Self {
        let mut global: Vec<usize> = own.clone().collect();
        global.extend(pairs.iter().flat_map(|p| [p.0 as usize, p.1 as usize]));
        global.sort_unstable();
        global.dedup();
        let local = |p: usize| global.partition_point(|&g| g < p);
        let renumbered: Vec<_> =
            pairs.iter().map(|&(i, j, b)| (local(i as usize) as u32, local(j as usize) as u32, b)).collect();
        let inverse = |&p: &usize| [1.0 / network.particles.mass[p], 1.0 / network.particles.inertia[p]];
        Domain {
            own: local(own.start)..local(own.end),
            rows: Rows::from_pairs(network, global.len(), &renumbered),
            inverse: global.iter().map(inverse).collect(),
            u: vec![[0.0; D]; global.len()],
            v: vec![[0.0; D]; global.len()],
            f: vec![[0.0; D]; global.len()],
            global,
            outgoing: Vec::new(),
            incoming: Vec::new(),
        }
    }

    /// One sweep: after its row the force on a particle is complete and nobody needs its old place any more, so
    /// that it moves at once.
    fn step(&mut self, dt: f64) {
        for i in 0..self.u.len() {
            let f = self.rows.row(i, &self.u, &mut self.f);
            self.f[i] = [0.0; D];
            if !self.own.contains(&i) {
                continue;
            }
            let [per_mass, per_inertia] = self.inverse[i];
            let (u, v) = (&mut self.u[i], &mut self.v[i]);
            for c in 0..D {
                v[c] -= dt * if c < R::DIM { per_mass } else { per_inertia } * f[c];
                u[c] += dt * v[c];
            }
        }
    }

    fn post(&self, to: &Mutex<Vec<[f64; D]>>) {
        let mut to = to.lock().expect("no thread panics while posting");
        to.clear();
        to.extend(self.outgoing.iter().map(|&p| self.u[p]));
    }

    fn collect(&mut self, posts: &[Post<D>], parity: usize) {
        // Sorted by who posts, so that each post is opened once.
        for from in self.incoming.chunk_by(|a, b| a.1 == b.1) {
            let post = posts[from[0].1][parity].lock().expect("no thread panics while posting");
            for &(p, _, place) in from {
                self.u[p] = post[place];
            }
        }
    }
}

impl<R: Record<D>, const D: usize> Team<R, D> {
    pub fn new(network: &Network, body: &str, threads: usize) -> Result<Self> {
        let count = network.particles.len();
        let all = sorted_pairs(network, body)?;
        let bounds: Vec<usize> = (0..=threads).map(|t| t * count / threads).collect();
        let mut domains: Vec<Domain<R, D>> = bounds
            .windows(2)
            .map(|w| {
                let own = w[0]..w[1];
                let mine =
                    |p: &&(u32, u32, usize)| own.contains(&(p.0 as usize)) || own.contains(&(p.1 as usize));
                let pairs: Vec<_> = all.iter().filter(mine).copied().collect();
                Domain::new(network, own, &pairs)
            })
            .collect();
        for d in 0..threads {
            let domain = &domains[d];
            let mirrored: Vec<(usize, usize)> = (0..domain.global.len())
                .filter(|local| !domain.own.contains(local))
                .map(|local| (local, domain.global[local]))
                .collect();
            for (local, global) in mirrored {
                let owner = bounds.partition_point(|&b| b <= global) - 1;
                let there = domains[owner].own.start + (global - bounds[owner]);
                // Two threads that mirror one particle each get a copy: rare, and places stay simple.
                domains[owner].outgoing.push(there);
                let place = domains[owner].outgoing.len() - 1;
                domains[d].incoming.push((local, owner, place));
            }
        }
        Ok(Team { domains, count })
    }

    pub fn set(&mut self, u: &[f64], v: &[f64]) {
        assert!(u.len() == self.count * D && v.len() == self.count * D, "one number per degree of freedom");
        let [u, v] = [u, v].map(|x| x.as_chunks::<D>().0);
        for domain in &mut self.domains {
            for (local, &global) in domain.global.iter().enumerate() {
                domain.u[local] = u[global];
                domain.v[local] = v[global];
            }
        }
    }

    pub fn get(&self) -> (Vec<f64>, Vec<f64>) {
        let own = |field: fn(&Domain<R, D>) -> &[[f64; D]]| {
            self.domains.iter().flat_map(|d| field(d)[d.own.clone()].as_flattened()).copied().collect()
        };
        (own(|d| &d.u), own(|d| &d.v))
    }

    pub fn advance(&mut self, dt: f64, steps: usize) {
        if let [domain] = &mut self.domains[..] {
            (0..steps).for_each(|_| domain.step(dt));
            return;
        }
        let barrier = Barrier::new(self.domains.len());
        let posts: Vec<Post<D>> = self.domains.iter().map(|_| Post::default()).collect();
        std::thread::scope(|scope| {
            for (d, domain) in self.domains.iter_mut().enumerate() {
                let (barrier, posts) = (&barrier, &posts);
                scope.spawn(move || {
                    for step in 0..steps {
                        domain.step(dt);
                        domain.post(&posts[d][step % 2]);
                        barrier.wait();
                        domain.collect(posts, step % 2);
                    }
                });
            }
        });
    }
}
