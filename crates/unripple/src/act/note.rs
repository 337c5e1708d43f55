//! Notes that go with the results of a focus.

use super::beyond::Beyond;
use crate::core::{Drive, Surface};
use crate::field::{Measured, TakenOn, TargetFigures, Threshold};
use crate::focus::{Focused, Target};
use crate::physics::design::{Linearity, limits, rigid_motions};
use serde::Serialize;

/// Topic of the note on why felt levels are not valid; a report that has such a note is worded accordingly.
pub(super) const FELT: &str = "felt";

/// Share of energy above what the threshold of touch was measured to, from which on levels as felt do not hold. With twice this value,
/// motion of which two fifths of the amplitude (√0.2) are too fast would pass.
const FAST: f64 = 0.1;

/// Share of the time over which touch adds up vibration, below which a motion is too short for levels as felt: half as long, it must be
/// 4 dB larger, 10 log10(1/(1 − e^{−1/2})). Doubled, 2 dB, a third of the spread between persons, would be remarked on.
const SHORT: f64 = 0.5;

/// Share of the surface outside the focal discs below which a note gives it. Larger, discs that leave most of the surface would
/// be remarked on.
const LITTLE: f64 = 0.5;

/// Number of a library's points outside the focal discs below which a note gives it: an rms over fewer is off by more than a
/// tenth by chance (1/√(2n)). With twice this value, by more than 7 %.
const FEW: usize = 50;

/// A remark or warning that goes with the results.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Note {
    /// Topic of the note, in a word or two.
    pub topic: &'static str,
    /// The note, a sentence or two.
    pub text: String,
}

/// Notes on targets for which the nearest stored points of a library are used.
pub fn nearby(focused: &Focused, targets: &[Target]) -> Vec<Note> {
    let places = targets.iter().zip(&focused.points).filter_map(|(target, used)| {
        let (asked, stored) = (*target.points.first()?, *used.first()?);
        let apart = asked.distance(stored);
        (apart > 1e-9).then(|| Note {
            topic: "library",
            text: format!(
                "{stored} is used for {asked}, {:.2} mm away: it is the nearest finished point",
                apart * 1e3
            ),
        })
    });
    places.collect()
}

/// Warnings that go with the metrics of a field.
pub(super) fn all(surface: &Surface, measured: &Measured, largest: f64, found: &Linearity) -> Vec<Note> {
    let mut notes = linear_theory(surface, largest, found);
    notes.extend(limits(surface).into_iter().map(|limit| Note { topic: "model", text: limit.text }));
    if measured.taken_on == TakenOn::Library {
        notes.push(Note {
            topic: "linear theory",
            text: "slopes, added tension and strain are not known between the points of a library: only the displacement at its points \
                   is compared with the limits of linear theory".into(),
        });
    }
    if measured.targets.iter().any(|target| !target.span_complete) {
        notes.push(Note {
            topic: "span",
            text: "the responses end before twice the focal instant: background contrast and worst spot are those of the known \
                part".into(),
        });
    }
    notes.extend(rigid(surface).filter(|_| measured.taken_on == TakenOn::Grid));
    notes.extend(outside(measured));
    notes.extend(felt(measured));
    notes
}

/// A note that a sheet which nothing holds moves as a rigid body, too, in a band from 0 Hz.
fn rigid(surface: &Surface) -> Option<Note> {
    let count = rigid_motions(surface)?;
    let motions =
        if count == 1 { "its motion as a rigid body is" } else { "its 3 motions as a rigid body are" };
    Some(Note {
        topic: "rigid motions",
        text: format!(
            "nothing holds the sheet and the band begins at 0 Hz, so that {motions} among the modes: a drive moves the sheet as a \
             whole, in proportion to the sum of its samples and to the decay time, and displacements and felt levels include this \
             motion; a band that begins above 0 Hz excludes it"
        ),
    })
}

/// A note on ratios that are not known, or taken over little, since hardly anything lies outside the focal discs.
fn outside(measured: &Measured) -> Option<Note> {
    let Measured { focal_radius_m, taken_on, outside_points, outside_share, .. } = *measured;
    let discs = format!("the focal discs of radius {:.1} mm", focal_radius_m * 1e3);
    let text = match taken_on {
        TakenOn::Grid if outside_points == 0 => {
            format!(
                "no place lies outside {discs}, so that there is no contrast and no motion elsewhere to compare with"
            )
        }
        TakenOn::Library if outside_points == 0 => {
            format!(
                "no point of the library lies outside {discs}, so that there is no contrast: it needs points farther away"
            )
        }
        TakenOn::Grid if outside_share < LITTLE => format!(
            "contrast and other ratios are taken over {:.1} % of the surface, all that lies outside {discs}",
            100.0 * outside_share
        ),
        TakenOn::Library if outside_points < FEW => format!(
            "contrast and other ratios are taken over {outside_points} of the library's points, all that lie outside {discs}: an \
             rms over so few is uncertain by {:.0} %",
            100.0 / (2.0 * outside_points as f64).sqrt()
        ),
        TakenOn::Grid | TakenOn::Library => return None,
    };
    Some(Note { topic: "outside", text })
}

