//! Lines and words of a text, with their numbers.
use super::file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
use crate::Vec3;

/// The lines of a text, which end in `\n`, `\r\n` or `\r`.
pub struct TextLines<'a> {
    rest: &'a [u8],
    /// The number of lines that were read.
    pub number: usize,
}

impl<'a> TextLines<'a> {
    /// Returns the lines of a text, of which some were read before.
    pub fn after(rest: &'a [u8], number: usize) -> Self {
        TextLines { rest, number }
    }
    /// Returns the bytes after the lines that were read.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for TextLines<'a> {
    type Item = &'a [u8];
    fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|byte| b"\r\n".contains(byte));
        let end = end.unwrap_or(self.rest.len());
        let (line, after) = self.rest.split_at(end);
        let length = match after {
            [b'\r', b'\n', ..] => 2,
            [] => 0,
            _ => 1,
        };
        self.rest = &after[length..];
        Some(line)
    }
}

/// Returns the words of a line.
pub fn words_of(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let parts = line.split(|byte| byte.is_ascii_whitespace());
    parts.filter(|word| !word.is_empty())
}

/// The words of a text.
pub struct TextWords<'a> {
    kind: FileKind,
    lines: TextLines<'a>,
    line: &'a [u8],
}

impl<'a> TextWords<'a> {
    /// Returns the words of the lines that are left.
    pub fn new(kind: FileKind, lines: TextLines<'a>) -> Self {
        TextWords {
            kind,
            lines,
            line: b"",
        }
    }
    /// Returns the next word; `None` at the end.
    pub fn next_word(&mut self) -> Option<&'a [u8]> {
        loop {
            let start = self
                .line
                .iter()
                .position(|byte| !byte.is_ascii_whitespace());
            let Some(start) = start else {
                self.line = self.lines.next()?;
                continue;
            };
            let word = &self.line[start..];
            let end = word.iter().position(|byte| byte.is_ascii_whitespace());
            let (word, rest) = word.split_at(end.unwrap_or(word.len()));
            self.line = rest;
            return Some(word);
        }
    }
    /// Returns the next word, which must be there.
    pub fn word(&mut self, expected: &'static str) -> Result<&'a [u8], FileFault> {
        let word = self.next_word();
        word.ok_or_else(|| self.fault(FileFlaw::Ends { expected }))
    }
    /// Returns the number of bytes that are left.
    pub fn bytes_left(&self) -> usize {
        self.line.len() + self.lines.rest().len()
    }
    /// Drops the rest of the line.
    pub fn skip_line(&mut self) {
        self.line = b"";
    }
    /// Returns a fault in the line of the last word.
    pub fn fault(&self, flaw: FileFlaw) -> FileFault {
        let place = FilePlace::Line(self.lines.number.max(1));
        self.kind.fault(place, flaw)
    }
    /// Returns the coordinates of a vertex.
    pub fn vertex(&mut self) -> Result<Vec3<f64>, FileFault> {
        let mut numbers = [0.0; 3];
        for number in &mut numbers {
            let word = self.word("a coordinate")?;
            *number = coordinate(word).map_err(|flaw| self.fault(flaw))?;
        }
        let [x, y, z] = numbers;
        Ok(Vec3::new(x, y, z))
    }
}

/// Returns the flaw of a word that is not what must be there.
pub fn unexpected(expected: &'static str, word: &[u8]) -> FileFlaw {
    let text = String::from_utf8_lossy(word);
    let found = text.chars().take(40).collect();
    FileFlaw::Unexpected { expected, found }
}

/// Returns the number of a word, whole or not by its type.
pub fn number<T: std::str::FromStr>(word: &[u8], expected: &'static str) -> Result<T, FileFlaw> {
    let number = std::str::from_utf8(word).ok().and_then(|x| x.parse().ok());
    number.ok_or_else(|| unexpected(expected, word))
}

/// Returns the finite number of a word.
pub fn coordinate(word: &[u8]) -> Result<f64, FileFlaw> {
    let number: f64 = number(word, "a coordinate")?;
    match number.is_finite() {
        true => Ok(number),
        false => Err(FileFlaw::NotFinite),
    }
}
