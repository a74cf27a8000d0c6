//! What a run needs to go on later, as bytes that tell whose they are and whether they are whole.
//!
//! The bytes: the line `MAGIC`, the state with every bit of every number (the format of the crate postcard), and a hash of
//! all that.

use crate::error::{Error, Result};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fmt::{Debug, Write};

const MAGIC: &[u8] = b"seam checkpoint 3\n";
const HASH: usize = blake3::OUT_LEN;

/// Hash of the debug text of something, which gives each of its numbers exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fingerprint([u8; HASH]);

impl Fingerprint {
    /// Of one thing, or of a tuple of several.
    pub fn of(what: &dyn Debug) -> Self {
        struct Hashing(blake3::Hasher);
        impl Write for Hashing {
            fn write_str(&mut self, text: &str) -> std::fmt::Result {
                self.0.update(text.as_bytes());
                Ok(())
            }
        }
        let mut hashing = Hashing(blake3::Hasher::new());
        write!(hashing, "{what:?}").expect("hashing does not fail");
        Fingerprint(*hashing.0.finalize().as_bytes())
    }
}

/// A state between its mark and its hash.
pub fn seal(state: &impl Serialize) -> Vec<u8> {
    let mut bytes = [MAGIC, &to_bytes(state)].concat();
    bytes.extend(blake3::hash(&bytes).as_bytes());
    bytes
}

/// The state in bytes of [`seal`].
///
/// # Errors
/// Bytes that are no checkpoint of this version, or not as they were written.
pub fn open<T: DeserializeOwned>(bytes: &[u8]) -> Result<T> {
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        return Err(refuse("it is no checkpoint of this version of Seam; start again"));
    };
    let (content, sum) = bytes.split_at(bytes.len() - HASH.min(rest.len()));
    if blake3::hash(content).as_bytes() != sum {
        return Err(refuse(DAMAGED));
    }
    from_bytes(&content[MAGIC.len()..])
}

const DAMAGED: &str = "it is damaged; take an older one or start again";

/// The refusal of a checkpoint.
pub(crate) fn refuse(message: &str) -> Error {
    Error::Checkpoint { message: message.to_owned() }
}

/// A part of a state.
pub(crate) fn to_bytes(part: &impl Serialize) -> Vec<u8> {
    postcard::to_stdvec(part).expect("numbers, texts and lists of them can always be written")
}

/// A part of a state.
///
/// # Errors
/// Bytes of something else, which may also show in what is left over.
pub(crate) fn from_bytes<T: DeserializeOwned>(bytes: &[u8]) -> Result<T> {
    match postcard::take_from_bytes(bytes) {
        Ok((part, [])) => Ok(part),
        _ => Err(refuse(DAMAGED)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_comes_back_and_every_damage_shows() {
        let state = (vec![0.1, -0.0, f64::NAN, f64::INFINITY, 5e-324], "middle".to_owned(), usize::MAX);
        let sealed = seal(&state);
        let (numbers, text, count): (Vec<f64>, String, usize) = open(&sealed).unwrap();
        let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((bits(&numbers), text, count), (bits(&state.0), state.1, state.2));
        let refusal = |bytes: &[u8]| open::<(Vec<f64>, String, usize)>(bytes).unwrap_err().to_string();
        for at in MAGIC.len()..sealed.len() {
            let mut broken = sealed.clone();
            broken[at] ^= 1;
            assert!(refusal(&broken).contains("damaged"), "{at}");
            assert!(refusal(&sealed[..at]).contains("damaged"), "{at}");
        }
        assert!(refusal(b"").contains("no checkpoint"));
        assert!(refusal(&seal(&1.0)).contains("damaged"), "a whole checkpoint of something else");
    }

    #[test]
    fn the_last_bit_tells_two_things_apart() {
        let of = |x: f64| Fingerprint::of(&vec![x]);
        assert_eq!(of(0.1), of(0.1));
        assert_ne!(of(0.1), of(0.1f64.next_up()));
    }
}
