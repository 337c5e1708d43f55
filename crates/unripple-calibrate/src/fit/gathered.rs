//! Sums over all frequencies of the products of derivatives, at one place: what its information is made of.

use super::layout::Unknown;
use super::readings::Reading;
use super::sensing::Sensing;
use unripple_linalg::{Mat, add_square, c64};

/// Share of its own square that a column must have beside the others for it to be eliminated: less is rounding.
const BESIDE: f64 = 1e-12;

/// What all places share at one frequency.
pub(super) struct Line {
    /// Responses at all places.
    pub reading: Reading,
    /// Gain of each channel.
    pub gains: Vec<c64>,
    /// The complex frequency (1/s), by which a delay changes responses.
    pub delay: c64,
    /// Rows of the orthonormal columns of modes far above the band, real and imaginary part of each.
    pub far: Vec<[f64; 2]>,
}

/// Sums over frequencies at one place.
#[derive(Clone, Debug)]
pub(super) struct Gathered {
    sensing: Sensing,
    unknowns: usize,
    /// Products of the derivatives by the unknowns, and by what is unknown of this place alone: the lower triangle.
    square: Mat<f64>,
    /// Products of these derivatives with the columns of modes far above the band, columns x (channel, far column).
    far: Mat<f64>,
    /// Sum of the squared magnitudes of the responses.
    pub power: f64,
}

impl Gathered {
    /// Number of unknowns of a sensor alone: its gain and its delay.
    const OWN: usize = 2;

    /// Sums over no frequency yet.
    pub fn none(sensing: Sensing, unknowns: &[Unknown], actuators: usize, far: usize) -> Self {
        let (own, far) = match sensing {
            Sensing::Sweeps => (Self::OWN, far),
            Sensing::Taps => (0, 0),
        };
        let columns = unknowns.len() + own;
        Self {
            sensing,
            unknowns: unknowns.len(),
            square: Mat::zeros(columns, columns),
            far: Mat::zeros(columns, actuators * far),
            power: 0.0,
        }
    }

    /// Number of numbers that such sums hold, or those made from them, at most.
    pub fn numbers(unknowns: usize, actuators: usize, far: usize) -> usize {
        let columns = unknowns + Self::OWN;
        columns * (2 * columns + actuators * far)
    }

    /// Adds some frequencies at a place.
    pub fn add(&mut self, place: usize, lines: &[Line], unknowns: &[Unknown]) {
        let columns = self.square.nrows();
        let channels = lines.first().map_or(0, |line| line.gains.len());
        let mut rows = Mat::<f64>::zeros(columns, 2 * channels * lines.len());
        for (i, line) in lines.iter().enumerate() {
            let model: Vec<c64> =
                (0..channels).map(|a| line.reading.admittance(place, a) * line.gains[a]).collect();
            self.power += model.iter().map(|y| y.norm_sqr()).sum::<f64>();
            for column in 0..columns {
                let slopes = self.slopes(place, line, &model, unknowns.get(column).copied(), column);
                for (a, slope) in slopes.iter().enumerate() {
                    let row = 2 * (i * channels + a);
                    (rows[(column, row)], rows[(column, row + 1)]) = (slope.re, slope.im);
                    for (k, [re, im]) in line.far.iter().enumerate() {
                        self.far[(column, a * line.far.len() + k)] += re * slope.re + im * slope.im;
                    }
                }
            }
        }
        add_square(self.square.as_mut(), 1.0, rows.as_ref());
    }

    /// Derivatives of the responses of all channels by an unknown, or, without one, by what is unknown of this place alone, the number of
    /// its column.
    fn slopes(
        &self,
        place: usize,
        line: &Line,
        model: &[c64],
        unknown: Option<Unknown>,
        column: usize,
    ) -> Vec<c64> {
        let only = |b: usize| {
            let one = |(a, y): (usize, &c64)| if a == b { *y } else { c64::new(0.0, 0.0) };
            model.iter().enumerate().map(one).collect::<Vec<c64>>()
        };
        let mut slopes: Vec<c64> = match (unknown, self.sensing) {
            (None, _) if column == self.unknowns => model.to_vec(),
            (None, _) => model.iter().map(|y| -line.delay * y).collect(),
            (Some(Unknown::Drive(b)), Sensing::Sweeps) | (Some(Unknown::Sense(b)), Sensing::Taps) => only(b),
            (Some(unknown), _) => {
                let slope = |(a, gain): (usize, &c64)| line.reading.slope(place, a, unknown) * gain;
                line.gains.iter().enumerate().map(slope).collect()
            }
        };
        if self.sensing == Sensing::Taps {
            // The spectrum of the force takes what is along the response.
            let power = model.iter().map(|y| y.norm_sqr()).sum::<f64>().max(f64::MIN_POSITIVE);
            let share = model.iter().zip(&slopes).map(|(y, x)| y.conj() * x).sum::<c64>() / power;
            slopes.iter_mut().zip(model).for_each(|(x, y)| *x -= share * y);
        }
        slopes
    }

