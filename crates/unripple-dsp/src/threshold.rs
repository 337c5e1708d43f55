//! The vibrotactile detection threshold of the fingertip against frequency.

use crate::DspError;
use unripple_core::OutOfRange;

/// Lower limit of extrapolated thresholds, in metres, as [`MOST`] is the upper limit: both are far beyond
/// any measurement, but keep levels above the threshold finite.
const LEAST: f64 = 1e-20;
/// Upper limit of extrapolated thresholds, in metres; see [`LEAST`].
const MOST: f64 = 1e20;

/// A vibrotactile detection threshold: the least peak displacement of a sine that is felt, in metres, against frequency.
///
/// The curve is linear on log-log axes between knots, constant below the first knot (so that it is finite at 0 Hz), and
/// continued with its last slope above the last knot.
///
/// # The published curve
/// [`Threshold::default`] is that of glabrous skin under a large contactor: flat at 3.16 µm (10 dB re 1 µm) below
/// 40 Hz, then −12 dB per octave down to 0.1 µm (−20 dB re 1 µm) between 226 and 300 Hz: Verrillo (1963), J. Acoust. Soc.
/// Am. 35, 1962–1966; above, 0.3 µm at 500 Hz and 3 µm at 1 kHz as in the four-channel model of Bolanowski, Gescheider,
/// Verrillo and Checkosky (1988), J. Acoust. Soc. Am. 84, 1680–1694. Above 1 kHz the slope of the last octave goes on,
/// 20 dB per octave: there it is a continuation, not a measurement.
///
/// # How certain it is
/// About ±6 dB between persons ([`Threshold::BETWEEN_PERSONS_DB`]). The part above 40 Hz falls by 3 dB with each doubling of
/// the area of contact (Verrillo 1963; [`Threshold::PER_DOUBLED_AREA_DB`]) and falls further with pressing force. A
/// cylinder held in the whole hand was felt by some at less than 0.01 µm: Brisben, Hsiao and Johnson (1999), J. Neurophysiol.
/// 81, 1548–1558. An error of the whole curve shifts all levels above threshold by as many dB; level differences between
/// places do not change.
///
/// ```
/// use unripple_dsp::Threshold;
///
/// let skin = Threshold::default();
/// assert_eq!(skin.at(250.0), 0.1e-6);
/// assert!((skin.at(80.0) / skin.at(160.0) - 10f64.powf(0.6)).abs() < 0.02); // 12 dB in an octave
/// let flat = Threshold::new(vec![[100.0, 1e-6]])?;
/// assert_eq!(flat.at(0.0), flat.at(5000.0));
/// # Ok::<(), unripple_dsp::DspError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    knots: Vec<[f64; 2]>,
}

impl Default for Threshold {
    fn default() -> Self {
        let knots =
            [[40.0, 10f64.sqrt() * 1e-6], [226.274, 0.1e-6], [300.0, 0.1e-6], [500.0, 0.3e-6], [1e3, 3e-6]];
        Self { knots: knots.to_vec() }
    }
}

impl Threshold {
    /// Spread of thresholds between persons: they differ from the published curve by up to about this many dB either way.
    /// With twice this spread, the levels above threshold of one drive would spread over 24 dB.
    pub const BETWEEN_PERSONS_DB: f64 = 6.0;

    /// Highest frequency, in Hz, at which the published curve rests on measurements, which are of sustained vibration. Levels above it are
    /// extrapolated: skin decouples from a surface that vibrates so fast, and short pulses are felt in other ways.
    pub const MEASURED_TO_HZ: f64 = 1e3;

    /// Time over which the sense of touch integrates vibration near its most sensitive frequency, in
    /// seconds: thresholds of shorter vibration are higher, by some 12 dB at 10 ms (Verrillo 1965, J.
    /// Acoust. Soc. Am. 37, 843–846). The published curve is for vibration that lasts a second.
    pub const INTEGRATION_S: f64 = 0.2;

    /// Change of the threshold above 40 Hz for each doubling of the contact area, in dB (Verrillo 1963), by spatial
    /// summation in the Pacinian channel.
    pub const PER_DOUBLED_AREA_DB: f64 = -3.0;

