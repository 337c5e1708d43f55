//! Modal states advanced by their exact propagator, in SIMD lanes.

use super::lanes::{
    LANES, Lanes, Rows, Tiles, accumulate, accumulate_both, gather, gather_both, read_out, total, vectors,
};
use pulp::{Simd, as_arrays, as_arrays_mut};
use unripple_core::Pole;

/// Number of terms of the power series for slow modes: the last term is below 1e-20 of the first. Twice as
/// many terms change no sum.
const TERMS: usize = 30;

/// Number of groups of sixteen modes processed together: as many as fit into the first-level cache with
/// their weights.
const TOGETHER: usize = 8;

/// Modal displacements and velocities below this value are set to zero, since denormal numbers would slow
/// the processor down.
const SILENCE: f64 = 1e-200;

/// Coefficients of the modes for one step: [`step::ROWS`] values of sixteen modes each, then those of the
/// next sixteen.
///
/// With the force `f` held and `p = f - ω² u`: `u⁺ = u + strike·v + push·p` and `v⁺ = hold·v + strike·p`.
pub(super) mod step {
    /// The squared angular frequency ω², in 1/s².
    pub(in super::super) const SQUARE: usize = 0;
    /// Displacement after a unit impulse; also the velocity after a unit force held over the step.
    pub(in super::super) const STRIKE: usize = 1;
    /// Velocity at the end of the step per unit of initial velocity, dimensionless.
    pub(in super::super) const HOLD: usize = 2;
    /// Displacement after a unit force held over the step.
    pub(in super::super) const PUSH: usize = 3;
    /// Number of values for each mode.
    pub(in super::super) const ROWS: usize = 4;
}

/// Forces on groups of modes, or their displacement over a step; aligned to cache lines.
#[derive(Default)]
#[repr(align(64))]
struct ModeBlock([Lanes; TOGETHER]);

/// Motion of the ports: displacement over the next step without forces, and velocity, each as sixteen partial sums over modes.
#[derive(Clone, Debug)]
pub(super) struct PortSums {
    /// Sums of displacement, one per column.
    pub(super) motion: Vec<Lanes>,
    /// Sums of velocity, one per column.
    pub(super) velocity: Vec<Lanes>,
    /// Number of ports without load, which come first and need no displacement.
    pub(super) plain: usize,
    /// Whether velocities are needed: some drive acts on the sheet as an impulse.
    pub(super) striking: bool,
}

impl PortSums {
    /// Sets the sums to zero.
    #[inline(always)]
    fn begin(&mut self, columns: usize) {
        self.motion[self.plain..columns].fill([0.0; LANES]);
        if self.striking {
            self.velocity[..columns].fill([0.0; LANES]);
        }
    }

    /// Adds the contributions of groups of modes to the sums.
    #[inline(always)]
    fn add<S: Simd>(
        &mut self,
        simd: S,
        tiles: &[Lanes],
        columns: usize,
        motion: &[Lanes],
        velocity: &[Lanes],
    ) {
        let loaded = [columns, self.plain];
        let moved = &mut self.motion[self.plain..columns];
        if !self.striking {
            accumulate(simd, tiles, loaded, motion, moved);
            return;
        }
        let (plain, fast) = self.velocity[..columns].split_at_mut(self.plain);
        accumulate(simd, tiles, [columns, 0], velocity, plain);
        accumulate_both(simd, tiles, loaded, [motion, velocity], [moved, fast]);
    }
}

/// Impulses and forces on the columns of the tiles.
#[derive(Clone, Copy)]
pub(super) struct PortForces<'a> {
    /// Impulses on all columns, in N·s; empty for none.
    pub(super) impulses: &'a [f64],
    /// Forces on the columns with loads, in N.
    pub(super) forces: &'a [f64],
}

/// Probes: points at which velocity or displacement is read.
#[derive(Clone, Debug)]
pub(super) struct Probes {
    weights: Rows,
    /// For each probe, whether it reads displacement rather than velocity.
    displaced: Vec<bool>,
    sums: Vec<Lanes>,
    /// The last reading of each probe, in m/s or m.
    pub(super) heard: Vec<f64>,
}

impl Probes {
    /// Probes of displacement or velocity. `rows` holds the modes' weights for each probe, probes x modes;
    /// `modes` is the number of all modes, of which the last ones may have no weights.
    pub(super) fn new(rows: &[Vec<f64>], displaced: Vec<bool>, modes: usize) -> Self {
        let mut weights = Rows::zeros(rows.len(), modes);
        rows.iter().enumerate().for_each(|(row, values)| weights.fill(row, values));
        Self { weights, displaced, sums: vec![[0.0; LANES]; rows.len()], heard: vec![0.0; rows.len()] }
    }

