//! Legal values in the file's units: those of the effects themselves, which are in SI.

use crate::surface::range::Limits;
use unripple_effects::limits as si;

const fn scaled([least, greatest]: [f64; 2], unit: &'static str, power: i32, factor: f64) -> Limits {
    Limits::new(unit, power, least * factor, greatest * factor)
}

const fn millimetres(range: [f64; 2]) -> Limits {
    scaled(range, "mm", -3, 1e3)
}

const fn milliseconds(range: [f64; 2]) -> Limits {
    scaled(range, "ms", -3, 1e3)
}

const fn plain(range: [f64; 2], unit: &'static str) -> Limits {
    scaled(range, unit, 0, 1.0)
}

/// Limits of each quantity by its name in the file, in the file's unit. The numbers are those of
/// `unripple_effects::limits`, so that no file passes what the player would refuse.
pub(super) const PITCH: Limits = millimetres(si::PITCH);
pub(super) const PLACE: Limits = millimetres(si::PLACE);
pub(super) const LENGTH: Limits = millimetres(si::LENGTH);
pub(super) const SCATTER: Limits = millimetres(si::SCATTER);
pub(super) const SPEED: Limits = scaled(si::SPEED, "mm/s", -3, 1e3);
pub(super) const TIME: Limits = milliseconds(si::TIME);
pub(super) const FADE: Limits = milliseconds(si::FADE);
pub(super) const PERIOD: Limits = milliseconds(si::PERIOD);
pub(super) const RATE: Limits = plain(si::RATE, "Hz");
pub(super) const FREQUENCY: Limits = plain(si::FREQUENCY, "Hz");
pub(super) const FORCE: Limits = plain(si::FORCE, "N");
pub(super) const SHARE: Limits = plain(si::SHARE, "");
pub(super) const FELT: Limits = plain(si::FELT, "dB above threshold");
pub(super) const HYSTERESIS: Limits = plain(si::HYSTERESIS, "of a pitch");
pub(super) const COUNT: Limits = Limits::new("", 0, 1.0, si::MOST_COUNT as f64);
/// Whole numbers that a file holds exactly: up to 2^53 - 1, past which a float64 skips some.
pub(super) const SEED: Limits = Limits::new("", 0, 0.0, 9_007_199_254_740_991.0);
/// Angles in degrees: two turns either way, more than any direction needs.
pub(super) const ANGLE: Limits =
    Limits { unit: "degrees", power: 0, turns: true, least: -720.0, greatest: 720.0 };

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the file's limits allow, the effects allow.
    #[test]
    fn file_and_effects_agree() {
        let pairs = [
            (PITCH, si::PITCH),
            (PLACE, si::PLACE),
            (LENGTH, si::LENGTH),
            (SCATTER, si::SCATTER),
            (SPEED, si::SPEED),
            (TIME, si::TIME),
            (FADE, si::FADE),
            (PERIOD, si::PERIOD),
        ];
        for (file, si) in pairs {
            for (value, expected) in [(file.least, si[0]), (file.greatest, si[1])] {
                assert_eq!(file.si(&format!("{value}")), Some(expected), "{file:?}");
            }
        }
        assert!(ANGLE.si("720").is_some_and(|angle| angle < si::ANGLE[1]));
    }
}
