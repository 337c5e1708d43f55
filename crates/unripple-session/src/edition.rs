//! The surfaces that were sent to pages most recently, each with the number of the edit that made it.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use unripple::core::Surface;

/// Number of surfaces that are kept: a page that lags behind by more edits cannot ask about its surface any more.
const KEPT: usize = 16;

/// A surface as it was sent to pages, with its number.
#[derive(Clone, Debug)]
pub struct Edition {
    /// Number of edits before this surface; 0 for the one that the program was started with.
    pub edit: u64,
    /// The surface after that edit.
    pub surface: Surface,
}

/// The most recent editions, the newest last.
#[derive(Debug, Default)]
pub struct Editions {
    kept: VecDeque<Arc<Edition>>,
    /// Number of the newest edit, shared with the worker that computes figures.
    newest: Arc<AtomicU64>,
}

impl Editions {
    /// Adds an edition. To be called before the surface is sent to any page.
    pub fn publish(&mut self, edition: Arc<Edition>) {
        if self.kept.len() == KEPT {
            self.kept.pop_front();
        }
        self.newest.store(edition.edit, Ordering::Relaxed);
        self.kept.push_back(edition);
    }

    /// Number of the newest edit, as a shared variable that every new edition changes.
    pub fn newest(&self) -> Arc<AtomicU64> {
        self.newest.clone()
    }

    /// The edition with the edit number that a page names; the newest if it names none.
    ///
    /// # Errors
    /// Reason in words why there is no such edition.
    pub fn find(&self, edit: Option<u64>) -> Result<Arc<Edition>, String> {
        let kept = &self.kept;
        let found = match edit {
            Some(edit) => kept.iter().rev().find(|edition| edition.edit == edit),
            None => kept.back(),
        };
        let range = || match (kept.front(), kept.back()) {
            (Some(first), Some(last)) => format!("{} to {}", first.edit, last.edit),
            _ => "none".into(),
        };
        found.cloned().ok_or_else(|| {
            let found = edit.map_or("none".into(), |edit| edit.to_string());
            format!("edit: expected {}, found {found}: the surface has changed meanwhile, try again", range())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::physics::design::papers_surface;

    #[test]
    fn a_page_is_answered_for_the_surface_that_it_names() {
        let mut editions = Editions::default();
        assert!(editions.find(None).is_err());
        for edit in 0..40 {
            let mut surface = papers_surface();
            surface.sheet.tension = 100.0 + edit as f64;
            editions.publish(Arc::new(Edition { edit, surface }));
        }
        assert_eq!(editions.find(None).unwrap().edit, 39);
        assert_eq!(editions.find(Some(30)).unwrap().surface.sheet.tension, 130.0);
        for gone in [3, 40] {
            let why = editions.find(Some(gone)).unwrap_err();
            assert!(why.contains("expected 24 to 39") && why.contains(&format!("found {gone}")), "{why}");
        }
    }
}
