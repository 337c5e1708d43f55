//! Width of a pulse in time at half maximum, and duration of a motion with pauses.

/// Full width at half maximum of a signal around the sample `centre`, in samples.
///
/// From the centre outwards to the first crossing of half the value there, interpolated linearly between samples; `None`
/// if either side ends first or the value is zero.
pub(crate) fn width(signal: &[f64], centre: usize) -> Option<f64> {
    let top = *signal.get(centre)?;
    if top == 0.0 {
        return None;
    }
    let after = half(signal[centre..].iter().map(|x| x / top))?;
    let before = half(signal[..=centre].iter().rev().map(|x| x / top))?;
    Some(before + after)
}

/// Steps until a signal that starts at 1 falls to one half.
fn half(signal: impl Iterator<Item = f64>) -> Option<f64> {
    let mut last = 1.0;
    for (i, value) in signal.enumerate() {
        if value <= 0.5 {
            return Some(i as f64 - (0.5 - value) / (last - value));
        }
        last = value;
    }
    None
}

/// Duration of a signal around the sample `centre`, in samples: from the first to the last sample at which
/// its magnitude is at least half that at `centre`, with no more than `pause` samples from one of these to
/// the next. With `again`, the signal is a period that is repeated without end. `None` if a repeated signal
/// never pauses, or if the signal is zero at `centre`.
pub(crate) fn lasting(signal: &[f64], centre: usize, pause: usize, again: bool) -> Option<usize> {
    let enough = 0.5 * signal.get(centre)?.abs();
    if enough == 0.0 {
        return None;
    }
    let (earlier, later) = (&signal[..centre], &signal[centre + 1..]);
    if !again {
        return Some(reach(earlier.iter().rev(), enough, pause) + 1 + reach(later.iter(), enough, pause));
    }
    let after = reach(later.iter().chain(&signal[..=centre]), enough, pause);
    let before = reach(earlier.iter().rev().chain(signal[centre..].iter().rev()), enough, pause);
    (after < signal.len()).then_some(before + 1 + after)
}

/// Steps to the last value of at least `enough`, with no more than `pause` steps from one of these to the next.
fn reach<'a>(signal: impl Iterator<Item = &'a f64>, enough: f64, pause: usize) -> usize {
    let mut last = 0;
    for (step, value) in (1..).zip(signal) {
        if step - last > pause {
            break;
        }
        if value.abs() >= enough {
            last = step;
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_width_of_known_pulses() {
        let triangle: Vec<f64> = (0..41).map(|i| -(20.0 - (f64::from(i) - 20.0).abs())).collect();
        assert_eq!(width(&triangle, 20), Some(20.0));
        let sigma = 30.0;
        let gauss: Vec<f64> =
            (0..400).map(|i| (-((f64::from(i) - 200.0) / sigma).powi(2) / 2.0).exp()).collect();
        let exact = 2.0 * (2.0 * 2f64.ln()).sqrt() * sigma;
        assert!((width(&gauss, 200).unwrap() - exact).abs() < 1e-2);
    }

    #[test]
    fn a_motion_goes_on_until_it_pauses() {
        let mut signal = vec![0.0; 60];
        for (at, value) in [(10, 1.0), (14, -0.6), (16, 0.4), (40, 0.9), (41, -0.5)] {
            signal[at] = value;
        }
        for (pause, again, expected) in [
            (3, false, Some(1)),
            (4, false, Some(5)),
            (25, false, Some(5)),
            (26, false, Some(32)),
            (60, false, Some(32)),
            (4, true, Some(5)),
            (28, true, Some(32)),
            (29, true, None),
            (60, true, None),
        ] {
            assert_eq!(lasting(&signal, 10, pause, again), expected, "{pause} {again}");
        }
        // The other end of the run is the same run; a period may begin within it.
        assert_eq!(lasting(&signal, 40, 28, true), Some(32));
        signal.rotate_left(12);
        assert_eq!(lasting(&signal, 58, 28, true), Some(32));
        assert_eq!(lasting(&signal, 58, 4, true), Some(5));
        assert_eq!(lasting(&[0.0, 1.0], 0, 9, false), None);
        assert_eq!(lasting(&[], 0, 9, true), None);
    }

    #[test]
    fn says_so_when_there_is_none() {
        assert_eq!(width(&[0.0, 0.9, 1.0, 0.8], 2), None);
        assert_eq!(width(&[0.0, 0.0, 0.0], 1), None);
        assert_eq!(width(&[0.0], 3), None);
    }
}
