//! The paper's film with eight actuators, on which its experiments are simulated.

use unripple::core::{Point, Responses, Surface};
use unripple_tasks::TaskError;
use unripple_tasks::judge;

/// The paper's surface with its responses, on which its experiments are simulated.
#[derive(Debug)]
pub struct PaperSetup {
    /// The film of the paper's section 4, with eight ideal force actuators.
    pub surface: Surface,
    /// Responses of the film, mode by mode, in the band.
    pub responses: Responses,
    /// Sample rate, in Hz.
    pub rate: f64,
    /// The paper's window T, in seconds.
    pub window: f64,
    /// Position of the single focus, in m.
    pub target: Point,
}

impl PaperSetup {
    /// The built-in surface `hudin-2012` with its responses, the paper's window and the target of a single
    /// focus.
    pub fn new() -> Result<Self, TaskError> {
        let surface = unripple_store::load_surface("hudin-2012")?;
        let responses = judge::model(&surface, None, &[])?;
        let rate = surface.emission.rate;
        Ok(Self { surface, responses, rate, window: 0.030, target: Point::from_mm(62.0, 90.0) })
    }
}
