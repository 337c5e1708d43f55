//! A damped oscillator as a pole: natural frequency, decay rate, impulse response, and its initial condition.

/// The initial condition of an oscillation just after a unit impulse: a velocity or a displacement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Onset {
    /// Displacement 0 and velocity 1: an oscillator excited by a force impulse. Undamped normal modes, and modes that damping
    /// does not couple, start like this.
    #[default]
    Velocity,
    /// Displacement 1/ω and velocity 0, in quadrature to [`Onset::Velocity`]. Complex modes, which damping
    /// couples, vibrate with a phase that depends on the place, so that each needs oscillations of both
    /// kinds.
    Displacement,
}

/// A decaying oscillation, the solution of ü + 2σu̇ + ω²u = unit impulse, for unit modal mass.
///
/// The closed forms of this solution hold for underdamped, critically damped, overdamped and rigid (ω = 0) oscillators.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// Undamped angular frequency ω, in rad/s.
    pub omega: f64,
    /// Decay rate of the amplitude σ = 1/τ, in 1/s.
    pub sigma: f64,
    /// The initial condition of the oscillation just after a unit impulse.
    pub onset: Onset,
}

impl Pole {
    /// An oscillation of angular frequency `omega` (rad/s) and decay rate `sigma` (1/s) that starts with
    /// velocity 1 after a unit impulse ([`Onset::Velocity`]).
    pub fn new(omega: f64, sigma: f64) -> Self {
        Self { omega, sigma, onset: Onset::Velocity }
    }

    /// An oscillation of angular frequency `omega` (rad/s) and decay rate `sigma` (1/s) that a unit
    /// impulse starts with displacement 1/ω and velocity 0 ([`Onset::Displacement`]).
    pub fn moved(omega: f64, sigma: f64) -> Self {
        Self { omega, sigma, onset: Onset::Displacement }
    }

    /// The initial state `[displacement, velocity]` just after a unit impulse of modal force.
    pub fn kick(self) -> [f64; 2] {
        match self.onset {
            Onset::Velocity => [0.0, 1.0],
            Onset::Displacement if self.omega > 0.0 => [1.0 / self.omega, 0.0],
            Onset::Displacement => [0.0, 0.0],
        }
    }

    /// Displacement at time `t` (s, of either sign) after a unit impulse: e^{-σt} sin(ω_d t)/ω_d for [`Onset::Velocity`],
    /// with ω_d = √(ω² - σ²).
    pub fn displacement(self, t: f64) -> f64 {
        let (c, s) = self.swing(t);
        let [u, v] = self.kick();
        u * (c + self.sigma * s) + v * s
    }

    /// Velocity at time `t` (s) after a unit impulse, the derivative of [`Pole::displacement`]; 1 at t = 0 for
    /// [`Onset::Velocity`].
    ///
    /// For negative `t` it is the analytic continuation, not zero.
    pub fn velocity(self, t: f64) -> f64 {
        let (c, s) = self.swing(t);
        match self.onset {
            Onset::Velocity => c - self.sigma * s,
            Onset::Displacement => -self.omega * s,
        }
    }

    /// Exact state-transition matrix over `dt` seconds of free decay: displacement and velocity `[u, v]` become
    /// `[[a, b], [c, d]] [u, v]`.
    pub fn step(self, dt: f64) -> [[f64; 2]; 2] {
        let (c, s) = self.swing(dt);
        let (sigma, omega) = (self.sigma, self.omega);
        [[c + sigma * s, s], [-omega * omega * s, c - sigma * s]]
    }

    /// e^{-σt} cos(ω_d t) and e^{-σt} sin(ω_d t)/ω_d, through their limits where ω_d is zero or imaginary.
    fn swing(self, t: f64) -> (f64, f64) {
        let square = (self.omega - self.sigma) * (self.omega + self.sigma);
        let rate = square.abs().sqrt();
        let x = rate * t;
        let decay = (-self.sigma * t).exp();
        // Near critical damping by their series, whose next terms are below rounding.
        if x.abs() < 1e-6 {
            let (c, s) = if square >= 0.0 {
                (1.0 - x * x / 2.0, 1.0 - x * x / 6.0)
            } else {
                (1.0 + x * x / 2.0, 1.0 + x * x / 6.0)
            };
            (decay * c, decay * t * s)
        } else if square > 0.0 {
            (decay * x.cos(), decay * x.sin() / rate)
        } else {
            // Two real exponentials, kept apart so that a strongly damped mode does not overflow in cosh.
            let slow = ((rate - self.sigma) * t).exp();
            let fast = (-(rate + self.sigma) * t).exp();
            ((slow + fast) / 2.0, (slow - fast) / (2.0 * rate))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn of(omega: f64, sigma: f64) -> Pole {
        Pole { omega, sigma, onset: Onset::Velocity }
    }

    const POLES: [Pole; 6] = [
        of(1000.0, 14.0),
        of(1000.0, 0.0),
        of(1000.0, 1000.0),
        of(1000.0, 4000.0),
        of(0.0, 14.0),
        of(0.0, 0.0),
    ];

    #[test]
    fn solves_its_equation() {
        for pole in POLES {
            for t in [1e-4, 7e-4, 3e-3] {
                let d = 1e-7;
                let acceleration = (pole.velocity(t + d) - pole.velocity(t - d)) / (2.0 * d);
                let residual = acceleration
                    + 2.0 * pole.sigma * pole.velocity(t)
                    + pole.omega * pole.omega * pole.displacement(t);
                let scale = 1.0 + pole.omega + 2.0 * pole.sigma;
                assert!(residual.abs() < 1e-6 * scale, "{pole:?} at {t}: {residual}");
            }
        }
    }

    #[test]
    fn steps_as_it_rings() {
        for pole in POLES {
            let dt = 1.0 / 48e3;
            let m = pole.step(dt);
            let (mut u, mut v) = (0.0, 1.0);
            for i in 1..2000 {
                (u, v) = (m[0][0] * u + m[0][1] * v, m[1][0] * u + m[1][1] * v);
                let t = f64::from(i) * dt;
                assert!((v - pole.velocity(t)).abs() < 1e-10, "{pole:?}");
                assert!((u - pole.displacement(t)).abs() < 1e-12, "{pole:?}");
            }
        }
    }

    #[test]
    fn moved_oscillations_ring_as_they_step() {
        for pole in POLES.map(|p| Pole::moved(p.omega, p.sigma)) {
            let m = pole.step(3e-4);
            let [u, v] = pole.kick();
            assert_eq!([u, v], [pole.displacement(0.0), pole.velocity(0.0)]);
            assert!((m[0][0] * u + m[0][1] * v - pole.displacement(3e-4)).abs() < 1e-12, "{pole:?}");
            assert!((m[1][0] * u + m[1][1] * v - pole.velocity(3e-4)).abs() < 1e-10, "{pole:?}");
        }
    }
}
