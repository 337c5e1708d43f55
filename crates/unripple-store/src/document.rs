//! The common head of all TOML files, and faults of a whole file.

use crate::fault::{Fault, FileFaults};
use crate::file::LARGEST_TEXT;
use crate::surface::reader::{Faults, Section};
use toml::de::DeTable;

/// The format that this version reads and writes; a file that says another is refused with that alone.
const FORMAT: i64 = 1;

/// Parses a TOML text with these keys at its top. `read` makes the result from the top table and from the name, which
/// is that of the key `name` or else of the file.
pub(crate) fn parse<T>(
    text: &str,
    file: &str,
    keys: &[&str],
    read: impl FnOnce(&Section, Option<String>, &mut Faults) -> Option<T>,
) -> Result<T, FileFaults> {
    parse_up_to(LARGEST_TEXT, text, file, keys, read)
}

/// As [`parse`], for a text of at most `most` bytes.
pub(crate) fn parse_up_to<T>(
    most: usize,
    text: &str,
    file: &str,
    keys: &[&str],
    read: impl FnOnce(&Section, Option<String>, &mut Faults) -> Option<T>,
) -> Result<T, FileFaults> {
    if text.len() > most {
        return Err(longer_than(most, file));
    }
    let mut faults = Faults::new(text);
    let made = match DeTable::parse(text) {
        Ok(document) => {
            let root = Section::root(document.get_ref());
            match is_ours(&root, &mut faults) {
                true => {
                    root.check_keys(keys, |_| None, &mut faults);
                    let name = name(&root, file, &mut faults);
                    read(&root, name, &mut faults)
                }
                // Another format has other keys, which would only be noise here.
                false => None,
            }
        }
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            faults.add("", span, format!("an error of TOML: {}", error.message()), "a TOML file", None);
            None
        }
    };
    let list = faults.into_list();
    match made {
        Some(made) if list.is_empty() => Ok(made),
        _ => Err(FileFaults::new(file, text, list)),
    }
}

/// Whether a file is of this format, or does not say.
fn is_ours(root: &Section, faults: &mut Faults) -> bool {
    let nearest = Some(FORMAT.to_string());
    match root.get("format") {
        Some(entry) if entry.is(FORMAT) => true,
        Some(entry) => {
            entry.refuse(format!("{FORMAT}, the format this version reads"), nearest, faults);
            false
        }
        None => {
            faults.add("format", 0..0, "no such key", "format = 1 at the top", nearest);
            true
        }
    }
}

fn name(root: &Section, file: &str, faults: &mut Faults) -> Option<String> {
    match root.get("name") {
        Some(entry) => entry.line("a name", faults),
        None => Some(stem(file)),
    }
}

/// The fault of a file past the usual size limit.
pub(crate) fn too_large(file: &str) -> FileFaults {
    longer_than(LARGEST_TEXT, file)
}

/// The fault of a file of more than `most` bytes.
fn longer_than(most: usize, file: &str) -> FileFaults {
    whole(file, "", 0, "more than that", &format!("a file of at most {most} bytes"))
}

/// One fault of a whole file, at a byte of its text.
pub(crate) fn whole(file: &str, text: &str, at: usize, found: &str, expected: &str) -> FileFaults {
    let fault = Fault {
        key: String::new(),
        line: 0,
        column: 0,
        found: found.into(),
        expected: expected.into(),
        nearest: None,
        span: at..at,
    };
    FileFaults::new(file, text, vec![fault])
}

/// A name made from the file's own, for a file without the key `name`.
pub(crate) fn stem(file: &str) -> String {
    let stem = std::path::Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned());
    stem.map(|s| s.chars().filter(|c| !c.is_control()).take(50).collect::<String>().trim().to_owned())
        .filter(|s| !s.is_empty())
        .unwrap_or_else(|| "surface".into())
}
