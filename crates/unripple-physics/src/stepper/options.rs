//! Options of the simulation of a surface in the time domain.

/// Options of the simulation of a surface in the time domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepperOptions {
    /// Largest number of fingers on the surface at once, including those that are being lifted.
    pub max_fingers: usize,
    /// Time in s over which a finger's load is faded in when the finger is put down, and faded out when it
    /// is lifted.
    pub fade: f64,
    /// Time in s over which the load of a finger that is moved is cross-faded from the old contact to the
    /// new one.
    pub glide: f64,
    /// Number of time steps per sample. More steps reduce the error of loads; without loads one step is
    /// exact.
    pub substeps: usize,
}

impl Default for StepperOptions {
    fn default() -> Self {
        Self { max_fingers: 4, fade: 8e-3, glide: 5e-3, substeps: 1 }
    }
}
