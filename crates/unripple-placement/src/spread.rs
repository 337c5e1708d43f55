//! Points spread evenly over a surface.

use crate::Rules;
use unripple_core::{Outline, Point};

/// The inverses of the plastic number, the real root of x³ = x + 1, and of its square: with them, points are spread more evenly than with
/// any other pair (M. Roberts, *The Unreasonable Effectiveness of Quasirandom Sequences*, 2018).
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// Points that are tried for each that is asked for, before the area counts as too small.
const TRIES: usize = 10_000;

/// Points of a low-discrepancy sequence over the places that `rules` allow on a sheet: `count` of them, after the first `skip`. Fewer if
/// hardly any place is allowed.
///
/// ```
/// use unripple_core::{Outline, Shape};
/// use unripple_placement::{Rules, spread};
///
/// let film = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
/// let rules = Rules { from_rim: [0.02, f64::INFINITY], ..Rules::default() };
/// let all = spread(&film, &rules, 0, 30);
/// assert_eq!(all[20..], spread(&film, &rules, 20, 10));
/// assert!(all.iter().all(|point| film.to_rim(*point) >= 0.02));
/// ```
pub fn spread(outline: &Outline, rules: &Rules, skip: usize, count: usize) -> Vec<Point> {
    let (width, height) = outline.extent();
    let at = |i: usize| {
        let [x, y] = STEPS.map(|step| (0.5 + step * (i + 1) as f64).fract());
        Point::new(x * width, y * height)
    };
    let tried = (0..TRIES * (skip + count)).map(at).filter(|point| rules.allow(outline, *point));
    tried.skip(skip).take(count).collect()
}
