//! The hypervolume of fronts: how much of the space of losses is worse than one of their designs.

/// Lines along which it is measured: Sobol points in all losses but the last.
const LINES: u32 = 4096;

/// Seed of the scrambling of these points. Any other gives others that lie as evenly.
const SEED: u32 = 1;

/// How far beyond the worst loss of either front the box reaches, as a share of its range: so that the ends of a front count too.
const BEYOND: f64 = 0.1;

/// Hypervolumes of two fronts of designs, each by its losses, at least two, as shares of a box that has both. The more, the better.
pub(super) fn volumes(fronts: [&[&[f64]]; 2]) -> [f64; 2] {
    let losses = fronts.iter().flat_map(|front| front.iter()).map(|point| point.len()).max().unwrap_or(0);
    let ends = |at: usize| {
        let all = fronts.iter().flat_map(|front| front.iter()).filter_map(|point| point.get(at));
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), loss| (low.min(*loss), high.max(*loss)))
    };
    let ends: Vec<(f64, f64)> = (0..losses).map(ends).collect();
    let scaled = |point: &&[f64]| -> Vec<f64> {
        let one = |(loss, (low, high)): (&f64, &(f64, f64))| {
            let range = (1.0 + BEYOND) * (high - low);
            if range > 0.0 { (loss - low) / range } else { 0.0 }
        };
        point.iter().zip(&ends).map(one).collect()
    };
    fronts.map(|front| volume(&front.iter().map(scaled).collect::<Vec<_>>()))
}

/// The share of the unit cube in which a point is nowhere smaller than some point of the front: the mean of its depth along the last axis.
fn volume(front: &[Vec<f64>]) -> f64 {
    let others = front.first().map_or(0, |point| point.len().saturating_sub(1));
    let depth = |line: u32| {
        let axis = |axis: usize| f64::from(sobol_burley::sample(line, axis as u32, SEED));
        let place: Vec<f64> = (0..others).map(axis).collect();
        let below = |point: &&Vec<f64>| point.iter().zip(&place).all(|(loss, here)| loss <= here);
        let last = front.iter().filter(below).filter_map(|point| point.last().copied());
        last.fold(0.0, |deepest: f64, loss| deepest.max(1.0 - loss))
    };
    (0..LINES).map(depth).sum::<f64>() / f64::from(LINES)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(front: &[&[f64]], whole: &[&[f64]]) -> f64 {
        volumes([front, whole])[0]
    }

    #[test]
    fn volumes_are_those_of_closed_forms() {
        // Steps between losses from 0 to 1, in a box to 1.1.
        let steps: [&[f64]; 3] = [&[0.0, 1.0], &[0.5, 0.5], &[1.0, 0.0]];
        let found = of(&steps, &steps);
        assert!((found - 0.46 / 1.21).abs() < 1e-3, "{found}");
        // Two boxes and what they share, with three losses in other units.
        let two: [&[f64]; 2] = [&[0.0, 30.0, 0.2], &[10.0, 0.0, 0.1]];
        let (one, other, both) = (1.1 * 0.1 * 0.1, 0.1 * 1.1 * 1.1, 0.1 * 0.1 * 0.1);
        let (found, expected) = (of(&two, &two), (one + other - both) / (1.1 * 1.1 * 1.1));
        assert!((found - expected).abs() < 2e-3, "{found} {expected}");
    }

    #[test]
    fn a_better_design_adds_to_it_and_a_worse_one_does_not() {
        let old: [&[f64]; 2] = [&[0.0, 4.0], &[4.0, 0.0]];
        let better: [&[f64]; 3] = [old[0], &[1.0, 1.0], old[1]];
        let [before, after] = volumes([&old, &better]);
        assert!(after > 2.0 * before, "{before} {after}");
        let worse: [&[f64]; 3] = [old[0], &[4.0, 4.0], old[1]];
        let [before, after] = volumes([&old, &worse]);
        assert_eq!(before, after);
        // One design alone, and one that takes its place.
        let [before, after] = volumes([&[&[2.0, 2.0]], &[&[1.0, 2.0]]]);
        assert!(after > before, "{before} {after}");
        let [before, after] = volumes([&[&[2.0, 2.0]], &[&[2.0, 2.0]]]);
        assert_eq!(before, after);
    }
}
