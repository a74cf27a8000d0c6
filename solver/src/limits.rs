//! What this machine can do, measured on the spot: what a speed is judged by.
//!
//! Arithmetic is that of this crate as it is compiled, and so is the memory traffic. Each is the best of some repetitions:
//! a limit is what is left when nobody disturbs.

use std::hint::black_box;
use std::time::Instant;

const REPETITIONS: usize = 10;

/// Bytes per second of `a ← b + s c` on `threads` threads, with arrays far larger than the caches (McCalpin 1995, "triad").
pub fn bandwidth(threads: usize) -> f64 {
    const N: usize = 8_000_000;
    let (mut a, b, c) = (vec![0.0; N], vec![1.0; N], vec![2.0; N]);
    let part = N.div_ceil(threads.max(1));
    let seconds = best(|s| {
        std::thread::scope(|scope| {
            for (a, (b, c)) in a.chunks_mut(part).zip(b.chunks(part).zip(c.chunks(part))) {
                scope.spawn(move || {
                    a.iter_mut().zip(b.iter().zip(c)).for_each(|(a, (b, c))| *a = b + s * c);
                });
            }
        });
        black_box(&a);
    });
    24.0 * N as f64 / seconds
}

/// Products and sums per second of `threads` threads: on each, many independent chains `x ← x a + b`.
pub fn arithmetic(threads: usize) -> f64 {
    const ROUNDS: usize = 2_000_000;
    const CHAINS: usize = 24;
    let chains = || {
        let (mut x, a, b) = (black_box([1.0f64; CHAINS]), black_box(0.5), black_box(0.25));
        for _ in 0..ROUNDS {
            x.iter_mut().for_each(|x| *x = *x * a + b);
        }
        black_box(x);
    };
    let threads = threads.max(1);
    let seconds = best(|_| {
        std::thread::scope(|scope| {
            // This thread takes part: starting one costs nothing where one is enough.
            (1..threads).for_each(|_| drop(scope.spawn(chains)));
            chains();
        });
    });
    (2 * CHAINS * ROUNDS * threads) as f64 / seconds
}

/// Shortest time, in s; `run` is given the number of the repetition.
fn best(mut run: impl FnMut(f64)) -> f64 {
    let time = |round: usize| {
        let start = Instant::now();
        run(round as f64);
        start.elapsed().as_secs_f64()
    };
    (0..REPETITIONS).map(time).fold(f64::INFINITY, f64::min)
}
