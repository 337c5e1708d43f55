//! Residuals of the fit, whitened by the noise, and their Jacobian.

use super::basis::Basis;
use super::coil::lag;
use super::forward::Answer;
use super::layout::{Layout, Unknown, Values};
use super::spectra::Spectra;
use super::system::System;
use crate::CalibrateError;
use rayon::prelude::*;
use unripple_linalg::{Mat, c64};

/// Residual of a fit, model minus measurement, in standard deviations of the noise, and its derivatives by
/// the unknowns, each in standard deviations of its prior.
#[derive(Clone, Debug)]
pub(super) struct Residual {
    /// Model minus measurement, whitened: in standard deviations of the noise.
    pub values: Vec<f64>,
    /// Derivatives of `values` by the unknowns, each in standard deviations of its prior: values x unknowns;
    /// empty unless requested.
    pub slopes: Mat<f64>,
    /// Number of independent real data, before the number of unknowns is subtracted.
    pub data: f64,
    /// Sum of squares of the measurement, in squared standard deviations of the noise.
    pub power: f64,
    /// Squared magnitudes of residual and measurement, `[line][2]`, at every spectral line of every
    /// response.
    pub lines: Vec<[f64; 2]>,
    /// For each row of `values`, the index of its response or tap and the index of its frequency.
    pub belongs: Vec<[usize; 2]>,
}

/// Everything from which residuals are computed: the nominal modes, the unknowns, the measured spectra.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case<'a> {
    /// The nominal modes.
    pub basis: &'a Basis,
    /// The unknowns of the fit, and their order in the vector of unknowns.
    pub layout: &'a Layout,
    /// The measured spectra.
    pub spectra: &'a Spectra,
    /// Number of nominal modes used.
    pub count: usize,
    /// Highest frequency of the band, in Hz.
    pub top: f64,
}

