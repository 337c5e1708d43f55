//! The state of the surface at the focal instant, as a linear function of the drive.

mod modal;
mod reduced;
mod room;
mod sampled;

pub(crate) use modal::{Keeps, ModalPlant};
pub(crate) use reduced::ReducedPlant;
pub(crate) use sampled::SampledPlant;

use crate::FocusError;
use room::fits;
use std::borrow::Cow;
use unripple_core::{Point, require};
use unripple_linalg::{Mat, MatRef, product, symmetric};

/// Directions of the drive whose energy in the surface is less than this share of the strongest are not
/// used: they are rounding of the Gram matrix. Larger, weak directions that can be driven would be lost.
const FAINT: f64 = 1e-13;

/// Largest number of coordinates of a state: decompositions take the cube of it. With twice this value, four times the memory and eight
/// times the time.
const MOST_COORDINATES: usize = 4000;

/// Linear model of a surface driven over one window or period: its state is made of the coordinates of its
/// velocity at the focal instant.
#[derive(Debug)]
pub(crate) enum Plant<'r> {
    /// A state whose coordinates are the velocities of modes.
    Modal(Box<ModalPlant<'r>>),
    /// A state whose coordinates are the velocities of linearly independent shapes, if the mode shapes are
    /// dependent.
    Reduced(Box<ReducedPlant<'r>>),
    /// A state whose coordinates are the velocities at the stored points of sampled responses.
    Sampled(SampledPlant<'r>),
}

impl Plant<'_> {
    fn coordinates(&self) -> usize {
        match self {
            Self::Modal(modal) => modal.modes(),
            Self::Reduced(reduced) => reduced.shapes(),
            Self::Sampled(sampled) => sampled.points(),
        }
    }

    /// `G Hᵀ`, with G the map from drives to the state of this plant and H that of the other.
    fn gram(&self, other: &Self) -> Mat<f64> {
        match (self, other) {
            (Self::Modal(one), Self::Modal(other)) => one.gram(other),
            (one, other) => product(one.map().transpose(), other.map().as_ref().as_ref()),
        }
    }

    /// G transposed, samples of all channels x coordinates.
    fn map(&self) -> Cow<'_, Mat<f64>> {
        match self {
            Self::Modal(modal) => Cow::Owned(modal.map()),
            Self::Reduced(reduced) => Cow::Borrowed(reduced.map()),
            Self::Sampled(sampled) => Cow::Borrowed(sampled.map()),
        }
    }

    /// Adds the drive `Gᵀ z` to the channels, each a row of samples.
    fn emit(&self, z: &[f64], channels: &mut [f64]) -> Result<(), FocusError> {
        match self {
            Self::Modal(modal) => modal.emit(z, channels),
            Self::Reduced(reduced) => {
                reduced.emit(z, channels);
                Ok(())
            }
            Self::Sampled(sampled) => {
                sampled.emit(z, channels);
                Ok(())
            }
        }
    }

    /// Weights that give the velocity at points from the state, coordinates x points, and the points used:
    /// those requested, or the nearest stored ones.
    fn readout(&self, target: usize, points: &[Point]) -> Result<(Mat<f64>, Vec<Point>), FocusError> {
        match self {
            Self::Modal(modal) => Ok((modal.readout(points), points.to_vec())),
            Self::Reduced(reduced) => Ok((reduced.readout(points), points.to_vec())),
            Self::Sampled(sampled) => sampled.readout(target, points),
        }
    }

    /// Weights that give the velocity at cells all over the surface from the state, coordinates x cells, and
    /// the cells' places.
    fn cells(&self) -> (Mat<f64>, Vec<Point>) {
        match self {
            Self::Modal(modal) => modal.cells(),
            Self::Reduced(reduced) => reduced.cells(),
            Self::Sampled(sampled) => sampled.cells(),
        }
    }
}

/// Drives of least energy, as linear functions of a state with coordinates of unit energy.
///
/// G maps drives over one window to the state at its end, `C = G Gᵀ = U Λ Uᵀ`. With `W = Λ^{-1/2} Uᵀ G`, whose rows are
/// orthonormal, the least-energy drive of the state y is `Wᵀ y`, its energy `|y|²`, and a readout φ of the state reads
/// `(Λ^{1/2} Uᵀ φ) · y`. Several plants under one drive have their coordinates one behind the other; the first is the
/// nominal one.
#[derive(Debug)]
pub(crate) struct State<'r> {
    plants: Vec<Plant<'r>>,
    length: usize,
    channels: usize,
    /// Λ^{1/2} Uᵀ, rank x coordinates.
    white: Mat<f64>,
    /// U Λ^{-1/2}, coordinates x rank.
    back: Mat<f64>,
    /// Λ, as far as it matters.
    pub(crate) energies: Vec<f64>,
}

