//! Gains of points beside each other.

use super::judge::{Judged, Kind};

/// A gain this far from the others', as a logarithm, is another gain.
const ANOTHER: f64 = 0.14;

/// How near to 1 a gain over the sensors' is, as a logarithm, that speaks for itself where points disagree evenly.
const ONE: f64 = 0.14;

/// What most points have for a gain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    /// The gain of most points, its sign included; `None` where no two points agree.
    pub common: Option<f64>,
    /// To speak of gains by: the common one, or the median of magnitudes.
    pub scale: f64,
}

impl Levels {
    /// Of the points that fit their places.
    pub fn of(judged: &[Judged]) -> Self {
        let gains: Vec<f64> =
            judged.iter().filter(|j| j.kind == Kind::Here).map(|j| j.nearby.found.gain).collect();
        let mut sizes: Vec<f64> = gains.iter().map(|g| g.abs()).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let scale = sizes.get(sizes.len() / 2).copied().unwrap_or(1.0);
        let agree = |g: f64| gains.iter().filter(|other| same(**other, g)).count();
        // The gain that most share; of two, the one that is the sensors' own.
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
        let median = |common: f64| {
            let mut all: Vec<f64> = gains.iter().copied().filter(|g| same(*g, common)).collect();
            all.sort_unstable_by(f64::total_cmp);
            all.get(all.len() / 2).copied().unwrap_or(common)
        };
        let common = common.map(median);
        Self { common, scale: common.unwrap_or(scale) }
    }

    /// What a point's responses are to be multiplied by, if its gain is not the common one.
    pub fn correction(&self, judged: &Judged) -> Option<f64> {
        let gain = judged.nearby.found.gain;
        self.common.filter(|common| !same(gain, *common)).map(|common| common / gain)
    }
}

/// Whether two gains are one.
pub(super) fn same(a: f64, b: f64) -> bool {
    a * b > 0.0 && (a / b).ln().abs() < ANOTHER
}
