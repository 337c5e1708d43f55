//! The modes that a drive is evaluated on: up to which frequency, and what a report says of them.

use super::model::inexact;
use super::{ActError, Note, Report};
use crate::core::{Memory, Responses, Surface};
use crate::physics::{PhysicsError, sampled_hz};

/// Highest frequency of the modes that drives are evaluated on by default, as a multiple of the top of the
/// band. A drive looks better on the modes that it was computed from than on a sheet, which has higher
/// modes as well. With twice this value, there are up to four times as many modes to compute.
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
    /// Note on why the modes end below the default frequency; `None` if they reach it.
    pub note: Option<Note>,
    /// Note on the accuracy of the natural frequencies, if it is lower than intended; else `None`.
    pub inexact: Option<Note>,
}

impl Judging {
    /// Calls `solve` with the highest frequency (Hz) of the modes to evaluate drives on: `asked`, or by
    /// default [`judged_hz`] with [`JUDGED_BANDS`]. If the modes up to the default need too much memory, or
    /// cannot be computed accurately enough, `solve` is called again for those of the band, and a note says
    /// so.
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
        solve: impl FnMut(f64) -> Result<T, ActError>,
    ) -> Result<(T, Self), ActError> {
        Self::among(surface, asked, &[JUDGED_BANDS], solve)
    }

    /// As [`Judging::of`], but the default frequencies are the multiples `bands` of the top of the band, in
    /// descending order: the first within reach is used, or the top of the band if none is.
    ///
    /// # Errors
    /// Those of `solve`.
    pub fn among<T>(
        surface: &Surface,
        asked: Option<f64>,
        bands: &[f64],
        solve: impl FnMut(f64) -> Result<T, ActError>,
    ) -> Result<(T, Self), ActError> {
        let Reached { found, hz, missed } = reached(surface, asked, bands, solve)?;
        Ok((found, Self { hz, note: missed.map(|missed| missed.on_judging(surface, hz)), inexact: None }))
    }

    /// Adds a note if the natural frequencies of `responses`, which were computed from these modes, are
    /// less accurate than intended.
    pub fn told_of(self, surface: &Surface, responses: &Responses) -> Self {
        Self { inexact: inexact(surface, responses), ..self }
    }

    /// Text on why the modes do not reach the default frequency or accuracy; `None` if they do.
    pub fn why(&self) -> Option<String> {
        let texts: Vec<&str> = self.note.iter().chain(&self.inexact).map(|note| note.text.as_str()).collect();
        (!texts.is_empty()).then(|| texts.join("; "))
    }

    /// Adds to a report the frequency up to which modes of `surface` were used for its metrics, and the
    /// notes on them.
    pub fn tell(&self, surface: &Surface, report: &mut Report) {
        report.judged_on = Some(format!("{}, modes up to {} Hz", surface.name, self.hz));
        report.notes.extend(self.note.iter().chain(&self.inexact).cloned());
    }
}

/// Result that was computed from the modes up to the highest frequency within reach.
#[derive(Clone, Debug)]
pub struct Reached<T> {
    /// The result, as `solve` in [`reached`] returned it.
    pub found: T,
    /// Highest frequency of the modes that were used, in Hz.
    pub hz: f64,
    /// The modes that should have been used, if they are out of reach; else `None`.
    pub missed: Option<Missed>,
}

/// Modes that are out of reach: too many for the memory, or not computable with the required accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct Missed {
    /// Highest frequency of the modes that are out of reach, in Hz.
    pub hz: f64,
    /// Why the modes are out of reach.
    pub error: ActError,
}

