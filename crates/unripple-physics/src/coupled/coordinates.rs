//! Modes of the sheet and the housings of exciters as the coordinates of one system.

use super::Loaded;
use crate::Load;
use unripple_core::Pole;
use unripple_linalg::Mat;

/// A loaded sheet in coordinates that include its housings: the modes of the sheet, then the housings that
/// a spring, damper or coil connects to it. No load then has a housing of its own.
///
/// The coordinate of a housing of mass M is √M times its displacement. It has unit mass and neither stiffness nor damping of its own,
/// like a mode of frequency 0, and moves nothing of the sheet. A load between contact and housing has the weights of the contact and
/// -1/√M: its motion is the difference of the two, and its force acts on both.
#[derive(Debug)]
pub(super) struct Coordinates {
    /// Poles of the sheet's modes, then those of the housings, whose frequency and decay rate are 0.
    pub poles: Vec<Pole>,
    /// Loads without housings: each load on the sheet is split into one or two of them.
    pub loads: Vec<Load>,
    /// Weights of the coordinates at these loads, loads x coordinates.
    pub at_loads: Mat<f64>,
    /// Forces on the coordinates per unit of drive, transducers x coordinates; per coil current for a coil
    /// driven by a voltage.
    pub driven: Mat<f64>,
    /// For each transducer that drives a coil by its voltage, the index of the load that has the coil.
    pub coils: Vec<Option<usize>>,
}

/// A load without a housing.
struct Part {
    load: Load,
    /// Index of the load on the sheet from which this part was split.
    whole: usize,
    /// Index of the coordinate of the housing that this part acts against; `None` for the ground.
    against: Option<usize>,
}

impl Loaded {
    /// The loaded sheet in coordinates that include the housings of its loads.
    pub(super) fn coordinates(&self) -> Coordinates {
        let modes = self.poles.len();
        let (mut parts, mut last, mut weights) = (Vec::new(), Vec::new(), Vec::new());
        for (whole, load) in self.loads.iter().enumerate() {
            let [ground, tied] = load.split();
            parts.extend(ground.map(|load| Part { load, whole, against: None }));
            if let Some((tied, housing)) = tied.filter(Load::acts).zip(load.housing) {
                parts.push(Part { load: tied, whole, against: Some(modes + weights.len()) });
                weights.push(housing.weight());
            }
            // A load that acts has a part at least; its coil is in the last one.
            last.push(parts.len() - 1);
        }
        let count = modes + weights.len();
        let at_loads = Mat::from_fn(parts.len(), count, |p, m| match parts[p].against {
            _ if m < modes => self.at_loads[(parts[p].whole, m)],
            Some(housing) if housing == m => weights[m - modes],
            _ => 0.0,
        });
        let driven = Mat::from_fn(self.transducers.len(), count, |t, m| {
            match self.own[t].and_then(|load| parts[last[load]].against) {
                _ if m < modes => self.driven[(t, m)],
                Some(housing) if housing == m => self.transducers[t].gain * weights[m - modes],
                _ => 0.0,
            }
        });
        let poles = self.poles.iter().copied().chain(weights.iter().map(|_| Pole::new(0.0, 0.0)));
        let coils = (0..self.transducers.len()).map(|t| self.driven_coil(t).map(|load| last[load]));
        Coordinates {
            poles: poles.collect(),
            at_loads,
            driven,
            coils: coils.collect(),
            loads: parts.into_iter().map(|part| part.load).collect(),
        }
    }
}
