//! Clamped rectangles of any uniform anisotropic sheet by the Ritz method, in products of polynomials.

use super::pencil;
use std::f64::consts::TAU;
use unripple_linalg::Mat;
use unripple_plates::gauss;

/// Number of polynomials along each side; with 22 of them the frequencies used here are up to 3e-8 higher.
const COUNT: usize = 28;

/// (1-x²)² times Legendre's polynomials of degrees 0 to `count` - 1, with first and second derivative, divided by a factor that keeps
/// their curvatures of order one.
pub fn bubbles(x: f64, count: usize) -> Vec<[f64; 3]> {
    let (mut below, mut here) = ([0.0; 3], [1.0, 0.0, 0.0]);
    let s = 1.0 - x * x;
    let window = [s * s, -4.0 * x * s, 12.0 * x * x - 4.0];
    (0..count)
        .map(|n| {
            let p = here;
            let m = n as f64;
            // (m+1) P_{m+1} = (2m+1) x P_m - m P_{m-1}, and its derivatives.
            let times = [x * p[0], p[0] + x * p[1], 2.0 * p[1] + x * p[2]];
            here = std::array::from_fn(|i| ((2.0 * m + 1.0) * times[i] - m * below[i]) / (m + 1.0));
            below = p;
            let scale = 1.0 / (1.0 + m * m);
            [
                scale * window[0] * p[0],
                scale * (window[1] * p[0] + window[0] * p[1]),
                scale * (window[2] * p[0] + 2.0 * window[1] * p[1] + window[0] * p[2]),
            ]
        })
        .collect()
}

/// Frequencies up to `max_hz` (Hz) of a clamped rectangle (m) without tension, of mass per area `mass` (kg/m²) and bending stiffness D11,
/// D12, D16, D22, D26, D66 (N·m).
pub fn clamped([width, height]: [f64; 2], bending: [f64; 6], mass: f64, max_hz: f64) -> Vec<f64> {
    // Integrals of the products of derivatives p and q along a side of length 2.
    let mut lines = vec![vec![Mat::<f64>::zeros(COUNT, COUNT); 3]; 3];
    for (x, w) in gauss(COUNT + 8) {
        let jets = bubbles(x, COUNT);
        for (p, row) in lines.iter_mut().enumerate() {
            for (q, line) in row.iter_mut().enumerate() {
                for i in 0..COUNT {
                    for j in 0..COUNT {
                        line[(i, j)] += w * jets[i][p] * jets[j][q];
                    }
                }
            }
        }
    }
    let (a, b) = (0.5 * width, 0.5 * height);
    // ∫ ∂x^p ∂y^q u ∂x^r ∂y^s v.
    let term = |[p, q]: [usize; 2], [r, s]: [usize; 2], i: usize, j: usize| {
        let unit = a.powi(1 - (p + r) as i32) * b.powi(1 - (q + s) as i32);
        unit * lines[p][r][(i / COUNT, j / COUNT)] * lines[q][s][(i % COUNT, j % COUNT)]
    };
    let curvatures = [([2, 0], 1.0), ([0, 2], 1.0), ([1, 1], 2.0)];
    let entry = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];
    let size = COUNT * COUNT;
    let stiffness = Mat::from_fn(size, size, |i, j| {
        let mut sum = 0.0;
        for (m, (left, f)) in curvatures.iter().enumerate() {
            for (n, (right, g)) in curvatures.iter().enumerate() {
                sum += f * g * bending[entry[m][n]] * term(*left, *right, i, j);
            }
        }
        sum
    });
    let weights = Mat::from_fn(size, size, |i, j| mass * term([0, 0], [0, 0], i, j));
    let top = (TAU * max_hz).powi(2);
    let all = pencil(&stiffness, &weights, 0.0);
    all.into_iter().filter(|s| *s < top).map(|s| s.sqrt() / TAU).collect()
}

/// Bending stiffness D11, D12, D16, D22, D26, D66 over E1 h³/12 of a sheet whose grain is turned by an angle (rad): from the four constants
/// of the rotation (Tsai and Pagano 1968). `across` is E2/E1, `shear` G/E1.
pub fn turned_grain(poisson: f64, across: f64, shear: f64, angle: f64) -> [f64; 6] {
    let whole = 1.0 / (1.0 - poisson * poisson * across);
    let (q11, q22, q12, q66) = (whole, across * whole, poisson * across * whole, shear);
    let u1 = (3.0 * q11 + 3.0 * q22 + 2.0 * q12 + 4.0 * q66) / 8.0;
    let u2 = (q11 - q22) / 2.0;
    let u3 = (q11 + q22 - 2.0 * q12 - 4.0 * q66) / 8.0;
    let u4 = (q11 + q22 + 6.0 * q12 - 4.0 * q66) / 8.0;
    let ((s2, c2), (s4, c4)) = ((2.0 * angle).sin_cos(), (4.0 * angle).sin_cos());
    [
        u1 + u2 * c2 + u3 * c4,
        u4 - u3 * c4,
        0.5 * u2 * s2 + u3 * s4,
        u1 - u2 * c2 + u3 * c4,
        0.5 * u2 * s2 - u3 * s4,
        0.5 * (u1 - u4) - u3 * c4,
    ]
}
