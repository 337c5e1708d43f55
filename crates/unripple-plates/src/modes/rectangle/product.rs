//! Symmetrised products of basis functions along x and y.

use super::line::{Class, Line};
use std::f64::consts::FRAC_1_SQRT_2;
use unripple_core::Encoded;

/// A deflection with norm 1: a function along x times a function along y, alone or with its mirror image (x
/// and y exchanged).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Product {
    /// Index of the function along x.
    pub(crate) x: usize,
    /// Index of the function along y.
    pub(crate) y: usize,
    /// Factor of the mirror image: 0 (no mirror image), 1 or -1.
    pub(crate) mirror: f64,
}

impl Encoded for Product {
    fn encode(&self, to: &mut Vec<u8>) {
        ([self.x, self.y], self.mirror).encode(to);
    }

    fn decode(from: &mut &[u8]) -> Option<Self> {
        let ([x, y], mirror) = Encoded::decode(from)?;
        Some(Self { x, y, mirror })
    }
}

impl Product {
    /// The factor that makes the norm 1.
    pub(crate) fn weight(self) -> f64 {
        match (self.mirror == 0.0, self.x == self.y) {
            (true, _) => 1.0,
            (false, true) => 0.5,
            (false, false) => FRAC_1_SQRT_2,
        }
    }

    /// Mirror image of the product: x and y exchanged.
    pub(crate) fn mirrored(self) -> Self {
        Self { x: self.y, y: self.x, ..self }
    }

    /// Value of the deflection at a point, from the values there of the functions along x and y.
    pub(crate) fn at(self, along_x: &[f64], along_y: &[f64]) -> f64 {
        let direct = along_x[self.x] * along_y[self.y];
        if self.mirror == 0.0 {
            return direct;
        }
        self.weight() * (direct + self.mirror * along_x[self.y] * along_y[self.x])
    }
}

/// A symmetry class: products that couple only with each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Symmetry {
    /// Functions along x.
    pub(crate) x: Class,
    /// Functions along y.
    pub(crate) y: Class,
    /// Parity under the exchange of x and y, 1 or -1; 0 if the class has none.
    pub(crate) mirror: f64,
}

impl Symmetry {
    /// Products of the class, in the order of their indices along x.
    pub(crate) fn products(self) -> impl Iterator<Item = Product> {
        let Self { x, y, mirror } = self;
        (0..x.len())
            .flat_map(move |i| (0..y.len()).map(move |j| Product { x: x.index(i), y: y.index(j), mirror }))
            .filter(move |p| mirror == 0.0 || p.x < p.y || (p.x == p.y && mirror > 0.0))
    }

    /// The class with all functions of two lines that couple with its own.
    pub(crate) fn further(self, lines: &[Line; 2]) -> Self {
        let reach = |axis: usize, class: Class| {
            if lines[axis].exact() { class } else { class.until(lines[axis].count()) }
        };
        Self { x: reach(0, self.x), y: reach(1, self.y), ..self }
    }

    /// All symmetry classes from the classes of functions along x and y, and for each whether its mirror
    /// image is another class with the same modes. `square` if x and y may be exchanged.
    pub(crate) fn all(x: &[Class], y: &[Class], square: bool) -> Vec<(Self, bool)> {
        let pairs =
            x.iter().enumerate().flat_map(|(i, x)| y.iter().enumerate().map(move |(j, y)| (i, j, *x, *y)));
        pairs
            .flat_map(|(i, j, x, y)| {
                let parities: &[f64] = match (square, i.cmp(&j)) {
                    (true, std::cmp::Ordering::Equal) => &[1.0, -1.0],
                    (true, std::cmp::Ordering::Greater) => &[],
                    _ => &[0.0],
                };
                parities.iter().map(move |mirror| (Self { x, y, mirror: *mirror }, square && i < j))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symmetries_share_out_all_products() {
        let classes = [Class { first: 0, step: 2, end: 7 }, Class { first: 1, step: 2, end: 7 }];
        for square in [false, true] {
            let count: usize = Symmetry::all(&classes, &classes, square)
                .into_iter()
                .map(|(symmetry, twice)| symmetry.products().count() * (1 + usize::from(twice)))
                .sum();
            assert_eq!(count, 49);
        }
    }
}
