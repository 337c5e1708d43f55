//! Cubic curves that stand for arcs of an ellipse, made finer.

use unripple_core::Point;

/// How near, relative to its coordinates, a curve must be to that of a quarter ellipse to stand for one: the accuracy of
/// single precision.
const SAME: f64 = 1e-6;

/// Whether a cubic curve is the usual stand-in for a quarter of an ellipse (handles of 4/3 (√2 - 1) of the tangents), as
/// circles, ellipses and round corners are drawn. Coordinates as the file has them.
pub(super) fn is_quarter(curve: &[Point; 4]) -> bool {
    let [a, b, c] = tangents(curve);
    let ratio = 1.5 / (1.0 - quarter().powi(2));
    let off = Point::new((a.x + b.x) * ratio - c.x, (a.y + b.y) * ratio - c.y);
    let largest = curve.iter().map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
    let bends = (a.x * b.y - a.y * b.x).abs() > SAME * length(a) * length(b);
    bends && length(off) <= 4.0 * SAME * largest && length(off) <= 1e-3 * length(c)
}

/// The arc that a cubic curve of at most a quarter turn stands for, as cubic curves within `tolerance` metres of it: a
/// curve over the angle θ is off by 1.1163 (θ/2π)⁶ of the radius.
pub(super) fn finer(curve: &[Point; 4], tolerance: f64) -> Vec<[Point; 4]> {
    let [a, b, c] = tangents(curve);
    let sum = Point::new(a.x + b.x, a.y + b.y);
    // Of a circle's arc over θ the handles are 4/3 tan(θ/4) of the tangents, and the chord is 1.5 / (1 - tan²(θ/4)) of
    // their sum; both hold for an ellipse, which is a circle seen aslant.
    let ratio = (c.x * sum.x + c.y * sum.y) / (sum.x * sum.x + sum.y * sum.y);
    let quarters = (1.0 - 1.5 / ratio).clamp(0.0, quarter().powi(2)).sqrt();
    let angle = 4.0 * quarters.atan();
    if !(angle.is_finite() && angle > 1e-3) {
        return vec![*curve];
    }
    let (sin, cos) = angle.sin_cos();
    let handle = 4.0 / 3.0 * quarters;
    // A point of the arc is centre + u cos φ + v sin φ.
    let v = Point::new(a.x / handle, a.y / handle);
    let u = Point::new((v.x * cos - b.x / handle) / sin, (v.y * cos - b.y / handle) / sin);
    let radius = length(u).hypot(length(v));
    let turns = angle / std::f64::consts::TAU;
    let count = (turns * (1.1163 * radius / tolerance).powf(1.0 / 6.0)).ceil().clamp(1.0, 64.0);
    let start = curve[0];
    let bow = |f: f64| {
        let (sin, cos) = f.sin_cos();
        Point::new(u.x * (cos - 1.0) + v.x * sin, u.y * (cos - 1.0) + v.y * sin)
    };
    // What rounding leaves at the far end is spread over the arc.
    let end = bow(angle);
    let rest = Point::new(c.x - end.x, c.y - end.y);
    let at = |f: f64| {
        let (p, share) = (bow(f), f / angle);
        Point::new(start.x + p.x + rest.x * share, start.y + p.y + rest.y * share)
    };
    let step = angle / count;
    let reach = 4.0 / 3.0 * (step / 4.0).tan();
    let along = |p: Point, f: f64, by: f64| {
        let (sin, cos) = f.sin_cos();
        Point::new(p.x + by * (v.x * cos - u.x * sin), p.y + by * (v.y * cos - u.y * sin))
    };
    (0..count as usize)
        .map(|i| {
            let (low, high) = (i as f64 * step, (i + 1) as f64 * step);
            let from = if i == 0 { start } else { at(low) };
            let to = if i + 1 == count as usize { curve[3] } else { at(high) };
            [from, along(from, low, reach), along(to, high, -reach), to]
        })
        .collect()
}

/// From the start to its handle, from the other handle to the end, and from the start to the end.
fn tangents(curve: &[Point; 4]) -> [Point; 3] {
    let way = |a: Point, b: Point| Point::new(b.x - a.x, b.y - a.y);
    [way(curve[0], curve[1]), way(curve[2], curve[3]), way(curve[0], curve[3])]
}

/// tan(π/8): of a quarter turn's fourth.
fn quarter() -> f64 {
    std::f64::consts::SQRT_2 - 1.0
}

fn length(p: Point) -> f64 {
    p.x.hypot(p.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple_core::Side;

    /// An arc from `start` over `angle` of an ellipse seen aslant, as one cubic curve.
    fn arc(start: f64, angle: f64) -> ([Point; 4], impl Fn(Point) -> f64) {
        let place = |x: f64, y: f64| Point::new(0.05 + 0.08 * x + 0.03 * y, 0.02 - 0.02 * x + 0.05 * y);
        let k = 4.0 / 3.0 * (angle / 4.0).tan();
        let on = |f: f64, by: f64| place(f.cos() - by * f.sin(), f.sin() + by * f.cos());
        let end = start + angle;
        // Distance from the ellipse, to first order, in units of its size.
        let off = |p: Point| {
            let (x, y) = (p.x - 0.05, p.y - 0.02);
            let area = 0.08 * 0.05 + 0.03 * 0.02;
            ((0.05 * x - 0.03 * y) / area).hypot((0.02 * x + 0.08 * y) / area) - 1.0
        };
        ([on(start, 0.0), on(start, k), on(end, -k), on(end, 0.0)], off)
    }

    #[test]
    fn arcs_are_followed_to_the_tolerance() {
        for (start, angle) in [(0.3, 1.57), (2.0, 0.4), (5.0, std::f64::consts::FRAC_PI_2), (1.0, -1.2)] {
            let (curve, off) = arc(start, angle);
            let fine = finer(&curve, 1e-7);
            assert!((2..5).contains(&fine.len()) || angle < 0.5, "{}", fine.len());
            assert!(fine.windows(2).all(|w| w[0][3] == w[1][0]));
            assert_eq!((fine[0][0], fine[fine.len() - 1][3]), (curve[0], curve[3]));
            for piece in &fine {
                for i in 0..=20 {
                    let p = Side::Cubic(*piece).at(f64::from(i) / 20.0);
                    assert!(off(p).abs() * 0.09 < 1e-7, "{start} {angle}: {}", off(p));
                }
            }
        }
    }

    #[test]
    fn quarters_are_told_from_other_curves() {
        let quarter = arc(0.7, std::f64::consts::FRAC_PI_2).0;
        assert!(is_quarter(&quarter));
        assert!(is_quarter(&arc(0.7, -std::f64::consts::FRAC_PI_2).0));
        assert!(!is_quarter(&arc(0.7, 1.5).0));
        let mut other = quarter;
        other[1].x += 1e-5;
        assert!(!is_quarter(&other));
        let p = Point::new;
        assert!(!is_quarter(&[p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(3.0, 0.0)]));
        assert_eq!(finer(&[p(0.0, 0.0), p(0.0, 0.0), p(0.0, 0.0), p(0.0, 0.0)], 1e-7).len(), 1);
    }
}
