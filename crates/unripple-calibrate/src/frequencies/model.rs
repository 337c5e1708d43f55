//! The modes of a surface as functions of the logarithms of the factors on its fitted quantities.

use super::Quantity;
use super::quantity::springs;
use crate::CalibrateError;
use std::cell::RefCell;
use std::f64::consts::TAU;
use unripple_core::{Air, Edge, ScattererKind, Surface};
use unripple_physics::design::expected_modes;
use unripple_physics::{Accuracy, SurfaceModes};

/// Relative accuracy of frequencies that is aimed at: a tenth of what the best ears and recordings give. A mesh takes minutes for more.
const ACCURACY: f64 = 1e-4;

/// Step of a logarithm for differences: frequencies move by up to a quarter of a per cent, many times their error, and hardly any two modes
/// cross.
const STEP: f64 = 5e-3;

/// Modes are computed up to this multiple of the frequency that is asked for, since a little more is asked for a little later.
const AHEAD: f64 = 1.05;

/// Frequencies below this share of the highest one are motions as a rigid body.
const RIGID: f64 = 1e-6;

/// Solutions that are kept: those of one step of the fit with all its differences, and of the starts.
const KEPT: usize = 40;

/// Natural frequencies of a surface, without motions as a rigid body.
#[derive(Clone, Debug, Default)]
pub(super) struct Computed {
    /// Frequencies in Hz, ascending.
    pub hz: Vec<f64>,
    /// Share of bending in the energy of each mode; empty where actuators load the sheet.
    pub bending: Vec<f64>,
}

impl Computed {
    fn of(found: &SurfaceModes, top: f64) -> Self {
        let poles = found.loaded.as_ref().unwrap_or(&found.sheet);
        let rigid = poles.iter().take_while(|pole| pole.omega <= RIGID * TAU * top).count();
        let hz = poles[rigid..].iter().map(|pole| pole.omega / TAU).collect();
        let bending = match found.loaded {
            Some(_) => Vec::new(),
            None => found.bending_shares[rigid..].to_vec(),
        };
        Self { hz, bending }
    }

    /// The modes up to `top` Hz, with all frequencies multiplied by a factor before.
    fn scaled(&self, factor: f64, top: f64) -> Self {
        let hz: Vec<f64> = self.hz.iter().map(|hz| hz * factor).take_while(|hz| *hz <= top).collect();
        let bending = self.bending.iter().copied().take(hz.len()).collect();
        Self { hz, bending }
    }

    /// Logarithms of the frequencies in Hz.
    pub fn logs(&self) -> Vec<f64> {
        self.hz.iter().map(|hz| hz.ln()).collect()
    }
}

/// A surface with quantities that are free.
pub(super) struct Model<'a> {
    /// The surface as its file describes it.
    pub nominal: &'a Surface,
    /// The quantities that are fitted.
    pub free: Vec<Quantity>,
    accuracy: Accuracy,
    /// Whether a common factor on all quantities multiplies all frequencies by its root.
    scales: bool,
    /// Whether the shares of energy give the derivatives by tension and modulus.
    shares: bool,
    kept: RefCell<Vec<(Vec<f64>, f64, Computed)>>,
}

impl<'a> Model<'a> {
    /// A surface whose quantities `free` are fitted.
    pub fn new(nominal: &'a Surface, free: &[Quantity]) -> Self {
        Self {
            nominal,
            free: free.to_vec(),
            accuracy: Accuracy::of(nominal.accuracy, ACCURACY),
            scales: scales(nominal, free),
            shares: plain(nominal) && springs_anywhere(nominal) == 0,
            kept: RefCell::new(Vec::new()),
        }
    }

    /// The surface whose quantities are multiplied by the exponentials of `logs`, dimensionless, one for each.
    pub fn surface(&self, logs: &[f64]) -> Surface {
        let mut surface = self.nominal.clone();
        self.free.iter().zip(logs).for_each(|(quantity, log)| quantity.scale(&mut surface, log.exp()));
        surface
    }

