//! Loads in the time-domain simulation: masses, springs, dampers and coils at ports, eight at a time.

use super::small::{Inverse, OCT, Oct, Small, Solution, add, get, octs, registers, set};
use crate::Circuit;
use pulp::Simd;

/// Factor per step, -0.8, by which the spurious root of the two-step formula for a mass decays. Nearer to
/// 1, an alternation from sample to sample decays more slowly.
const MEMORY: f64 = 0.8;

/// Currents below this value (A) are set to zero, so that none becomes a denormal number, which is slow to
/// compute with. It has no effect on results.
const DEAD: f64 = 1e-200;

/// The constants of a load: a mass, a damper and a spring to the ground, and optionally a coil.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Burden {
    /// Mass μ, in kg.
    pub(super) mass: f64,
    /// Damping β, in N·s/m.
    pub(super) damping: f64,
    /// Stiffness κ to the ground, in N/m.
    pub(super) stiffness: f64,
    /// A coil driven by a voltage; `None` without one.
    pub(super) circuit: Option<Circuit>,
    /// Whether the load belongs to the twin of a housing (a reference copy, see `wiring.rs`), whose energy
    /// is not counted as the surface's.
    pub(super) twin: bool,
}

/// The loads at eight ports: their coefficients for one time step, and their states.
///
/// Over a step the force on the sheet is `F = b - D² Δu`, with Δu the displacement of the port and b from the state before.
#[derive(Clone, Copy, Debug, Default)]
struct Loads {
    /// Coefficients of b/D for the spring's extension (`spring`), the mass's two states (`recall`) and the
    /// current (`carry`).
    spring: Oct,
    recall: [Oct; 2],
    carry: Oct,
    /// Coefficients with which the states advance by one step.
    memory: Oct,
    fade: Oct,
    induce: Oct,
    /// The factor 1/√μ if impulses are shared with masses; else 0.
    lightness: Oct,
    /// Coefficients of the energy: stiffness, inductance, and the quadratic form of the mass.
    stiffness: Oct,
    inductance: Oct,
    masses: [Oct; 3],
    /// Extension of the spring, in m.
    extension: Oct,
    /// Filtered velocity of the mass after the last step and after the step before, in m/s.
    pace: [Oct; 2],
    /// The two parts of the coil's current, in A: what the drive causes in a coil at rest (`still`), and
    /// what the motion drives (`driven`).
    still: Oct,
    driven: Oct,
    /// Work done on the loads since this value was last reset, in J.
    work: Oct,
}

/// The loads at all ports; coefficients are zero at ports without a load.
#[derive(Clone, Debug)]
pub(super) struct Bank {
    loads: Vec<Loads>,
    /// The factor D of each port (`depth`), and √μ if impulses are shared with masses (`heft`).
    depth: Vec<Oct>,
    heft: Vec<Oct>,
    dt: f64,
    right: Vec<Oct>,
    /// Forces over the next step, and the displacement of the ports that they cause.
    forces: Solution,
    /// Displacement of the ports over the next step.
    moved: Vec<Oct>,
    /// Impulses shared with masses, and the changes of velocity that they cause.
    shares: Solution,
    /// Whether masses change their velocity instantly with an impulse on the sheet.
    shared: bool,
}

impl Bank {
    /// Storage for loads at `size` ports, with steps of `dt` seconds; `shared` if masses change their
    /// velocity instantly with an impulse.
    pub(super) fn new(size: usize, dt: f64, shared: bool) -> Self {
        let zeros = vec![[0.0; OCT]; octs(size)];
        Self {
            loads: vec![Loads::default(); zeros.len()],
            depth: zeros.clone(),
            heft: zeros.clone(),
            dt,
            right: zeros.clone(),
            forces: Solution::zeros(size),
            moved: zeros,
            shares: Solution::zeros(size),
            shared,
        }
    }

