//! How alike two images are: the structural similarity index (SSIM).

use crate::Grid;
use crate::source::{Tally, largest};
use serde::Serialize;
use unripple_core::Point;

/// Side of the window in which images are compared, in cells: the default of scikit-image (`win_size`). Wang et al. take 11 cells
/// under a Gaussian.
const WINDOW: usize = 7;

/// Shares of the range of values, squared, that keep quotients of small numbers finite: K_1 and K_2 of Wang et al. (2004), the default of
/// scikit-image.
const STABLE: [f64; 2] = [0.01, 0.03];

/// Standard deviations of the wanted image's bells in a focal radius: at the rim of the focal disc, 1 % of the height is left. With twice
/// this value, the bells would be narrower than a focus can be.
const DEVIATIONS: f64 = 3.0;

/// How alike the images of the vibration and the image that is wanted are: structural similarity, 1 for equal images and about 0 for
/// unrelated ones.
///
/// Each image is a map over the grid, of one value per cell, divided by its largest value, so that the range of values is 1. The wanted one
/// is a bell exp(−d²/2s²) in the distance d from the nearest point of any target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Similarity {
    /// Structural similarity of the map of the largest velocities and the wanted image.
    pub peak_velocity: f64,
    /// Structural similarity of the map of the rms velocities and the wanted image.
    pub rms_velocity: f64,
    /// Standard deviation s of the bells of the wanted image, a third of the focal radius, in metres.
    pub target_gaussian_m: f64,
}

impl Similarity {
    /// Compares the velocities of a survey with the image of a vibration at `wanted` (m) only, of a focal `radius` (m), as
    /// [`Similarity::of`] does; `None` without a grid, too.
    pub(crate) fn surveyed(
        grid: Option<&Grid>,
        tallies: &[[Tally; 2]],
        wanted: &[Point],
        radius: f64,
    ) -> Option<Self> {
        let grid = grid?;
        let peak: Vec<f64> = largest(tallies, 0, grid.inside.len()).into_iter().map(f64::from).collect();
        let mut squares = vec![0.0; grid.inside.len()];
        for [velocity, _] in tallies {
            squares.iter_mut().zip(&velocity.squares).for_each(|(sum, own)| *sum += own);
        }
        Self::of(grid, [&peak, &squares], wanted, radius)
    }

    /// Compares maps of the largest and of the mean square velocity at the points of a grid with the image of a vibration at `wanted`
    /// (m) only, of a focal `radius` (m). `None` without such points, where nothing moves, and on a grid smaller than the window.
    fn of(grid: &Grid, [peak, squares]: [&[f64]; 2], wanted: &[Point], radius: f64) -> Option<Self> {
        if wanted.is_empty() {
            return None;
        }
        let deviation = radius / DEVIATIONS;
        let bell = |at: &Point| {
            let nearest = wanted.iter().map(|point| point.distance(*at)).fold(f64::INFINITY, f64::min);
            (-(nearest / deviation).powi(2) / 2.0).exp()
        };
        let bells: Vec<f64> = grid.points().iter().map(bell).collect();
        let bells = image(grid, &bells)?;
        let rms: Vec<f64> = squares.iter().map(|square| square.sqrt()).collect();
        let compared = |values: &[f64]| ssim(&image(grid, values)?, &bells, grid.columns, 1.0);
        Some(Self {
            peak_velocity: compared(peak)?,
            rms_velocity: compared(&rms)?,
            target_gaussian_m: deviation,
        })
    }
}

/// A map as an image: the value of every cell over the largest, NaN outside the outline; `None` if no value is above 0.
fn image(grid: &Grid, values: &[f64]) -> Option<Vec<f64>> {
    let largest = values.iter().copied().fold(0.0, f64::max);
    let scaled = |value: &f64| value / largest;
    (largest > 0.0).then(|| grid.spread(&values.iter().map(scaled).collect::<Vec<f64>>()))
}

