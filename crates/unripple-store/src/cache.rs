//! A cache of results of long computations, as files in a folder.

use sha2::{Digest, Sha256};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, SystemTime};
use unripple_core::Cache;

/// First bytes of an entry. Another layout of files gets another number.
const MAGIC: &[u8; 16] = b"unripple-cache1\n";

/// Length of the SHA-256 of an entry's data, which follows the first bytes.
const HASH: usize = 32;

/// Ends of the names of entries, and of entries that are being written.
const ENTRY: &str = "entry";
const PART: &str = "part";

/// Age after which a file that is being written counts as left by a program that was killed: to write 4 GB takes minutes on the slowest
/// disks.
const ABANDONED: Duration = Duration::from_secs(3600);

/// A cache in a folder. Any number of programs may use it at once, and may be killed at any time: an entry is complete, or is no entry, and
/// one that was damaged is removed. Where the folder cannot be written or the disk is full, nothing is stored.
///
/// The entries that were not used for longest are removed once all together are larger than a limit.
///
/// ```
/// use unripple_core::Cache;
/// use unripple_store::DiskCache;
///
/// let folder = std::env::temp_dir().join(format!("unripple-cache-example-{}", std::process::id()));
/// let cache = DiskCache::new(&folder, 1 << 20, "this program");
/// cache.write("a question", &[1, 2, 3]);
/// assert_eq!(cache.read("a question"), Some(vec![1, 2, 3]));
/// // Another program may compute it in another way.
/// assert_eq!(DiskCache::new(&folder, 1 << 20, "another").read("a question"), None);
/// assert_eq!((cache.usage()?.entries, cache.empty()?.entries, cache.usage()?.entries), (1, 1, 0));
/// std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct DiskCache {
    folder: PathBuf,
    /// Largest size of all entries, in bytes; beyond it the oldest are removed.
    limit: u64,
    /// The program whose results these are.
    program: String,
}

/// Number and size of the results in a cache.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Number of entries, of all programs.
    pub entries: usize,
    /// Bytes of all files.
    pub bytes: u64,
}

/// A file of the cache.
struct Stored {
    path: PathBuf,
    bytes: u64,
    used: SystemTime,
}

impl DiskCache {
    /// A cache in `folder`, which is made once something is stored, of at most `limit` bytes. Results of one `program` (its name, version and
    /// build) are not those of another.
    pub fn new(folder: &Path, limit: u64, program: impl Into<String>) -> Self {
        Self { folder: folder.into(), limit, program: program.into() }
    }

    /// Number and size of the results in the cache.
    ///
    /// # Errors
    /// If the folder exists but cannot be read.
    pub fn usage(&self) -> io::Result<Usage> {
        let files = self.files()?;
        let entries = files.iter().filter(|file| is(&file.path, ENTRY)).count();
        Ok(Usage { entries, bytes: files.iter().map(|file| file.bytes).sum() })
    }

    /// Removes all results from the cache, and returns their number and size.
    ///
    /// # Errors
    /// If the folder cannot be read, or a file cannot be removed.
    pub fn empty(&self) -> io::Result<Usage> {
        let usage = self.usage()?;
        for file in self.files()? {
            gone(fs::remove_file(file.path))?;
        }
        Ok(usage)
    }

    fn path(&self, key: &str) -> PathBuf {
        let mut hash = Sha256::new();
        // With its length, so that no program and key are those of others joined.
        hash.update((self.program.len() as u64).to_le_bytes());
        hash.update(&self.program);
        hash.update(key);
        let name: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        self.folder.join(name).with_extension(ENTRY)
    }

    /// The cache's own files in the folder: no others, which somebody may have there, are looked at or removed.
    fn files(&self) -> io::Result<Vec<Stored>> {
        let folder = match fs::read_dir(&self.folder) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            folder => folder?,
        };
        let mut files = Vec::new();
        for file in folder {
            let path = file?.path();
            // Another program may have removed it meanwhile.
            if is_own(&path)
                && let Ok(about) = fs::metadata(&path)
                && about.is_file()
            {
                files.push(Stored { path, bytes: about.len(), used: about.modified()? });
            }
        }
        Ok(files)
    }

    fn store(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        fs::create_dir_all(&self.folder)?;
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let part = path.with_extension(format!("{}-{number}.{PART}", std::process::id()));
        let written = write(&part, bytes).and_then(|()| fs::rename(&part, path));
        if written.is_err() {
            // What is left is removed later, if it cannot be now.
            let _ = fs::remove_file(&part);
        }
        written?;
        self.shrink()
    }

    /// Removes what was left by killed programs, and the oldest entries beyond the limit.
    fn shrink(&self) -> io::Result<()> {
        let now = SystemTime::now();
        let mut files = self.files()?;
        files.sort_by_key(|file| file.used);
        let mut bytes: u64 = files.iter().map(|file| file.bytes).sum();
        for file in files {
            let left = now.duration_since(file.used).is_ok_and(|age| age > ABANDONED);
            let part = is(&file.path, PART);
            // What cannot be removed stays; others are removed in its place.
            if (part && left || !part && bytes > self.limit) && gone(fs::remove_file(file.path)).is_ok() {
                bytes -= file.bytes;
            }
        }
        Ok(())
    }
}

impl Cache for DiskCache {
    fn read(&self, key: &str) -> Option<Vec<u8>> {
        let path = self.path(key);
        let mut bytes = fs::read(&path).ok()?;
        let start = MAGIC.len() + HASH;
        let intact = bytes.len() >= start
            && bytes.starts_with(MAGIC)
            && Sha256::digest(&bytes[start..])[..] == bytes[MAGIC.len()..start];
        if !intact {
            // If it cannot be removed it is read again, and is no entry again.
            let _ = fs::remove_file(&path);
            return None;
        }
        // Where the time cannot be set, the entry is only removed earlier.
        let _ =
            File::options().append(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        bytes.drain(..start);
        Some(bytes)
    }

    fn holds(&self, key: &str) -> bool {
        self.path(key).is_file()
    }

    fn write(&self, key: &str, bytes: &[u8]) {
        if bytes.len() as u64 <= self.limit {
            // A result that is not stored is computed again.
            let _ = self.store(&self.path(key), bytes);
        }
    }
}

/// Writes an entry.
fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create_new(path)?;
    file.write_all(MAGIC)?;
    file.write_all(&Sha256::digest(bytes))?;
    file.write_all(bytes)
}

/// Whether a file has a name that the cache gives: the hash of a key, and what an entry or one that is being written ends in.
fn is_own(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let (hash, end) = name.split_at_checked(2 * HASH).unwrap_or_default();
    let hashed = hash.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte));
    hashed && !hash.is_empty() && (end == format!(".{ENTRY}") || is(path, PART))
}

/// Whether a path ends in `end`.
fn is(path: &Path, end: &str) -> bool {
    path.extension().is_some_and(|found| found == end)
}

/// That a file is gone, whoever removed it.
fn gone(removed: io::Result<()>) -> io::Result<()> {
    match removed {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
