//! Options of the simulation of a surface in the time domain.

/// Options of the simulation of a surface in the time domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepperOptions {
    /// Largest number of fingers at once, those that are being lifted included.
    pub max_fingers: usize,
    /// Time over which the load of a finger is faded in when it is put down, and out when it is lifted, in s.
    pub fade: f64,
    /// Time over which a finger that is moved changes from one contact to the next, in s.
    pub glide: f64,
    /// Steps per sample. More steps reduce the error of loads; without loads one step is exact.
    pub substeps: usize,
}

impl Default for StepperOptions {
    fn default() -> Self {
        Self { max_fingers: 4, fade: 8e-3, glide: 5e-3, substeps: 1 }
    }
}
