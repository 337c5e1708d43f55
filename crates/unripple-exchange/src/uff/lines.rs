//! Lines of a universal file, and the marks between its datasets.

use crate::error::shown;
use crate::{ExchangeError, Place};

/// A line of a file, without what ends it.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    /// Number of the line, from 1.
    pub number: usize,
    /// The bytes of the line, blanks included.
    pub bytes: &'a [u8],
}

impl Line<'_> {
    /// Whether it is the mark -1, which begins and ends datasets: in the first six columns, or somewhat off.
    fn is_mark(&self) -> bool {
        let blanks = self.bytes.iter().take_while(|b| **b == b' ').count();
        // A record that holds the integer -1 in its first field of ten columns has more blanks before it.
        blanks <= 4 && self.bytes.trim_ascii() == b"-1"
    }

    /// Whether it holds nothing but blanks.
    pub fn is_blank(&self) -> bool {
        self.bytes.trim_ascii().is_empty()
    }
}

/// The records of a universal file, line by line.
pub(super) struct Records<'a> {
    rest: &'a [u8],
    number: usize,
    /// The dataset that is being read, from 1; 0 before the first.
    pub dataset: usize,
    /// Name of the file in messages.
    pub file: &'a str,
}

impl<'a> Records<'a> {
    /// The records of a file.
    pub fn of(bytes: &'a [u8], file: &'a str) -> Self {
        Self { rest: bytes, number: 0, dataset: 0, file }
    }

    /// Number of bytes that are left.
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    fn line(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| *b == b'\n');
        let (bytes, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &self.rest[..0]),
        };
        self.rest = rest;
        self.number += 1;
        Some(Line { number: self.number, bytes: bytes.strip_suffix(b"\r").unwrap_or(bytes) })
    }

    /// The first line of the next dataset, with its number; `None` at the end of the file.
    pub fn begin(&mut self) -> Result<Option<Line<'a>>, ExchangeError> {
        let mut marked = false;
        while let Some(line) = self.line() {
            if line.is_mark() {
                marked = true;
            } else if marked {
                self.dataset += 1;
                return Ok(Some(line));
            } else if !line.is_blank() {
                let at = Place::Line(line.number);
                let expected = "-1, which begins a dataset";
                return Err(ExchangeError::content(self.file, at, expected, shown(line.bytes)));
            }
        }
        // A mark too many at the end is in some files.
        Ok(None)
    }

    /// The next record of the dataset; `what` says in the error what it should be.
    pub fn record(&mut self, what: &str) -> Result<Line<'a>, ExchangeError> {
        match self.line() {
            Some(line) if line.is_mark() => Err(self.refused(what, "the end of the dataset")),
            Some(line) => Ok(line),
            None => Err(self.refused(what, "the end of the file")),
        }
    }

    /// The next record of a dataset that goes on until its mark; `None` at the mark.
    pub fn record_or_end(&mut self, what: &str) -> Result<Option<Line<'a>>, ExchangeError> {
        match self.line() {
            Some(line) if line.is_mark() => Ok(None),
            Some(line) => Ok(Some(line)),
            None => {
                Err(self.refused(format!("{what}, or -1 at the end of the dataset"), "the end of the file"))
            }
        }
    }

    /// The end of the dataset, after lines that are blank.
    pub fn end(&mut self) -> Result<(), ExchangeError> {
        while let Some(line) = self.record_or_end("-1")? {
            if !line.is_blank() {
                return Err(self.refused("-1 at the end of the dataset", shown(line.bytes)));
            }
        }
        Ok(())
    }

    /// Goes over the rest of the dataset.
    pub fn skip_dataset(&mut self) -> Result<(), ExchangeError> {
        while self.record_or_end("a record")?.is_some() {}
        Ok(())
    }

    /// Whether the mark that ends the dataset stands behind so many bytes.
    pub fn ends_after(&self, count: usize) -> bool {
        let Some(rest) = self.rest.get(count..) else { return false };
        let rest = rest.strip_prefix(b"\r").unwrap_or(rest);
        let rest = rest.strip_prefix(b"\n").unwrap_or(rest);
        let end = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        Line { number: 0, bytes: &rest[..end] }.is_mark()
    }

    /// Bytes of a binary dataset, as many as its first line says.
    pub fn binary(&mut self, count: usize) -> Result<&'a [u8], ExchangeError> {
        let Some((taken, rest)) = self.rest.split_at_checked(count) else {
            return Err(
                self.refused(format!("{count} bytes of values"), format!("{} bytes", self.rest.len()))
            );
        };
        self.rest = rest;
        // What ends the last line of values counts as no line of its own.
        self.rest = self.rest.strip_prefix(b"\r").unwrap_or(self.rest);
        self.rest = self.rest.strip_prefix(b"\n").unwrap_or(self.rest);
        self.number += taken.iter().filter(|b| **b == b'\n').count() + 1;
        Ok(taken)
    }

    /// The error of what is in the line that was read last.
    pub fn refused(&self, expected: impl Into<String>, found: impl std::fmt::Display) -> ExchangeError {
        self.refused_at(self.number, expected, found)
    }

    /// The error of what is in a line of the dataset.
    pub fn refused_at(
        &self,
        line: usize,
        expected: impl Into<String>,
        found: impl std::fmt::Display,
    ) -> ExchangeError {
        let at = Place::Dataset { dataset: self.dataset, line };
        ExchangeError::content(self.file, at, expected, found)
    }
}
