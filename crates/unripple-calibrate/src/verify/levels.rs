//! Comparison of the points' gains with each other.

use super::judge::{Judged, Kind};
use unripple_dsp::median;

/// Smallest difference of two gains, as a logarithm, at which they count as different: 15 %.
const ANOTHER: f64 = 0.14;

/// Largest distance from 1, as a logarithm, of a gain relative to the sensors' that is accepted if two
/// points disagree: also 15 %.
const ONE: f64 = 0.14;

/// Largest ratio of the unexplained share at another place to that at the stated one for the probe to count
/// as having been at the other. Near errors of the model, such as a stray mass that it does not include, the
/// ratio is 0.65 or more; for a probe that was a tenth of a wavelength off, it is less than half.
const CLEARLY: f64 = 0.6;

/// Number of standard errors by which a gain has to differ to be corrected. By chance one point in 370 differs by that.
const SURE: f64 = 3.0;

/// The gain that most points have, and the gain relative to which others are expressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    /// The gain of most points, its sign included; `None` if no two points agree.
    pub common: Option<f64>,
    /// The gain relative to which others are expressed: the common gain, or the median of their magnitudes
    /// if there is none.
    pub scale: f64,
}

impl Levels {
    /// The common gain of the points that fit their places.
    pub fn of(judged: &[Judged]) -> Self {
        let gains: Vec<f64> =
            judged.iter().filter(|j| j.kind == Kind::Here).map(|j| j.nearby.found.gain).collect();
        let scale = median(gains.iter().map(|g| g.abs())).unwrap_or(1.0);
        let agree = |g: f64| gains.iter().filter(|other| same(**other, g)).count();
        // The gain on which most points agree; of two different gains, the one that equals the sensors'.
        let best = gains.iter().copied().max_by(|a, b| agree(*a).cmp(&agree(*b)));
        let common = match (best, gains.len()) {
            (Some(best), n) if n < 3 || 2 * agree(best) > n => Some(best),
            _ => None,
        };
        let split = gains.len() == 2 && common.is_some_and(|c| agree(c) < 2);
        let common = match split {
            true => {
                Some(gains.iter().copied().filter(|g| *g > 0.0 && g.ln().abs() < ONE).collect::<Vec<_>>())
                    .filter(|own| own.len() == 1)
                    .map(|own| own[0])
            }
            false => common,
        };
        let typical =
            |common: f64| median(gains.iter().copied().filter(|g| same(*g, common))).unwrap_or(common);
        let common = common.map(typical);
        Self { common, scale: common.unwrap_or(scale) }
    }

    /// Whether the probe was probably not at the point's stated place but at a place nearby (the one that
    /// explains the responses best). It must explain them clearly better, with a gain that is either that of
    /// the stated place or the common gain of all points: beside a rim and near nodes another place differs
    /// by little else than a gain, so that a wrong gain alone would look like another place.
    pub fn moved(&self, judged: &Judged) -> bool {
        let [own, nearby] = [judged.own, judged.nearby.found];
        let one = |common: f64| same(nearby.gain.abs(), common.abs());
        nearby.unexplained() < CLEARLY * own.unexplained()
            && (same(nearby.gain, own.gain) || self.common.is_none_or(one))
    }

    /// The gain of a point relative to the sensors, a ratio: at its stated place, or at the place nearby if
    /// it was [moved](Self::moved).
    pub fn gain(&self, judged: &Judged) -> f64 {
        if self.moved(judged) { judged.nearby.found.gain } else { judged.own.gain }
    }

    /// Factor that would bring a point's responses to the common gain; `None` if they have that gain
    /// already, or if there is no common gain.
    pub fn factor_to_common(&self, judged: &Judged) -> Option<f64> {
        let gain = self.gain(judged);
        self.common.filter(|common| !same(gain, *common)).map(|common| common / gain)
    }

