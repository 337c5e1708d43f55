/// A decaying oscillation: ü + 2σu̇ + ω²u = impulse, for unit modal mass.
///
/// Underdamped, critical, overdamped and rigid (ω = 0) oscillators are all exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// Undamped angular frequency ω, in rad/s.
    pub omega: f64,
    /// Decay rate of the amplitude σ = 1/τ, in 1/s.
    pub sigma: f64,
}

impl Pole {
    /// Displacement a time `t` (s, of either sign) after a unit impulse: e^{-σt} sin(ω_d t)/ω_d.
    pub fn displacement(self, t: f64) -> f64 {
        let (_, s) = self.swing(t);
        s
    }

    /// Velocity a time `t` (s) after a unit impulse, the derivative of [`Pole::displacement`]; 1 at t = 0.
    ///
    /// For negative `t` it is the analytic continuation, not zero.
    pub fn velocity(self, t: f64) -> f64 {
        let (c, s) = self.swing(t);
        c - self.sigma * s
    }

    /// Exact propagator over `dt` seconds: `[u, v]` becomes `[[a, b], [c, d]] [u, v]`.
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

    const POLES: [Pole; 6] = [
        Pole { omega: 1000.0, sigma: 14.0 },
        Pole { omega: 1000.0, sigma: 0.0 },
        Pole { omega: 1000.0, sigma: 1000.0 },
        Pole { omega: 1000.0, sigma: 4000.0 },
        Pole { omega: 0.0, sigma: 14.0 },
        Pole { omega: 0.0, sigma: 0.0 },
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
}