    /// Products of the derivatives by the unknowns, without what modes far above the band and what is unknown of the place can explain: the
    /// lower triangle, unknowns x unknowns.
    pub fn eliminated(self) -> Mat<f64> {
        let mut square = self.square;
        let own: Vec<f64> = (0..square.nrows()).map(|i| square[(i, i)]).collect();
        if self.far.ncols() > 0 {
            add_square(square.as_mut(), -1.0, self.far.as_ref());
        }
        for pivot in (self.unknowns..own.len()).rev() {
            let left = square[(pivot, pivot)];
            if left > BESIDE * own[pivot] {
                for j in 0..pivot {
                    for i in j..pivot {
                        let explained = square[(pivot, i)] * square[(pivot, j)] / left;
                        square[(i, j)] -= explained;
                    }
                }
            }
        }
        // Rounding may leave less than nothing of an unknown that the others explain.
        (0..self.unknowns).for_each(|i| square[(i, i)] = square[(i, i)].max(0.0));
        square
    }
}

#[cfg(test)]
mod tests {
    use super::super::basis::Basis;
    use super::super::information::Study;
    use super::super::layout::{Layout, Values};
    use super::super::residual::Case;
    use super::super::run::{FitOptions, nominal_values, prepared, unknowns_of};
    use super::super::spectra::{Lines, Spectra};
    use super::super::system::System;
    use super::*;
    use unripple_core::{Point, Surface};
    use unripple_linalg::product;

    /// Three actuators on the paper's film, in a tenth of its band, with loads that count.
    struct Film {
        basis: Basis,
        layout: Layout,
        values: Values,
        lines: Lines,
        count: usize,
        top: f64,
    }

    impl Film {
        fn new() -> Self {
            let mut surface: Surface = unripple_physics::design::papers_surface();
            surface.actuators.truncate(3);
            surface.emission.band = [0.0, 400.0];
            let options = FitOptions { profile: 1, ..FitOptions::default() };
            let (basis, top) = prepared(&surface, &options, [0.0, 390.0]).unwrap();
            let layout = unknowns_of(&surface, &basis, Vec::new(), top);
            let mut values = nominal_values(&surface, &basis, &layout, top);
            values.tension = 0.02;
            values.profile[0] = 0.01;
            values.masses = vec![300e-6, 20e-6, 100e-6];
            values.resistances = vec![0.02, 0.05, 0.01];
            values.sense = vec![0.3, -0.2, 0.1];
            let lines = Lines::new((48e3, 12_000), [0.0, 390.0], (30.0, 0.25));
            let count = basis.below(1.4 * top);
            Self { basis, layout, values, lines, count, top }
        }

        fn system(&self, values: &Values, taps: &[Point]) -> System {
            System::new(&self.basis, &self.layout, values, taps, (self.count, self.top)).unwrap()
        }

        fn gathered(&self, sensing: Sensing, places: &[Point]) -> Vec<Gathered> {
            let Self { basis, layout, values, lines, .. } = self;
            let system = self.system(values, &[]);
            Study { basis, layout, values, lines, sensing }.gathered(&system, places).unwrap()
        }

        /// The Jacobian of the fit's residual of a tap, as loud as the model is with a unit impulse of force.
        fn jacobian(&self, place: Point) -> Mat<f64> {
            let Self { basis, layout, values, lines, count, top } = self;
            let system = self.system(values, &[place]);
            let answers = system.admittances(&lines.frequencies);
            let heard = |a: usize| -> Vec<c64> {
                answers.iter().map(|y| y[(a, layout.actuators)] * values.sense[a].exp()).collect()
            };
            let spectra = Spectra {
                frequencies: lines.frequencies.clone(),
                pairs: Vec::new(),
                pair_noise: 1.0,
                far: lines.far(),
                taps: vec![(0..layout.actuators).map(heard).collect()],
                places: vec![place],
                tap_noise: vec![1.0],
                overlap: 1.0,
            };
            let case = Case { basis, layout, spectra: &spectra, count: *count, top: *top };
            case.linear(values).unwrap().slopes
        }

        /// The information of one place in units of the priors, as the whole of its matrix.
        fn in_priors(&self, gathered: Gathered) -> Mat<f64> {
            let lower = gathered.eliminated();
            let units = self.priors();
            let entry = |i: usize, j: usize| units[i] * units[j] * lower[(i.max(j), i.min(j))];
            Mat::from_fn(units.len(), units.len(), entry)
        }

        fn priors(&self) -> Vec<f64> {
            self.layout.unknowns().iter().map(|unknown| self.layout.spread(*unknown)).collect()
        }
    }

    /// The largest difference of two matrices, each entry relative to the roots of the diagonal ones.
    fn off(lower: &Mat<f64>, exact: &Mat<f64>) -> f64 {
        let mut most: f64 = 0.0;
        let least = 1e-12 * (0..exact.nrows()).map(|i| exact[(i, i)]).fold(0.0, f64::max);
        for i in 0..exact.nrows() {
            for j in 0..=i {
                let scale = ((exact[(i, i)] + least) * (exact[(j, j)] + least)).sqrt();
                most = most.max((lower[(i, j)] - exact[(i, j)]).abs() / scale);
            }
        }
        most
    }