/// Calls `solve` with the highest frequency (Hz) of the modes to use: with `asked`, or by default with the
/// multiples `bands` of the top of the band, in descending order ([`judged_hz`]), until the modes fit into
/// memory and can be computed accurately enough; last with the top of the band itself.
///
/// # Errors
/// Those of `solve`.
pub fn reached<T>(
    surface: &Surface,
    asked: Option<f64>,
    bands: &[f64],
    mut solve: impl FnMut(f64) -> Result<T, ActError>,
) -> Result<Reached<T>, ActError> {
    if let Some(hz) = asked {
        return Ok(Reached { found: solve(hz)?, hz, missed: None });
    }
    let last = surface.emission.band[1];
    let mut tops: Vec<f64> = bands.iter().map(|bands| judged_hz(surface, *bands)).collect();
    // Multiples that the sample rate limits may be the same.
    tops.dedup();
    let mut missed = None;
    for hz in tops.into_iter().filter(|hz| *hz > last) {
        match solve(hz) {
            Ok(found) => return Ok(Reached { found, hz, missed }),
            // The first says what was wanted, and why it was not to be had.
            Err(error) if is_out_of_reach(&error) => {
                missed.get_or_insert(Missed { hz, error });
            }
            Err(error) => return Err(error),
        }
    }
    let found = solve(last)?;
    Ok(Reached { found, hz: last, missed })
}

impl Missed {
    /// A note that a drive on `surface` is evaluated on the modes up to `hz` (Hz) instead of the missed
    /// ones.
    fn on_judging(&self, surface: &Surface, hz: f64) -> Note {
        let Self { hz: wanted, error } = self;
        Note {
            topic: "judged on",
            text: format!(
                "the field is that of {}, since those up to {wanted} Hz are out of reach ({error}): a drive that was computed from the \
                 same modes looks better on them than on a sheet, which has modes above as well",
                told(surface, hz)
            ),
        }
    }

    /// A note that a drive for waveforms on `surface` is planned on the modes up to `hz` (Hz) instead of
    /// the missed ones.
    pub fn on_planning(&self, surface: &Surface, hz: f64) -> Note {
        let Self { hz: wanted, error } = self;
        Note {
            topic: "planned on",
            text: format!(
                "the drive is planned on {}, since those up to {wanted} Hz are out of reach ({error}): at low frequencies a sheet yields \
                 by modes far above as well, and targets follow their waveforms less closely than on those",
                told(surface, hz)
            ),
        }
    }
}

/// The modes of a surface up to `hz` (Hz), in words.
fn told(surface: &Surface, hz: f64) -> String {
    let of = if hz == surface.emission.band[1] { " of the band," } else { "" };
    format!("the modes{of} up to {hz} Hz")
}

/// Whether modes are out of reach by their number or accuracy, so that fewer of them may be within it: on every machine alike, so that what
/// only this one has no memory for is refused.
fn is_out_of_reach(error: &ActError) -> bool {
    match error {
        ActError::Physics(PhysicsError::TooLarge { needed_gib, .. }) => {
            !Memory::default().holds(needed_gib * Memory::GIB)
        }
        ActError::Physics(error) => {
            matches!(error, PhysicsError::NotConverged { .. } | PhysicsError::Solver { .. })
        }
        _ => false,
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
    fn of_several_multiples_of_the_band_the_highest_within_reach_counts() {
        let short_of = |most: f64| {
            move |hz: f64| match hz > most {
                true => Err(ActError::from(PhysicsError::Solver {
                    max_hz: hz,
                    found: format!("no factors at {hz} Hz"),
                })),
                false => Ok(hz),
            }
        };
        for (most, expected) in [(9000.0, 9000.0), (6000.0, 6000.0), (3000.0, 3000.0)] {
            let (found, judging) = Judging::among(&film(48e3), None, &[3.0, 2.0], short_of(most)).unwrap();
            assert_eq!((found, judging.hz), (expected, expected));
            assert_eq!(judging.note.is_some(), most < 9000.0);
            // What was wanted first, and why it was not to be had.
            let text = judging.note.map_or(String::new(), |note| note.text);
            assert!(most == 9000.0 || text.contains("no factors at 9000 Hz"), "{text}");
        }
        let beyond = Judging::among(&film(48e3), None, &[3.0, 2.0], short_of(1000.0)).unwrap_err();
        assert!(beyond.to_string().contains("3000 Hz"), "{beyond}");
    }

    #[test]
    fn what_was_asked_for_is_computed_or_refused() {
        for error in out_of_reach() {
            let refused = Judging::of(&film(48e3), Some(6000.0), short(error.clone())).unwrap_err();
            assert_eq!(refused, ActError::Physics(error.clone()));
            let (found, judging) = Judging::of(&film(48e3), Some(3000.0), short(error)).unwrap();
            assert_eq!((found, judging), (3000.0, Judging { hz: 3000.0, note: None, inexact: None }));
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