/// A note on why levels as felt do not hold for a motion: it is too fast or too short for the threshold of touch.
fn felt(measured: &Measured) -> Option<Note> {
    let targets = &measured.targets;
    let share = |of: fn(&TargetFigures) -> Option<f64>| targets.iter().filter_map(of).reduce(f64::max);
    let here = share(|target| Some(target.share_above_1khz)).unwrap_or(0.0);
    let elsewhere = share(|target| target.worst_spot_share_above_1khz);
    let lasts = targets.iter().filter_map(|target| target.felt_duration_s).fold(f64::INFINITY, f64::min);
    let at = if targets.len() > 1 { "a target" } else { "the target" };
    let mut why = Vec::new();
    if here.max(elsewhere.unwrap_or(0.0)) > FAST {
        let there = elsewhere.map_or(String::new(), |share| {
            format!(" and {:.0} % of that at the strongest place elsewhere", 100.0 * share)
        });
        why.push(format!(
            "above {:.0} Hz lie {:.0} % of the energy of the velocity at {at}{there}; at such frequencies the surface loses contact \
             with the skin, and transients are felt by other mechanisms (pulses of 7 µm, of waves above 20 kHz, were felt although they \
             are below this threshold: Hudin, Lozada and Hayward 2015)",
            Threshold::MEASURED_TO_HZ,
            100.0 * here
        ));
    }
    if lasts < SHORT * Threshold::INTEGRATION_S {
        why.push(format!(
            "what is felt at {at} lasts {:.0} ms: the sense of touch integrates vibration over some {:.0} ms, and so short a motion \
             must be larger to be felt",
            1e3 * lasts,
            1e3 * Threshold::INTEGRATION_S
        ));
    }
    let holds = "the threshold of touch is that of sustained vibration, and felt levels are not valid here";
    (!why.is_empty()).then(|| Note { topic: FELT, text: format!("{holds}: {}", why.join("; ")) })
}

/// Notes on what linear theory cannot say of a field with a displacement of `largest` metres.
fn linear_theory(surface: &Surface, largest: f64, found: &Linearity) -> Vec<Note> {
    let um = |metres: f64| metres * 1e6;
    let mut notes = Vec::new();
    let mut note = |text| notes.push(Note { topic: "linear theory", text });
    if surface.sheet.thickness > 0.0 && found.displacement_over_thickness > 1.0 {
        note(format!(
            "the largest displacement, {:.0} µm, is above the sheet's thickness of {:.0} µm: the sheet would stretch as \
             much as it bends, and linear theory does not hold",
            um(largest),
            um(surface.sheet.thickness)
        ));
    }
    if let Some(change) = found.tension_change.filter(|change| *change > 0.1) {
        note(format!(
            "slopes of up to {:.3} add {:.1} N/m to the tension, {:.0} % of it: above 10 %, the wave speed depends on the \
             amplitude, and linear theory does not hold",
            found.slope,
            found.tension_added_n_per_m,
            100.0 * change
        ));
    }
    if let Some(share) = found.share_of_yield.filter(|share| *share > 1.0) {
        note(format!(
            "the strain is {:.2e} at the faces by bending and {:.2e} in the mid-plane by stretching: with the tension, {share:.1} times \
             the strain at which the sheet yields",
            found.bending_strain, found.stretching_strain
        ));
    }
    notes
}

/// A note that the drive is at its limit because the sheet's thickness is unknown, so that no bound of
/// linear theory is known.
pub(super) fn unknown(surface: &Surface, drive: &Drive) -> Option<Note> {
    let known = surface.sheet.thickness > 0.0;
    (!known && drive.peak() > 0.0).then(|| Note {
        topic: "level",
        text: "how far linear theory holds is not known, since the sheet has no thickness: the drive is at its limit, and \
               displacements may be beyond linear theory"
            .into(),
    })
}

/// A note that a drive is at its limit, because the requested level is above that of the limit.
pub(super) fn beyond(beyond: &Beyond) -> Note {
    let Beyond { most, wanted, unit, .. } = beyond;
    Note {
        topic: "level",
        text: format!("reaches {most} at the drive limit, not the {wanted} {unit} asked for"),
    }
}
