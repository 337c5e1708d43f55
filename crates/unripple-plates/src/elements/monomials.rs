//! Monomials in coordinates centred and scaled for a triangle.

use unripple_core::Point;

/// Degree of the polynomials of a triangle at a clamped or supported curve, where bubble functions are
/// added; the degree is 5 on all other triangles.
pub(crate) const HIGHEST: usize = 7;

/// Number of monomials x^i y^j with i + j ≤ 5: 21, equal to the number of values that determine Argyris's
/// element.
pub(crate) const QUINTIC: usize = count(5);

/// Number of monomials up to the highest degree.
pub(crate) const COUNT: usize = count(HIGHEST);

/// Exponents of all monomials, the lowest degree first.
pub(crate) const EXPONENTS: [[usize; 2]; COUNT] = exponents();

/// Number of monomials x^i y^j up to a degree.
pub(crate) const fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// Index of the monomial with the given exponents in [`EXPONENTS`].
pub(crate) const fn place([i, j]: [usize; 2]) -> usize {
    (i + j) * (i + j + 1) / 2 + j
}

/// The exponents of all monomials, degree by degree.
const fn exponents() -> [[usize; 2]; COUNT] {
    let mut all = [[0; 2]; COUNT];
    let (mut degree, mut next) = (0, 0);
    while degree <= HIGHEST {
        let mut j = 0;
        while j <= degree {
            all[next] = [degree - j, j];
            (next, j) = (next + 1, j + 1);
        }
        degree += 1;
    }
    all
}

/// The centre and scale of a triangle's monomials.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// The centre of the coordinates of the monomials, in metres.
    pub(crate) centre: Point,
    /// The length by which coordinates are divided, in metres.
    pub(crate) scale: f64,
}

/// Value, first and second derivatives of a function at a point: u, u_x, u_y, u_xx, u_xy, u_yy.
pub(crate) type Jet = [f64; 6];

/// Values and derivatives of all monomials at a point: rows u, u_x, u_y, u_xx, u_xy, u_yy.
pub(crate) type Jets = [[f64; COUNT]; 6];

impl Frame {
    /// The frame of a straight triangle: its centroid, and the largest distance of a vertex from the
    /// centroid, in metres.
    pub(crate) fn of(vertices: [Point; 3]) -> Self {
        let third = |f: fn(&Point) -> f64| vertices.iter().map(f).sum::<f64>() / 3.0;
        let centre = Point::new(third(|p| p.x), third(|p| p.y));
        Self { centre, scale: vertices.iter().map(|p| p.distance(centre)).fold(0.0, f64::max) }
    }

    /// A point's coordinates in the frame, dimensionless.
    pub(crate) fn local(&self, p: Point) -> [f64; 2] {
        [(p.x - self.centre.x) / self.scale, (p.y - self.centre.y) / self.scale]
    }

    /// Values of the monomials at a point (m), one per monomial.
    pub(crate) fn values(&self, p: Point) -> [f64; COUNT] {
        let [px, py] = self.local(p).map(powers);
        EXPONENTS.map(|[i, j]| px[i] * py[j])
    }

    /// Values and derivatives (with respect to metres) of all monomials at a point (m): six rows.
    pub(crate) fn jets(&self, p: Point) -> Jets {
        let [px, py] = self.local(p).map(derived);
        let product = |a: usize, b: usize| {
            let unit = self.scale.powi(-((a + b) as i32));
            EXPONENTS.map(|[i, j]| unit * px[a][i] * py[b][j])
        };
        [product(0, 0), product(1, 0), product(0, 1), product(2, 0), product(1, 1), product(0, 2)]
    }
}

/// The powers of a number, from 0 up.
type Powers = [f64; HIGHEST + 1];

fn powers(x: f64) -> Powers {
    let mut p = [1.0; HIGHEST + 1];
    for i in 1..=HIGHEST {
        p[i] = p[i - 1] * x;
    }
    p
}

/// Powers of a number, with the first and second derivatives of each.
fn derived(x: f64) -> [Powers; 3] {
    let p = powers(x);
    let (mut first, mut second) = ([0.0; HIGHEST + 1], [0.0; HIGHEST + 1]);
    for i in 1..=HIGHEST {
        first[i] = i as f64 * p[i - 1];
        second[i] = i as f64 * first[i - 1];
    }
    [p, first, second]
}
