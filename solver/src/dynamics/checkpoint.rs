//! Stopping an explicit run and going on later, bit by bit.
//!
//! The file: the line `MAGIC`, a hash of model and options, all numbers that change from step to step (64 bits each,
//! little-endian), and a hash of all that.

use super::explicit::{Explicit, Motion, Options};
use super::ledger::WorkDone;
use crate::error::{Error, Result};
use crate::files::write_atomically;
use crate::model::{Model, Numbering};
use crate::work::Work;
use nalgebra::{Quaternion, UnitQuaternion};
use std::fmt::Write;
use std::path::Path;

const MAGIC: &[u8] = b"seam checkpoint 1\n";
const HASH: usize = blake3::OUT_LEN;

/// Writes the state of a run of `model`.
///
/// # Errors
/// A file that cannot be written; a run that breaks bonds, whose laws are not kept in it.
pub fn write(path: &Path, model: &Model, run: &Explicit) -> Result<()> {
    if run.breaking().is_some() {
        let message = "a run that breaks bonds has no checkpoints; run it through".to_owned();
        return Err(Error::File { file: path.display().to_string(), line: None, message });
    }
    let Motion { start, step, u, v, done, initial } = &run.motion;
    let mut bytes = [MAGIC, &fingerprint(model, run.options())].concat();
    let mut put = |x: u64| bytes.extend(x.to_le_bytes());
    put(*step);
    counters(&run.work).into_iter().for_each(&mut put);
    let scalars = [*start, *initial, done.external, done.damping, done.interface];
    scalars.iter().chain(u).chain(v).for_each(|x| put(x.to_bits()));
    run.forces.orientations().flat_map(|q| q.coords.iter()).for_each(|x| put(x.to_bits()));
    bytes.extend(blake3::hash(&bytes).as_bytes());
    write_atomically(path, &bytes)
}

/// Reads a state and goes on from it.
///
/// # Errors
/// A file that cannot be read, is damaged, or belongs to another model or other options; whatever
/// [`Explicit::new`] refuses.
pub fn resume(path: &Path, model: &Model, options: Options) -> Result<Explicit> {
    let refuse = |message: &str| Error::File {
        file: path.display().to_string(),
        line: None,
        message: message.to_owned(),
    };
    let bytes = std::fs::read(path).map_err(|e| refuse(&format!("{e}; check the path")))?;
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        return Err(refuse("it is no checkpoint of this version of Seam"));
    };
    let damaged = || refuse("it is damaged; take an older one or start again");
    let (content, sum) = bytes.split_at_checked(bytes.len() - HASH.min(rest.len())).ok_or_else(damaged)?;
    if blake3::hash(content).as_bytes() != sum {
        return Err(damaged());
    }
    let (hash, numbers) = content[MAGIC.len()..].split_at_checked(HASH).ok_or_else(damaged)?;
    if hash != fingerprint(model, &options) {
        return Err(refuse(
            "it was written for another model or with other options; resume with those, or start again",
        ));
    }
    let mut numbers = numbers.as_chunks::<8>().0.iter().map(|b| u64::from_le_bytes(*b));
    let n = Numbering::new(model).len();
    let mut next = || numbers.next().ok_or_else(damaged);
    let step = next()?;
    let mut work = Work::default();
    for counter in counters_mut(&mut work) {
        *counter = next()?;
    }
    let mut number = || next().map(f64::from_bits);
    let [start, initial, external, damping, interface] =
        [number()?, number()?, number()?, number()?, number()?];
    let mut vector = || (0..n).map(|_| number()).collect::<Result<Vec<f64>>>();
    let (u, v) = (vector()?, vector()?);
    let done = WorkDone { external, damping, interface, ..WorkDone::default() };
    let mut run = Explicit::prepare(model, options, Motion { start, step, u, v, done, initial })?;
    run.work = work;
    let mut orientation = || -> Result<_> {
        let [i, j, k, w] = [number()?, number()?, number()?, number()?];
        Ok(UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)))
    };
    let all = (0..run.forces.orientations().count()).map(|_| orientation()).collect::<Result<_>>()?;
    run.forces.set_orientations(all);
    Ok(run)
}

/// Hash of every field of a model and of the options: their debug text gives each number exactly.
fn fingerprint(model: &Model, options: &Options) -> [u8; HASH] {
    struct Hashing(blake3::Hasher);
    impl Write for Hashing {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0.update(text.as_bytes());
            Ok(())
        }
    }
    let mut hashing = Hashing(blake3::Hasher::new());
    write!(hashing, "{model:?} {options:?}").expect("hashing does not fail");
    *hashing.0.finalize().as_bytes()
}

fn counters(work: &Work) -> [u64; 7] {
    let mut work = *work;
    counters_mut(&mut work).map(|c| *c)
}

fn counters_mut(work: &mut Work) -> [&mut u64; 7] {
    let Work {
        bond_updates,
        element_updates,
        factorisations,
        factor_nonzeros,
        solves,
        contact_checks,
        steps,
    } = work;
    [bond_updates, element_updates, factorisations, factor_nonzeros, solves, contact_checks, steps]
}