impl Case<'_> {
    /// The coupled equations of sheet and loads at some values of the unknowns.
    pub fn system(&self, values: &Values) -> Result<System, CalibrateError> {
        System::new(self.basis, self.layout, values, &self.spectra.places, (self.count, self.top))
    }

    /// Computes the residual without derivatives.
    pub fn residual(&self, values: &Values) -> Result<Residual, CalibrateError> {
        let answers = self.system(values)?.admittances(&self.spectra.frequencies);
        let answers = answers.into_iter().map(|y| Answer { admittance: y, derivatives: Vec::new() });
        Ok(self.compared(values, &answers.collect::<Vec<_>>(), false))
    }

    /// Computes the residual with its derivatives by the unknowns.
    pub fn linear(&self, values: &Values) -> Result<Residual, CalibrateError> {
        let answers = self.system(values)?.answers(self.basis, &self.spectra.frequencies);
        Ok(self.compared(values, &answers, true))
    }

    fn compared(&self, values: &Values, answers: &[Answer], slopes: bool) -> Residual {
        let unknowns = if slopes { self.layout.unknowns() } else { Vec::new() };
        let blocks = self.blocks(values, answers, &unknowns);
        let mut columns = columns(&blocks, unknowns.len());
        for (u, unknown) in unknowns.iter().enumerate() {
            columns.col_mut(u).iter_mut().for_each(|x| *x *= self.layout.spread(*unknown));
        }
        let frequencies = self.spectra.frequencies.len();
        let belongs = |(n, block): (usize, &Block)| {
            let (rows, paired) = (block.values.len(), block.paired);
            let line = move |row: usize| if paired { row % frequencies } else { row * frequencies / rows };
            (0..rows).map(move |row| [n, line(row)])
        };
        Residual {
            slopes: columns,
            belongs: blocks.iter().enumerate().flat_map(belongs).collect(),
            lines: blocks.iter().flat_map(|b| b.lines.iter().copied()).collect(),
            data: blocks.iter().map(|b| b.data).sum(),
            power: blocks.iter().map(|b| b.power).sum(),
            values: blocks.into_iter().flat_map(|b| b.values).collect(),
        }
    }

    /// Derivatives of the residual, in standard deviations of the noise, from those of the admittances in
    /// `answers`: one column per unknown.
    pub fn columns(&self, values: &Values, answers: &[Answer], unknowns: &[Unknown]) -> Mat<f64> {
        columns(&self.blocks(values, answers, unknowns), unknowns.len())
    }

    /// The rows of the residual for every response and every tap on the surface, with their derivatives by
    /// `unknowns`.
    pub fn blocks(&self, values: &Values, answers: &[Answer], unknowns: &[Unknown]) -> Vec<Block> {
        let (pairs, taps) = (self.spectra.pairs.len(), self.spectra.taps.len());
        (0..pairs + taps)
            .into_par_iter()
            .filter(|n| *n >= pairs || !self.spectra.pairs[*n].is_empty())
            .map(|n| match n < pairs {
                true => self.pair(n, values, answers, unknowns),
                false => self.tap(n - pairs, values, answers, unknowns),
            })
            .collect()
    }

    /// Rows of a response between actuators. The contribution of modes far above the band is projected out of both model and
    /// measurement: a part that is the same at all frequencies (an impulse within one sample), and parts that grow with s, s³ and s⁵
    /// (compliance, inertia and the next term).
    fn pair(&self, pair: usize, values: &Values, answers: &[Answer], unknowns: &[Unknown]) -> Block {
        let actuators = self.layout.actuators;
        let (driven, heard) = (pair / actuators, pair % actuators);
        let gain = values.gain(driven, heard);
        let scale = 1.0 / self.spectra.pair_noise;
        let nuisance = Nuisance::new(&self.spectra.far);
        let column = |f: &dyn Fn(usize) -> c64| {
            let mut column: Vec<f64> = (0..answers.len()).map(|n| f(n).re * scale).collect();
            column.extend((0..answers.len()).map(|n| f(n).im * scale));
            nuisance.remove(&mut column);
            column
        };
        let frequencies = &self.spectra.frequencies;
        let [drives, hears] = [driven, heard].map(|n| self.basis.coil(n));
        let turn = |s: &c64| gain * (-s * values.late).exp() * lag(drives, *s) * lag(hears, *s);
        let turned: Vec<c64> = frequencies.iter().map(turn).collect();
        let model = |n: usize| turned[n] * answers[n].admittance[(heard, driven)];
        let measured = column(&|n| self.spectra.pairs[pair][n]);
        let modelled = column(&model);
        let slope = |(u, unknown): (usize, &Unknown)| match unknown {
            Unknown::Drive(a) if *a == driven => modelled.clone(),
            Unknown::Sense(a) if *a == heard => modelled.clone(),
            Unknown::Drive(_) | Unknown::Sense(_) => vec![0.0; modelled.len()],
            Unknown::Level => modelled.clone(),
            Unknown::Late => column(&|n| -frequencies[n] * model(n)),
            _ => column(&|n| turned[n] * answers[n].derivatives[u][(heard, driven)]),
        };
        let values: Vec<f64> = modelled.iter().zip(&measured).map(|(a, b)| a - b).collect();
        let count = answers.len();
        let square = |all: &[f64], n: usize| all[n].powi(2) + all[count + n].powi(2);
        Block {
            columns: unknowns.iter().enumerate().map(slope).collect(),
            lines: (0..count).map(|n| [square(&values, n), square(&measured, n)]).collect(),
            values,
            data: (modelled.len() as f64 - self.spectra.far.len() as f64).max(0.0),
            power: measured.iter().map(|x| x * x).sum(),
            paired: true,
        }
    }

    /// Rows of a tap. At each frequency the model gives the sensors' signals up to a common factor, the force's spectrum. Its best
    /// value leaves a residual orthogonal to the model (variable projection: Kaufman, *BIT* 15, 49, 1975).
    fn tap(&self, tap: usize, values: &Values, answers: &[Answer], unknowns: &[Unknown]) -> Block {
        let actuators = self.layout.actuators;
        let at = self.layout.loaded() + tap;
        let scale = 1.0 / self.spectra.tap_noise[tap];
        let heard = &self.spectra.taps[tap];
        let rows = 2 * actuators * answers.len();
        let mut block = Block {
            values: Vec::with_capacity(rows),
            columns: vec![Vec::with_capacity(rows); unknowns.len()],
            lines: Vec::with_capacity(actuators * answers.len()),
            data: (2 * (actuators - 1) * answers.len()) as f64,
            power: 0.0,
            paired: false,
        };
        for (n, answer) in answers.iter().enumerate() {
            let s = self.spectra.frequencies[n];
            let sensors = values.sense.iter().enumerate();
            let gains: Vec<c64> = sensors.map(|(a, g)| lag(self.basis.coil(a), s) * g.exp()).collect();
            let model: Vec<c64> = (0..actuators).map(|a| answer.admittance[(a, at)] * gains[a]).collect();
            let power = model.iter().map(|y| y.norm_sqr()).sum::<f64>().max(f64::MIN_POSITIVE);
            let along = |x: &[c64]| model.iter().zip(x).map(|(y, x)| y.conj() * x).sum::<c64>() / power;
            let measured: Vec<c64> = (0..actuators).map(|a| heard[a][n] * scale).collect();
            let force = along(&measured);
            block.power += measured.iter().map(|y| y.norm_sqr()).sum::<f64>();
            let residual = |a: usize| force * model[a] - measured[a];
            block.values.extend((0..actuators).flat_map(|a| [residual(a).re, residual(a).im]));
            block.lines.extend((0..actuators).map(|a| [residual(a).norm_sqr(), measured[a].norm_sqr()]));
            for (u, unknown) in unknowns.iter().enumerate() {
                let mut slope: Vec<c64> = match unknown {
                    Unknown::Sense(b) => {
                        (0..actuators).map(|a| if a == *b { model[a] } else { c64::new(0.0, 0.0) }).collect()
                    }
                    Unknown::Drive(_) | Unknown::Level | Unknown::Late => vec![c64::new(0.0, 0.0); actuators],
                    _ => (0..actuators).map(|a| answer.derivatives[u][(a, at)] * gains[a]).collect(),
                };
                let share = along(&slope);
                slope.iter_mut().zip(&model).for_each(|(x, y)| *x = (*x - share * y) * force);
                block.columns[u].extend(slope.iter().flat_map(|x| [x.re, x.im]));
            }
        }
        block
    }
}