    /// Attaches a load, at rest, to the port with this index.
    pub(super) fn set(&mut self, port: usize, burden: &Burden) {
        let (dt, shared) = (self.dt, self.shared);
        let (loads, lane) = (&mut self.loads[port / OCT], port % OCT);
        loads.fields().into_iter().for_each(|field| field[lane] = 0.0);
        let coil = burden.circuit.map(|circuit| Coil::of(&circuit, dt)).unwrap_or_default();
        let memory = if shared { 1.0 } else { MEMORY };
        let (first, last) = ((3.0 + memory) / 2.0, (memory - 1.0) / 2.0);
        let mass = burden.mass / dt;
        let square = burden.stiffness / 2.0 + burden.damping / dt + mass * first / dt + coil.square;
        let depth = square.sqrt();
        let over = |x: f64| if depth > 0.0 { x / depth } else { 0.0 };
        loads.spring[lane] = over(-burden.stiffness);
        loads.recall[0][lane] = over(mass * (first * (1.0 + memory) - last));
        loads.recall[1][lane] = over(mass * last);
        loads.carry[lane] = over(coil.carry);
        (loads.memory[lane], loads.fade[lane], loads.induce[lane]) = (memory, coil.fade, coil.induce);
        let counted = if burden.twin { 0.0 } else { 1.0 };
        (loads.stiffness[lane], loads.inductance[lane]) =
            (counted * burden.stiffness, counted * coil.inductance);
        let form = [(5.0 + 3.0 * memory) / 4.0, -(1.0 - memory) * (2.0 + memory) / 2.0, (1.0 - memory) / 4.0];
        let mass = counted * burden.mass;
        loads.masses.iter_mut().zip(form).for_each(|(to, share)| to[lane] = mass * share);
        let heft = if shared { burden.mass.sqrt() } else { 0.0 };
        loads.lightness[lane] = if heft > 0.0 { 1.0 / heft } else { 0.0 };
        self.depth[port / OCT][lane] = depth;
        self.heft[port / OCT][lane] = heft;
    }

    /// Removes the port with this index from `count` ports; the ports behind it move up by one.
    pub(super) fn remove(&mut self, port: usize, count: usize) {
        for vector in [&mut self.depth, &mut self.heft] {
            let flat = vector.as_flattened_mut();
            flat.copy_within(port + 1..count, port);
            flat[count - 1] = 0.0;
        }
        for to in port..count {
            let from = to + 1;
            let mut source = if from < count { self.loads[from / OCT] } else { Loads::default() };
            let to = (&mut self.loads[to / OCT], to % OCT);
            for (field, source) in to.0.fields().into_iter().zip(source.fields()) {
                field[to.1] = source[from % OCT];
            }
        }
    }

    /// The factor D of each port, the square root of the load's effective stiffness over a step, in √(N/m).
    #[inline(always)]
    pub(super) fn depth(&self) -> &[f64] {
        self.depth.as_flattened()
    }

    /// The factor √μ of each port, in √kg, if impulses are shared with masses; else 0.
    #[inline(always)]
    pub(super) fn heft(&self) -> &[f64] {
        self.heft.as_flattened()
    }

    /// Raises the current of a port's coil by `current` (A).
    #[inline(always)]
    pub(super) fn induce(&mut self, port: usize, current: f64) {
        self.loads[port / OCT].still[port % OCT] += current;
    }

    /// The current that the motion drives through a port's coil, in A, positive in the direction of the drive's current.
    #[inline(always)]
    pub(super) fn driven(&self, port: usize) -> f64 {
        self.loads[port / OCT].driven[port % OCT]
    }

    /// Sets currents below [`DEAD`] to zero, before they become denormal.
    pub(super) fn silence(&mut self) {
        for current in self.loads.iter_mut().flat_map(|loads| loads.still.iter_mut().chain(&mut loads.driven))
        {
            if current.abs() < DEAD {
                *current = 0.0;
            }
        }
    }

    /// Extension of a port's spring, in m.
    pub(super) fn extension(&self, port: usize) -> f64 {
        self.loads[port / OCT].extension[port % OCT]
    }

    /// Work done on a port's load since the last reset, in J.
    pub(super) fn work(&self, port: usize) -> f64 {
        self.loads[port / OCT].work[port % OCT]
    }

    /// Force on the sheet at each port over the next step, in N.
    #[inline(always)]
    pub(super) fn forces(&self) -> &[f64] {
        self.forces.scaled.as_flattened()
    }

    /// Whether the velocity of any mass changes instantly with an impulse.
    pub(super) fn shares(&self) -> bool {
        self.heft().iter().any(|heft| *heft > 0.0)
    }

