//! One fault of a file: line, column, found, expected.

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// Largest number of faults reported of one file; the rest are counted.
pub(crate) const MOST_FAULTS: usize = 100;

/// One fault of a TOML file: its place, what was found, what was expected, and the nearest valid alternative.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// Path of the key, as in `actuator[3].at_mm`, counted from 0; empty for the whole file.
    pub key: String,
    /// Line of the file, counted from 1.
    pub line: usize,
    /// Column of the line in characters, counted from 1.
    pub column: usize,
    /// What was found in the file at this place.
    pub found: String,
    /// What the file may contain at this place.
    pub expected: String,
    /// The nearest legal value or known name, in the file's own unit.
    pub nearest: Option<String>,
    /// Range of bytes of the file that is at fault.
    #[serde(skip)]
    pub span: Range<usize>,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        write!(f, "expected {}, found {}", self.expected, self.found)?;
        match &self.nearest {
            Some(nearest) => write!(f, " (nearest: {nearest})"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Fault {}

impl Diagnostic for Fault {
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = match &self.nearest {
            Some(nearest) => format!("nearest: {nearest}"),
            None => "here".into(),
        };
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(label), self.span.clone()))))
    }
}

/// All faults of one TOML file, of a surface or of effects, in the file's order.
///
/// Formatted by `{}` it is one line; by `{:#}`, one more line for each fault, with file, line and column. As a
/// [`miette::Diagnostic`] it shows the lines of the file with a caret under each fault.
///
/// ```
/// let text = "format = 1\nnmae = \"film\"\n";
/// let faults = unripple_store::parse_surface(text, "film.toml").unwrap_err();
/// let typo = faults.faults().iter().find(|fault| fault.key == "nmae").unwrap();
/// assert_eq!((typo.line, typo.column), (2, 1));
/// assert_eq!(typo.nearest.as_deref(), Some("name"));
/// assert!(format!("{faults:#}").contains("film.toml:2:1: nmae: expected "));
/// ```
#[derive(Clone, Debug)]
pub struct FileFaults(Box<Report>);

#[derive(Clone, Debug)]
struct Report {
    file: String,
    source: NamedSource<String>,
    faults: Vec<Fault>,
    omitted: usize,
}

impl FileFaults {
    pub(crate) fn new(file: &str, text: &str, mut faults: Vec<Fault>) -> Self {
        faults.sort_by_key(|fault| fault.span.start);
        // A value that applies to several tables is reported once.
        faults.dedup();
        let omitted = faults.len().saturating_sub(MOST_FAULTS);
        faults.truncate(MOST_FAULTS);
        for fault in &mut faults {
            (fault.line, fault.column) = position(text, fault.span.start);
        }
        let source = NamedSource::new(file, text.to_owned());
        Self(Box::new(Report { file: file.into(), source, faults, omitted }))
    }

    /// The faults, in the file's order, at most a hundred.
    pub fn faults(&self) -> &[Fault] {
        &self.0.faults
    }

    /// Number of faults beyond those that [`FileFaults::faults`] holds.
    pub fn omitted(&self) -> usize {
        self.0.omitted
    }

    /// Name of the file, as it was passed to the reader.
    pub fn file(&self) -> &str {
        &self.0.file
    }
}

impl fmt::Display for FileFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.0.faults.len() + self.0.omitted;
        let plural = if count == 1 { "" } else { "s" };
        write!(f, "{count} fault{plural} in {}", self.0.file)?;
        if !f.alternate() {
            return Ok(());
        }
        for fault in &self.0.faults {
            write!(f, "\n{}:{}:{}: {fault}", self.0.file, fault.line, fault.column)?;
        }
        match self.0.omitted {
            0 => Ok(()),
            more => write!(f, "\nand {more} more"),
        }
    }
}

impl std::error::Error for FileFaults {}

impl Diagnostic for FileFaults {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.0.source)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.0.faults.iter().map(|fault| fault as &dyn Diagnostic)))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (self.0.omitted > 0)
            .then(|| Box::new(format!("and {} more", self.0.omitted)) as Box<dyn fmt::Display>)
    }
}

impl Serialize for FileFaults {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut map = serializer.serialize_struct("FileFaults", 3)?;
        map.serialize_field("file", &self.0.file)?;
        map.serialize_field("faults", &self.0.faults)?;
        map.serialize_field("omitted", &self.0.omitted)?;
        map.end()
    }
}

/// Line and column, in characters from 1, of a byte of `text`.
fn position(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}
