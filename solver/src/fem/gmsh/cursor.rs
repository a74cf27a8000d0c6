//! Numbers and section names of a Gmsh file, text or binary, with the place of every fault.

use crate::error::{Error, Result};

/// How numbers are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Text, separated by white space.
    Ascii,
    /// Native binary, least significant byte first.
    Little,
    /// Native binary, most significant byte first.
    Big,
}

/// A place in the bytes of a file.
#[derive(Debug, Clone)]
pub struct Cursor<'a> {
    file: &'a str,
    bytes: &'a [u8],
    at: usize,
    /// How the numbers that follow are stored.
    pub encoding: Encoding,
}

impl<'a> Cursor<'a> {
    pub fn new(file: &'a str, bytes: &'a [u8]) -> Self {
        Cursor { file, bytes, at: 0, encoding: Encoding::Ascii }
    }

    /// An error here; the line is known in text files only.
    pub fn fault(&self, message: impl Into<String>) -> Error {
        let before = &self.bytes[..self.at.min(self.bytes.len())];
        let line = before.iter().filter(|&&b| b == b'\n').count() + 1;
        let line = (self.encoding == Encoding::Ascii).then_some(line);
        Error::File { file: self.file.to_owned(), line, message: message.into() }
    }

    /// The next `$Name`, or `None` at the end of the file.
    pub fn section(&mut self) -> Result<Option<String>> {
        self.skip_space();
        if self.at == self.bytes.len() {
            return Ok(None);
        }
        let line = self.line();
        match line.strip_prefix('$') {
            Some(name) => Ok(Some(name.to_owned())),
            None => {
                Err(self.fault("expected the '$' of a section here; is the file complete and unaltered?"))
            }
        }
    }

    /// Goes behind the `$End…` of a section whose content does not matter, or checks that it comes next.
    pub fn end(&mut self, name: &str, skip: bool) -> Result<()> {
        let mark = format!("$End{name}");
        let rest = &self.bytes[self.at..];
        let found = if skip {
            rest.windows(mark.len()).position(|w| w == mark.as_bytes())
        } else {
            let space = rest.iter().take_while(|b| b.is_ascii_whitespace()).count();
            rest[space..].starts_with(mark.as_bytes()).then_some(space)
        };
        let Some(offset) = found else {
            return Err(
                self.fault(format!("section ${name} does not end with {mark}; is the file complete?"))
            );
        };
        self.at += offset + mark.len();
        Ok(())
    }

    /// The rest of the line, without its end and outer blanks.
    pub fn line(&mut self) -> String {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at = (self.at + length + 1).min(self.bytes.len());
        String::from_utf8_lossy(&rest[..length]).trim().to_owned()
    }

    /// A C `int`: tags, dimensions and types.
    pub fn int(&mut self) -> Result<i32> {
        self.number("an integer", i32::from_le_bytes, i32::from_be_bytes)
    }

    /// A C `size_t`: counts and tags of nodes and elements.
    pub fn size(&mut self) -> Result<u64> {
        self.number("a count or tag", u64::from_le_bytes, u64::from_be_bytes)
    }

    /// A C `double`.
    pub fn double(&mut self) -> Result<f64> {
        let value = self.number("a number", f64::from_le_bytes, f64::from_be_bytes)?;
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.fault(format!("{value} is no coordinate; mesh the geometry again")))
    }

    fn number<const B: usize, T: std::str::FromStr>(
        &mut self,
        what: &str,
        little: fn([u8; B]) -> T,
        big: fn([u8; B]) -> T,
    ) -> Result<T> {
        match self.encoding {
            Encoding::Ascii => {
                let word = self.word();
                word.parse().map_err(|_| self.fault(format!("expected {what} but found '{}'", clip(word))))
            }
            Encoding::Little | Encoding::Big => {
                let Some(&bytes) = self.bytes[self.at..].first_chunk::<B>() else {
                    return Err(self.fault(format!("expected {what} but the file ends; is it complete?")));
                };
                self.at += B;
                Ok(if self.encoding == Encoding::Little { little(bytes) } else { big(bytes) })
            }
        }
    }

    fn word(&mut self) -> &'a str {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        std::str::from_utf8(&rest[..length]).unwrap_or("bytes that are no text")
    }

    fn skip_space(&mut self) {
        self.at += self.bytes[self.at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
    }
}

/// The start of a word, for messages.
fn clip(word: &str) -> String {
    word.chars().take(30).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_encodings_give_the_same_numbers() {
        let little = [&(-3i32).to_le_bytes()[..], &7u64.to_le_bytes(), &0.25f64.to_le_bytes()].concat();
        let big = [&(-3i32).to_be_bytes()[..], &7u64.to_be_bytes(), &0.25f64.to_be_bytes()].concat();
        let files: [(Encoding, &[u8]); 3] =
            [(Encoding::Ascii, b" -3 7\n0.25 "), (Encoding::Little, &little), (Encoding::Big, &big)];
        for (encoding, bytes) in files {
            let mut cursor = Cursor::new("numbers", bytes);
            cursor.encoding = encoding;
            let read = (cursor.int().unwrap(), cursor.size().unwrap(), cursor.double().unwrap());
            assert_eq!(read, (-3, 7, 0.25), "{encoding:?}");
            assert!(cursor.double().is_err());
        }
    }
}
