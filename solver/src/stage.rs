//! Where wall time goes: a clock that tells a few stages apart, off unless somebody measures.
//!
//! [`measured`] starts a clock on this thread, [`timed`] says which stage runs. Stages nest and each gets its own time only:
//! a factorisation inside the steps counts as factorisation. Calibration, packing and relaxation keep all that happens inside
//! them. Stages are entered once per run, factorisation or output, never inside a loop over bonds, and without a clock
//! entering one looks at a single flag.

use std::cell::RefCell;
use std::time::Instant;

/// What a run does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Placing and bonding particles.
    Packing,
    /// Finding the bonds that give a material.
    Calibration,
    /// Matrices, constraint rows and masses.
    Assembly,
    /// Sparse factors.
    Factorisation,
    /// Solves and time steps.
    Steps,
    /// Bringing new particles to equilibrium.
    Relaxation,
    /// Reading probes.
    Output,
}

/// All stages, in the order of a run, with their names.
pub const STAGES: [(Stage, &str); 7] = [
    (Stage::Packing, "packing"),
    (Stage::Calibration, "calibration"),
    (Stage::Assembly, "assembly"),
    (Stage::Factorisation, "factorisation"),
    (Stage::Steps, "steps"),
    (Stage::Relaxation, "relaxation"),
    (Stage::Output, "output"),
];

impl Stage {
    /// Whether what happens inside belongs to it, stages of its own included.
    fn keeps_all(self) -> bool {
        matches!(self, Stage::Packing | Stage::Calibration | Stage::Relaxation)
    }
}

/// Seconds of each stage, in the order of [`STAGES`].
pub type Seconds = [f64; STAGES.len()];

struct Clock {
    seconds: Seconds,
    stage: Option<Stage>,
    since: Instant,
}

thread_local! {
    static CLOCK: RefCell<Option<Clock>> = const { RefCell::new(None) };
}

impl Clock {
    /// Books the time since the last change, and goes on with another stage.
    fn change(&mut self, stage: Option<Stage>) {
        let now = Instant::now();
        if let Some(stage) = self.stage {
            self.seconds[stage as usize] += (now - self.since).as_secs_f64();
        }
        (self.stage, self.since) = (stage, now);
    }
}

/// Runs something with a clock of its own and gives the seconds of each stage; what no stage claims is in none of them.
pub fn measured<T>(run: impl FnOnce() -> T) -> (T, Seconds) {
    let fresh = Clock { seconds: Seconds::default(), stage: None, since: Instant::now() };
    let outer = CLOCK.replace(Some(fresh));
    let done = run();
    let own = CLOCK.replace(outer);
    (done, own.map_or(Seconds::default(), |clock| clock.seconds))
}

/// Runs something as a stage.
pub fn timed<T>(stage: Stage, run: impl FnOnce() -> T) -> T {
    let before = CLOCK.with_borrow_mut(|clock| {
        let clock = clock.as_mut().filter(|clock| !clock.stage.is_some_and(Stage::keeps_all))?;
        let before = clock.stage;
        clock.change(Some(stage));
        Some(before)
    });
    let done = run();
    if let Some(before) = before {
        CLOCK.with_borrow_mut(|clock| clock.iter_mut().for_each(|clock| clock.change(before)));
    }
    done
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread::sleep;
    use std::time::Duration;

    fn wait() {
        sleep(Duration::from_millis(2));
    }

    /// Sleeping takes at least its time, so the least of each stage is known.
    #[test]
    fn each_stage_gets_its_own_time_and_a_whole_one_keeps_all() {
        let ((), seconds) = measured(|| {
            timed(Stage::Steps, || timed(Stage::Factorisation, wait));
            timed(Stage::Calibration, || timed(Stage::Assembly, wait));
            wait();
        });
        let of = |stage: Stage| seconds[stage as usize];
        assert!(of(Stage::Factorisation) >= 0.002 && of(Stage::Calibration) >= 0.002, "{seconds:?}");
        assert!(of(Stage::Steps) < of(Stage::Factorisation), "{seconds:?}");
        assert_eq!([of(Stage::Assembly), of(Stage::Output)], [0.0, 0.0]);
    }

    #[test]
    fn a_clock_inside_another_leaves_it_its_time() {
        let (inner, outer) = measured(|| timed(Stage::Steps, || measured(|| timed(Stage::Output, wait)).1));
        assert!(inner[Stage::Output as usize] >= 0.002 && inner[Stage::Steps as usize] == 0.0, "{inner:?}");
        assert!(outer[Stage::Steps as usize] >= 0.002 && outer[Stage::Output as usize] == 0.0, "{outer:?}");
    }

    #[test]
    fn without_a_clock_nothing_is_measured() {
        assert_eq!(timed(Stage::Steps, || 7), 7);
        assert_eq!(measured(|| ()).1, Seconds::default());
    }
}