    /// The factor of [`Levels::factor_to_common`], if it is certain; otherwise `None`. Two conditions hold
    /// then. The gains at the stated place and at the best place nearby are equal, and neither is the common
    /// one, since a probe a little beside its place has another gain near a node. And the factor is negative,
    /// or its logarithm exceeds three standard errors, which follow from the share that the model leaves
    /// unexplained and the number of `actuators`.
    pub fn correction(&self, judged: &Judged, actuators: usize) -> Option<f64> {
        let [own, nearby] = [judged.own, judged.nearby.found];
        let left = own.unexplained().max(nearby.unexplained());
        let error =
            left / (1.0 - left * left).max(f64::MIN_POSITIVE).sqrt() / (actuators.max(1) as f64).sqrt();
        let sure = |factor: &f64| *factor < 0.0 || factor.ln().abs() > SURE * error;
        let common = |gain: f64| self.common.is_some_and(|common| same(gain, common));
        let both = same(own.gain, nearby.gain) && !common(own.gain) && !common(nearby.gain);
        self.factor_to_common(judged).filter(|_| both).filter(sure)
    }
}

/// Whether two gains count as equal.
pub(super) fn same(a: f64, b: f64) -> bool {
    a * b > 0.0 && (a / b).ln().abs() < ANOTHER
}

#[cfg(test)]
mod tests {
    use super::super::checker::Match;
    use super::super::sheet::Spot;
    use super::*;
    use unripple_core::Point;

    /// A point that fits where it is, with its gain at its own place and nearby, and what is left unexplained.
    fn point(own: f64, nearby: f64, unexplained: f64) -> Judged {
        let likeness = (1.0 - unexplained * unexplained).sqrt();
        let found = Match { likeness, gain: nearby };
        let nearby = Spot { at: Point::new(0.0, 0.0), late: 0.0, found };
        Judged { own: Match { likeness, gain: own }, nearby, error: 0.0, kind: Kind::Here }
    }

    /// What was found of good points beside the rim of a film with stray masses: the gain beside the rim itself has no limit.
    #[test]
    fn another_place_counts_if_it_explains_more_by_one_gain() {
        let found =
            |unexplained: f64, gain: f64| Match { likeness: (1.0 - unexplained * unexplained).sqrt(), gain };
        let at = |own: (f64, f64), nearby: (f64, f64)| {
            let mut one = point(own.1, nearby.1, own.0);
            one.nearby.found = found(nearby.0, nearby.1);
            one
        };
        let levels = Levels::of(&vec![point(0.99, 0.99, 0.06); 9]);
        let good = [
            at((0.154, 1.0), (0.087, 43_995.0)),
            at((0.137, 1.01), (0.084, 3.24)),
            at((0.086, 0.98), (0.056, 0.80)),
            at((0.107, 1.0), (0.073, 1.68)),
            at((0.105, 1.08), (0.078, 1.08)),
        ];
        for one in good {
            assert!(
                !levels.moved(&one)
                    && levels.factor_to_common(&one).is_none()
                    && levels.correction(&one, 8).is_none()
            );
        }
        // Three millimetres beside its place, alone and with another gain.
        assert!(levels.moved(&at((0.3, 0.94), (0.07, 0.99))));
        assert!(levels.moved(&at((0.3, 1.9), (0.07, 2.0))));
    }

    #[test]
    fn a_gain_is_corrected_only_where_it_is_sure() {
        let mut all = vec![point(1.0, 1.0, 0.05); 4];
        all.push(point(1.42, 1.42, 0.05));
        let levels = Levels::of(&all);
        let factor = levels.correction(&all[4], 8).unwrap();
        assert!((factor * 1.42 - 1.0).abs() < 1e-9);
        assert_eq!(levels.correction(&all[0], 8), None);
        assert_eq!(levels.correction(&point(-1.0, -1.0, 0.3), 8), Some(-1.0));
        // Near a node: another gain a millimetre beside it.
        let beside = point(1.0, 1.3, 0.1);
        assert!(levels.factor_to_common(&beside).is_none() && levels.correction(&beside, 8).is_none());
        // Of a response that the model hardly explains: 0.39 / sqrt(8) is 14 %.
        let unsure = point(1.3, 1.3, 0.39);
        assert!(levels.factor_to_common(&unsure).is_some() && levels.correction(&unsure, 8).is_none());
        assert!(levels.correction(&unsure, 80).is_some());
    }
}
