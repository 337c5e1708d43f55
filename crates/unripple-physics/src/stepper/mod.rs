//! Time-domain simulation of a surface with its actuators and fingers, block by block: drive in, sensors and probes out.
//!
//! # The scheme
//!
//! Mode m of unit modal mass obeys ü + 2σu̇ + ω²u = Σ_j w_jm F_j, with w_jm the weight of mode m at the footprint of load j. At
//! sample i
//!
//! 1. the drive acts as an impulse: `v_m += gain · w_m · d[i]/rate`. A voltage instead raises the current of its coil by
//!    V/(L · rate), or gives the impulse bl/R · V/rate if there is no inductance; if L/R is about as short as a step, it does both
//!    in part;
//! 2. sensors and probes read the sheet, so that without loads `v[i] = Σ_j h[i-j] d[j]/rate` with the full value of `h[0]`, to
//!    rounding. The sensor of a coil driven by a voltage reads the current j that only the motion drives, L dj/dt + R j = bl·v;
//! 3. one sample passes. Forces F are constant over it, and each mode moves exactly under them: u⁺ = au + bv + γ w·F,
//!    v⁺ = cu + dv + δ w·F with the propagator of [`Pole::step`](unripple_core::Pole::step).
//!
//! The displacement of a load over the sample is exactly Δu_j = w_j·(u⁺ - u) = (part without forces) + Σ_k S_jk F_k with
//! S = W diag(γ) Wᵀ. The parts of the load follow the implicit midpoint rule for this displacement: the force of a spring is
//! -κ(e + e⁺)/2 with e⁺ = e + Δu, of a damper -βΔu/dt, of a mass -μ(v_f⁺ - v_f)/dt with Δu = dt(v_f + v_f⁺)/2, of a coil
//! bl(i + i⁺)/2 with L(i⁺ - i)/dt + R(i + i⁺)/2 = -blΔu/dt. All have the form F = -AΔu + (known terms), A ≥ 0, and the system
//! (I + SA)F = …, with a row for each load, is solved at each step.
//!
//! The housing of an exciter, or the mass of a resonator, is one more coordinate, which moves freely as a mode of frequency 0; its spring,
//! damper and coil are a load
//! for which w_j has the weight -1/√M there, so that Δu_j is the displacement of the contact relative to the housing.
//!
//! # Why it cannot gain energy
//!
//! Since F is constant, its work on the sheet over the sample is exactly F·Δu, and the sheet's energy changes by that minus
//! the dissipation of its modes. By the midpoint rule, the energy of each load changes by -F·Δu minus its dissipation: for
//! the spring, κ(e⁺² - e²)/2 = κ(e + e⁺)/2 · Δu, and so on. So the sum never grows, at any rate and for any load. For a finger
//! that is put down, moved or lifted, the weights w are scaled and mixed, for force and motion alike, so that this holds at
//! each step.
//!
//! The error of loads is of second order in the step ([`StepperOptions::substeps`] shortens it); the sheet alone is exact.

mod bank;
mod couplings;
mod engine;
mod faults;
mod field;
mod history;
mod lanes;
mod lead;
mod options;
mod plant;
mod run;
mod small;
mod surface;
mod touch;
mod wiring;

pub use faults::{FaultySurface, InjectedFaults};
pub use history::History;
pub use options::StepperOptions;
pub use plant::{Channel, ContactWeights, Plant};
pub use surface::{FingerMotion, Reading, Snapshot, VirtualSurface};
