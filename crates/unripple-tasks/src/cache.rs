//! The cache of computed modes on this machine: its folder, its size, and emptying it.

use crate::TaskError;
use serde::Serialize;
use std::env;
use std::path::PathBuf;
use std::sync::Arc;
use unripple::core::Cache;
use unripple_store::{DiskCache, Usage};

/// The variable that names the folder of the cache; empty or `off` for none.
pub const VARIABLE: &str = "UNRIPPLE_CACHE";

/// Largest size of the cache in bytes: the modes of some ten large surfaces. With half this value, five.
const LIMIT: u64 = 4 << 30;

/// Folder, number of results and size of the cache of computed modes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The folder of the cache; `None` if it is turned off.
    pub folder: Option<PathBuf>,
    /// Number of results in it.
    pub entries: usize,
    /// Size of its files, in bytes.
    pub bytes: u64,
    /// Size that it grows to before results that were not used for longest are removed, in bytes.
    pub limit_bytes: u64,
    /// Whether all results have been removed.
    pub emptied: bool,
}

/// The cache of computed modes, which the programs of this user share; `None` if it is turned off, or there is no folder for it. Results of
/// programs that were built from other sources are not used, and a program of which these are not known uses none.
///
/// The folder is the one that the variable `UNRIPPLE_CACHE` names, or `unripple` in the user's folder of caches (`$XDG_CACHE_HOME` or
/// `~/.cache`; `%LOCALAPPDATA%` on Windows).
pub fn disk() -> Option<Arc<dyn Cache>> {
    let cache: Arc<dyn Cache> = Arc::new(found()?.1);
    Some(cache)
}

/// Reports the size of the cache of computed modes, and removes all results in it if `empty` is true.
///
/// ```
/// use unripple_tasks::Report;
///
/// let report = unripple_tasks::cache::look(false)?;
/// println!("{}", report.text());
/// assert!(!report.emptied);
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Work`] if the folder cannot be read, or a file cannot be removed.
pub fn look(empty: bool) -> Result<Report, TaskError> {
    let Some((folder, cache)) = found() else {
        return Ok(Report { folder: None, entries: 0, bytes: 0, limit_bytes: LIMIT, emptied: false });
    };
    let usage = if empty { cache.empty() } else { cache.usage() };
    let told = |error: std::io::Error| TaskError::work(format!("{}: {error}", folder.display()));
    let Usage { entries, bytes } = usage.map_err(told)?;
    Ok(Report { folder: Some(folder), entries, bytes, limit_bytes: LIMIT, emptied: empty })
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let Some(folder) = &self.folder else {
            return format!(
                "the cache is turned off: {VARIABLE} is `off` or empty, or the program does not know where to keep it"
            );
        };
        let megabytes = |bytes: u64| format!("{:.1} MB", bytes as f64 * 1e-6);
        let (folder, held) =
            (folder.display(), format!("{} results, {}", self.entries, megabytes(self.bytes)));
        match self.emptied {
            true => format!("{folder}: removed {held}"),
            false => format!(
                "{folder}: {held} of at most {}\nremove them with unripple cache --empty; {VARIABLE}=off computes everything anew",
                megabytes(self.limit_bytes)
            ),
        }
    }
}

fn found() -> Option<(PathBuf, DiskCache)> {
    let folder = folder()?;
    let program = format!("{} {}", env!("CARGO_PKG_VERSION"), crate::record::sources()?);
    let cache = DiskCache::new(&folder, LIMIT, program);
    Some((folder, cache))
}

fn folder() -> Option<PathBuf> {
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    if env::var_os(VARIABLE).is_some() {
        return set(VARIABLE).filter(|folder| folder.as_os_str() != "off");
    }
    let caches = match cfg!(windows) {
        true => set("LOCALAPPDATA"),
        false => set("XDG_CACHE_HOME").or_else(|| set("HOME").map(|home| home.join(".cache"))),
    };
    caches.map(|caches| caches.join("unripple"))
}