/// Mean structural similarity of two images, rows of `columns` values each, whose values have the range `range`: Wang et al., *IEEE Trans.
/// Image Process.* 13, 600 (2004), eq. 13, as `structural_similarity` of scikit-image computes it by default, with even weights in
/// windows of 7 x 7 values, sample variances (over one less than the number of values), and without the windows that reach over the
/// border. Windows with a value that is not a number are left out too.
///
/// `None` if the images are of different sizes, or no window is left.
///
/// ```
/// let image: Vec<f64> = (0..100).map(|i| f64::from(i * i % 17) / 16.0).collect();
/// let darker: Vec<f64> = image.iter().map(|x| 0.5 * x).collect();
/// assert_eq!(unripple_field::ssim(&image, &image, 10, 1.0), Some(1.0));
/// assert!(unripple_field::ssim(&image, &darker, 10, 1.0).is_some_and(|ssim| ssim < 0.9));
/// ```
pub fn ssim(one: &[f64], other: &[f64], columns: usize, range: f64) -> Option<f64> {
    if columns < WINDOW || one.len() != other.len() || !one.len().is_multiple_of(columns) {
        return None;
    }
    let rows = one.len() / columns;
    let [a, b] = STABLE.map(|share| (share * range).powi(2));
    let (mut sum, mut count) = (0.0, 0usize);
    for row in 0..(rows + 1).saturating_sub(WINDOW) {
        for column in 0..=columns - WINDOW {
            let first = row * columns + column;
            let Moments { means: [x, y], variances: [xx, yy], covariance: xy } =
                Moments::of(one, other, columns, first);
            let alike = (2.0 * x * y + a) * (2.0 * xy + b) / ((x * x + y * y + a) * (xx + yy + b));
            if alike.is_finite() {
                sum += alike;
                count += 1;
            }
        }
    }
    (count > 0).then(|| sum / count as f64)
}

/// Means, variances and covariance of two images in one window.
struct Moments {
    means: [f64; 2],
    variances: [f64; 2],
    covariance: f64,
}

