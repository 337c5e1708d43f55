//! A fitted model through the band of the measurement that it was fitted to.

use crate::signals::Band;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{ModalResponses, Point, Shapes};
use unripple_linalg::Mat;

/// Highest mode that is sampled, over the sample rate. Near one half of the rate a mode is folded back; a tenth is
/// left for the filters.
const FASTEST: f64 = 0.45;

/// A model through the band of a measurement.
///
/// Sweeps end above a surface's band and fade out there, and what is focused by a measurement has the modes in between: a model that ended
/// at the band would not only focus less well, it would also leave all of them over where it is corrected by what was measured.
#[derive(Clone, Debug)]
pub(super) struct Reached {
    /// All modes that can be sampled: of those above the measurement's band is heard what they give way.
    pub responses: ModalResponses,
    /// The band of the measurement.
    pub band: Band,
}

impl Reached {
    /// The model through a band, as far above the surface's own as that reaches.
    pub fn of(model: &ModalResponses, band: Band) -> Self {
        let most = TAU * FASTEST * model.conditions.rate;
        let kept: Vec<usize> = (0..model.poles.len()).filter(|m| model.poles[*m].omega < most).collect();
        let input = Mat::from_fn(model.input.nrows(), kept.len(), |a, m| model.input[(a, kept[m])]);
        let poles = kept.iter().map(|m| model.poles[*m]).collect();
        let shapes = Arc::new(Part { base: model.shapes.clone(), kept });
        Self { responses: ModalResponses { input, poles, shapes, ..model.clone() }, band }
    }

    /// A model with other responses of the same modes.
    pub fn with(&self, change: impl Fn(&ModalResponses) -> ModalResponses) -> Self {
        Self { responses: change(&self.responses), band: self.band }
    }
}

/// Some of all shapes.
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
