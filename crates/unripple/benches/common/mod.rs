//! Shared by the benchmarks: timing, tables, the machine, and programs compared with.

#![allow(dead_code)]

pub mod machine;
pub mod peers;
pub mod table;
pub mod times;

use unripple::core::{ModalResponses, Point, Responses, Surface};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};

/// Result of a benchmark, which ends early if its input is not what it must be.
pub type Outcome = Result<(), Fault>;

/// Any error of a benchmark.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// The paper's membrane: 150 x 150 mm, clamped, eight actuators, 3 kHz at 48 kHz.
pub fn surface() -> Surface {
    papers_surface()
}

/// Modal responses of a surface, with default accuracy.
pub fn modal(surface: &Surface) -> Result<ModalResponses, Fault> {
    match responses(surface, &ResponseOptions::default())? {
        Responses::Modal(modal) => Ok(modal),
        Responses::Sampled(_) => Err("responses of a surface are modal".into()),
    }
}

/// The `i`-th point (m) of a sequence spread evenly over the paper's membrane, 5 mm or more from its edges (Roberts's
/// R2 sequence).
pub fn place(i: usize) -> Point {
    let along = |share: f64| 5.0 + 140.0 * (0.5 + share * (i + 1) as f64).fract();
    Point::from_mm(along(0.754_877_666_246_692_8), along(0.569_840_290_998_053_3))
}
