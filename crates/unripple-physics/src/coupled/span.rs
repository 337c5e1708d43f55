//! Gram-Schmidt orthonormalisation, vector by vector.

/// A set of orthonormal vectors that grows vector by vector.
#[derive(Debug, Default)]
pub(super) struct Span {
    /// The orthonormal vectors so far.
    pub vectors: Vec<Vec<f64>>,
}

impl Span {
    /// Adds the part of a vector that is orthogonal to those in the set, normalised to length 1, unless
    /// that part is at most the share `least` of the vector; returns whether it was added.
    ///
    /// Gram-Schmidt orthogonalisation, twice, which is enough (Giraud et al., *Numer. Math.* 101, 87, 2005).
    pub fn add(&mut self, mut vector: Vec<f64>, least: f64) -> bool {
        let whole = norm(&vector);
        if !(whole > 0.0 && whole.is_finite()) {
            return false;
        }
        vector.iter_mut().for_each(|v| *v /= whole);
        for _ in 0..2 {
            for known in &self.vectors {
                let part: f64 = known.iter().zip(&vector).map(|(a, b)| a * b).sum();
                vector.iter_mut().zip(known).for_each(|(v, k)| *v -= part * k);
            }
        }
        let left = norm(&vector);
        if left <= least {
            return false;
        }
        // Once more, since the remainder may contain rounding along the others.
        vector.iter_mut().for_each(|v| *v /= left);
        for known in &self.vectors {
            let part: f64 = known.iter().zip(&vector).map(|(a, b)| a * b).sum();
            vector.iter_mut().zip(known).for_each(|(v, k)| *v -= part * k);
        }
        let left = norm(&vector);
        vector.iter_mut().for_each(|v| *v /= left);
        self.vectors.push(vector);
        true
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stays_orthonormal_and_refuses_what_it_has() {
        let mut span = Span::default();
        for i in 0..6 {
            let vector = (0..20).map(|j| 1.0 + 1e-3 * f64::from(i * j).sin()).collect();
            assert!(span.add(vector, 1e-10));
        }
        let sum = (0..20).map(|j| span.vectors[0][j] - 3.0 * span.vectors[4][j]).collect();
        assert!(!span.add(sum, 1e-10));
        assert!(!span.add(vec![0.0; 20], 1e-10));
        for (i, a) in span.vectors.iter().enumerate() {
            for (j, b) in span.vectors.iter().enumerate() {
                let product: f64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
    }
}
