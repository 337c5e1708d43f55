//! Exact modes of supported plates and of membranes: products of sines.

use super::line::sines;
use super::problem::Problem;
use crate::PhysicsError;
use rayon::prelude::*;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
use unripple_core::{Edge, Memory, Point};
use unripple_linalg::{Mat, col_chunks};

/// Approximate number of bytes for each mode, by which a problem too large for the allowed memory is refused: mostly the values
/// of its shape at the 256 points at which shapes are read at once. With twice this value, half as many modes are allowed.
const BYTES_PER_MODE: f64 = 2048.0;

/// Number of points in one task. With twice this value, there are half as many tasks to share among threads.
const CHUNK: usize = 64;

/// Exact modes that are one sine or cosine along each side: any sides of a membrane, or a plate supported all round.
#[derive(Debug)]
pub(crate) struct Separable {
    sides: [f64; 2],
    waves: [Wave; 2],
    /// Half-wave index along x and y of each mode.
    indices: Vec<(u32, u32)>,
    /// Largest index along x and y.
    most: [usize; 2],
    /// Amplitude of each product of waves, in 1/√kg.
    amplitudes: Vec<f64>,
}

/// The sines or cosines along one direction, which depend on the ends at which displacement is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wave {
    /// sin(nπx/L), n = 1, 2, …: zero displacement at both ends.
    Sine,
    /// cos(nπx/L), n = 0, 1, …: both ends free.
    Cosine,
    /// sin((n-½)πx/L), n = 1, 2, …: zero displacement at the lower end only.
    QuarterSine,
    /// cos((n-½)πx/L), n = 1, 2, …: zero displacement at the upper end only.
    QuarterCosine,
}

impl Wave {
    /// The functions for a line with these edge conditions; without bending stiffness, clamped and
    /// supported ends are equivalent.
    pub(crate) fn of(low: Edge, high: Edge) -> Self {
        match (low != Edge::Free, high != Edge::Free) {
            (true, true) => Self::Sine,
            (false, false) => Self::Cosine,
            (true, false) => Self::QuarterSine,
            (false, true) => Self::QuarterCosine,
        }
    }

    /// Wavenumber of function `n` on a side of the length `side` (m), in rad/m.
    fn wavenumber(self, n: usize, side: f64) -> f64 {
        let halves = match self {
            Self::Sine | Self::Cosine => n as f64,
            Self::QuarterSine | Self::QuarterCosine => n as f64 - 0.5,
        };
        halves * PI / side
    }

    /// The lowest index n of the functions.
    fn first(self) -> usize {
        usize::from(self != Self::Cosine)
    }

    /// Values of functions 0 … `most` at `x` of a side, amplitude 1 (1/√2 for the constant); index 0 is unused by all but cosines.
    fn at(self, x: f64, side: f64, most: usize) -> Vec<f64> {
        let mut values = vec![0.0; most + 1];
        let theta = PI * x / side;
        match self {
            Self::Sine => sines(theta, &mut values[1..]),
            Self::Cosine => {
                values.iter_mut().enumerate().for_each(|(n, v)| *v = (n as f64 * theta).cos());
                values[0] = FRAC_1_SQRT_2;
            }
            Self::QuarterSine => {
                values.iter_mut().enumerate().for_each(|(n, v)| *v = ((n as f64 - 0.5) * theta).sin());
            }
            Self::QuarterCosine => {
                values.iter_mut().enumerate().for_each(|(n, v)| *v = ((n as f64 - 0.5) * theta).cos());
            }
        }
        values
    }
}

impl Separable {
    /// All modes with wavenumber up to `k_max` (rad/m), ascending, and their wavenumbers. `sides` are in
    /// metres, `mass` is that of the whole sheet in kg.
    ///
    /// k² = k_x² + k_y²; equal ones are ordered by the index along x.
    pub(crate) fn up_to(sides: [f64; 2], waves: [Wave; 2], k_max: f64, mass: f64) -> (Self, Vec<f64>) {
        let mut found: Vec<(f64, u32, u32)> = Vec::new();
        let [width, height] = sides;
        for m in waves[0].first().. {
            let along_x = waves[0].wavenumber(m, width);
            if along_x > k_max {
                break;
            }
            for n in waves[1].first().. {
                let along_y = waves[1].wavenumber(n, height);
                let k = along_x.hypot(along_y);
                if k > k_max {
                    break;
                }
                found.push((k, m as u32, n as u32));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let most = |f: fn(&(f64, u32, u32)) -> u32| found.iter().map(f).max().unwrap_or(0) as usize;
        let separable = Self {
            sides,
            waves,
            most: [most(|f| f.1), most(|f| f.2)],
            indices: found.iter().map(|f| (f.1, f.2)).collect(),
            amplitudes: vec![2.0 / mass.sqrt(); found.len()],
        };
        (separable, found.iter().map(|f| f.0).collect())
    }

    /// Refuses a problem with more modes than the allowed memory holds, before any is computed.
    pub(crate) fn guard(problem: &Problem) -> Result<(), PhysicsError> {
        let bytes =
            |k: f64| BYTES_PER_MODE * problem.sides.iter().map(|side| side * k / PI + 1.5).product::<f64>();
        let needed = bytes(problem.bounds.k_top);
        let memory = Memory::here();
        if memory.holds(needed) {
            return Ok(());
        }
        let nearest = problem.bounds.k_top * (memory.bytes() / needed).sqrt();
        let unknowns = (needed / BYTES_PER_MODE) as usize;
        let nearest_hz = problem.bounds.medium.omega(nearest) / TAU;
        Err(PhysicsError::too_large(problem.bounds.max_hz, unknowns, needed, nearest_hz))
    }

    /// Mass-normalised shapes at a point, in 1/√kg.
    pub(crate) fn at(&self, point: Point, row: &mut [f64]) {
        let along_x = self.waves[0].at(point.x, self.sides[0], self.most[0]);
        let along_y = self.waves[1].at(point.y, self.sides[1], self.most[1]);
        for ((slot, (m, n)), amplitude) in row.iter_mut().zip(&self.indices).zip(&self.amplitudes) {
            *slot = amplitude * along_x[*m as usize] * along_y[*n as usize];
        }
    }

    /// Shapes at many points, points x modes.
    pub(crate) fn at_all(&self, points: &[Point]) -> Mat<f64> {
        let mut weights = Mat::zeros(self.indices.len(), points.len());
        col_chunks(weights.as_mut(), CHUNK).into_par_iter().zip(points.par_chunks(CHUNK)).for_each(
            |(columns, points)| {
                let mut row = vec![0.0; self.indices.len()];
                for (point, column) in points.iter().zip(columns.col_iter_mut()) {
                    self.at(*point, &mut row);
                    column.iter_mut().zip(&row).for_each(|(w, v)| *w = *v);
                }
            },
        );
        weights.transpose().to_owned()
    }

    /// The same modes, with each shape multiplied by its factor.
    pub(crate) fn scaled(mut self, factors: &[f64]) -> Self {
        self.amplitudes.iter_mut().zip(factors).for_each(|(a, f)| *a *= f);
        self
    }
}
