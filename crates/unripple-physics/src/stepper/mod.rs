//! Time-domain simulation of the surface, block by block: drive in, sensors and probes out, fingers on it.
//!
//! # The scheme
//!
//! Mode m of unit modal mass obeys ü + 2σu̇ + ω²u = Σ_j w_jm F_j, w_j what load j feels of the modes. At sample i
//!
//! 1. the drive strikes: `v_m += gain · w_m · d[i]/rate`; a voltage instead jumps the current of its coil by V/(L · rate), or
//!    strikes with bl/R · V/rate where there is no inductance; where L/R is about as short as a step it does both in part;
//! 2. sensors and probes read the sheet, so that without loads `v[i] = Σ_j h[i-j] d[j]/rate` with `h[0]` whole, to rounding; the
//!    sensor of a coil on a voltage reads the current j that the motion alone drives, L dj/dt + R j = bl·v;
//! 3. one sample passes. Forces F are constant over it, and under them each mode moves exactly: u⁺ = au + bv + γ w·F, v⁺ = cu + dv
//!    + δ w·F with the propagator of [`Pole::step`](unripple_core::Pole::step).
//!
//! What a load feels over the sample is the exact change Δu_j = w_j·(u⁺ - u) = (free part) + Σ_k S_jk F_k with
//! S = W diag(γ) Wᵀ. Its own parts follow the implicit midpoint rule on that change: a spring pulls by -κ(e + e⁺)/2 with
//! e⁺ = e + Δu, a damper by -βΔu/dt, a mass by -μ(v_f⁺ - v_f)/dt with Δu = dt(v_f + v_f⁺)/2, a coil by bl(i + i⁺)/2 with
//! L(i⁺ - i)/dt + R(i + i⁺)/2 = -blΔu/dt. All are F = -AΔu + (what is known), A ≥ 0, and (I + SA)F = … is solved at each
//! step, as many rows as there are loads.
//!
//! # Why it cannot gain energy
//!
//! F being constant, its work on the sheet over the sample is F·Δu exactly, and the sheet's own energy changes by that less
//! what its modes dissipate. The midpoint rule makes the change of each load's energy -F·Δu less what it dissipates: for
//! the spring, κ(e⁺² - e²)/2 = κ(e + e⁺)/2 · Δu, and so on. The sum never grows, at any rate and for any load. A finger that
//! comes, moves or goes has its weights w scaled and mixed, force and motion alike, which keeps the argument at each step.
//!
//! Loads are second order in the sample's length ([`StepperOptions::substeps`] shortens it); the sheet alone is exact.

mod bank;
mod couplings;
mod engine;
mod faults;
mod field;
mod history;
mod lanes;
mod lead;
mod plant;
mod run;
mod small;
mod surface;
mod touch;

pub use faults::{InjectedFaults, Misbehaving};
pub use history::History;
pub use plant::{Channel, Footing, Plant};
pub use surface::{FingerMotion, Reading, Snapshot, StepperOptions, VirtualSurface};