impl<'r> State<'r> {
    /// The state of plants under drives of `channels` channels of `length` samples.
    ///
    /// # Errors
    /// [`FocusError::Count`] for too many coordinates, [`FocusError::Decomposition`].
    pub fn new(plants: Vec<Plant<'r>>, channels: usize, length: usize) -> Result<Self, FocusError> {
        let sizes: Vec<usize> = plants.iter().map(Plant::coordinates).collect();
        let total: usize = sizes.iter().sum();
        if total > MOST_COORDINATES || total == 0 {
            let expected = format!("1 to {MOST_COORDINATES}");
            return Err(FocusError::Count { what: "modes or points of a state", expected, found: total });
        }
        let starts = starts(&sizes);
        let mut gram = Mat::<f64>::zeros(total, total);
        for (i, one) in plants.iter().enumerate() {
            for (j, other) in plants.iter().enumerate().take(i + 1) {
                let block = one.gram(other);
                let size = (block.nrows(), block.ncols());
                gram.as_mut().submatrix_mut(starts[i], starts[j], size.0, size.1).copy_from(block.as_ref());
                gram.as_mut()
                    .submatrix_mut(starts[j], starts[i], size.1, size.0)
                    .copy_from(block.transpose());
            }
        }
        let energy = (0..total).map(|i| gram[(i, i)]).sum::<f64>();
        let finite = energy.is_finite() && energy > 0.0;
        require("energy of the responses", finite, "a positive finite number", energy)?;
        let (values, vectors) = symmetric(gram.as_ref()).ok_or(FocusError::Decomposition)?;
        let most = values[total - 1];
        let first = (0..total).position(|i| values[i] > FAINT * most).ok_or(FocusError::Decomposition)?;
        let energies: Vec<f64> = (first..total).map(|i| values[i]).collect();
        let rank = energies.len();
        let white = Mat::from_fn(rank, total, |i, j| energies[i].sqrt() * vectors[(j, first + i)]);
        let back = Mat::from_fn(total, rank, |i, j| vectors[(i, first + j)] / energies[j].sqrt());
        Ok(Self { plants, length, channels, white, back, energies })
    }

    /// Number of samples of a drive.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Number of coordinates of the state, each of unit energy.
    pub fn rank(&self) -> usize {
        self.energies.len()
    }

    /// Number of plants (surface models) that share the drive.
    pub fn plants(&self) -> usize {
        self.plants.len()
    }

    /// Weights that give the nominal plant's velocity at a target's points from the state, rank x points,
    /// and the points used: those requested, or the nearest stored ones.
    ///
    /// # Errors
    /// [`FocusError::Unknown`] for points without responses.
    pub fn readout(&self, target: usize, points: &[Point]) -> Result<(Mat<f64>, Vec<Point>), FocusError> {
        let (weights, used) = self.plants[0].readout(target, points)?;
        Ok((self.whiten(0, weights.as_ref()), used))
    }

    /// Weights that give a plant's velocity at cells all over the surface from the state, rank x cells, and
    /// the cells' places.
    pub fn cells(&self, plant: usize) -> (Mat<f64>, Vec<Point>) {
        let (weights, points) = self.plants[plant].cells();
        (self.whiten(plant, weights.as_ref()), points)
    }

    fn whiten(&self, plant: usize, weights: MatRef<'_, f64>) -> Mat<f64> {
        let first: usize = self.plants[..plant].iter().map(Plant::coordinates).sum();
        product(self.white.as_ref().subcols(first, weights.nrows()), weights)
    }

    /// The drive of least energy for the state y, `Wᵀ y`: the samples of each channel, one channel after
    /// another.
    ///
    /// # Errors
    /// [`FocusError::Dsp`] if the plants do not fit together.
    pub fn emit(&self, y: MatRef<'_, f64>) -> Result<Vec<f64>, FocusError> {
        let z = product(self.back.as_ref(), y);
        let z = z.col_as_slice(0);
        let mut channels = vec![0.0; self.channels * self.length];
        let mut first = 0;
        for plant in &self.plants {
            plant.emit(&z[first..first + plant.coordinates()], &mut channels)?;
            first += plant.coordinates();
        }
        Ok(channels)
    }

    /// The matrix W that maps a drive to the state, rank x samples of all channels.
    ///
    /// # Errors
    /// [`FocusError::Count`] if it has too many values; those of [`State::emit`].
    pub fn map(&self) -> Result<Mat<f64>, FocusError> {
        fits("samples of all channels times modes", self.channels * self.length, self.rank())?;
        let mut map = Mat::zeros(self.channels * self.length, self.rank());
        for i in 0..self.rank() {
            let unit = Mat::from_fn(self.rank(), 1, |row, _| f64::from(row == i));
            map.col_as_slice_mut(i).copy_from_slice(&self.emit(unit.as_ref())?);
        }
        Ok(map.transpose().to_owned())
    }
}

/// Start index of each block, for blocks of these sizes one after another.
fn starts(sizes: &[usize]) -> Vec<usize> {
    sizes
        .iter()
        .scan(0, |next, size| {
            let start = *next;
            *next += size;
            Some(start)
        })
        .collect()
}