    /// Replaces the weights, one per mode, of the probe with this index.
    pub(super) fn place(&mut self, probe: usize, weights: &[f64]) {
        self.weights.fill(probe, weights);
    }

    /// Adds the contributions of groups of modes, beginning at group `first`, to the readings; starts from
    /// zero if that is group 0.
    #[inline(always)]
    fn read_out<S: Simd>(&mut self, simd: S, first: usize, u: &[Lanes], v: &[Lanes]) {
        for (probe, sum) in self.sums.iter_mut().enumerate() {
            if first == 0 {
                *sum = [0.0; LANES];
            }
            let row = &as_arrays::<LANES, _>(self.weights.row(probe)).0[first..];
            read_out(simd, row, if self.displaced[probe] { u } else { v }, sum);
        }
    }

    /// Adds up the partial sums of each probe to its reading, in m/s or m.
    #[inline(always)]
    pub(super) fn reduce<S: Simd>(&mut self, simd: S) -> &[f64] {
        total(simd, &self.sums, &mut self.heard);
        &self.heard
    }
}

/// The state of all modes (displacement and velocity), and their coefficients for a step.
#[derive(Clone, Debug)]
pub(super) struct Field {
    displacement: Rows,
    velocity: Rows,
    steps: Rows,
    /// Copies of the coefficients `STRIKE` and `PUSH` as rows, for sums over modes.
    pub(super) factors: Rows,
}

impl Field {
    /// All modes at rest; `dt` is the length of a step, in s.
    pub(super) fn new(poles: &[Pole], dt: f64) -> Self {
        let modes = poles.len();
        let [displacement, velocity] = [(); 2].map(|()| Rows::zeros(1, modes));
        let steps = Rows::zeros(1, modes.next_multiple_of(LANES) * step::ROWS);
        let mut field = Self { displacement, velocity, steps, factors: Rows::zeros(2, modes) };
        field.tune(poles.iter().copied(), dt);
        field
    }

    /// Sets the poles for steps of `dt` (s); displacement and velocity stay as they are.
    pub(super) fn tune(&mut self, poles: impl Iterator<Item = Pole>, dt: f64) {
        for (m, pole) in poles.enumerate() {
            let [[_, strike], [_, hold]] = pole.step(dt);
            let push = push(pole, dt);
            let rows = [
                (step::SQUARE, pole.omega * pole.omega),
                (step::STRIKE, strike),
                (step::HOLD, hold),
                (step::PUSH, push),
            ];
            let steps = &mut self.steps.row_mut(0)[m / LANES * LANES * step::ROWS..];
            rows.into_iter().for_each(|(row, value)| steps[row * LANES + m % LANES] = value);
            self.factors.row_mut(0)[m] = strike;
            self.factors.row_mut(1)[m] = push;
        }
    }

    /// Displacement of every mode, in m·√kg.
    #[inline(always)]
    pub(super) fn displacement(&self) -> &[f64] {
        self.displacement.row(0)
    }

    /// Velocity of every mode, in √J.
    #[inline(always)]
    pub(super) fn velocity(&self) -> &[f64] {
        self.velocity.row(0)
    }

    /// Applies `impulses`, one per column in N·s, to the modes, and reads the probes.
    #[inline(always)]
    pub(super) fn settle<S: Simd>(
        &mut self,
        simd: S,
        tiles: &Tiles,
        impulses: &[f64],
        probes: Option<&mut Probes>,
    ) {
        let u = as_arrays::<LANES, _>(self.displacement.row(0)).0;
        let v = as_arrays_mut::<LANES, _>(self.velocity.row_mut(0)).0;
        if !impulses.is_empty() {
            gather(simd, tiles.all(), [tiles.columns(), 0], impulses, v);
        }
        if let Some(probes) = probes {
            probes.read_out(simd, 0, u, v);
        }
    }

