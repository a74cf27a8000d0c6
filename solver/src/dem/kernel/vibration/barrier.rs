//! A barrier for threads that meet every few hundred microseconds.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Looks this often before giving the core away, where every thread has one: longer than the threads of a balanced step
/// differ, short if the machine is busy with other work.
const LOOKS: usize = 20_000;

/// All threads wait until the last one has come. `std::sync::Barrier` puts threads to sleep, which
/// takes longer than a step of a small network.
pub(super) struct Barrier {
    threads: usize,
    looks: usize,
    waiting: AtomicUsize,
    round: AtomicUsize,
}

impl Barrier {
    pub fn new(threads: usize) -> Self {
        // With more threads than cores, who looks keeps a core from the one that is waited for.
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let looks = if threads <= cores { LOOKS } else { 0 };
        Barrier { threads, looks, waiting: AtomicUsize::new(0), round: AtomicUsize::new(0) }
    }

    /// Returns when every thread has called it as often as this one.
    pub fn wait(&self) {
        let round = self.round.load(Ordering::Acquire);
        if self.waiting.fetch_add(1, Ordering::AcqRel) + 1 == self.threads {
            self.waiting.store(0, Ordering::Relaxed);
            self.round.store(round.wrapping_add(1), Ordering::Release);
            return;
        }
        let mut looks = 0;
        while self.round.load(Ordering::Acquire) == round {
            looks += 1;
            if looks < self.looks {
                std::hint::spin_loop();
            } else {
                std::thread::yield_now();
            }
        }
    }
}
