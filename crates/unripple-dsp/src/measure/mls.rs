use super::{Stimulus, positive};
use crate::DspError;
use unripple_core::OutOfRange;

/// A maximum-length sequence: 2^order − 1 values of ±1 whose circular autocorrelation is −1 but at lag 0.
///
/// Source: S. W. Golomb, "Shift Register Sequences" (1967). The polynomials are primitive over GF(2), the smallest with
/// fewest terms: W. Stahnke, Math. Comp. 27 (1973), table 1.
///
/// ```
/// use unripple_dsp::Mls;
///
/// let sequence = Mls::new(4)?.samples(1.0);
/// let lagged: f64 = (0..15).map(|i| sequence[i] * sequence[(i + 3) % 15]).sum();
/// assert_eq!(lagged, -1.0);
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mls {
    order: u32,
}

/// Exponents of the inner terms of x^n + … + 1, for n from 2.
const INNER: [&[u32]; 19] = [
    &[1],
    &[1],
    &[1],
    &[2],
    &[1],
    &[1],
    &[6, 5, 1],
    &[4],
    &[3],
    &[2],
    &[7, 4, 3],
    &[4, 3, 1],
    &[12, 11, 1],
    &[1],
    &[5, 3, 2],
    &[3],
    &[7],
    &[6, 5, 1],
    &[3],
];

impl Mls {
    /// The sequence of an order from 2 to 20.
    ///
    /// # Errors
    /// [`DspError::Range`] for another order.
    pub fn new(order: u32) -> Result<Self, DspError> {
        if (2..=20).contains(&order) {
            return Ok(Self { order });
        }
        let found = f64::from(order);
        Err(DspError::Range(OutOfRange::new("order of a maximum-length sequence", "2 to 20", found)))
    }

    /// The shortest sequence of at least so many samples.
    ///
    /// # Errors
    /// [`DspError::Range`] if none of order 20 or less is that long.
    pub fn of_length(least: usize) -> Result<Self, DspError> {
        Self::new((2..=20).find(|&order| Self { order }.period() >= least).unwrap_or(u32::BITS))
    }

    /// Samples of a period, 2^order − 1.
    pub fn period(&self) -> usize {
        (1 << self.order) - 1
    }

    /// One period, of values ±`amplitude`.
    pub fn samples(&self, amplitude: f64) -> Vec<f64> {
        let inner = usize::try_from(self.order).ok().and_then(|n| INNER.get(n - 2)).copied().unwrap_or(&[]);
        // a[i + n] = a[i] + Σ a[i + k] over the inner exponents k: bit 0 of the register is a[i].
        let taps = inner.iter().fold(1_u32, |mask, k| mask | 1 << k);
        let mut register = 1_u32;
        (0..self.period())
            .map(|_| {
                let bit = register & 1;
                let next = (register & taps).count_ones() & 1;
                register = register >> 1 | next << (self.order - 1);
                if bit == 1 { -amplitude } else { amplitude }
            })
            .collect()
    }

    /// One period as a stimulus that goes round, useful at all frequencies but 0.
    ///
    /// # Errors
    /// [`DspError::Range`] if `rate` or `amplitude` is not positive.
    pub fn stimulus(&self, rate: f64, amplitude: f64) -> Result<Stimulus, DspError> {
        positive("amplitude of a sequence", amplitude)?;
        Ok(Stimulus::new(self.samples(amplitude), rate)?.repeated())
    }
}
