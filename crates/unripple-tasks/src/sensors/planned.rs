//! Results of a plan of sensors, as they stand in the report.

use super::setting::Setting;
use serde::Serialize;
use unripple::core::Point;
use unripple::linalg::Mat;
use unripple_calibrate::Parameter;
use unripple_placement::Approximate;

/// An unknown of the fit, and the standard deviation that a fit would leave it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unknown {
    /// Name of the unknown.
    pub name: String,
    /// Unit of its deviations; empty for a ratio.
    pub unit: &'static str,
    /// Standard deviation before anything is measured: that of the prior of the fit.
    pub prior: f64,
    /// Standard deviation with measurements at the planned places.
    pub planned: f64,
    /// Mean of the standard deviations with as many random places; absent where none were found that keep the least distance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub random: Option<f64>,
    /// Standard deviation with as many evenly spread places; absent where there is no room for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub even: Option<f64>,
}

/// How good a choice of places can be, and how good this one is.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Certificate {
    /// Least D-efficiency of the planned places, relative to all choices of as many places, those that repeat a place included.
    pub efficiency: f64,
    /// Mean of the same of random places.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub random: Option<f64>,
    /// The same of evenly spread places.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub even: Option<f64>,
    /// Number of unknowns that the best measurements tell of, beside what is known before.
    pub told: f64,
    /// Excess of the largest sensitivity of the best shares over the number of unknowns, relative to it.
    pub excess: f64,
    /// Whether this is less than a millionth, so that the equivalence theorem holds.
    pub certified: bool,
    /// Number of places with a part in the best shares.
    pub support: usize,
    /// What is known of the planned places, in words.
    pub certificate: String,
}

/// Two unknowns, and their correlation in what a fit finds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Pair {
    /// Names of both.
    pub unknowns: Vec<String>,
    /// The correlation, -1 to 1.
    pub correlation: f64,
}

/// A number of places, and what is known with so many.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// Number of places, without those that are measured in any case.
    pub places: usize,
    /// Least D-efficiency relative to all choices of as many places.
    pub efficiency: f64,
    /// Geometric mean of the standard deviations along all principal axes, each relative to the prior.
    pub mean_deviation: f64,
    /// Largest standard deviation of an unknown relative to its prior.
    pub worst_deviation: f64,
    /// Name of this unknown.
    pub worst: String,
}

/// Standard deviations of unknowns, in the units of their priors, from their covariance.
pub(super) fn deviations(covariance: &Mat<f64>) -> Vec<f64> {
    (0..covariance.nrows()).map(|u| covariance[(u, u)].max(0.0).sqrt()).collect()
}

/// The unknown with the largest deviation relative to its prior, and this deviation.
pub(super) fn worst(deviations: &[f64], unknowns: &[Parameter]) -> (String, f64) {
    let most =
        (0..deviations.len()).reduce(|most, u| if deviations[u] > deviations[most] { u } else { most });
    most.map_or_else(Default::default, |u| (unknowns[u].name.clone(), deviations[u]))
}

/// The two unknowns that a fit tells apart worst.
pub(super) fn worst_pair(covariance: &Mat<f64>, unknowns: &[Parameter]) -> Pair {
    let deviations = deviations(covariance);
    let mut most = Pair::default();
    for j in 0..unknowns.len() {
        for i in j + 1..unknowns.len() {
            let correlation = covariance[(i, j)] / (deviations[i] * deviations[j]).max(f64::MIN_POSITIVE);
            if correlation.abs() > most.correlation.abs() {
                let unknowns = [j, i].map(|u| unknowns[u].name.clone()).to_vec();
                most = Pair { unknowns, correlation };
            }
        }
    }
    most
}

/// Places of an even spread, each the free one that is nearest to a point of it; `None` if there is no room.
pub(super) fn even(
    setting: &Setting,
    points: &[Point],
    free: impl Fn(&[usize], usize) -> bool,
) -> Option<Vec<usize>> {
    let mut chosen: Vec<usize> = Vec::with_capacity(points.len());
    for point in points {
        let far = |b: usize| setting.places[b].distance(*point);
        let others = (0..setting.places.len()).filter(|b| free(&chosen, *b));
        let nearest = others.min_by(|a, b| far(*a).total_cmp(&far(*b)))?;
        chosen.push(nearest);
    }
    Some(chosen)
}

/// A lower bound, rounded down to a multiple of 1/`parts`.
pub(super) fn below(bound: f64, parts: f64) -> f64 {
    (bound * parts).floor() / parts
}

impl Certificate {
    /// The certificate of places with this ln det among all choices of as many.
    pub(super) fn of(setting: &Setting, best: &Approximate, count: usize, log_det: f64) -> Self {
        let efficiency = best.efficiency(&setting.informations, log_det);
        let theorem = match best.is_certified() {
            true => "the equivalence theorem holds to a millionth".to_owned(),
            false => {
                format!("the equivalence theorem holds to {:.0e}, which the bound allows for", best.excess)
            }
        };
        let certificate = format!(
            "no choice of {count} of these places, be it with a place more than once, leaves variances of which the geometric mean is less \
             than {:.3} times that of the planned ones; of the information that any such choice adds to what is known before, these add at \
             least {:.1} %; {theorem}",
            below(efficiency, 1e3),
            below(100.0 * best.added(&setting.informations, log_det), 10.0),
        );
        Self {
            efficiency,
            random: None,
            even: None,
            told: best.told,
            excess: best.excess,
            certified: best.is_certified(),
            support: best.weights.iter().filter(|weight| **weight > 0.0).count(),
            certificate,
        }
    }
}
