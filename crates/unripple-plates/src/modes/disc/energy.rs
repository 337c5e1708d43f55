//! The elastic energy of a round sheet in the functions of one angular order.

use super::super::eigen::product;
use super::super::legendre::gauss;
use super::problem::Problem;
use super::radial::{Jet, Radial};
use unripple_linalg::{Mat, MatRef, Par};

/// The energy as a sum of squares: twice that of a deflection Σ c_j f_j cos nθ, per mass, is |Xc|², in 1/s².
///
/// T ∫ f'² + n² f²/ξ² and D ∫ (f''+κ)² (1+ν)/2 + (f''-κ)² (1-ν)/2 + 2(1-ν) c² over ξ dξ, with κ = f'/ξ - n² f/ξ² and
/// c = n (f'/ξ - f/ξ²), and springs at the rim (Leissa, *Vibration of Plates*, NASA SP-160, 1969, section 2).
pub(super) struct Energy {
    /// X, one row for each square, the squares of bending first.
    squares: Mat<f64>,
    /// Number of rows of bending.
    bending: usize,
}

impl Energy {
    /// The energy of all functions of an angular order.
    pub(super) fn new(problem: &Problem, radial: &Radial) -> Self {
        let (a, medium, nu) = (problem.radius, &problem.bounds.medium, problem.bounds.poisson);
        let scale = |value: f64, power: i32| (value / (medium.areal_density * a.powi(power))).sqrt();
        let [plate, film] = [scale(medium.bending_stiffness, 4), scale(medium.tension, 2)];
        let [sum, difference, twist] =
            [(0.5 * (1.0 + nu)).sqrt(), (0.5 * (1.0 - nu)).sqrt(), (2.0 * (1.0 - nu)).sqrt()];
        let bent: [&dyn Fn(&Jet) -> f64; 3] = [
            &|f| plate * sum * (f.curvature + f.across),
            &|f| plate * difference * (f.curvature - f.across),
            &|f| plate * twist * f.twist,
        ];
        let stretched: [&dyn Fn(&Jet) -> f64; 2] = [&|f| film * f.slope, &|f| film * f.around];
        // ξ dξ = dt/4; squares have a degree in ξ² of at most n + 2 (count + 1).
        let rule = gauss(radial.count() + radial.order / 2 + 3);
        let nodes: Vec<(Vec<Jet>, f64)> =
            rule.into_iter().map(|(t, w)| (radial.jets((0.5 * (1.0 + t)).sqrt()), 0.5 * w.sqrt())).collect();
        let bending = if plate > 0.0 { bent.len() * nodes.len() } else { 0 };
        let tension = if film > 0.0 { stretched.len() * nodes.len() } else { 0 };
        let springs = problem.springs().unwrap_or([0.0; 2]);
        let mut squares = Mat::zeros(bending + tension + springs.len(), radial.count());
        let mut row = 0;
        let mut fill = |jets: &[Jet], of: &dyn Fn(&Jet) -> f64, weight: f64| {
            jets.iter().enumerate().for_each(|(j, jet)| squares[(row, j)] = weight * of(jet));
            row += 1;
        };
        let terms =
            bent.into_iter().filter(|_| plate > 0.0).chain(stretched.into_iter().filter(|_| film > 0.0));
        for of in terms {
            nodes.iter().for_each(|(jets, weight)| fill(jets, of, *weight));
        }
        let rim = radial.jets(1.0);
        let [lift, tilt] = [scale(springs[0], 1), scale(springs[1], 3)];
        fill(&rim, &|f| f.value, lift);
        fill(&rim, &|f| f.slope, tilt);
        Self { squares, bending }
    }

    /// The energy matrix between all functions but the first `rigid`, in 1/s².
    pub(super) fn matrix(&self, rigid: usize) -> Mat<f64> {
        let rest = self.squares.as_ref().subcols(rigid, self.squares.ncols() - rigid);
        product(rest.transpose(), rest, Par::Seq)
    }

    /// Twice the energy in bending per mass between several deflections, functions x deflections, in 1/s²: deflections x deflections.
    pub(super) fn of_bending(&self, deflections: MatRef<f64>) -> Mat<f64> {
        if self.bending == 0 {
            return Mat::zeros(deflections.ncols(), deflections.ncols());
        }
        let parts = product(self.squares.as_ref().subrows(0, self.bending), deflections, Par::Seq);
        product(parts.transpose(), parts.as_ref(), Par::Seq)
    }

    /// A bound of the relative error that rounding leaves in the squared frequencies `squares` (1/s²) of modes, functions (without the first
    /// `rigid`) x modes. It is as many rounding errors of each product in the energy of a mode as there are functions: where springs are
    /// hard or tension is large, products cancel each other.
    pub(super) fn rounded(&self, rigid: usize, (squares, modes): (&[f64], MatRef<f64>)) -> f64 {
        let rest = self.squares.as_ref().subcols(rigid, modes.nrows());
        let sizes = Mat::from_fn(rest.nrows(), rest.ncols(), |i, j| rest[(i, j)].abs());
        let shapes = Mat::from_fn(modes.nrows(), squares.len(), |j, m| modes[(j, m)].abs());
        let parts = product(sizes.as_ref(), shapes.as_ref(), Par::Seq);
        let sum = |m: usize| parts.col(m).iter().map(|part| part * part).sum::<f64>() / squares[m];
        f64::EPSILON * modes.nrows() as f64 * (0..squares.len()).map(sum).fold(0.0, f64::max)
    }
}