    /// One pass over the modes: applies impulses, reads probes, advances all modes by one step under the
    /// forces, and sums up the resulting motion of the columns.
    #[inline(always)]
    pub(super) fn sweep<S: Simd>(
        &mut self,
        simd: S,
        tiles: &Tiles,
        laid: &PortForces,
        felt: &mut PortSums,
        mut probes: Option<&mut Probes>,
    ) {
        let displacement = as_arrays_mut::<LANES, _>(self.displacement.row_mut(0)).0;
        let velocity = as_arrays_mut::<LANES, _>(self.velocity.row_mut(0)).0;
        let steps = as_arrays::<{ step::ROWS * LANES }, _>(self.steps.row(0)).0;
        let columns = tiles.columns();
        felt.begin(columns);
        let modes = displacement.chunks_mut(TOGETHER).zip(velocity.chunks_mut(TOGETHER));
        for (chunk, ((u, v), steps)) in modes.zip(steps.chunks(TOGETHER)).enumerate() {
            let tiles = &tiles.all()[chunk * TOGETHER * columns..][..v.len() * columns];
            // Holds the forces first, then the displacement over the next step.
            let mut work = ModeBlock::default();
            let work = &mut work.0[..v.len()];
            let loaded = [columns, felt.plain];
            match (columns > 0 && !laid.impulses.is_empty(), felt.plain < columns) {
                (true, true) => gather_both(simd, tiles, loaded, [laid.impulses, laid.forces], [v, work]),
                (true, false) => gather(simd, tiles, [columns, 0], laid.impulses, v),
                (false, true) => gather(simd, tiles, loaded, laid.forces, work),
                (false, false) => (),
            }
            if let Some(probes) = &mut probes {
                probes.read_out(simd, chunk * TOGETHER, u, v);
            }
            advance::<S, true>(simd, u, v, steps, work);
            felt.add(simd, tiles, columns, work, v);
        }
    }

    /// Sums up the motion of the columns without advancing the modes.
    #[inline(always)]
    pub(super) fn look<S: Simd>(&mut self, simd: S, tiles: &Tiles, felt: &mut PortSums) {
        let displacement = as_arrays_mut::<LANES, _>(self.displacement.row_mut(0)).0;
        let velocity = as_arrays_mut::<LANES, _>(self.velocity.row_mut(0)).0;
        let steps = as_arrays::<{ step::ROWS * LANES }, _>(self.steps.row(0)).0;
        let columns = tiles.columns();
        felt.begin(columns);
        let modes = displacement.chunks_mut(TOGETHER).zip(velocity.chunks_mut(TOGETHER));
        for (chunk, ((u, v), steps)) in modes.zip(steps.chunks(TOGETHER)).enumerate() {
            let tiles = &tiles.all()[chunk * TOGETHER * columns..][..v.len() * columns];
            let mut work = ModeBlock::default();
            advance::<S, false>(simd, u, v, steps, &mut work.0[..]);
            felt.add(simd, tiles, columns, &work.0[..v.len()], v);
        }
    }

    /// Sets modal displacements and velocities below [`SILENCE`] to zero, which can only lower the energy.
    #[inline(always)]
    pub(super) fn silence(&mut self) {
        for x in self.displacement.row_mut(0).iter_mut().chain(self.velocity.row_mut(0)) {
            *x = if x.abs() < SILENCE { 0.0 } else { *x };
        }
    }

    /// Kinetic and elastic energy of the first `modes` modes, in J.
    pub(super) fn energy(&self, modes: usize) -> f64 {
        let steps = self.steps.row(0);
        let twice = |(m, (u, v)): (usize, (&f64, &f64))| {
            let square = steps[(m / LANES * step::ROWS + step::SQUARE) * LANES + m % LANES];
            v * v + square * u * u
        };
        0.5 * self.displacement().iter().zip(self.velocity()).enumerate().take(modes).map(twice).sum::<f64>()
    }
}

/// Advances groups of modes by a step. `work` holds the forces on the modes before, and their displacement
/// over the next step without forces afterwards. With `MOVE` false, only that displacement is computed.
#[inline(always)]
fn advance<S: Simd, const MOVE: bool>(
    simd: S,
    u: &mut [Lanes],
    v: &mut [Lanes],
    steps: &[[f64; step::ROWS * LANES]],
    work: &mut [Lanes],
) {
    for (((u, v), steps), work) in u.iter_mut().zip(v).zip(steps).zip(work) {
        let (u, v) = (S::as_mut_simd_f64s(u).0, S::as_mut_simd_f64s(v).0);
        let (steps, work) = (S::as_simd_f64s(steps).0, S::as_mut_simd_f64s(work).0);
        for i in 0..vectors::<S>() {
            let row = |row: usize| steps[row * vectors::<S>() + i];
            let (square, strike) = (row(step::SQUARE), row(step::STRIKE));
            let (hold, push) = (row(step::HOLD), row(step::PUSH));
            let (mut at, mut fast) = (u[i], v[i]);
            if MOVE {
                let pull = simd.negate_mul_add_e_f64s(square, at, work[i]);
                let moved = simd.mul_add_e_f64s(push, pull, simd.mul_f64s(strike, fast));
                fast = simd.mul_add_e_f64s(hold, fast, simd.mul_f64s(strike, pull));
                at = simd.add_f64s(at, moved);
                (u[i], v[i]) = (at, fast);
            }
            let pull = simd.mul_f64s(square, at);
            work[i] = simd.negate_mul_add_e_f64s(push, pull, simd.mul_f64s(strike, fast));
        }
    }
}

