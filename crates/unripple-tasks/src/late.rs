//! The sentence about a probe's delay relative to the sensors, for reports and logs.

/// Sentence that says that the probe's delay (s) relative to the sensors was found and corrected.
pub fn comes(delay: f64) -> String {
    let (ms, side) = (1e3 * delay.abs(), if delay < 0.0 { "earlier" } else { "later" });
    format!("the probe's signals arrive {ms:.3} ms {side} than those of the sensors: corrected")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_that_comes_first_is_said_to() {
        assert_eq!(
            comes(-0.5e-3),
            "the probe's signals arrive 0.500 ms earlier than those of the sensors: corrected"
        );
        assert_eq!(
            comes(1e-3),
            "the probe's signals arrive 1.000 ms later than those of the sensors: corrected"
        );
    }
}