    /// Makes the velocity of each mass equal to that of its port after impulses: returns the impulses on
    /// the sheet that do so, in N·s, and the resulting changes of the ports' velocities. `velocity` holds
    /// the ports' velocities before.
    #[inline(always)]
    pub(super) fn share<S: Simd>(
        &mut self,
        simd: S,
        velocity: &[Oct],
        (inverse, momentum): (&Inverse, &Small),
        ports: usize,
    ) -> (&[Oct], &[Oct]) {
        let two = simd.splat_f64s(2.0);
        for (((right, loads), heft), velocity) in
            self.right.iter_mut().zip(&self.loads).zip(&self.heft).zip(velocity)
        {
            for i in 0..registers::<S>() {
                let lag = simd.mul_f64s(two, get::<S>(&loads.pace[0], i));
                let lag = simd.sub_f64s(lag, get::<S>(velocity, i));
                set::<S>(right, i, simd.mul_f64s(get::<S>(heft, i), lag));
            }
        }
        inverse.solve(simd, (momentum, &self.heft), &self.right, ports, &mut self.shares);
        let half = simd.splat_f64s(0.5);
        let Solution { x, scaled: impulse, image: change, .. } = &self.shares;
        let known = impulse.iter().zip(x).zip(velocity.iter().zip(change));
        for (loads, ((impulse, x), (velocity, change))) in self.loads.iter_mut().zip(known) {
            for i in 0..registers::<S>() {
                let lost = simd.mul_f64s(simd.mul_f64s(half, get::<S>(&loads.lightness, i)), get::<S>(x, i));
                let pace = simd.sub_f64s(get::<S>(&loads.pace[0], i), lost);
                set::<S>(&mut loads.pace[0], i, pace);
                let mean = simd.mul_add_e_f64s(half, get::<S>(change, i), get::<S>(velocity, i));
                let work = simd.negate_mul_add_e_f64s(get::<S>(impulse, i), mean, get::<S>(&loads.work, i));
                set::<S>(&mut loads.work, i, work);
            }
        }
        (impulse, change)
    }

    /// Computes the loads' forces over the next step; `free` is the displacement of the ports without these
    /// forces, in m.
    #[inline(always)]
    pub(super) fn solve<S: Simd>(
        &mut self,
        simd: S,
        free: &[Oct],
        (inverse, push): (&Inverse, &Small),
        ports: usize,
    ) {
        for (((right, loads), depth), free) in
            self.right.iter_mut().zip(&self.loads).zip(&self.depth).zip(free)
        {
            for i in 0..registers::<S>() {
                let product =
                    |a: &Oct, b: &Oct, sum| simd.mul_add_e_f64s(get::<S>(a, i), get::<S>(b, i), sum);
                let current = simd.add_f64s(get::<S>(&loads.still, i), get::<S>(&loads.driven, i));
                let held = simd.mul_f64s(get::<S>(&loads.carry, i), current);
                let held = product(&loads.spring, &loads.extension, held);
                let held = product(&loads.recall[0], &loads.pace[0], held);
                let held = product(&loads.recall[1], &loads.pace[1], held);
                set::<S>(right, i, simd.negate_mul_add_e_f64s(get::<S>(depth, i), get::<S>(free, i), held));
            }
        }
        inverse.solve(simd, (push, &self.depth), &self.right, ports, &mut self.forces);
        self.moved.copy_from_slice(free);
        add(simd, &mut self.moved, &self.forces.image);
    }

    /// Advances the states of all loads by one step.
    #[inline(always)]
    pub(super) fn advance<S: Simd>(&mut self, simd: S) {
        let rate = simd.splat_f64s(1.0 / self.dt);
        for ((loads, force), moved) in self.loads.iter_mut().zip(&self.forces.scaled).zip(&self.moved) {
            for i in 0..registers::<S>() {
                let moved = get::<S>(moved, i);
                let work = simd.negate_mul_add_e_f64s(get::<S>(force, i), moved, get::<S>(&loads.work, i));
                set::<S>(&mut loads.work, i, work);
                let extension = simd.add_f64s(get::<S>(&loads.extension, i), moved);
                set::<S>(&mut loads.extension, i, extension);
                let before = get::<S>(&loads.pace[0], i);
                let mean = simd.mul_f64s(moved, rate);
                let pace = simd.negate_mul_add_e_f64s(get::<S>(&loads.memory, i), before, mean);
                set::<S>(&mut loads.pace[1], i, before);
                set::<S>(&mut loads.pace[0], i, pace);
                let (fade, induced) =
                    (get::<S>(&loads.fade, i), simd.mul_f64s(get::<S>(&loads.induce, i), moved));
                let left = simd.mul_f64s(fade, get::<S>(&loads.driven, i));
                set::<S>(&mut loads.driven, i, simd.sub_f64s(left, induced));
                let still = simd.mul_f64s(fade, get::<S>(&loads.still, i));
                set::<S>(&mut loads.still, i, still);
            }
        }
    }

