//! The tension of the sheet that explains the recordings best.

use super::agreement::Agreement;
use super::lines::Spectrum;
use super::model::Model;

/// Largest change of tension that is searched for, as a share, and the number of steps to it. A step of a quarter of a per cent
/// turns a wave of 1 kHz that rings for 70 ms by half a radian, so that no maximum is missed; twice as many cost twice the time.
const MOST: f64 = 0.06;
const STEPS: i32 = 24;

/// Number of times that the interval around the best step is shortened by the golden ratio: to 1e-5 of the tension.
const SHORTENED: usize = 12;

/// The golden ratio's inverse, by which an interval is shortened so that one of two inner points serves again.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Finds the tension, relative to the model's, under which the model explains the recordings best, and the agreement there.
pub(super) fn search(model: &Model, heard: &[Spectrum], drive: &[Spectrum]) -> (f64, Agreement) {
    let at = |ratio: f64| (ratio, Agreement::of(model.lines(), heard, &model.predict(drive, ratio)));
    let step = MOST / f64::from(STEPS);
    let tried = (-STEPS..=STEPS).map(|n| at(1.0 + f64::from(n) * step));
    let Some(mut best) = tried.min_by(|a, b| a.1.left.total_cmp(&b.1.left)) else { return at(1.0) };
    let [mut low, mut high] = [best.0 - step, best.0 + step];
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let [mut one, mut two] = inner(low, high).map(at);
    for _ in 0..SHORTENED {
        for tried in [one, two] {
            if tried.1.left < best.1.left {
                best = tried;
            }
        }
        if one.1.left < two.1.left {
            (high, two) = (two.0, one);
            one = at(inner(low, high)[0]);
        } else {
            (low, one) = (one.0, two);
            two = at(inner(low, high)[1]);
        }
    }
    best
}
