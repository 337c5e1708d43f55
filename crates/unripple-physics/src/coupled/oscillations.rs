//! Damped oscillations of the coupled system, as real modal responses.

use super::Loaded;
use super::active::Active;
use super::basis::{Shape, split};
use super::condensed;
use super::conservative::Conservative;
use super::coordinates::Coordinates;
use super::mixed::Mixed;
use super::quotient;
use super::state::{Drives, Root, State, proportional};
use crate::PhysicsError;
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{Memory, Observed, Pole, Shapes};
use unripple_linalg::{Mat, c64, product};

/// A part of an oscillation below this share of its largest part is rounding error and is left out. Larger,
/// weak parts that matter at nodes of the others would be lost.
const VANISHED: f64 = 1e-12;

/// Number of bytes needed for each pair of coupled modes: the state matrix with twice as many rows as
/// modes, its decomposition, complex eigenvectors and their inverse. Doubled, 0.7 times as many modes are
/// allowed.
const BYTES_PER_PAIR: f64 = 320.0;

/// Number of bytes needed for each pair of a mode that does not couple to the loads and any other mode: two
/// copies of its readout weight.
const BYTES_PER_READOUT: f64 = 16.0;

/// The decaying oscillations of a loaded sheet, with real input and readout weights, in the form of modal
/// responses.
#[derive(Clone, Debug)]
pub struct Oscillations {
    /// The poles, in order of ascending frequency; a mode with a complex shape is represented by up to four
    /// oscillations with real weights.
    pub poles: Vec<Pole>,
    /// Input weights per unit of drive, transducers x oscillations.
    pub input: Mat<f64>,
    /// Readout weights at any point, in 1/√kg.
    pub shapes: Arc<dyn Shapes>,
    /// The poles of the modes of the loaded sheet, one per mode, in order of ascending natural frequency.
    /// Real poles, whose motion does not oscillate, are not included.
    pub modes: Vec<Pole>,
}

/// One oscillation: its pole, the column of its readout, its input weights.
struct Part {
    pole: Pole,
    column: usize,
    input: Vec<f64>,
}

/// The list of oscillations while it is being built.
#[derive(Default)]
struct Parts {
    parts: Vec<Part>,
    /// Readout weights as combinations of modes, one list of coefficients per column.
    columns: Vec<Vec<f64>>,
    /// Poles of the modes, one per mode.
    modes: Vec<Pole>,
}

impl Loaded {
    /// The decaying oscillations of the sheet with all loads. Modes up to `dynamic_hz` (Hz) are treated one
    /// by one, higher modes only in the combinations that the loads excite.
    ///
    /// Oscillations of a frequency |s|/2π outside `band` (Hz) are left out. A complex mode with poles s = -σ ± jω_d has the
    /// displacement 2Re(D e^{st}), D = shape · input. It is written as ω 2Re(D) times an oscillation of
    /// [`Onset::Displacement`](unripple_core::Onset::Displacement) plus 2Re(D s) times one of
    /// [`Onset::Velocity`](unripple_core::Onset::Velocity), both of frequency ω = |s| and decay rate σ; each coefficient is a sum of
    /// two products of real weights. So there are up to four oscillations, and one where damping does not couple modes. A real
    /// pole p is written as an overdamped oscillation of poles p and 2p, of which the part of 2p cancels. Real poles above the
    /// band are kept, since they do not oscillate.
    ///
    /// # Errors
    /// [`PhysicsError::TooLarge`] if more memory would be needed than [is allowed](Memory); [`PhysicsError::NotConverged`] if an eigenvalue
    /// problem fails.
    pub fn oscillations(&self, dynamic_hz: f64, band: [f64; 2]) -> Result<Oscillations, PhysicsError> {
        let system = self.coordinates();
        let (active, passive) = split(&system.poles, system.at_loads.as_ref());
        let coupled = active.iter().filter(|shape| shape.pole.omega <= TAU * dynamic_hz).count();
        guard(coupled, passive.len() * system.poles.len(), band[1])?;
        Observed::here().part(|| format!("{coupled} modes coupled to {} loads", system.loads.len()));
        let mut parts = Parts::default();
        let [low, high] = band.map(|hz| TAU * hz);
        // A mode exactly at the top stays in, whatever the rounding.
        let within = move |omega: f64| omega >= low && omega <= high * (1.0 + 1e-9);
        for shape in passive.iter().filter(|shape| within(shape.pole.omega)) {
            parts.alone(shape, &system);
        }
        let active = Active::of(&active, system.at_loads.as_ref(), TAU * dynamic_hz);
        let modes = Conservative::of(&active, &system.loads, dynamic_hz)?;
        let drives = system.drives(&active, &modes);
        let kept = parts.columns.len();
        if proportional(&modes, &system.loads) {
            for m in (0..modes.omegas.len()).filter(|m| within(modes.omegas[*m])) {
                parts.real(m, &modes, &drives);
            }
        } else {
            let found = quotient::roots(&active, &modes, &system.loads, &drives)
                .or_else(|| condensed::roots(&modes, &system.loads, &drives, high));
            let found = match found {
                Some(found) => found,
                None => State::of(&modes, &system.loads, &drives).roots(dynamic_hz)?,
            };
            for root in found {
                let real = root.s.im == 0.0;
                if (real && root.s.norm() >= low) || within(root.s.norm()) {
                    parts.complex(root);
                }
            }
        }
        let basis = product(active.map.as_ref(), modes.shapes.as_ref());
        Ok(parts.whole(self, kept, &basis))
    }
}

