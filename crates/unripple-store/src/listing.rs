//! The hidden file of an output folder: it lists what a run wrote there, so that a later run may replace that and nothing else.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Name of the hidden file in an output folder that lists the files written there by a run, so that a later run
/// may replace them and nothing else.
pub const MARKER: &str = ".unripple";

/// First lines of the hidden file. The number is that of the format.
const HEAD: &str = "unripple output 1\n\
    A later run replaces this folder if it holds only what is listed here, unchanged: bytes, CRC-32C, name.\n";

/// Content of the hidden file while the folder is being filled.
pub(crate) const UNFINISHED: &str = "unripple output, unfinished\n";

/// Largest hidden file that is read, in bytes: that of a million files.
const LARGEST: u64 = 1 << 26;

/// Number of foreign files that a message names; of further ones it gives the number only, so that it stays a line.
const NAMED: usize = 3;

/// Bytes and checksum of a file.
type Print = (u64, u32);

/// Content of a folder's hidden file.
pub(crate) enum Said {
    /// Nothing: no run of ours wrote it.
    Nothing,
    /// The folder is unfinished.
    Unfinished,
    /// The folder is ours, but its list cannot be read: an earlier or a later version of this program wrote it.
    Unlisted,
    /// The files that were written, with size and checksum.
    Files(BTreeMap<String, Print>),
}

/// Reads the hidden file of a folder.
pub(crate) fn read(folder: &Path) -> io::Result<Said> {
    let path = folder.join(MARKER);
    let metadata = match fs::symlink_metadata(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Said::Nothing),
        other => other?,
    };
    if !metadata.is_file() {
        return Ok(Said::Nothing);
    }
    let mut bytes = Vec::new();
    File::open(&path)?.take(LARGEST).read_to_end(&mut bytes)?;
    let text = String::from_utf8(bytes).unwrap_or_default();
    // Empty: the process was killed when it was about to write it.
    if text.is_empty() || text == UNFINISHED {
        return Ok(Said::Unfinished);
    }
    let lines = text.strip_prefix(HEAD).map(|lines| lines.lines().map(line).collect::<Option<_>>());
    Ok(lines.flatten().map_or(Said::Unlisted, Said::Files))
}

fn line(text: &str) -> Option<(String, Print)> {
    let mut words = text.splitn(3, ' ');
    let (bytes, check, name) = (words.next()?, words.next()?, words.next()?);
    Some((name.to_owned(), (bytes.parse().ok()?, u32::from_str_radix(check, 16).ok()?)))
}

/// The text that lists all files of a folder.
pub(crate) fn of(folder: &Path) -> io::Result<String> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if let Some(name) = entry.file_name().to_str().filter(|name| *name != MARKER)
            && entry.file_type()?.is_file()
        {
            files.insert(name.to_owned(), print(&entry.path())?);
        }
    }
    let mut text = HEAD.to_owned();
    for (name, (bytes, check)) in files {
        let _ = writeln!(text, "{bytes} {check:08x} {name}");
    }
    Ok(text)
}

fn print(path: &Path) -> io::Result<Print> {
    let (mut file, mut chunk) = (File::open(path)?, vec![0; 1 << 16]);
    let (mut bytes, mut check) = (0, 0);
    loop {
        match file.read(&mut chunk)? {
            0 => return Ok((bytes, check)),
            n => (bytes, check) = (bytes + n as u64, crc32c::crc32c_append(check, &chunk[..n])),
        }
    }
}

/// Files of a folder that are not on its list, or not as they were: in words, none if all is ours.
pub(crate) fn guests(folder: &Path, files: &BTreeMap<String, Print>) -> io::Result<Option<String>> {
    let mut guests = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        if name == MARKER {
            continue;
        }
        let listed = name.to_str().and_then(|name| files.get(name));
        let (kind, name) = (entry.file_type()?, name.to_string_lossy().into_owned());
        // A file that is gone meanwhile is no foreign one: another run has replaced all that was ours.
        let same = |known: &Print| match entry
            .metadata()
            .and_then(|found| Ok(found.len() == known.0 && print(&entry.path())? == *known))
        {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(true),
            other => other,
        };
        match listed {
            Some(known) if kind.is_file() && same(known)? => {}
            Some(_) if kind.is_file() => guests.push(format!("`{name}` (changed since it was written)")),
            _ if kind.is_dir() => guests.push(format!("the folder `{name}`")),
            _ => guests.push(format!("`{name}`")),
        }
    }
    guests.sort();
    let more = guests.len().saturating_sub(NAMED);
    guests.truncate(NAMED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    Ok((!guests.is_empty()).then(|| format!("{}{more}", guests.join(", "))))
}

/// Removes what a folder lists, its list, and the folder if nothing else is in it.
pub(crate) fn remove(folder: &Path) -> io::Result<()> {
    let gone = |done: io::Result<()>| match done {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        other => other,
    };
    if let Said::Files(files) = read(folder)? {
        files.keys().try_for_each(|name| gone(fs::remove_file(folder.join(name))))?;
        gone(fs::remove_file(folder.join(MARKER)))?;
    }
    gone(fs::remove_dir(folder))
}

/// Removes an unfinished folder with all that is in it, the hidden file last: if the program is killed meanwhile, the
/// next run still recognises the folder.
pub(crate) fn remove_unfinished(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name() == MARKER {
            continue;
        }
        match entry.file_type()?.is_dir() {
            true => fs::remove_dir_all(entry.path())?,
            false => fs::remove_file(entry.path())?,
        }
    }
    match fs::remove_file(folder.join(MARKER)) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => fs::remove_dir(folder),
    }
}
