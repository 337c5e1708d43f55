//! Copy of a part of a periodic signal.

/// Copies `out.len()` samples of a periodic signal, from sample `start` on, which may be negative.
pub(super) fn cut(circle: &[f64], start: i64, out: &mut [f64]) {
    let Ok(size) = i64::try_from(circle.len()) else { return };
    if size == 0 {
        return out.fill(0.0);
    }
    let first = usize::try_from(start.rem_euclid(size)).unwrap_or(0);
    let around = circle[first..].iter().chain(circle.iter().cycle());
    // The second round begins at 0: the chain runs on from the end of the first.
    out.iter_mut().zip(around).for_each(|(to, from)| *to = *from);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goes_round_both_ways() {
        let circle = [0.0, 1.0, 2.0];
        let mut out = [0.0; 7];
        cut(&circle, -2, &mut out);
        assert_eq!(out, [1.0, 2.0, 0.0, 1.0, 2.0, 0.0, 1.0]);
        cut(&[], 4, &mut out);
        assert_eq!(out, [0.0; 7]);
    }
}
