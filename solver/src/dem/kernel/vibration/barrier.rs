//! A barrier for threads that meet every few hundred microseconds.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Looks this often before giving the core away: longer than the threads of a balanced step differ, short if the
/// machine is busy with other work.
const LOOKS: usize = 20_000;

/// All threads wait until the last one has come.
pub(super) enum Barrier {
    /// Each thread has a core: it looks, since falling asleep takes longer than a step of a small network.
    Looking(Looking),
    /// There are more threads than cores: who looks keeps a core from the one that is waited for.
    Sleeping(std::sync::Barrier),
}

impl Barrier {
    pub fn new(threads: usize) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        match threads <= cores {
            true => {
                Self::Looking(Looking { threads, waiting: AtomicUsize::new(0), round: AtomicUsize::new(0) })
            }
            false => Self::Sleeping(std::sync::Barrier::new(threads)),
        }
    }

    /// Returns when every thread has called it as often as this one.
    pub fn wait(&self) {
        match self {
            Self::Looking(barrier) => barrier.wait(),
            Self::Sleeping(barrier) => {
                barrier.wait();
            }
        }
    }
}

/// Counts who has come, and in which round.
pub(super) struct Looking {
    threads: usize,
    waiting: AtomicUsize,
    round: AtomicUsize,
}

impl Looking {
    fn wait(&self) {
        let round = self.round.load(Ordering::Acquire);
        if self.waiting.fetch_add(1, Ordering::AcqRel) + 1 == self.threads {
            self.waiting.store(0, Ordering::Relaxed);
            self.round.store(round.wrapping_add(1), Ordering::Release);
            return;
        }
        let mut looks = 0;
        while self.round.load(Ordering::Acquire) == round {
            looks += 1;
            if looks < LOOKS {
                std::hint::spin_loop();
            } else {
                std::thread::yield_now();
            }
        }
    }
}
