//! Membranes with one singular corner by the method of particular solutions (Fox, Henrici and Moler 1967; Betcke and Trefethen, *SIAM
//! Review* 47, 469, 2005).
//!
//! Around the corner a mode is a sum of J_ν(kr) sin(νθ), ν = nπ/angle, each of which satisfies the equation and the conditions at both
//! edges of the corner. A wavenumber is found where some sum satisfies the conditions at the rest of the rim without vanishing inside:
//! where the least singular value of the rim's rows of an orthonormal basis has a minimum.

use super::bessel::series;
use std::f64::consts::{PI, TAU};
use unripple_linalg::{Mat, singular};

/// Number of particular solutions: ten more change no wavenumber used here by more than 1e-10.
const TERMS: usize = 40;
/// Points along each piece of the rim, and inside.
const POINTS: usize = 50;

/// What holds along a piece of the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// No deflection.
    Fixed,
    /// No slope across the piece: a line of symmetry.
    Mirror,
}

/// A domain around its singular corner at the origin, with an edge along x.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Orders ν of the sines: the first, and from one to the next.
    pub orders: [f64; 2],
    /// The other pieces of the rim, straight, with what holds there.
    pub rim: Vec<([f64; 2], [f64; 2], Along)>,
    /// A length of the domain (m), for the scale of the terms.
    pub size: f64,
    /// Corners of a triangle inside.
    pub inside: [[f64; 2]; 3],
}

impl Domain {
    /// A regular polygon of few sides (`count`; of many, other corners are too near for the sums to converge) and unit circumradius, the modes that all its mirrors leave as they are: half a side of one
    /// corner.
    pub fn regular(count: u32) -> Self {
        let half = PI / f64::from(count);
        let angle = PI - 2.0 * half;
        let (side, apothem) = (2.0 * half.sin(), half.cos());
        let (middle, centre) = ([0.5 * side, 0.0], [0.5 * side, apothem]);
        Self {
            orders: [PI / angle, 2.0 * PI / angle],
            rim: vec![(middle, centre, Along::Mirror)],
            size: 1.0,
            inside: [[0.0, 0.0], middle, centre],
        }
    }

    /// Three unit squares in an L, the singular corner at the origin.
    pub fn ell() -> Self {
        let rim = [[1.0, 0.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [0.0, -1.0]];
        Self {
            orders: [2.0 / 3.0; 2],
            rim: rim.windows(2).map(|w| (w[0], w[1], Along::Fixed)).collect(),
            size: 1.4,
            inside: [[0.9, 0.1], [0.2, 0.9], [-0.9, -0.6]],
        }
    }

    /// The simple wavenumbers between two bounds, where the least singular value has a minimum near 0.
    pub fn wavenumbers(&self, [from, to]: [f64; 2], steps: usize) -> Vec<f64> {
        let place = |i: usize| from + (to - from) * i as f64 / steps as f64;
        let values: Vec<f64> = (0..=steps).map(|i| self.least(place(i))).collect();
        let dips = (1..steps).filter(|i| values[*i] < values[i - 1] && values[*i] <= values[i + 1]);
        let found = dips.map(|i| self.minimum(place(i - 1), place(i + 1)));
        found.filter(|k| self.least(*k) < 1e-4).collect()
    }

    /// The place of a minimum between two bounds, by golden section, then by the parabola of the squares beside it.
    fn minimum(&self, mut a: f64, mut b: f64) -> f64 {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        while b - a > 1e-5 * b {
            let (c, d) = (b - golden * (b - a), a + golden * (b - a));
            if self.least(c) < self.least(d) { b = d } else { a = c }
        }
        // The least singular value is proportional to the distance from the wavenumber.
        let (k, step) = (0.5 * (a + b), 2e-5 * b);
        let [low, middle, high] = [k - step, k, k + step].map(|k| self.least(k).powi(2));
        k + 0.5 * step * (low - high) / (low - 2.0 * middle + high)
    }

    /// The least norm along the rim of a sum whose norm on all points is 1.
    fn least(&self, k: f64) -> f64 {
        let rows = self.rows(k);
        let along = self.rim.len() * POINTS;
        let all = singular(Mat::from_fn(rows.len(), TERMS, |i, j| rows[i][j]).as_ref()).unwrap();
        let kept = all.values.iter().filter(|v| **v > 1e-14 * all.values[0]).count();
        let on_rim = Mat::from_fn(along, kept, |i, j| all.left[(i, j)]);
        singular(on_rim.as_ref()).unwrap().values[kept - 1]
    }

    /// The terms' conditions at points of the rim, then their values at points inside.
    fn rows(&self, k: f64) -> Vec<[f64; TERMS]> {
        let mut rows = Vec::new();
        for ([x, y], [u, v], along) in &self.rim {
            let length = (u - x).hypot(v - y);
            let normal = [(v - y) / length, (x - u) / length];
            for i in 0..POINTS {
                // Denser towards the ends.
                let s = 0.5 - 0.5 * (PI * (i as f64 + 0.5) / POINTS as f64).cos();
                let [value, dx, dy] = self.terms(k, [x + s * (u - x), y + s * (v - y)]);
                rows.push(match along {
                    Along::Fixed => value,
                    Along::Mirror => std::array::from_fn(|j| (normal[0] * dx[j] + normal[1] * dy[j]) / k),
                });
            }
        }
        for i in 0..POINTS {
            // A sequence that fills the triangle evenly.
            let (mut s, mut t) = ((0.618_034 * i as f64).fract(), (0.754_878 * i as f64).fract());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let [a, b, c] = self.inside;
            let at = std::array::from_fn(|n| a[n] + s * (b[n] - a[n]) + t * (c[n] - a[n]));
            rows.push(self.terms(k, at)[0]);
        }
        rows
    }

    /// Values and derivatives by x and y of all terms at a point.
    fn terms(&self, k: f64, [x, y]: [f64; 2]) -> [[f64; TERMS]; 3] {
        let (r, theta) = (x.hypot(y).max(1e-9), y.atan2(x).rem_euclid(TAU));
        let of_order = |j: usize| {
            let order = self.orders[0] + j as f64 * self.orders[1];
            let scale = self.size.powf(-order);
            let [f, slope, _] = series(order, k, r, -1.0).map(|v| scale * v);
            let (s, c) = (order * theta).sin_cos();
            let (along, around) = (slope * s, f * order * c / r);
            [f * s, along * theta.cos() - around * theta.sin(), along * theta.sin() + around * theta.cos()]
        };
        let columns: [[f64; 3]; TERMS] = std::array::from_fn(of_order);
        std::array::from_fn(|d| columns.map(|column| column[d]))
    }
}
