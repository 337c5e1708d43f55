//! The modes that a drive is evaluated on: up to which frequency, and what a report says of them.

use super::{ActError, Note, Report};
use crate::core::Surface;
use crate::physics::{PhysicsError, sampled_hz};

/// Multiple of the band up to which the modes go that drives are evaluated on by default. On the modes that it was computed from a
/// drive looks better than on a sheet, which has modes above as well. Doubled, there are up to four times as many modes to compute.
pub const JUDGED_BANDS: f64 = 2.0;

/// Highest frequency (Hz) of the modes that drives are evaluated on: `bands` times the top of the surface's band, at most 0.45 of its
/// sample rate, but never below the top of the band.
pub fn judged_hz(surface: &Surface, bands: f64) -> f64 {
    let top = surface.emission.band[1];
    sampled_hz(surface, bands * top, top)
}

/// The modes that a drive was evaluated on.
#[derive(Clone, Debug, PartialEq)]
pub struct Judging {
    /// Highest frequency of the modes, in Hz.
    pub hz: f64,
    /// Reason why the modes end at the top of the band, where those up to the default frequency are out of reach.
    pub note: Option<Note>,
}

impl Judging {
    /// Calls `solve` with the highest frequency (Hz) of the modes to evaluate drives on: `asked`, or by default [`judged_hz`] with
    /// [`JUDGED_BANDS`]. Where the modes up to the default are too many for the memory, or not to be had with the accuracy, `solve` is
    /// called again for those of the band, and a note says so.
    ///
    /// ```
    /// use unripple::act::{Judging, model};
    ///
    /// let mut film = unripple::physics::design::papers_surface();
    /// film.emission.band = [0.0, 700.0];
    /// let (responses, judging) = Judging::of(&film, None, |hz| model(&film, Some(hz), &[]))?;
    /// assert_eq!((judging.hz, judging.note), (1400.0, None));
    /// assert_eq!(responses.conditions().band, [0.0, 700.0]);
    /// # Ok::<(), unripple::act::ActError>(())
    /// ```
    ///
    /// # Errors
    /// Those of `solve`.
    pub fn of<T>(
        surface: &Surface,
        asked: Option<f64>,
        mut solve: impl FnMut(f64) -> Result<T, ActError>,
    ) -> Result<(T, Self), ActError> {
        let top = surface.emission.band[1];
        let hz = asked.unwrap_or_else(|| judged_hz(surface, JUDGED_BANDS));
        match solve(hz) {
            Err(error) if asked.is_none() && hz > top && is_out_of_reach(&error) => {
                let note = Some(within_the_band(top, hz, &error));
                Ok((solve(top)?, Self { hz: top, note }))
            }
            found => Ok((found?, Self { hz, note: None })),
        }
    }

    /// Adds to a report what its metrics were computed on: the modes of `surface` up to this frequency, with the note.
    pub fn tell(&self, surface: &Surface, report: &mut Report) {
        report.judged_on = Some(format!("{}, modes up to {} Hz", surface.name, self.hz));
        report.notes.extend(self.note.clone());
    }
}

/// Whether modes are out of reach by their number or accuracy, so that fewer of them may be within it.
fn is_out_of_reach(error: &ActError) -> bool {
    matches!(
        error,
        ActError::Physics(
            PhysicsError::TooLarge { .. } | PhysicsError::NotConverged { .. } | PhysicsError::Solver { .. }
        )
    )
}

/// A note that a drive is evaluated on the modes up to `top` (Hz) instead of those up to `hz`.
fn within_the_band(top: f64, hz: f64, error: &ActError) -> Note {
    Note {
        topic: "judged on",
        text: format!(
            "the field is that of the modes of the band, up to {top} Hz, since those up to {hz} Hz are out of reach ({error}): a \
             drive that was computed from the same modes looks better on them than on a sheet, which has modes above as well"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::design::papers_surface;
    use unripple_core::OutOfRange;

    /// The paper's film, whose band ends at 3 kHz, with another sample rate.
    fn film(rate: f64) -> Surface {
        let mut film = papers_surface();
        film.emission.rate = rate;
        film
    }

    #[test]
    fn modes_go_to_twice_the_band_and_as_far_as_samples_tell_them_apart() {
        let cases = [(48e3, 6000.0), (13.4e3, 6000.0), (9e3, 4050.0), (6.4e3, 3000.0), (1.0, 3000.0)];
        for (rate, expected) in cases {
            assert_eq!(judged_hz(&film(rate), JUDGED_BANDS), expected, "{rate} Hz");
        }
        assert_eq!(judged_hz(&film(48e3), 1.0), 3000.0);
        assert_eq!(judged_hz(&film(48e3), 3.0), 9000.0);
    }

    /// Finds the modes up to the top of the band and none above.
    fn short(error: PhysicsError) -> impl Fn(f64) -> Result<f64, ActError> {
        move |hz| if hz > 3000.0 { Err(error.clone().into()) } else { Ok(hz) }
    }

    fn out_of_reach() -> [PhysicsError; 3] {
        let max_hz = 6000.0;
        [
            PhysicsError::TooLarge {
                max_hz,
                unknowns: 70_000,
                needed_gib: 5.5,
                limit_gib: 4.0,
                nearest_hz: 5000.0,
            },
            PhysicsError::NotConverged { max_hz, expected: 1e-4, found: 2e-3 },
            PhysicsError::Solver { max_hz, found: "no factors".into() },
        ]
    }

    #[test]
    fn where_twice_the_band_is_out_of_reach_the_band_counts_and_a_note_says_why() {
        for error in out_of_reach() {
            let why = error.to_string();
            let (found, judging) = Judging::of(&film(48e3), None, short(error)).unwrap();
            assert_eq!((found, judging.hz), (3000.0, 3000.0));
            let note = judging.note.unwrap();
            assert_eq!(note.topic, "judged on");
            assert!(note.text.contains("up to 3000 Hz, since those up to 6000 Hz"), "{}", note.text);
            assert!(note.text.contains(&why), "{}", note.text);
        }
    }

    #[test]
    fn what_was_asked_for_is_computed_or_refused() {
        for error in out_of_reach() {
            let refused = Judging::of(&film(48e3), Some(6000.0), short(error.clone())).unwrap_err();
            assert_eq!(refused, ActError::Physics(error.clone()));
            let (found, judging) = Judging::of(&film(48e3), Some(3000.0), short(error)).unwrap();
            assert_eq!((found, judging), (3000.0, Judging { hz: 3000.0, note: None }));
        }
        // What is wrong with fewer modes as well is an error at once.
        let wrong = OutOfRange::new("sample rate in Hz", "a positive number", 0.0);
        let mut calls = 0;
        let refused = Judging::of(&film(48e3), None, |_| {
            calls += 1;
            Err::<f64, _>(ActError::Range(wrong.clone()))
        });
        assert_eq!((refused.unwrap_err(), calls), (ActError::Range(wrong), 1));
    }
}