impl Coordinates {
    /// How each transducer's drive acts: as forces on the modes, or as the voltage on its coil.
    fn drives(&self, active: &Active, modes: &Conservative) -> Drives {
        let basis = product(active.map.as_ref(), modes.shapes.as_ref());
        let mut forces = product(self.driven.as_ref(), basis.as_ref());
        for (drive, load) in self.coils.iter().enumerate() {
            let Some(load) = *load else { continue };
            // A coil of negligible inductance gives a force at once; otherwise its current has to build up first.
            let direct = self.loads[load].direct_coil_force();
            for m in 0..forces.ncols() {
                forces[(drive, m)] = direct * modes.at_loads[(load, m)];
            }
        }
        Drives { forces, coils: self.coils.clone() }
    }
}

/// Refuses a problem that would not fit into memory, before any memory is allocated: `coupled` modes that
/// couple to loads, and `readouts` pairs of a mode that does not couple and any mode. `max_hz` (Hz) is the
/// top of the band.
pub(crate) fn guard(coupled: usize, readouts: usize, max_hz: f64) -> Result<(), PhysicsError> {
    let needed = BYTES_PER_PAIR * (coupled as f64).powi(2) + BYTES_PER_READOUT * readouts as f64;
    let memory = Memory::here();
    if memory.holds(needed) {
        return Ok(());
    }
    // The number of modes grows at least in proportion to the frequency, so that this is not too much.
    let nearest_hz = max_hz * (memory.bytes() / needed).sqrt();
    Err(PhysicsError::too_large(max_hz, 2 * coupled, needed, nearest_hz))
}

impl Parts {
    /// Adds the oscillation of a mode that does not couple to the loads.
    fn alone(&mut self, shape: &Shape, system: &Coordinates) {
        let mut column = vec![0.0; system.poles.len()];
        shape.parts.iter().for_each(|(mode, part)| column[*mode] = *part);
        let input = (0..system.coils.len())
            .map(|t| match system.coils[t] {
                Some(_) => 0.0,
                None => shape.weight(system.driven.row(t)),
            })
            .collect();
        self.modes.push(shape.pole);
        self.parts.push(Part { pole: shape.pole, column: self.columns.len(), input });
        self.columns.push(column);
    }

    /// Adds a conservative mode that damping does not couple to others.
    fn real(&mut self, mode: usize, modes: &Conservative, drives: &Drives) {
        let mut column = vec![0.0; modes.omegas.len()];
        column[mode] = 1.0;
        let pole = Pole::new(modes.omegas[mode], 0.5 * modes.damping[(mode, mode)]);
        let input = drives.forces.col(mode).iter().copied().collect();
        self.modes.push(pole);
        self.parts.push(Part { pole, column: self.columns.len(), input });
        self.columns.push(column);
    }

