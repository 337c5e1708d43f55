//! Values of designs by their index alone: of grids, Sobol points and lists.

use super::pairs::Pairs;
use serde_json::Value;
use unripple_store::{Axis, AxisValues, Designs, Varied};

/// What varies in a design, with its values, in the order of the plan.
pub(super) fn of(designs: &Designs, index: usize) -> Vec<(Varied, Value)> {
    match designs {
        Designs::Grid(axes) => of_grid(axes, index),
        Designs::Sobol { axes, seed, .. } => {
            let share = |axis: usize| f64::from(sobol_burley::sample(index as u32, axis as u32, *seed));
            axes.iter()
                .enumerate()
                .map(|(i, axis)| (axis.varied.clone(), between(&axis.values, share(i))))
                .collect()
        }
        Designs::List(list) => list.get(index).cloned().unwrap_or_default(),
    }
}

/// The same by their names, for rows and tables.
pub(super) fn named(values: &[(Varied, Value)]) -> Pairs {
    Pairs(values.iter().map(|(varied, value)| (varied.to_string(), value.clone())).collect())
}

/// The values of a design of a grid, in which those of the last axis change first.
fn of_grid(axes: &[Axis], index: usize) -> Vec<(Varied, Value)> {
    let mut left = index;
    let mut found: Vec<(Varied, Value)> = axes
        .iter()
        .rev()
        .map(|axis| {
            let count = axis.count();
            let at = left % count;
            left /= count;
            (axis.varied.clone(), step(&axis.values, at))
        })
        .collect();
    found.reverse();
    found
}

/// The value of an axis at a step, counted from 0.
pub(crate) fn step(values: &AxisValues, at: usize) -> Value {
    match values {
        AxisValues::List(list) => list.get(at).cloned().unwrap_or_default(),
        AxisValues::Range { from, to, steps, log, whole } => {
            let last = steps.unwrap_or(2).saturating_sub(1).max(1);
            let found = match (at, log) {
                (0, _) => *from,
                (at, _) if at == last => *to,
                (at, false) => from + (to - from) * at as f64 / last as f64,
                (at, true) => from * libm::pow(to / from, at as f64 / last as f64),
            };
            number(found, *whole)
        }
    }
}

/// The value of an axis at a share of its length, from 0 to below 1.
fn between(values: &AxisValues, share: f64) -> Value {
    match values {
        AxisValues::List(list) => list.get((share * list.len() as f64) as usize).cloned().unwrap_or_default(),
        AxisValues::Range { from, to, log, whole, .. } => {
            let found = match (log, whole) {
                // Each whole number takes the same share.
                (false, true) => (from + (share * (to - from + 1.0)).floor()).min(*to),
                (false, false) => from + (to - from) * share,
                (true, _) => from * libm::pow(to / from, share),
            };
            number(found, *whole)
        }
    }
}

/// A number of a plan, with a fraction unless it is to be whole.
fn number(value: f64, whole: bool) -> Value {
    // Both ends are far within the range of 64 bits.
    if whole { Value::from(value.round() as i64) } else { Value::from(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(key: &str, values: AxisValues) -> Axis {
        Axis { varied: Varied::Surface(key.into()), values }
    }

    fn range(from: f64, to: f64, steps: Option<usize>, log: bool, whole: bool) -> AxisValues {
        AxisValues::Range { from, to, steps, log, whole }
    }

    fn numbers(designs: &Designs, axis: usize) -> Vec<f64> {
        (0..designs.len()).map(|i| of(designs, i)[axis].1.as_f64().unwrap()).collect()
    }

    #[test]
    fn the_last_axis_of_a_grid_is_the_fastest() {
        let designs = Designs::Grid(vec![
            axis("a", AxisValues::List(vec!["x".into(), "y".into()])),
            axis("b", range(100.0, 400.0, Some(4), false, false)),
        ]);
        let texts: Vec<String> = (0..8)
            .map(|i| of(&designs, i).iter().map(|(_, value)| value.to_string()).collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(texts[..2], ["\"x\" 100.0", "\"x\" 200.0"]);
        assert_eq!(texts[3..5], ["\"x\" 400.0", "\"y\" 100.0"]);
        assert_eq!(texts[7], "\"y\" 400.0");
    }

    #[test]
    fn ratios_are_equal_on_a_logarithmic_axis_and_ends_are_exact() {
        let designs = Designs::Grid(vec![axis("a", range(0.1, 1000.0, Some(5), true, false))]);
        let found = numbers(&designs, 0);
        assert_eq!((found[0], found[4]), (0.1, 1000.0));
        assert!(found.windows(2).all(|pair| (pair[1] / pair[0] - 10.0).abs() < 1e-12), "{found:?}");
        let whole = Designs::Grid(vec![axis("a", range(4.0, 16.0, Some(4), false, true))]);
        assert_eq!(of(&whole, 1)[0].1.to_string(), "8");
    }

    #[test]
    fn sobol_points_lie_as_evenly_as_they_must() {
        let ends = || range(0.0, 1.0, None, false, false);
        let axes = vec![axis("a", ends()), axis("b", ends())];
        let designs = Designs::Sobol { axes, count: 256, seed: 7 };
        let (x, y) = (numbers(&designs, 0), numbers(&designs, 1));
        // A (0, 8, 2)-net in base 2: each cell of 16 x 16 has one point.
        let cell = |i: usize| (16.0 * x[i]) as usize * 16 + (16.0 * y[i]) as usize;
        let mut cells: Vec<usize> = (0..256).map(cell).collect();
        cells.sort_unstable();
        assert_eq!(cells, (0..256).collect::<Vec<_>>());
        let axes = vec![axis("a", range(1.0, 4.0, None, false, true))];
        let whole = numbers(&Designs::Sobol { axes, count: 64, seed: 7 }, 0);
        for value in [1.0, 2.0, 3.0, 4.0] {
            assert_eq!(whole.iter().filter(|found| **found == value).count(), 16, "{value}");
        }
    }
}