    /// Sets the work done on all loads to zero.
    #[inline(always)]
    pub(super) fn reset_work(&mut self) {
        self.loads.iter_mut().for_each(|loads| loads.work = [0.0; OCT]);
    }

    /// Energy stored in all loads, in J.
    pub(super) fn energy(&self) -> f64 {
        let twice = |loads: &Loads, lane: usize| {
            let [now, before] = loads.pace.map(|pace| pace[lane]);
            let [a, b, c] = loads.masses.map(|mass| mass[lane]);
            loads.stiffness[lane] * loads.extension[lane] * loads.extension[lane]
                + loads.inductance[lane] * (loads.still[lane] + loads.driven[lane]).powi(2)
                + 2.0 * (a * now * now + b * now * before + c * before * before)
        };
        0.5 * self.loads.iter().map(|loads| (0..OCT).map(|lane| twice(loads, lane)).sum::<f64>()).sum::<f64>()
    }
}

impl Loads {
    /// All fields, for operations on each of them.
    fn fields(&mut self) -> [&mut Oct; 19] {
        let [r0, r1] = &mut self.recall;
        let [m0, m1, m2] = &mut self.masses;
        let [p0, p1] = &mut self.pace;
        let steps = [&mut self.memory, &mut self.fade, &mut self.induce, &mut self.lightness];
        let [memory, fade, induce, lightness] = steps;
        let (stiffness, inductance) = (&mut self.stiffness, &mut self.inductance);
        let (extension, still, driven) = (&mut self.extension, &mut self.still, &mut self.driven);
        let work = &mut self.work;
        let (spring, carry) = (&mut self.spring, &mut self.carry);
        [
            spring, r0, r1, carry, memory, fade, induce, lightness, stiffness, inductance, m0, m1, m2,
            extension, p0, p1, still, driven, work,
        ]
    }
}

/// The exact coefficients of a coil for one step at a constant velocity ν of its port.
///
/// With θ = R dt/L, the current goes to `i e^{-θ} - (bl ν/R)(1 - e^{-θ})`, and its mean is `p i - bl ν (1 - p)/R`,
/// `p = (1 - e^{-θ})/θ`.
#[derive(Clone, Copy, Debug, Default)]
struct Coil {
    /// Contribution of the coil to D² (the load's effective stiffness over a step), in N/m.
    square: f64,
    /// Mean force over the step per initial current, in N/A.
    carry: f64,
    /// Share of the initial current that is left after the step.
    fade: f64,
    /// Decrease of the current over the step per displacement of the port, in A/m.
    induce: f64,
    inductance: f64,
}

impl Coil {
    /// The coefficients of a coil for steps of `dt` (s).
    fn of(circuit: &Circuit, dt: f64) -> Self {
        let Circuit { force_constant: bl, resistance, inductance } = *circuit;
        let theta = resistance * dt / inductance;
        if inductance == 0.0 {
            let square = bl * bl / resistance / dt;
            return Self { square, induce: bl / resistance / dt, ..Self::default() };
        }
        let lost = -(-theta).exp_m1();
        let mean = lost / theta;
        // (1 - p)/θ, by its series where that would cancel.
        let lag = if theta < 1e-3 { 0.5 - theta / 6.0 + theta * theta / 24.0 } else { (1.0 - mean) / theta };
        Self {
            square: bl * bl * lag / inductance,
            carry: bl * mean,
            fade: 1.0 - lost,
            induce: bl * mean / inductance,
            inductance,
        }
    }
}
