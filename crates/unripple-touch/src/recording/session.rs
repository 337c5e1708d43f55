//! A recorded session, read and checked.

use super::line::{self, FORMAT, Head, Item, VERSION};
use crate::TouchError;
use std::collections::BTreeSet;
use std::io::{Error, ErrorKind};
use std::path::Path;
use unripple_core::Phase;

/// The longest line, in bytes, and the longest file that is opened. A line has some hundred bytes; what is longer is
/// an error rather than memory.
const LONGEST_LINE: usize = 1024;
const LONGEST_FILE: u64 = 256 << 20;
/// Fingers at once in a recording; a line that puts one more down is an error.
const MOST: usize = 64;

/// A recorded session: touches, and requests for effects and levels.
///
/// A file of JSON lines. The first is `{"format":"unripple-touches","version":1}`; each of the others is one touch,
/// effect or level, in mm, ms, N and dB.
///
/// ```
/// use unripple_touch::Recording;
///
/// let text = r#"{"format":"unripple-touches","version":1}
/// {"at_ms":0,"finger":1,"phase":"down","at_mm":[62,90],"force_n":0.3}
/// {"at_ms":12.5,"finger":1,"phase":"move","at_mm":[63,90]}
/// {"at_ms":20,"effect":"click"}
/// {"at_ms":30,"finger":1,"phase":"up","at_mm":[63,90]}
/// "#;
/// assert_eq!(Recording::read(text)?.duration(), 0.03);
/// let wrong = text.replace("[63,90]", "[63]");
/// assert!(Recording::read(&wrong).unwrap_err().to_string().starts_with("line 3: "));
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    items: Vec<Item>,
}

impl Recording {
    /// Reads the text of a file; the error names the first line that is wrong.
    pub fn read(text: &str) -> Result<Self, TouchError> {
        let mut lines = (1..).zip(text.lines());
        let bad = |line: usize, what: String| TouchError::Line { line, what };
        head(lines.next().map_or("", |(_, line)| line)).map_err(|what| bad(1, what))?;
        let (mut items, mut down, mut last) = (Vec::new(), BTreeSet::new(), 0.0);
        for (number, text) in lines {
            let item = next(text, last, &mut down).map_err(|what| bad(number, what))?;
            last = item.time();
            items.push(item);
        }
        Ok(Self { items })
    }

    /// Reads a recording from a file of at most 256 MiB.
    pub fn open(path: &Path) -> Result<Self, TouchError> {
        let fix = "a recording is a text file of at most 256 MB";
        let error = |error| TouchError::io(format!("reading {}", path.display()), error, fix);
        if std::fs::metadata(path).map_err(error)?.len() > LONGEST_FILE {
            return Err(error(Error::from(ErrorKind::FileTooLarge)));
        }
        Self::read(&std::fs::read_to_string(path).map_err(error)?)
    }

    /// Duration of the recording, in s.
    pub fn duration(&self) -> f64 {
        self.items.last().map_or(0.0, Item::time)
    }

    /// Number of touches and requests; the one at index i is on line i + 2.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether the recording holds no touch and no request.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    pub(super) fn items(&self) -> &[Item] {
        &self.items
    }
}

fn head(text: &str) -> Result<(), String> {
    let expected = || format!(r#"expected {{"format":"{FORMAT}","version":{VERSION}}}"#);
    let sound = text.len() <= LONGEST_LINE;
    let head = sound.then(|| serde_json::from_str::<Head>(text).ok()).flatten().ok_or_else(expected)?;
    if head.format != FORMAT {
        return Err(expected());
    }
    if head.version != VERSION {
        return Err(format!("version: expected {VERSION}, found {}", head.version));
    }
    Ok(())
}

/// Reads the next line, and checks it against what is known from those before.
fn next(text: &str, last: f64, down: &mut BTreeSet<u64>) -> Result<Item, String> {
    if text.len() > LONGEST_LINE {
        return Err(format!("expected at most {LONGEST_LINE} bytes, found {}", text.len()));
    }
    let item = line::read(text)?;
    if item.time() < last {
        return Err(format!("at_ms: expected at least {}, found {}", last * 1e3, item.time() * 1e3));
    }
    if let Item::Touch(touch) = &item {
        let finger = touch.finger;
        match touch.phase {
            Phase::Down if !down.insert(finger) => {
                return Err(format!("finger: expected one that is not down, found {finger}"));
            }
            Phase::Down if down.len() > MOST => {
                return Err(format!("finger: expected at most {MOST} at once, found one more"));
            }
            Phase::Move if !down.contains(&finger) => {
                return Err(format!("finger: expected one that is down, found {finger}"));
            }
            Phase::Up if !down.remove(&finger) => {
                return Err(format!("finger: expected one that is down, found {finger}"));
            }
            _ => {}
        }
    }
    Ok(item)
}
