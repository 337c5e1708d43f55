//! A sheet's modes coupled by what hangs on the sheet: dynamic substructuring.
//!
//! The displacement is u = Σ_m φ_m q_m with q̈ + 2Σq̇ + Ω²q = Φ_Aᵀ f - Wᵀ F: loads feel the velocities W q̇ at their footprints and
//! answer with the forces F = Z(s) W q̇. Masses and springs only change the frequencies and shapes; dampers and coils make
//! them complex. Two ways lead from here to a response: [`Loaded::admittance`], at one frequency, by Woodbury's identity,
//! and [`Loaded::oscillations`], at all times, by the eigenvalues of the whole. They share nothing but the modes.
//!
//! Loads feel modes far above the band, whose resonances are out of reach but whose compliance is not: a finger's disc is
//! smaller than the shortest wavelength. Modes up to `dynamic_hz` are kept one by one; those above only through the
//! combinations Ω^{-2k} Wᵀ that the loads set in motion (residual attachment modes: Rubin, *AIAA J.* 13, 995, 1975), which
//! makes what the loads feel of them exact to the order (ω/ω_m)^{4·DEPTH}. Above the highest mode known, the sheet answers as an
//! endless one does ([`Loaded::with_rest`]).

mod active;
mod admittance;
mod basis;
mod conservative;
mod mixed;
mod oscillations;
mod remainder;
mod rest;
mod span;
mod state;

pub use oscillations::Oscillations;

use crate::{Entry, Footprint, Load, Medium, PhysicsError, Transducer};
use remainder::Remainder;
use rest::WithRest;
use std::sync::Arc;
use unripple_core::{Onset, Pole, Shapes};
use unripple_linalg::Mat;

/// A sheet's modes with its actuators and with what hangs on it.
#[derive(Clone, Debug)]
pub struct Loaded {
    shapes: Arc<dyn Shapes>,
    poles: Vec<Pole>,
    transducers: Vec<Transducer>,
    /// Weights of the transducers' footprints times their gains, transducers x modes.
    driven: Mat<f64>,
    /// Index into the loads of each transducer's own, if it acts.
    own: Vec<Option<usize>>,
    /// All that has an impedance: the transducers' own loads, then the fingers.
    loads: Vec<Load>,
    /// Weights of the loads' footprints, loads x modes.
    felt: Mat<f64>,
}

impl Loaded {
    /// Modes with transducers and with loads that belong to no transducer, fingers for example.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a load that is not passive; [`PhysicsError::Unsupported`] if poles and shapes differ in
    /// number or if a pole is not that of a mode (its onset not [`Onset::Velocity`]).
    pub fn new(
        shapes: Arc<dyn Shapes>,
        poles: &[Pole],
        transducers: &[Transducer],
        fingers: &[Load],
    ) -> Result<Self, PhysicsError> {
        if poles.len() != shapes.modes() || poles.iter().any(|pole| pole.onset != Onset::Velocity) {
            return Err(PhysicsError::Unsupported {
                what: "modes to attach loads to",
                expected: "a struck oscillation for each shape",
                found: format!("{} poles and {} shapes", poles.len(), shapes.modes()),
            });
        }
        let mut loads: Vec<Load> = Vec::new();
        let mut own = Vec::new();
        for transducer in transducers {
            let load = transducer.load.as_ref().filter(|load| load.acts());
            own.push(load.map(|_| loads.len()));
            loads.extend(load.cloned());
        }
        loads.extend(fingers.iter().filter(|load| load.acts()).cloned());
        transducers.iter().filter_map(|t| t.load.as_ref()).chain(fingers).try_for_each(Load::check)?;
        let places: Vec<Footprint> = transducers.iter().map(|t| t.footprint.clone()).collect();
        let mut driven = Footprint::all_weights(&places, shapes.as_ref());
        for (row, transducer) in transducers.iter().enumerate() {
            driven.row_mut(row).iter_mut().for_each(|weight| *weight *= transducer.gain);
        }
        let places: Vec<Footprint> = loads.iter().map(|load| load.footprint.clone()).collect();
        let felt = Footprint::all_weights(&places, shapes.as_ref());
        Ok(Self {
            shapes,
            poles: poles.to_vec(),
            transducers: transducers.to_vec(),
            driven,
            own,
            loads,
            felt,
        })
    }

    /// The same, the loads feeling besides the modes given what modes of wavenumbers from `above` (rad/m) on would answer.
    ///
    /// That is the static deflection of an endless sheet of that `medium` less its part below `above`, with its inertia to first
    /// order; `decay` gives the decay rate (1/s) of a motion of some frequency (rad/s) and wavenumber (rad/m). Contacts count as
    /// discs that are no smaller than `finest` (m), the thickness of the sheet.
    ///
    /// # Errors
    /// Those of [`Loaded::new`].
    pub fn with_rest(
        self,
        medium: Medium,
        above: f64,
        finest: f64,
        decay: impl Fn(f64, f64) -> f64,
    ) -> Result<Self, PhysicsError> {
        if !(self.is_loaded() && above > 0.0 && finest > 0.0) {
            return Ok(self);
        }
        let remainder = Remainder::new(medium, above, finest);
        let mut poles = self.poles;
        let shapes = WithRest::add(self.shapes, &mut poles, &self.loads, &remainder, decay);
        let owned = self.own.iter().flatten().count();
        Self::new(shapes, &poles, &self.transducers, &self.loads[owned..])
    }

    /// The oscillations of the sheet without its loads, and their shapes.
    pub(crate) fn sheet(&self) -> (&[Pole], &Arc<dyn Shapes>) {
        (&self.poles, &self.shapes)
    }

    /// Whether anything hangs on the sheet.
    pub fn is_loaded(&self) -> bool {
        !self.loads.is_empty()
    }

    /// Input weights of the transducers without any load, transducers x modes.
    pub fn input(&self) -> &Mat<f64> {
        &self.driven
    }

    /// The load whose voltage a transducer is driven by.
    fn driven_coil(&self, transducer: usize) -> Option<usize> {
        self.own[transducer].filter(|_| self.transducers[transducer].entry == Entry::Voltage)
    }
}
