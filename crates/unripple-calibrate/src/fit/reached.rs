//! A fitted model limited to the band of its measurement.

use crate::signals::Band;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{ModalResponses, Point, Shapes};
use unripple_linalg::Mat;

/// Highest natural frequency that is kept, relative to the sample rate. Modes above half the rate would alias; a tenth of the range is
/// left for the filters.
const FASTEST: f64 = 0.45;

/// A model limited to the band of its measurement.
///
/// Sweeps end above a surface's band and fade out there, so that measured responses contain modes in between. A model that ended at the
/// surface's band would focus less well, and [`Fitted::blend`](super::Fitted::blend) would take all of those modes for an error of the
/// model.
#[derive(Clone, Debug)]
pub(super) struct Reached {
    /// Modal responses of all modes that the sample rate can represent. Those above the measurement's band
    /// contribute their compliance.
    pub responses: ModalResponses,
    /// The band of the measurement.
    pub band: Band,
}

impl Reached {
    /// The model limited to `band`, which may extend above the surface's band.
    pub fn of(model: &ModalResponses, band: Band) -> Self {
        let most = TAU * FASTEST * model.conditions.rate;
        let kept: Vec<usize> = (0..model.poles.len()).filter(|m| model.poles[*m].omega < most).collect();
        let input = Mat::from_fn(model.input.nrows(), kept.len(), |a, m| model.input[(a, kept[m])]);
        let poles = kept.iter().map(|m| model.poles[*m]).collect();
        let shapes = Arc::new(Part { base: model.shapes.clone(), kept });
        Self { responses: ModalResponses { input, poles, shapes, ..model.clone() }, band }
    }

    /// This model with its responses replaced by `change` of them; the modes must stay the same.
    pub fn with(&self, change: impl Fn(&ModalResponses) -> ModalResponses) -> Self {
        Self { responses: change(&self.responses), band: self.band }
    }
}

/// A selection of mode shapes.
#[derive(Debug)]
struct Part {
    base: Arc<dyn Shapes>,
    kept: Vec<usize>,
}

impl Shapes for Part {
    fn modes(&self) -> usize {
        self.kept.len()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        let all = self.at_all(&[point]);
        row.iter_mut().zip(all.row(0).iter()).for_each(|(r, w)| *r = *w);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let all = self.base.at_all(points);
        Mat::from_fn(points.len(), self.kept.len(), |p, m| all[(p, self.kept[m])])
    }
}