    /// A threshold curve through knots `[frequency in Hz, peak displacement in m]`, frequencies ascending; with a single knot it is
    /// constant.
    ///
    /// # Errors
    /// [`DspError::Range`] if there are no knots, if frequencies are not positive and ascending, or if a displacement is not
    /// between 1e-15 and 1 m.
    pub fn new(knots: Vec<[f64; 2]>) -> Result<Self, DspError> {
        let wrong = |what, expected: &str, found| {
            let expected = expected.to_owned();
            Err(DspError::Range(OutOfRange::new(what, expected, found)))
        };
        if knots.is_empty() {
            return wrong("knots of a threshold", "at least 1", 0.0);
        }
        let mut below = 0.0;
        for [hz, metres] in &knots {
            if !(hz.is_finite() && *hz > below) {
                return wrong("frequency of a threshold (Hz)", "positive and ascending numbers", *hz);
            }
            if !(1e-15..=1.0).contains(metres) {
                return wrong("displacement of a threshold (m)", "1e-15 to 1", *metres);
            }
            below = *hz;
        }
        Ok(Self { knots })
    }

    /// The knots of the curve, `[frequency in Hz, peak displacement in m]` each.
    pub fn knots(&self) -> &[[f64; 2]] {
        &self.knots
    }

    /// The threshold at a frequency (Hz, of either sign), as peak displacement in metres.
    pub fn at(&self, hz: f64) -> f64 {
        let hz = hz.abs();
        let above = self.knots.partition_point(|knot| knot[0] <= hz);
        let last = self.knots.len() - 1;
        if above == 0 || last == 0 {
            return self.knots[0][1];
        }
        let ([f0, u0], [f1, u1]) = (self.knots[above.min(last) - 1], self.knots[above.min(last)]);
        let share = (hz / f0).ln() / (f1 / f0).ln();
        (u0 * (u1 / u0).powf(share)).clamp(LEAST, MOST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn db(ratio: f64) -> f64 {
        20.0 * ratio.log10()
    }

    #[test]
    fn the_published_curve_is_as_described() {
        let skin = Threshold::default();
        for hz in [0.0, 1e-9, 10.0, 40.0] {
            assert!((db(skin.at(hz) / 1e-6) - 10.0).abs() < 1e-9, "{hz}");
        }
        for hz in [40.0, 70.0, 113.0] {
            let octave = db(skin.at(2.0 * hz) / skin.at(hz));
            assert!((octave + 12.0).abs() < 0.05, "{hz}: {octave}");
        }
        for (hz, um) in [(226.274, 0.1), (250.0, 0.1), (300.0, 0.1), (500.0, 0.3), (1000.0, 3.0)] {
            assert!((skin.at(hz) / (um * 1e-6) - 1.0).abs() < 1e-12, "{hz}");
        }
        assert!((db(skin.at(2000.0) / skin.at(1000.0)) - 20.0).abs() < 1e-9, "the last slope goes on");
        assert_eq!(skin.at(-250.0), skin.at(250.0));
    }

    #[test]
    fn refuses_what_is_no_curve() {
        let nan = f64::NAN;
        for knots in [
            vec![],
            vec![[0.0, 1e-6]],
            vec![[-5.0, 1e-6]],
            vec![[nan, 1e-6]],
            vec![[f64::INFINITY, 1e-6]],
            vec![[10.0, 1e-6], [10.0, 2e-6]],
            vec![[10.0, 1e-6], [5.0, 2e-6]],
            vec![[10.0, 0.0]],
            vec![[10.0, -1e-6]],
            vec![[10.0, nan]],
            vec![[10.0, 2.0]],
        ] {
            let error = Threshold::new(knots.clone()).unwrap_err();
            assert!(matches!(error, DspError::Range(_)), "{knots:?}");
            assert!(error.to_string().contains("expected"), "{error}");
        }
    }

    proptest! {
        #[test]
        fn is_positive_and_finite_and_passes_through_its_knots(
            steps in prop::collection::vec((1e-6..3.0_f64, -15.0..0.0_f64), 1..6), hz in 0.0..1e12_f64,
        ) {
            let mut at = 1.0;
            let knots: Vec<[f64; 2]> = steps.iter().map(|(step, exponent)| {
                at *= 1.0 + step;
                [at, 10f64.powf(*exponent)]
            }).collect();
            let curve = Threshold::new(knots.clone()).unwrap();
            let value = curve.at(hz);
            prop_assert!(value.is_finite() && value > 0.0);
            for [hz, metres] in knots {
                prop_assert!((curve.at(hz) / metres - 1.0).abs() < 1e-9, "{hz}");
            }
        }
    }
}
