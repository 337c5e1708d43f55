//! Energy and peak of samples, each in eight independent parts that a processor can compute at the same
//! time.

/// Σh² over all samples, in eight independent sums.
pub(crate) fn energy(samples: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let chunks = samples.chunks_exact(8);
    let rest: f64 = chunks.remainder().iter().map(|h| h * h).sum();
    for chunk in chunks {
        sums.iter_mut().zip(chunk).for_each(|(sum, h)| *sum += h * h);
    }
    rest + sums.iter().sum::<f64>()
}

/// Largest magnitude of samples, in their unit, in eight independent searches; NaN is passed over.
pub(crate) fn peak(samples: &[f64]) -> f64 {
    let larger = |best: f64, h: f64| if h.abs() > best { h.abs() } else { best };
    let mut peaks = [0.0; 8];
    let chunks = samples.chunks_exact(8);
    let rest = chunks.remainder().iter().fold(0.0, |best, h| larger(best, *h));
    for chunk in chunks {
        peaks.iter_mut().zip(chunk).for_each(|(best, h)| *best = larger(*best, *h));
    }
    peaks.iter().fold(rest, |best, h| larger(best, *h))
}
