//! Fingerprints of recordings, by which changed recordings are evaluated again and copies of others are
//! found.

use super::fault::Fault;
use super::planned::Wanted;
use crate::TaskError;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::UNIX_EPOCH;
use unripple_store::{Library, read_wav};

/// Key of the library's log entry for the fingerprints of recordings.
const TAKES: &str = "takes";

/// Key of the library's log entry for the note that recordings were resampled.
const RATE: &str = "rate";

/// Properties by which a recording is recognised: size, time, sample rate and a hash of its samples.
#[derive(Clone, Debug, PartialEq)]
struct Mark {
    bytes: u64,
    /// When the file was last written, in ns after 1970: a file with the same size and time is not read
    /// again.
    written: u64,
    /// Sample rate, in Hz; 0 in logs of earlier versions.
    rate: f64,
    /// Hash of the samples, independent of the file format.
    hash: String,
}

/// Fingerprints of all recordings that exist and can be read, by file name.
#[derive(Clone, Debug, Default)]
pub struct Marks {
    all: BTreeMap<String, Mark>,
}

impl Marks {
    /// Computes the fingerprints of the `wanted` files in a folder; files whose size and time are in the
    /// library's log are not read again.
    pub fn of<'a>(
        folder: &Path,
        wanted: impl Iterator<Item = &'a Wanted>,
        library: Option<&Library>,
    ) -> Self {
        let known = library.and_then(|library| library.logged(TAKES));
        let mut all = BTreeMap::new();
        for file in wanted.map(|one| &one.file) {
            let Ok(about) = std::fs::metadata(folder.join(file)) else { continue };
            let written = about.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
            let written = written.map_or(0, |since| since.as_nanos() as u64);
            let bytes = about.len();
            let before = known.and_then(|known| Mark::of(known.get(file)?));
            let before = before.filter(|mark| mark.bytes == bytes && mark.written == written && written > 0);
            let read = || hash(folder, file).map(|(rate, hash)| Mark { bytes, written, rate, hash });
            if let Some(mark) = before.or_else(read) {
                all.insert(file.clone(), mark);
            }
        }
        Self { all }
    }

    /// Hash of a recording's samples, by the name of its file.
    pub fn hash(&self, file: &str) -> Option<&str> {
        self.all.get(file).map(|mark| mark.hash.as_str())
    }

    /// Faults of recordings with the same samples as another. If one of them is in `trusted` (measured
    /// before), only the others are at fault.
    pub fn copies(&self, trusted: &[String]) -> Vec<Fault> {
        let mut by_hash: BTreeMap<&str, Vec<&String>> = BTreeMap::new();
        self.all.iter().for_each(|(file, mark)| by_hash.entry(&mark.hash).or_default().push(file));
        let mut faults = Vec::new();
        for files in by_hash.values().filter(|files| files.len() > 1) {
            let originals: Vec<&&String> = files.iter().filter(|file| trusted.contains(file)).collect();
            let suspects = files.iter().filter(|file| originals.len() != 1 || !trusted.contains(file));
            for file in suspects {
                let others: Vec<&str> =
                    files.iter().filter(|other| other != &file).map(|other| other.as_str()).collect();
                let why =
                    format!("has the same samples as {}, one for one: one is a copy", others.join(", "));
                faults.push(Fault::new(file, why, "record it again"));
            }
        }
        faults
    }

    /// Sentence on recordings whose sample rate is not `rate` (Hz); `None` if there are none.
    fn resampled(&self, rate: f64) -> Option<String> {
        let other: Vec<(&String, f64)> = self
            .all
            .iter()
            .map(|(file, mark)| (file, mark.rate))
            .filter(|(_, of)| *of > 0.0 && *of != rate)
            .collect();
        match other[..] {
            [] => None,
            [(file, of)] => Some(format!("{file} is at {of} Hz: resampled to {rate} Hz")),
            [(file, of), ..] => Some(format!(
                "{file} ({of} Hz) and {} more recordings are at another rate: resampled to {rate} Hz",
                other.len() - 1
            )),
        }
    }

    /// Stores all fingerprints in a library's log, beside those of files that no longer exist, and a note
    /// on which recordings had to be resampled.
    pub fn keep(&self, library: &mut Library) -> Result<(), TaskError> {
        let said = self.resampled(library.plan().conditions.rate);
        library.log(RATE, said.map_or(Value::Null, |said| json!({ "said": said })))?;
        let mut told = library.logged(TAKES).and_then(Value::as_object).cloned().unwrap_or_default();
        told.extend(self.all.iter().map(|(file, mark)| (file.clone(), mark.told())));
        Ok(library.log(TAKES, Value::Object(told))?)
    }

    /// Hashes of some files as JSON, by file name, for a point's log.
    pub fn told<'a>(&self, files: impl Iterator<Item = &'a Wanted>) -> Value {
        let known = files.filter_map(|one| Some((one.file.clone(), json!(self.hash(&one.file)?))));
        Value::Object(known.collect::<Map<_, _>>())
    }
}

impl Mark {
    fn of(told: &Value) -> Option<Self> {
        let number = |key: &str| told.get(key)?.as_u64();
        let hash = told.get("hash")?.as_str()?.to_owned();
        let rate = told.get("rate_hz").and_then(Value::as_f64).unwrap_or(0.0);
        Some(Self { bytes: number("bytes")?, written: number("written_ns")?, rate, hash })
    }

    fn told(&self) -> Value {
        json!({ "bytes": self.bytes, "written_ns": self.written, "rate_hz": self.rate, "hash": self.hash })
    }
}

/// The sample rate, and a 64-bit FNV-1a hash of all samples, channel after channel; `None` for a file that
/// cannot be read.
fn hash(folder: &Path, file: &str) -> Option<(f64, String)> {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    let wav = read_wav(folder.join(file)).ok()?;
    let mut hash = OFFSET;
    let mut add = |bits: u64| hash = (hash ^ bits).wrapping_mul(PRIME).rotate_left(23);
    add(wav.rate.to_bits());
    for channel in &wav.channels {
        add(channel.len() as u64);
        channel.iter().for_each(|x| add(x.to_bits()));
    }
    Some((wav.rate, format!("{hash:016x}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_named_and_the_known_one_is_not() {
        let mark = |hash: &str| Mark { bytes: 1, written: 2, rate: 44_100.0, hash: hash.into() };
        let all = [("a.wav", "1"), ("b.wav", "2"), ("c.wav", "1")].map(|(f, h)| (f.to_owned(), mark(h)));
        let marks = Marks { all: all.into() };
        let files = |trusted: &[&str]| {
            let trusted: Vec<String> = trusted.iter().map(|file| (*file).to_owned()).collect();
            marks.copies(&trusted).into_iter().map(|fault| fault.file).collect::<Vec<_>>()
        };
        assert_eq!(files(&[]), ["a.wav", "c.wav"]);
        assert_eq!(files(&["a.wav", "b.wav"]), ["c.wav"]);
        assert_eq!(files(&["a.wav", "c.wav"]), ["a.wav", "c.wav"], "who is right is not known");
        assert!(marks.copies(&[])[0].why.contains("same samples as c.wav"));
        let said = marks.resampled(48_000.0).unwrap();
        assert_eq!(said, "a.wav (44100 Hz) and 2 more recordings are at another rate: resampled to 48000 Hz");
        assert_eq!(marks.resampled(44_100.0), None);
    }
}
