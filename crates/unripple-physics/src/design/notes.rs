//! Notes on the figures of a design: their limits, and what they leave out.

use super::ground::Ground;
use super::left_out::left_out;
use super::limits::limits;
use super::{Design, Note, milliseconds};
use unripple_core::Surface;

/// The notes on the figures of a surface.
pub(super) fn notes(ground: &Ground<'_>, design: &Design) -> Vec<Note> {
    let mut notes = vec![which(ground, design), growth(design), power()];
    notes.extend(limits(ground.surface));
    notes.extend(rigid(ground));
    notes.extend(super::lattice::note(ground.surface));
    notes.extend(left_out(ground));
    notes
}

/// The note on which of the predicted contrasts to trust, and why they differ.
fn which(ground: &Ground<'_>, design: &Design) -> Note {
    let (refined, plain) = (design.contrast_predicted, design.contrast_plain);
    let statistics = "modal density and decay time against frequency, the rim and the first reflections";
    let text = match ground.loaded_contrast {
        Some(_) => format!(
            "{refined:.1} is the more reliable: the mean over many targets, computed from this surface's own modes with its actuators \
             at their places. Contrasts for other windows and numbers of actuators follow from the statistics of these modes, those for \
             other bands, noise and rates from the statistics of the band, all scaled to agree with it. For comparison, {plain:.1} is \
             the result of the plain form, with one modal density and one decay time for the whole band"
        ),
        None => format!(
            "{refined:.1}, by statistics of the band, is more reliable than {plain:.1}, the result of the plain form: the statistics \
             include {statistics}, while the plain form has one modal density and one decay time for the whole band. Since this \
             surface's own modes were not computed, both are means over all sheets like it; `focus` gives the contrast at a target"
        ),
    };
    Note { topic: "which contrast".into(), text }
}

/// The note that the modes include rigid-body motions, for a sheet without any edge that resists
/// displacement in a band from 0 Hz.
fn rigid(ground: &Ground<'_>) -> Option<Note> {
    let count = rigid_motions(ground.surface)?;
    let all = match &ground.counted {
        Ok(counted) => format!(" of the {counted} modes counted"),
        Err(_) => String::new(),
    };
    Some(Note {
        topic: "rigid motions".into(),
        text: format!(
            "nothing holds the sheet and the band begins at 0 Hz: {count}{all} {} at 0 Hz; a band that begins above 0 Hz excludes rigid \
             motions",
            if count == 1 { "is its motion as a rigid body," } else { "are its motions as a rigid body," }
        ),
    })
}

/// Number of rigid-body motions among the modes of a surface's band: 3 for a sheet without any edge that
/// resists displacement (up and down, and two tilts), 1 for such a sheet under tension, which resists
/// tilts. `None` if an edge resists displacement or the band begins above 0 Hz.
pub fn rigid_motions(surface: &Surface) -> Option<usize> {
    let free = !surface.outline.resists_displacement() && surface.emission.band[0] <= 0.0;
    free.then_some(if surface.sheet.tension > 0.0 { 1 } else { 3 })
}

/// The note on how contrast grows with the window, and why it does not grow as the square root of the
/// window.
fn growth(design: &Design) -> Note {
    Note {
        topic: "contrast".into(),
        text: format!(
            "around the recommended window it varies as T^{:.2}; as √T only where T is far below the Heisenberg time \
             ({} ms) and the decay time ({} ms)",
            design.window_exponent,
            milliseconds(design.heisenberg_time_s),
            milliseconds(design.decay_time_s)
        ),
    }
}

/// The note on what is meant by the power at a finger.
fn power() -> Note {
    Note {
        topic: "power at a finger".into(),
        text: "that of the incident wave at its crest; its mean over a period is half".into(),
    }
}
