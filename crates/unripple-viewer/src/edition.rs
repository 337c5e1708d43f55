//! The surfaces that pages were sent lately, by the number of the edit that made each.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use unripple::core::Surface;

/// Surfaces that can still be asked about: a page that lags behind by more has lost sight of what it asks.
const KEPT: usize = 16;

/// A surface as pages know it.
#[derive(Clone, Debug)]
pub struct Edition {
    /// How many edits came before; 0 for the surface that the program was started with.
    pub edit: u64,
    /// The surface after that edit.
    pub surface: Surface,
}

/// The newest of them.
#[derive(Debug, Default)]
pub struct Editions {
    kept: VecDeque<Arc<Edition>>,
    /// The newest edit, for whoever computes an older one elsewhere.
    newest: Arc<AtomicU64>,
}

impl Editions {
    /// Adds an edition, before any page is sent it.
    pub fn publish(&mut self, edition: Arc<Edition>) {
        if self.kept.len() == KEPT {
            self.kept.pop_front();
        }
        self.newest.store(edition.edit, Ordering::Relaxed);
        self.kept.push_back(edition);
    }

    /// The edit that is the newest, whenever it is looked at.
    pub fn newest(&self) -> Arc<AtomicU64> {
        self.newest.clone()
    }

    /// The one that a page speaks of; the newest where it does not say.
    ///
    /// # Errors
    /// Why there is none, in words.
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