impl Moments {
    /// The moments in the window whose lowest corner is the value `first`.
    fn of(one: &[f64], other: &[f64], columns: usize, first: usize) -> Self {
        let count = (WINDOW * WINDOW) as f64;
        let window = |image: &[f64]| -> [f64; WINDOW * WINDOW] {
            std::array::from_fn(|i| image[first + i / WINDOW * columns + i % WINDOW])
        };
        let windows = [window(one), window(other)];
        let means = windows.map(|values| values.iter().sum::<f64>() / count);
        let product = |i: usize, j: usize| {
            let pairs = windows[i].iter().zip(&windows[j]);
            pairs.map(|(x, y)| (x - means[i]) * (y - means[j])).sum::<f64>() / (count - 1.0)
        };
        Self { means, variances: [product(0, 0), product(1, 1)], covariance: product(0, 1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::{Conditions, Outline, Random, Shape};

    /// Values from 0 to 1 without order.
    fn noise(count: usize, seed: u64) -> Vec<f64> {
        let mut random = Random::seeded(seed);
        (0..count).map(|_| random.uniform()).collect()
    }

    /// The lines of `structural_similarity` of scikit-image 0.25, with means over windows in the place of its `uniform_filter`.
    fn as_there([x, y]: [&[f64]; 2], columns: usize, range: f64) -> f64 {
        let rows = x.len() / columns;
        let mut similarities = Vec::new();
        for row in 3..rows - 3 {
            for column in 3..columns - 3 {
                let filtered = |f: &dyn Fn(usize) -> f64| {
                    let cells =
                        (row - 3..=row + 3).flat_map(|r| (column - 3..=column + 3).map(move |c| (r, c)));
                    cells.map(|(r, c)| f(r * columns + c)).sum::<f64>() / 49.0
                };
                let (ux, uy) = (filtered(&|i| x[i]), filtered(&|i| y[i]));
                let (uxx, uyy) = (filtered(&|i| x[i] * x[i]), filtered(&|i| y[i] * y[i]));
                let uxy = filtered(&|i| x[i] * y[i]);
                let norm = 49.0 / 48.0;
                let (vx, vy, vxy) = (norm * (uxx - ux * ux), norm * (uyy - uy * uy), norm * (uxy - ux * uy));
                let (c1, c2) = ((0.01 * range).powi(2), (0.03 * range).powi(2));
                let (a1, a2) = (2.0 * ux * uy + c1, 2.0 * vxy + c2);
                let (b1, b2) = (ux * ux + uy * uy + c1, vx + vy + c2);
                similarities.push(a1 * a2 / (b1 * b2));
            }
        }
        similarities.iter().sum::<f64>() / similarities.len() as f64
    }

    #[test]
    fn images_are_as_alike_as_scikit_image_finds_them() {
        for (columns, rows, range) in [(7, 7, 1.0), (19, 11, 1.0), (12, 30, 2.5)] {
            let (one, other) = (noise(columns * rows, 3), noise(columns * rows, 8));
            for share in [0.0, 0.3, 1.0] {
                let mixed: Vec<f64> =
                    one.iter().zip(&other).map(|(x, y)| (1.0 - share) * x + share * y).collect();
                let found = ssim(&one, &mixed, columns, range).unwrap();
                let expected = as_there([&one, &mixed], columns, range);
                assert!((found - expected).abs() < 1e-12, "{columns} x {rows}, {share}: {found} {expected}");
                assert_eq!(found > 1.0 - 1e-12, share == 0.0, "{found}");
            }
        }
    }

    #[test]
    fn what_cannot_be_compared_is_not() {
        let image = noise(70, 1);
        assert_eq!(ssim(&image, &image, 10, 1.0).map(|ssim| (ssim - 1.0).abs() < 1e-12), Some(true));
        for (one, other, columns) in
            [(&image[..], &image[..60], 10), (&image[..], &image[..], 6), (&image[..60], &image[..60], 10)]
        {
            assert_eq!(ssim(one, other, columns, 1.0), None);
        }
        assert_eq!(ssim(&image, &image, 0, 1.0), None);
        assert_eq!(ssim(&image, &image, 9, 1.0), None);
        assert_eq!(ssim(&[], &[], 10, 1.0), None);
        assert_eq!(ssim(&[f64::NAN; 70], &image, 10, 1.0), None);
    }

    #[test]
    fn a_vibration_that_is_the_wanted_image_is_wholly_like_it() {
        let outline = Outline::new(Shape::Circle { radius: 0.05 });
        let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 0.0145, outline };
        let grid = Grid::new(&conditions, 8.0).unwrap();
        let (wanted, radius) = ([Point::new(0.04, 0.05), Point::new(0.07, 0.06)], conditions.focal_radius());
        let bell = |at: &Point| {
            let nearest = wanted[0].distance(*at).min(wanted[1].distance(*at));
            3.0 * (-4.5 * (nearest / radius).powi(2)).exp()
        };
        let peak: Vec<f64> = grid.points().iter().map(bell).collect();
        let squares: Vec<f64> = peak.iter().map(|value| value * value).collect();
        let found = Similarity::of(&grid, [&peak, &squares], &wanted, radius).unwrap();
        assert!(found.peak_velocity > 0.999 && found.rms_velocity > 0.999, "{found:?}");
        assert!((found.target_gaussian_m - radius / 3.0).abs() < 1e-12);
        let even = Similarity::of(&grid, [&vec![1.0; peak.len()], &squares], &wanted, radius).unwrap();
        assert!(even.peak_velocity < 0.5 && even.rms_velocity > 0.999, "{even:?}");
        assert_eq!(Similarity::of(&grid, [&peak, &squares], &[], radius), None);
        let still = vec![0.0; peak.len()];
        assert_eq!(Similarity::of(&grid, [&still, &still], &wanted, radius), None);
    }
}