    /// Adds the oscillations of a complex pair or of a real pole.
    fn complex(&mut self, root: Root) {
        let real = root.s.im == 0.0;
        // A real pole decays at least a little, so that rounding cannot let it grow.
        let s = if real { c64::new(root.s.re.min(-1e-9), 0.0) } else { root.s };
        let (omega, sigma, both) = if real {
            (2f64.sqrt() * s.norm(), 1.5 * s.norm(), 1.0)
        } else {
            (s.norm(), (-s.re).max(0.0), 2.0)
        };
        if !real {
            self.modes.push(Pole::new(omega, sigma));
        }
        // The phase for which the shape is as nearly real as possible.
        let turn = root.shape.iter().map(|d| d * d).sum::<c64>().sqrt();
        let turn = if turn.norm() > 0.0 { turn.conj() / turn.norm() } else { c64::new(1.0, 0.0) };
        let input: Vec<c64> = root.input.iter().map(|b| b * turn.conj() * both).collect();
        // Re(D x) = Re(shape) Re(input x) - Im(shape) Im(input x).
        let parts: [fn(c64) -> f64; 2] = [|x| x.re, |x| -x.im];
        let halves = [1.0, -1.0].into_iter().zip(parts).map(|(sign, part)| {
            (root.shape.iter().map(|d| sign * part(d * turn)).collect::<Vec<f64>>(), part)
        });
        let halves: Vec<_> = halves.collect();
        let onsets = [(Pole::new(omega, sigma), s), (Pole::moved(omega, sigma), c64::new(omega, 0.0))];
        let mut found = Vec::new();
        for (half, (readout, part)) in halves.iter().enumerate() {
            for (pole, factor) in onsets {
                let input: Vec<f64> = input.iter().map(|b| part(b * factor)).collect();
                found.push((half, pole, largest(readout) * largest(&input), input));
            }
        }
        let whole = found.iter().map(|(.., size, _)| *size).fold(0.0, f64::max);
        for (half, (readout, _)) in halves.into_iter().enumerate() {
            let column = self.columns.len();
            let kept = found.iter().filter(|(h, _, size, _)| *h == half && *size > VANISHED * whole);
            self.parts.extend(kept.map(|(_, pole, _, input)| Part {
                pole: *pole,
                column,
                input: input.clone(),
            }));
            if self.parts.last().is_some_and(|part| part.column == column) {
                self.columns.push(readout);
            }
        }
    }

    /// All oscillations in order of frequency. Columns with an index below `kept` are coefficients of the
    /// modes, the others coefficients of the columns of `basis` (modes x coordinates). Rows beyond the
    /// modes of the sheet are left out, since housings do not move the sheet's points.
    fn whole(mut self, loaded: &Loaded, kept: usize, basis: &Mat<f64>) -> Oscillations {
        let made = Mat::from_fn(basis.ncols(), self.columns.len() - kept, |i, c| self.columns[kept + c][i]);
        let made = basis * made;
        let mixing = Mat::from_fn(loaded.poles.len(), self.columns.len(), |m, c| {
            if c < kept { self.columns[c][m] } else { made[(m, c - kept)] }
        });
        self.parts.sort_by(|a, b| a.pole.omega.total_cmp(&b.pole.omega));
        self.modes.sort_by(|a, b| a.omega.total_cmp(&b.omega));
        let columns = self.parts.iter().map(|part| part.column).collect();
        Oscillations {
            poles: self.parts.iter().map(|part| part.pole).collect(),
            input: Mat::from_fn(loaded.transducers.len(), self.parts.len(), |a, m| self.parts[m].input[a]),
            shapes: Arc::new(Mixed { base: loaded.shapes.clone(), mixing, columns }),
            modes: self.modes,
        }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| v.abs().max(most))
}
