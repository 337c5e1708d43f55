//! The tables `[drive]` and `[finger]`.

use super::range::of;
use super::reader::{Faults, Section};
use crate::decimal;
use crate::wav::most_rate;
use unripple_core::{Emission, Finger};

/// Samples per second where a file does not say. 48 kHz, which every sound card has.
const DEFAULT_RATE: f64 = 48_000.0;

/// The table `[drive]`.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Emission> {
    section.check_keys(&["band_hz", "sample_rate_hz", "limit", "rms_limit"], |_| None, faults);
    let rate = rate(section, faults);
    let limit = section.number_or("limit", 1.0, &of::DRIVE, faults);
    let rms_limit = match section.get("rms_limit") {
        Some(entry) => entry.number(&of::DRIVE, faults).map(Some),
        None => Some(None),
    };
    let band = band(section, rate, faults);
    Some(Emission { band: band?, rate: rate?, limit: limit?, rms_limit: rms_limit? })
}

/// Samples per second, a whole number.
fn rate(section: &Section, faults: &mut Faults) -> Option<f64> {
    let Some(entry) = section.get("sample_rate_hz") else { return Some(DEFAULT_RATE) };
    let rate = entry.number(&of::RATE, faults)?;
    if rate.fract() == 0.0 {
        return Some(rate);
    }
    let expected = "a whole number of Hz, since the header of a WAV file holds no other";
    entry.refuse(expected, of::RATE.nearest(rate.round()), faults);
    None
}

fn band(section: &Section, rate: Option<f64>, faults: &mut Faults) -> Option<[f64; 2]> {
    let shape = "[lowest, highest] in Hz";
    let entry = section.require("band_hz", shape, faults)?;
    let [low, high] = entry.numbers::<2>(&of::FREQUENCY, shape, faults)?;
    if high <= low {
        let expected = format!("{shape}, the second above the first");
        let swapped = format!("[{}, {}]", decimal::text(high, 0), decimal::text(low, 0));
        entry.refuse(expected, (high < low).then_some(swapped), faults);
        return None;
    }
    let half = rate? / 2.0;
    if high < half {
        return Some([low, high]);
    }
    let written = |hz: f64| decimal::text(hz, 0);
    // The highest whole frequency below half the rate.
    let most = half.ceil() - 1.0;
    let nearest = (low < most).then(|| format!("[{}, {}]", written(low), written(most)));
    entry.refuse(format!("a band below {} Hz, half the sample rate", written(half)), nearest, faults);
    None
}

/// A fault if the header of a WAV file, which counts the bytes of a second, cannot hold the sample rate of a drive of so many actuators.
pub(super) fn carry(root: &Section, emission: &Emission, actuators: usize, faults: &mut Faults) {
    let most = most_rate(actuators);
    let entry = root.get("drive").and_then(|drive| drive.section(faults)?.get("sample_rate_hz"));
    if let Some(entry) = entry.filter(|_| emission.rate > most) {
        let most = decimal::text(most, 0);
        let expected =
            format!("at most {most} Hz with {actuators} actuators, since a WAV file holds no more");
        entry.refuse(expected, Some(most), faults);
    }
}

/// The table `[finger]`: every key has the default finger's value.
pub(super) fn finger(section: &Section, faults: &mut Faults) -> Option<Finger> {
    let keys = ["mass_g", "damping_n_s_per_m", "stiffness_n_per_mm", "contact_radius_mm"];
    section.check_keys(&keys, |_| None, faults);
    let default = Finger::default();
    let mass = section.number_or(keys[0], default.mass, &of::FINGER_MASS, faults);
    let damping = section.number_or(keys[1], default.damping, &of::FINGER_DAMPING, faults);
    let stiffness = section.number_or(keys[2], default.stiffness, &of::FINGER_STIFFNESS, faults);
    let radius = section.number_or(keys[3], default.contact_radius, &of::CONTACT_RADIUS, faults);
    Some(Finger { mass: mass?, damping: damping?, stiffness: stiffness?, contact_radius: radius? })
}
