//! The tables `[drive]` and `[finger]`.

use super::range::{Limits, of};
use super::reader::{Faults, Section};
use crate::decimal;
use unripple_core::{Emission, Finger};

/// Samples per second where a file does not say. 48 kHz, which every sound card has.
const DEFAULT_RATE: f64 = 48_000.0;

/// The table `[drive]`.
pub(super) fn read(section: &Section, faults: &mut Faults) -> Option<Emission> {
    section.check_keys(&["band_hz", "sample_rate_hz", "limit", "rms_limit"], |_| None, faults);
    let rate = section.number_or("sample_rate_hz", DEFAULT_RATE, &of::RATE, faults);
    let limit = section.number_or("limit", 1.0, &of::DRIVE, faults);
    let rms_limit = match section.get("rms_limit") {
        Some(entry) => entry.number(&of::DRIVE, faults).map(Some),
        None => Some(None),
    };
    let band = band(section, rate, faults);
    Some(Emission { band: band?, rate: rate?, limit: limit?, rms_limit: rms_limit? })
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
    let top = Limits { greatest: rate? / 2.0, ..of::FREQUENCY };
    if !top.allow(high) {
        let nearest = decimal::text(top.greatest, 0);
        let expected = format!("a band up to {nearest} Hz, half the sample rate");
        entry.refuse(
            expected,
            Some(format!("[{}, {nearest}]", decimal::text(low.min(top.greatest), 0))),
            faults,
        );
        return None;
    }
    Some([low, high])
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
