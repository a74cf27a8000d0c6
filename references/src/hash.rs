//! Fingerprints of files.

use serde::Deserialize;
use sha2::Digest;
use std::fmt::{self, Write};

/// A SHA-256, 64 lower-case hexadecimal digits.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Sha256(String);

impl Sha256 {
    /// The hash of some bytes.
    pub fn of(bytes: &[u8]) -> Self {
        let mut digits = String::with_capacity(64);
        for byte in sha2::Sha256::digest(bytes) {
            let _ = write!(digits, "{byte:02x}");
        }
        Self(digits)
    }

    /// Its digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for Sha256 {
    type Error = String;

    fn try_from(digits: String) -> Result<Self, String> {
        let is_digit = |c| matches!(c, '0'..='9' | 'a'..='f');
        if digits.len() == 64 && digits.chars().all(is_digit) {
            Ok(Self(digits))
        } else {
            Err(format!("'{digits}' is no SHA-256; write 64 lower-case hexadecimal digits"))
        }
    }
}

impl fmt::Display for Sha256 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-2 (2002), appendix B.1.
    #[test]
    fn the_hash_of_abc_is_that_of_the_standard() {
        let standard = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(Sha256::of(b"abc").as_str(), standard);
    }
}