/// Rows of the residual that belong to one response or tap.
pub(super) struct Block {
    /// Model minus measurement, in standard deviations of the noise.
    pub values: Vec<f64>,
    /// Derivatives of `values`, one column for each requested unknown.
    pub columns: Vec<Vec<f64>>,
    lines: Vec<[f64; 2]>,
    data: f64,
    power: f64,
    /// Whether its rows are real parts, then imaginary ones, at all frequencies; otherwise frequency by frequency.
    paired: bool,
}

/// The columns of all blocks below each other.
fn columns(blocks: &[Block], count: usize) -> Mat<f64> {
    let rows = if count > 0 { blocks.iter().map(|b| b.values.len()).sum() } else { 0 };
    let mut all = Mat::zeros(rows, count);
    let mut first = 0;
    for block in blocks.iter().filter(|_| count > 0) {
        for (u, column) in block.columns.iter().enumerate() {
            column.iter().enumerate().for_each(|(i, x)| all[(first + i, u)] = *x);
        }
        first += block.values.len();
    }
    all
}

/// Orthonormal columns that are projected out of responses between actuators: those of modes far above the band.
pub(super) struct Nuisance(pub Vec<Vec<f64>>);

impl Nuisance {
    /// From columns of complex values at all frequencies: real parts, then imaginary ones.
    pub fn new(far: &[Vec<c64>]) -> Self {
        let mut nuisance = Self(Vec::new());
        for values in far {
            let mut column: Vec<f64> = values.iter().map(|v| v.re).collect();
            column.extend(values.iter().map(|v| v.im));
            nuisance.remove(&mut column);
            unit(&mut column);
            nuisance.0.push(column);
        }
        nuisance
    }

    fn remove(&self, column: &mut [f64]) {
        for unit in &self.0 {
            let share: f64 = unit.iter().zip(column.iter()).map(|(a, b)| a * b).sum();
            column.iter_mut().zip(unit).for_each(|(x, u)| *x -= share * u);
        }
    }
}

fn unit(column: &mut [f64]) {
    let norm = column.iter().map(|x| x * x).sum::<f64>().sqrt();
    if norm > 0.0 {
        column.iter_mut().for_each(|x| *x /= norm);
    }
}
