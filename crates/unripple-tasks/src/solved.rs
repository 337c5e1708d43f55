//! Cache of responses and windows that were computed from modes.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use unripple::act::{self, ActError};
use unripple::core::{Contact, Responses, Surface};
use unripple::physics::design::{Recommended, Windows};

/// Number of sets of responses in the cache: those of the band, those up to two and three times its top, on
/// which drives are evaluated, and those under fingers. Twice as many would hold twice the memory.
const KEPT: usize = 4;

/// Cache of the four sets of modal responses used last, of any surface, and of the windows of the last
/// surface. Clones share the cache.
///
/// ```
/// use unripple_tasks::Solved;
///
/// let film = unripple_store::load_surface("hudin-2012")?;
/// let solved = Solved::default();
/// let first = solved.model(&film, Some(3000.0), &[])?;
/// // Not computed again: the top of the band is 3 kHz.
/// let again = solved.model(&film, None, &[])?;
/// assert_eq!(first.ports(), again.ports());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Solved(Arc<Mutex<Kept>>);

/// Contents of the cache, in the order of last use.
#[derive(Debug, Default)]
struct Kept {
    models: Vec<Model>,
    windows: Option<(Surface, Windows)>,
}

/// One set of responses, with the surface, frequency and fingers that it was computed for.
#[derive(Debug)]
struct Model {
    surface: Surface,
    /// Highest frequency of the modes, in Hz.
    top: f64,
    contacts: Vec<Contact>,
    responses: Responses,
}

impl Solved {
    /// Responses as [`act::model`] computes them, from modes up to `max_hz` (Hz; by default the top of the
    /// surface's band), with fingers at `contacts`; returned from the cache if they are in it.
    ///
    /// # Errors
    /// Those of [`act::model`].
    pub fn model(
        &self,
        surface: &Surface,
        max_hz: Option<f64>,
        contacts: &[Contact],
    ) -> Result<Responses, ActError> {
        let top = max_hz.unwrap_or(surface.emission.band[1]);
        if let Some(found) = self.find(surface, top, contacts) {
            return Ok(found);
        }
        // Meanwhile others find what is kept.
        let responses = act::model(surface, Some(top), contacts)?;
        let mut kept = self.kept();
        // The first one was needed longest ago.
        if kept.models.len() == KEPT {
            kept.models.remove(0);
        }
        let (surface, contacts) = (surface.clone(), contacts.to_vec());
        kept.models.push(Model { surface, top, contacts, responses: responses.clone() });
        Ok(responses)
    }

    /// Default focusing window for a surface and its responses, as [`act::chosen_window`] computes it; the
    /// part that does not depend on the length of the responses is cached.
    pub fn window(&self, surface: &Surface, responses: &Responses) -> Recommended {
        let kept = self.kept().windows.clone().filter(|(known, _)| known == surface);
        let (_, windows) = kept.unwrap_or_else(|| {
            let solved = (surface.clone(), act::windows(surface, responses));
            self.kept().windows = Some(solved.clone());
            solved
        });
        act::chosen_among(&windows, responses)
    }

    /// Whether responses of the surface, from modes up to any frequency, are in the cache.
    pub fn knows(&self, surface: &Surface) -> bool {
        self.kept().models.iter().any(|model| model.surface == *surface)
    }

    fn find(&self, surface: &Surface, top: f64, contacts: &[Contact]) -> Option<Responses> {
        let mut kept = self.kept();
        let is_wanted =
            |model: &Model| model.top == top && model.contacts == contacts && model.surface == *surface;
        let at = kept.models.iter().position(is_wanted)?;
        let model = kept.models.remove(at);
        let responses = model.responses.clone();
        kept.models.push(model);
        Some(responses)
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
