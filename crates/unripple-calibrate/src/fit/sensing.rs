//! What is measured at a place where a sensor or a tap may be.

/// What is measured at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sensing {
    /// A sensor there, while each actuator plays a sweep. The sensor's gain and delay are not known.
    #[default]
    Sweeps,
    /// A tap there, recorded by the sensors of all actuators. The force of the tap is not known, at any frequency.
    Taps,
}