    /// The modes up to `top` Hz.
    pub fn modes(&self, logs: &[f64], top: f64) -> Result<Computed, CalibrateError> {
        let common = if self.scales { logs.iter().sum::<f64>() / logs.len() as f64 } else { 0.0 };
        let factor = (0.5 * common).exp();
        let rest: Vec<f64> = logs.iter().map(|log| log - common).collect();
        let same = |(at, reach, _): &&(Vec<f64>, f64, Computed)| {
            *reach * factor >= top && at.iter().zip(&rest).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        if let Some((_, _, known)) = self.kept.borrow().iter().find(same) {
            return Ok(known.scaled(factor, top));
        }
        let reach = AHEAD * top / factor;
        let found = SurfaceModes::solve(&self.surface(&rest), reach, self.accuracy)?;
        let computed = Computed::of(&found, reach);
        let scaled = computed.scaled(factor, top);
        let mut kept = self.kept.borrow_mut();
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((rest, reach, computed));
        Ok(scaled)
    }

    /// At least `count` of the lowest modes, where there are as many below 5 MHz.
    pub fn lowest(&self, logs: &[f64], count: usize) -> Result<Computed, CalibrateError> {
        let surface = self.surface(logs);
        let enough = |hz: f64| expected_modes(&surface, hz) >= count as f64 + 1.0;
        let mut high = 1.0;
        while !enough(high) && high < 5e6 {
            high *= 2.0;
        }
        let mut low = 0.5 * high;
        for _ in 0..5 {
            let middle = (low * high).sqrt();
            if enough(middle) { high = middle } else { low = middle }
        }
        let mut found = self.modes(logs, high)?;
        for _ in 0..6 {
            if found.hz.len() >= count {
                break;
            }
            // Weyl's law counts some modes too many below the first few.
            high *= 1.3;
            found = self.modes(logs, high)?;
        }
        Ok(found)
    }

    /// Derivatives of the logarithms of the frequencies of `computed`, modes x quantities.
    pub fn sensitivities(&self, logs: &[f64], computed: &Computed) -> Result<Vec<Vec<f64>>, CalibrateError> {
        let columns = (0..self.free.len())
            .map(|which| self.sensitivity(logs, computed, which))
            .collect::<Result<Vec<_>, _>>()?;
        Ok((0..computed.hz.len()).map(|mode| columns.iter().map(|column| column[mode]).collect()).collect())
    }

    /// Derivatives by one quantity. By Rayleigh's quotient that of ω² is the share of the energy that is proportional to the quantity.
    fn sensitivity(
        &self,
        logs: &[f64],
        computed: &Computed,
        which: usize,
    ) -> Result<Vec<f64>, CalibrateError> {
        let known = self.shares && computed.bending.len() == computed.hz.len();
        match self.free[which] {
            Quantity::Modulus if known => {
                return Ok(computed.bending.iter().map(|share| 0.5 * share).collect());
            }
            Quantity::Tension if known => {
                return Ok(computed.bending.iter().map(|share| 0.5 * (1.0 - share)).collect());
            }
            _ => {}
        }
        let mut beside = logs.to_vec();
        beside[which] += STEP;
        let top = computed.hz.last().copied().unwrap_or(1.0) * (1.0 + STEP);
        let stepped = self.modes(&beside, top)?;
        let slope =
            |(mode, hz): (usize, &f64)| stepped.hz.get(mode).map_or(0.0, |moved| (moved / hz).ln() / STEP);
        Ok(computed.hz.iter().enumerate().map(slope).collect())
    }
}

/// Number of sides with springs, those of holes included.
fn springs_anywhere(surface: &Surface) -> usize {
    let rims = surface.outline.loops().into_iter().flat_map(|rim| rim.sides);
    rims.filter(|(_, edge)| matches!(edge, Edge::Elastic { .. })).count()
}

/// Whether all stiffness of a sheet is its own, and neither air nor resonators move with it.
fn plain(surface: &Surface) -> bool {
    let stiffens = |kind: &ScattererKind| matches!(kind, ScattererKind::Disc { .. });
    let stuck = surface.sheet.uneven.scatterers.iter().any(|scatterer| stiffens(&scatterer.kind));
    surface.sheet.air == Air::None && !stuck && !surface.sheet.uneven.resonates()
}

/// Whether a common factor on the free quantities is one on all stiffness of the surface.
fn scales(surface: &Surface, free: &[Quantity]) -> bool {
    let has = |quantity: Quantity| free.contains(&quantity);
    let grain = [Quantity::YoungAlong, Quantity::YoungAcross, Quantity::Shear];
    let parts = grain.iter().filter(|quantity| has(**quantity)).count();
    let bends = match (surface.sheet.young > 0.0, has(Quantity::Modulus)) {
        (false, _) => parts == 0,
        (true, true) => parts == 0,
        (true, false) => parts == grain.len(),
    };
    let stretches = surface.sheet.tension == 0.0 || has(Quantity::Tension);
    let rim = springs(surface).count();
    let of_sides = free.iter().any(|quantity| matches!(quantity, Quantity::Side(_)));
    let apart = has(Quantity::Lift) || has(Quantity::Tilt) || of_sides;
    let springy = springs_anywhere(surface) == rim && !apart && (rim == 0 || has(Quantity::Spring));
    let bare = surface.actuators.iter().all(|a| matches!(a.kind, unripple_core::ActuatorKind::Force));
    plain(surface) && bends && stretches && springy && bare
}