    #[test]
    fn taps_have_the_information_of_the_jacobian_of_the_fit() {
        let film = Film::new();
        let places = [Point::from_mm(61.0, 47.0), Point::from_mm(101.0, 118.0)];
        let found = film.gathered(Sensing::Taps, &places);
        for (place, gathered) in places.iter().zip(found) {
            let slopes = film.jacobian(*place);
            let exact = product(slopes.transpose(), slopes.as_ref());
            let off = off(&film.in_priors(gathered), &exact);
            assert!(off < 1e-7, "{place}: {off:.1e}");
        }
    }

    /// Against differences of the responses themselves, from which gain, delay and the columns of far modes are taken by least squares.
    #[test]
    fn sweeps_have_the_information_of_differences_of_the_responses() {
        let film = Film::new();
        let place = Point::from_mm(61.0, 47.0);
        let gathered = film.gathered(Sensing::Sweeps, &[place]).remove(0);
        let (actuators, lines) = (film.layout.actuators, &film.lines.frequencies);
        let held = film.system(&film.values, &[place]);
        let responses = |values: &Values| -> Vec<f64> {
            let mut system = film.system(values, &[place]);
            // Of the flexibility of modes that are left out, derivatives have none, nor have those of the fit: it is held, with its decay rate,
            // the last one.
            system.rest = held.rest;
            system.sheet.sigmas.push(held.sheet.sigmas[held.sheet.sigmas.len() - 1]);
            let answers = system.admittances(lines);
            let heard = |a: usize| {
                answers.iter().map(move |y| y[(actuators, a)] * values.drive[a].exp()).collect::<Vec<c64>>()
            };
            stacked(&(0..actuators).map(heard).collect::<Vec<_>>())
        };
        let model = responses(&film.values);
        let mut nuisances = Vec::new();
        for a in 0..actuators {
            for far in film.lines.far() {
                let none = vec![c64::new(0.0, 0.0); lines.len()];
                let alone = (0..actuators).map(|b| if a == b { far.clone() } else { none.clone() });
                nuisances.push(stacked(&alone.collect::<Vec<_>>()));
            }
        }
        nuisances.push(model.clone());
        nuisances.push(delayed(&model, actuators, lines));
        let unknowns = film.layout.unknowns();
        let units = film.priors();
        let slopes: Vec<Vec<f64>> = unknowns
            .iter()
            .zip(&units)
            .map(|(unknown, unit)| {
                let [before, after] = [-1e-4, 1e-4].map(|step| {
                    let mut values = film.values.clone();
                    *values.of(*unknown) += step * unit;
                    responses(&values)
                });
                let own = match unknown {
                    // These are the sensor's own gain and delay here.
                    Unknown::Sense(_) | Unknown::Level | Unknown::Late => vec![0.0; model.len()],
                    _ => after.iter().zip(&before).map(|(x, y)| (x - y) / 2e-4).collect(),
                };
                beside(own, &mut nuisances.clone())
            })
            .collect();
        let exact = Mat::from_fn(units.len(), units.len(), |i, j| {
            slopes[i].iter().zip(&slopes[j]).map(|(x, y)| x * y).sum::<f64>()
        });
        let off = off(&film.in_priors(gathered), &exact);
        assert!(off < 1e-5, "{off:.1e}");
    }

    /// Real parts of all responses, then imaginary ones, response by response.
    fn stacked(responses: &[Vec<c64>]) -> Vec<f64> {
        let parts = |response: &Vec<c64>| {
            let real = response.iter().map(|y| y.re);
            real.chain(response.iter().map(|y| y.im)).collect::<Vec<f64>>()
        };
        responses.iter().flat_map(parts).collect()
    }

    /// Derivative of stacked responses by a delay.
    fn delayed(stack: &[f64], actuators: usize, lines: &[c64]) -> Vec<f64> {
        let one = |a: usize| {
            let from = 2 * a * lines.len();
            let response =
                (0..lines.len()).map(move |n| c64::new(stack[from + n], stack[from + lines.len() + n]));
            response.zip(lines).map(|(y, s)| -*s * y).collect::<Vec<c64>>()
        };
        stacked(&(0..actuators).map(one).collect::<Vec<_>>())
    }

    /// What of a column the others do not explain, by Gram-Schmidt, twice for rounding.
    fn beside(mut column: Vec<f64>, others: &mut [Vec<f64>]) -> Vec<f64> {
        let remove = |from: &mut Vec<f64>, unit: &[f64]| {
            let share: f64 = from.iter().zip(unit).map(|(x, u)| x * u).sum();
            from.iter_mut().zip(unit).for_each(|(x, u)| *x -= share * u);
        };
        for i in 0..others.len() {
            let (before, now) = others.split_at_mut(i);
            for _ in 0..2 {
                before.iter().for_each(|unit| remove(&mut now[0], unit));
            }
            let norm = now[0].iter().map(|x| x * x).sum::<f64>().sqrt();
            now[0].iter_mut().for_each(|x| *x /= norm);
            (0..2).for_each(|_| remove(&mut column, &now[0]));
        }
        column
    }
}