/// Displacement after `dt` (s) under a constant unit force from rest, for unit modal mass: `∫_0^dt g = (1 - a)/ω²`
/// in s², with g the displacement after a unit impulse.
///
/// Computed without cancellation: by a power series if ω dt and σ dt are small, from the two real exponents if the mode is
/// slow and strongly damped.
pub(super) fn push(pole: Pole, dt: f64) -> f64 {
    let (w, s) = (pole.omega * dt, pole.sigma * dt);
    if w > 0.5 {
        return ((1.0 - pole.step(dt)[0][0]) / (pole.omega * pole.omega)).max(0.0);
    }
    if s <= 1.0 {
        // x'' = 1 - 2 s x' - w² x in units of the step.
        let (mut sum, mut before, mut last) = (0.5, 0.0, 0.5);
        for n in 1..TERMS {
            let n = n as f64;
            let next = (-2.0 * s * (n + 1.0) * last - w * w * before) / ((n + 2.0) * (n + 1.0));
            (before, last) = (last, next);
            sum += next;
        }
        return sum * dt * dt;
    }
    let spread = ((s - w) * (s + w)).sqrt();
    let [slow, fast] = [-w * w / (s + spread), -(s + spread)];
    let mean = |x: f64| if x == 0.0 { 1.0 } else { x.exp_m1() / x };
    (mean(slow) - mean(fast)) / (2.0 * spread) * dt * dt
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_force_moves_modes_of_any_kind() {
        // Against Gauss-Legendre sums of the impulse response over many pieces of the step.
        let gauss = unripple_plates::gauss(12);
        let mut worst: f64 = 0.0;
        for omega in [0.0, 1e-6, 1.0, 30.0, 499.0, 501.0, 3e3, 2e4] {
            for sigma in [0.0, 1e-3, 14.0, 499.0, 999.0, 1001.0, 3e3, 4e4] {
                let (pole, dt, pieces) = (Pole::new(omega, sigma), 1e-3, 400);
                let piece = dt / f64::from(pieces);
                let integral: f64 = (0..pieces)
                    .flat_map(|i| gauss.iter().map(move |(x, w)| (f64::from(i) + 0.5 * (1.0 + x), 0.5 * w)))
                    .map(|(at, weight)| weight * piece * pole.displacement(at * piece))
                    .sum();
                worst = worst.max((push(pole, dt) / integral - 1.0).abs());
                assert!(
                    (push(pole, dt) / integral - 1.0).abs() < 1e-10,
                    "{pole:?}: {} {integral}",
                    push(pole, dt)
                );
            }
        }
        assert!(worst > 0.0);
    }

    #[test]
    fn energy_changes_by_the_work_of_the_force() {
        let poles: Vec<Pole> = (0..11).map(|m| Pole::new(f64::from(m * m) * 40.0, 0.0)).collect();
        // A port of its own for each mode.
        let (mut field, mut tiles) = (Field::new(&poles, 1e-3), Tiles::zeros(11, 11));
        tiles.resize(11);
        for m in 0..11 {
            let mut row = [0.0; LANES];
            row[m] = 1.0;
            tiles.set(m, &row);
        }
        let zeros = vec![[0.0; LANES]; 11];
        let mut felt = PortSums { motion: zeros.clone(), velocity: zeros, plain: 0, striking: true };
        let impulses: Vec<f64> = (0..11).map(|m| 1.0 - 0.3 * f64::from(m)).collect();
        let simd = pulp::Scalar::new();
        field.settle(simd, &tiles, &impulses, None);
        for i in 0..200 {
            let (before, from) = (field.energy(11), field.displacement().to_vec());
            let forces: Vec<f64> = (0..11).map(|m| f64::from((7 * i + 3 * m) % 13) * 100.0 - 600.0).collect();
            let laid = PortForces { impulses: &[], forces: &forces };
            field.sweep(simd, &tiles, &laid, &mut felt, None);
            let moved = field.displacement().iter().zip(&from).zip(&forces);
            let work: f64 = moved.map(|((to, from), force)| force * (to - from)).sum();
            let gain = field.energy(11) - before;
            assert!((gain - work).abs() < 1e-11 * field.energy(11).max(1.0), "{i}: {gain} {work}");
        }
    }
}
