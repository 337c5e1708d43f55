//! Width of a pulse in time, at half maximum.

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
    fn says_so_when_there_is_none() {
        assert_eq!(width(&[0.0, 0.9, 1.0, 0.8], 2), None);
        assert_eq!(width(&[0.0, 0.0, 0.0], 1), None);
        assert_eq!(width(&[0.0], 3), None);
    }
}
