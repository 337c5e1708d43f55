//! Modes of a sheet coupled by loads on it: dynamic substructuring.
//!
//! The displacement is u = Σ_m φ_m q_m with q̈ + 2Σq̇ + Ω²q = Φ_Aᵀ f - Wᵀ F. Loads move with the velocities W q̇ at their footprints
//! and react with the forces F = Z(s) W q̇. Masses and springs only change the frequencies and shapes; dampers and coils make
//! them complex. The housing of an exciter moves by itself: at one frequency it is part of the impedance Z, for all times a
//! coordinate beside the modes ([`coordinates`]). Responses follow in two ways, which share only the modes: [`Loaded::admittance`], at one frequency, by Woodbury's
//! identity, and [`Loaded::oscillations`], for all times, from the eigenvalues of the coupled system.
//!
//! Modes far above the band contribute their compliance at the loads, though they do not resonate there, since the disc of a
//! finger is smaller than the shortest wavelength. Modes up to `dynamic_hz` are kept one by one; those above only through the
//! combinations Ω^{-2k} Wᵀ that the loads excite (residual attachment modes: Rubin, *AIAA J.* 13, 995, 1975), which makes their
//! compliance at the loads exact to the order (ω/ω_m)^{4·DEPTH}. Above the highest mode computed, the response at the loads is
//! that of an infinite sheet ([`Loaded::with_rest`]).

mod active;
mod admittance;
mod basis;
mod complement;
mod condensed;
mod conservative;
mod coordinates;
mod kept;
mod mixed;
mod oscillations;
mod quotient;
mod remainder;
mod rest;
mod span;
mod state;
mod system;

pub(crate) use active::coordinates_of_loads;
pub use oscillations::Oscillations;
pub(crate) use oscillations::guard;

use crate::loads::FEW;
use crate::{Entry, Footprint, Load, Medium, PhysicsError, Transducer};
use remainder::Remainder;
use rest::WithRest;
use std::sync::Arc;
use unripple_core::{Onset, Pole, Shapes};
use unripple_linalg::Mat;

/// The modes of a sheet with its actuators and the loads on it.
#[derive(Clone, Debug)]
pub struct Loaded {
    shapes: Arc<dyn Shapes>,
    poles: Vec<Pole>,
    transducers: Vec<Transducer>,
    /// Mode shapes averaged over the transducers' footprints times the transducers' gains, transducers x
    /// modes.
    driven: Mat<f64>,
    /// Index into `loads` of each transducer's own load; `None` for a transducer without a load.
    own: Vec<Option<usize>>,
    /// All loads: the transducers' own, then the fingers.
    loads: Vec<Load>,
    /// Mode shapes averaged over the loads' footprints, loads x modes.
    at_loads: Mat<f64>,
}

impl Loaded {
    /// Combines modes of the sheet without loads (shapes and poles) with transducers and with further loads, such as fingers.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a load that is not passive; [`PhysicsError::Unsupported`] if the numbers of poles and shapes
    /// differ or if a pole is not that of a normal mode (its onset is not [`Onset::Velocity`]).
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
        let (driven, at_loads) = weights(transducers, &loads, shapes.as_ref());
        Ok(Self {
            shapes,
            poles: poles.to_vec(),
            transducers: transducers.to_vec(),
            driven,
            own,
            loads,
            at_loads,
        })
    }

    /// Adds the residual compliance at the loads of all modes with wavenumbers above `above` (rad/m), which
    /// were not computed.
    ///
    /// The compliance is the static deflection of an infinite sheet of this `medium`, without its part of wavenumbers below `above`, with
    /// its inertia to first order. `decay` gives the decay rate (1/s) for a frequency (rad/s) and wavenumber (rad/m). Contacts
    /// count as discs of a radius of at least `finest` (m), the thickness of the sheet. Without loads nothing is added; nor is it at
    /// resonators where they are more than 64, for which modes have to be computed up to waves as short as their lattice's.
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
        let many = self.loads.iter().filter(|load| load.resonates()).count() > FEW;
        let corrected = self.loads.iter().filter(|load| !(many && load.resonates()));
        let corrected: Vec<Load> = corrected.cloned().collect();
        if corrected.is_empty() || !(above > 0.0 && finest > 0.0) {
            return Ok(self);
        }
        let remainder = Remainder::new(medium, above, finest);
        let mut poles = self.poles.clone();
        let Some(shapes) = WithRest::add(self.shapes.clone(), &mut poles, &corrected, &remainder, decay)
        else {
            return Ok(self);
        };
        // What the sheet's own modes weigh is known.
        let (driven, at_loads) = weights(&self.transducers, &self.loads, &shapes.added());
        let (driven, at_loads) = (beside(&self.driven, &driven), beside(&self.at_loads, &at_loads));
        Ok(Self { shapes: Arc::new(shapes), poles, driven, at_loads, ..self })
    }

    /// The poles and shapes of the sheet without its loads, with the modes that [`Loaded::with_rest`] added.
    pub(crate) fn sheet(&self) -> (&[Pole], &Arc<dyn Shapes>) {
        (&self.poles, &self.shapes)
    }

    /// Whether any load (finger, mass, coil or housing) acts on the sheet.
    pub fn is_loaded(&self) -> bool {
        !self.loads.is_empty()
    }

    /// Modal force per unit of drive (per coil current for a coil driven by a voltage) of each transducer, for
    /// the modes of the sheet without loads, transducers x modes.
    pub fn input(&self) -> &Mat<f64> {
        &self.driven
    }

    /// Index of the load whose coil a transducer drives by its voltage.
    fn driven_coil(&self, transducer: usize) -> Option<usize> {
        self.own[transducer].filter(|_| self.transducers[transducer].entry == Entry::Voltage)
    }
}

/// The shapes averaged over the footprints of transducers, times their gains, and over those of loads, a row for each. Footprints of both that
/// are equal, as those of a transducer and of its own load, are averaged over once.
fn weights(transducers: &[Transducer], loads: &[Load], shapes: &dyn Shapes) -> (Mat<f64>, Mat<f64>) {
    let mut places: Vec<Footprint> = Vec::new();
    let mut place = |footprint: &Footprint| {
        places.iter().position(|known| known == footprint).unwrap_or_else(|| {
            places.push(footprint.clone());
            places.len() - 1
        })
    };
    let driven: Vec<usize> = transducers.iter().map(|transducer| place(&transducer.footprint)).collect();
    let at_loads: Vec<usize> = loads.iter().map(|load| place(&load.footprint)).collect();
    let all = Footprint::all_weights(&places, shapes);
    let gained = |t: usize, m: usize| all[(driven[t], m)] * transducers[t].gain;
    (
        Mat::from_fn(transducers.len(), shapes.modes(), gained),
        Mat::from_fn(loads.len(), shapes.modes(), |l, m| all[(at_loads[l], m)]),
    )
}

/// Two matrices of as many rows beside each other.
fn beside(left: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    let known = left.ncols();
    Mat::from_fn(left.nrows(), known + right.ncols(), |i, j| {
        if j < known { left[(i, j)] } else { right[(i, j - known)] }
    })
}
