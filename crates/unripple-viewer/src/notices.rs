//! Messages and pictures for all pages, from which each takes those that it has not seen.

use axum::body::Bytes;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use tokio::sync::watch;
use unripple_session::{Picture, lock};

/// A message or picture for all pages.
#[derive(Clone, Debug)]
pub enum Notice {
    /// A message as JSON.
    Text(Arc<str>),
    /// A picture of the field as encoded bytes, and what is known of it.
    Frame(Bytes, Picture),
}

/// The newest message or picture of each kind. Each page takes those that it has not seen when it has time, so that a slow page misses some
/// and delays no one.
#[derive(Debug)]
pub struct Notices {
    posted: Mutex<BTreeMap<String, (u64, Notice)>>,
    version: watch::Sender<u64>,
    viewers: AtomicUsize,
}

/// The mark of an open page, which is counted as open until this value is dropped.
#[derive(Debug)]
pub struct Viewing {
    notices: Arc<Notices>,
}

impl Drop for Viewing {
    fn drop(&mut self) {
        self.notices.viewers.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Notices {
    /// An empty set of notices.
    pub fn new() -> Self {
        let (version, _) = watch::channel(0);
        Self { posted: Mutex::new(BTreeMap::new()), version, viewers: AtomicUsize::new(0) }
    }

    /// Stores a notice in place of the last one of its kind. Never waits for a page.
    pub fn post(&self, kind: &str, notice: Notice) {
        let mut posted = lock(&self.posted);
        // Under the same lock, so that no two notices share a version.
        let version = *self.version.borrow() + 1;
        posted.insert(kind.to_owned(), (version, notice));
        self.version.send_replace(version);
    }

    /// Stores a message as JSON, in place of the last one of its kind.
    pub fn tell(&self, kind: &str, message: &impl serde::Serialize) {
        // A message is made of numbers and names: always JSON.
        if let Ok(text) = serde_json::to_string(message) {
            self.post(kind, Notice::Text(text.into()));
        }
    }

    /// Removes the notice of a kind.
    pub fn withdraw(&self, kind: &str) {
        lock(&self.posted).remove(kind);
    }

    /// All notices newer than a version, oldest first, each with its version: a number that rises with each notice.
    pub fn since(&self, version: u64) -> Vec<(u64, Notice)> {
        let posted = lock(&self.posted);
        let mut fresh: Vec<(u64, Notice)> =
            posted.values().filter(|(at, _)| *at > version).cloned().collect();
        fresh.sort_by_key(|(at, _)| *at);
        fresh
    }

    /// The newest notice of a kind.
    pub fn newest(&self, kind: &str) -> Option<Notice> {
        lock(&self.posted).get(kind).map(|(_, notice)| notice.clone())
    }

    /// Channel that follows the version of the newest notice.
    pub fn watch(&self) -> watch::Receiver<u64> {
        self.version.subscribe()
    }

    /// Counts one more open page, unless `most` are open already; the page is counted until the returned
    /// value is dropped.
    pub fn enter(self: &Arc<Self>, most: usize) -> Option<Viewing> {
        let one_more = |viewers| (viewers < most).then_some(viewers + 1);
        self.viewers.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_more).ok()?;
        Some(Viewing { notices: self.clone() })
    }

    /// Number of pages that are open.
    pub fn viewers(&self) -> usize {
        self.viewers.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_pages_come_than_may() {
        let notices = Arc::new(Notices::new());
        let both = [notices.enter(2), notices.enter(2)];
        assert!(both.iter().all(Option::is_some) && notices.enter(2).is_none());
        drop(both);
        assert!(notices.viewers() == 0 && notices.enter(1).is_some());
    }

    #[test]
    fn whoever_looks_misses_no_kind_however_many_post() {
        let notices = Notices::new();
        std::thread::scope(|scope| {
            for kind in ["a", "b", "c", "d"] {
                let notices = &notices;
                scope.spawn(move || (0..500).for_each(|i| notices.tell(kind, &(kind, i))));
            }
            let (mut seen, mut last) = (0, BTreeMap::new());
            while last.values().filter(|i| **i == 499).count() < 4 {
                for (version, notice) in notices.since(seen) {
                    let Notice::Text(text) = notice else { continue };
                    let (kind, i): (String, u32) = serde_json::from_str(&text).unwrap();
                    assert!(version > seen);
                    assert!(last.insert(kind, i).is_none_or(|before| before < i));
                    seen = version;
                }
            }
        });
        assert_eq!(*notices.watch().borrow(), 2000);
        notices.withdraw("a");
        assert_eq!(notices.since(0).len(), 3);
    }
}
