//! Tables of the Bessel functions of which covariances of isotropic wave fields consist.

use unripple_dsp::bessel_j;

/// Nodes per unit of argument: cubics between them are off by 3e-9.
const DENSITY: f64 = 32.0;

/// Tables of J0(x) and 2 J1(x)/x: the spatial covariances of isotropic wave fields of one wavenumber, and of all
/// wavenumbers up to a largest one.
#[derive(Clone, Debug)]
pub(crate) struct Bessel {
    /// Value and slope (per node interval) of each of the two functions at each node, `[node][function][value,
    /// slope]`.
    nodes: Vec<[[f64; 2]; 2]>,
}

impl Bessel {
    /// Tables of both functions for arguments x from 0 up to `most` (dimensionless).
    pub fn up_to(most: f64) -> Self {
        let count = (most.max(0.0) * DENSITY).ceil() as usize + 2;
        Self { nodes: (0..count).map(|i| node(i as f64 / DENSITY)).collect() }
    }

    /// J0(|x|), dimensionless: the covariance of isotropic waves of one wavenumber k at a distance r, with x
    /// = kr. For x beyond the table, the value of its last node is returned.
    pub fn ring(&self, x: f64) -> f64 {
        self.cubic(x, 0)
    }

    /// 2 J1(|x|)/|x|, dimensionless: the covariance of isotropic waves of all wavenumbers up to k at a
    /// distance r, with x = kr. For x beyond the table, the value of its last node is returned.
    pub fn disc(&self, x: f64) -> f64 {
        self.cubic(x, 1)
    }

    fn cubic(&self, x: f64, which: usize) -> f64 {
        let place = x.abs() * DENSITY;
        let at = (place as usize).min(self.nodes.len() - 2);
        let t = (place - at as f64).min(1.0);
        let ([a, da], [b, db]) = (self.nodes[at][which], self.nodes[at + 1][which]);
        let rise = b - a;
        a + t * (da + t * (3.0 * rise - 2.0 * da - db + t * (da + db - 2.0 * rise)))
    }
}

fn node(x: f64) -> [[f64; 2]; 2] {
    let [j0, j1] = [bessel_j(0, x), bessel_j(1, x)];
    let (disc, slope) =
        if x > 1e-3 { (2.0 * j1 / x, 2.0 * (j0 - 2.0 * j1 / x) / x) } else { (1.0 - x * x / 8.0, -x / 4.0) };
    [[j0, -j1 / DENSITY], [disc, slope / DENSITY]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_tables() {
        // Abramowitz and Stegun, table 9.1.
        let table = [
            (0.0, 1.0, 1.0),
            (1.0, 0.765_197_686_557_966_6, 2.0 * 0.440_050_585_744_933_5),
            (5.0, -0.177_596_771_314_338_3, 2.0 * -0.327_579_137_591_465_2 / 5.0),
            (10.0, -0.245_935_764_451_348_3, 2.0 * 0.043_472_746_168_861_4 / 10.0),
        ];
        let bessel = Bessel::up_to(12.0);
        for (x, j0, disc) in table {
            assert!((bessel.ring(x) - j0).abs() < 1e-12 && (bessel.disc(x) - disc).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn cubics_join_the_nodes() {
        let bessel = Bessel::up_to(60.0);
        for i in 0..1000 {
            let x = 0.05991 * f64::from(i);
            let [j0, j1] = [bessel_j(0, x), bessel_j(1, x)];
            assert!((bessel.ring(x) - j0).abs() < 4e-9, "{x}");
            assert!(x < 0.01 || (bessel.disc(x) - 2.0 * j1 / x).abs() < 4e-9, "{x}");
        }
    }
}
