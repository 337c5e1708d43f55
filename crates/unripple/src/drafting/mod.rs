//! Results that follow an edit of a surface, the quickest first: closed-form figures, a focus at one place, a map of
//! contrast.

mod figures;
mod spot;

pub use figures::{Figure, figures};
pub use spot::Spot;

use crate::act::{Act, ActError, Acted, Judging, Level, accuracy, model};
use crate::contrast_map::{ContrastMap, MapOptions, contrast_map};
use crate::core::{Point, Responses, Surface};
use crate::focus::{Options, Target};
use crate::physics::design::{Design, design_by_law, design_on};
use crate::physics::{Modes, PhysicsError, ResponseOptions, response_modes, responses_on};
use std::sync::{Arc, OnceLock};

/// A surface being designed: its modes are computed once, and all results are derived from them.
///
/// Results in the order in which they become available, the quickest first: [`Draft::by_law`], [`Draft::of`] with
/// [`Draft::figures`], [`Draft::spot`], [`Draft::map`], and [`Draft::focus`] for all metrics of a focus.
///
/// ```
/// use unripple::core::Point;
/// use unripple::drafting::Draft;
///
/// let surface = unripple::physics::design::papers_surface();
/// let by_law = Draft::by_law(&surface)?; // at once
/// let draft = Draft::of(&surface)?; // modes solved
/// let predicted = |draft: &[unripple::drafting::Figure]| draft[0].value;
/// // Before the modes are known the window is chosen by their statistics, and is another.
/// assert!((predicted(&by_law) / predicted(&draft.figures()) - 1.0).abs() < 0.15);
/// let spot = draft.spot(Point::from_mm(62.0, 90.0), None)?;
/// assert!((spot.contrast.unwrap_or(0.0) - 25.116).abs() < 0.001);
/// let map = draft.map(None, 24)?;
/// assert!(map.contrast.iter().flatten().count() == 24 * 24);
/// # Ok::<(), unripple::act::ActError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Draft {
    surface: Surface,
    design: Design,
    modes: Result<Arc<Modes>, PhysicsError>,
    responses: OnceLock<Result<Arc<Responses>, ActError>>,
    judged: OnceLock<Result<(Arc<Responses>, Judging), ActError>>,
}

impl Draft {
    /// Figures of a surface estimated by Weyl's law, without computing its modes; takes milliseconds.
    ///
    /// # Errors
    /// Those of [`design_by_law`].
    pub fn by_law(surface: &Surface) -> Result<Vec<Figure>, ActError> {
        Ok(figures(&design_by_law(surface, "not counted yet")?))
    }

    /// Computes the modes of a surface. If that fails, the draft has figures by Weyl's law and no responses.
    ///
    /// # Errors
    /// Those of [`design()`](crate::physics::design()).
    pub fn of(surface: &Surface) -> Result<Self, ActError> {
        let modes = response_modes(surface, &options(surface)).map(Arc::new);
        let design = match &modes {
            Ok(modes) => design_on(surface, modes)?,
            Err(error) => design_by_law(surface, error.to_string())?,
        };
        let (responses, judged) = (OnceLock::new(), OnceLock::new());
        Ok(Self { surface: surface.clone(), design, modes, responses, judged })
    }

    /// The surface of this draft.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// All results of `unripple design` for the surface.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The main figures of the design, the most important first.
    pub fn figures(&self) -> Vec<Figure> {
        figures(&self.design)
    }

    /// The responses of the surface, as `unripple focus` computes them. The first call computes them, which takes long
    /// where coils load the surface; later calls return the same ones.
    ///
    /// # Errors
    /// [`ActError::Physics`] if the modes or the responses cannot be computed.
    pub fn responses(&self) -> Result<&Arc<Responses>, ActError> {
        let found = self.responses.get_or_init(|| {
            let modes = self.modes.clone()?;
            Ok(Arc::new(responses_on(&self.surface, modes, &options(&self.surface))?))
        });
        found.as_ref().map_err(Clone::clone)
    }

    /// The responses on which `unripple focus` evaluates drives on the surface, and the frequency up to
    /// which their modes reach ([`Judging::of`]). The first call computes them; later calls return the same
    /// ones.
    ///
    /// # Errors
    /// Those of [`model`] and [`Draft::responses`].
    pub fn judged(&self) -> Result<&(Arc<Responses>, Judging), ActError> {
        let found = self.judged.get_or_init(|| {
            Judging::of(&self.surface, None, |hz| {
                if hz > self.surface.emission.band[1] {
                    return Ok(Arc::new(model(&self.surface, Some(hz), &[])?));
                }
                self.responses().cloned()
            })
            .map(|(responses, judging)| {
                let judging = judging.told_of(&self.surface, &responses);
                (responses, judging)
            })
        });
        found.as_ref().map_err(Clone::clone)
    }

    /// Computes a time-reversal focus at one point (m), evaluated only at its focal instant and on the
    /// modes of the band, as in [`Draft::map`]: it has the contrast of `unripple focus` with `--judge-hz`
    /// at the top of the band. The window has `window` seconds, or is the recommended one.
    ///
    /// # Errors
    /// Those of [`Draft::responses`], [`focus`](crate::focus::focus()) and [`Field::snapshots`](crate::field::Field::snapshots).
    pub fn spot(&self, at: Point, window: Option<f64>) -> Result<Spot, ActError> {
        spot::spot(self.responses()?, at, &self.options(window))
    }

    /// Computes a time-reversal focus at one point (m) with all metrics of `unripple focus`, with a window
    /// of `window` seconds or the recommended one.
    ///
    /// # Errors
    /// Those of [`Draft::responses`], [`Draft::judged`] and [`Act::run_from`].
    pub fn focus(&self, at: Point, window: Option<f64>) -> Result<Acted, ActError> {
        let (targets, options) = (&[Target::at(at)], &self.options(window));
        let (known, (responses, _)) = (self.responses()?, self.judged()?);
        let act = Act { surface: &self.surface, responses, targets, options, level: Level::default() };
        act.run_from(known, &act.readouts())
    }

    fn options(&self, window: Option<f64>) -> Options {
        let emission = &self.surface.emission;
        let (limit, rms_limit, window) = (emission.limit, emission.rms_limit, self.window(window));
        Options { window, limit, rms_limit, ..Options::default() }
    }

    /// The requested window, or the one recommended for the surface, in s.
    fn window(&self, asked: Option<f64>) -> f64 {
        asked.unwrap_or(self.design.window_recommended_s)
    }

    /// The contrast of time reversal over the whole surface, on `across` cells along its longer side, with a window of
    /// `window` seconds or the recommended one.
    ///
    /// # Errors
    /// Those of [`Draft::responses`] and [`contrast_map`].
    pub fn map(&self, window: Option<f64>, across: usize) -> Result<ContrastMap, ActError> {
        let options = MapOptions { window: self.window(window), across, ..MapOptions::default() };
        contrast_map(self.responses()?, &options)
    }
}

fn options(surface: &Surface) -> ResponseOptions {
    ResponseOptions { accuracy: accuracy(surface), ..ResponseOptions::default() }
}
