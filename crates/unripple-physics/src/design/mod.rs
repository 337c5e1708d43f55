//! Design figures of a surface, predicted before it is built: waves, modes, window, contrast, focal spot, deformation, power to move a
//! finger.
//!
//! "The paper" is C. Hudin, J. Lozada, M. Wiertlewski and V. Hayward, *Tradeoffs in the Application of Time-Reversed Acoustics to Tactile
//! Stimulation*, EuroHaptics 2012, whose numbers about its own film are compared with these.

mod cavity;
pub mod closed;
mod deformation;
mod digits;
mod figures;
mod ground;
mod lattice;
mod left_out;
mod limits;
mod linear_level;
mod linearity;
mod note;
mod notes;
mod paper;
mod printed;
mod remarks;
mod statistics;
mod strip;
mod text;
mod touch;
mod tradeoffs;
mod waves;
mod weyl;
mod window;
mod with_actuators;

pub use cavity::Cavity;
pub use deformation::{Bend, Deformation, deformation};
pub use figures::{Design, Predicted};
pub use lattice::{LatticeFigures, LatticeWave, Smallest};
pub use limits::{kirchhoff_over_mindlin, limits};
pub use linear_level::{LinearBound, LinearLevel};
pub use linearity::{Linearity, linearity};
pub use note::Note;
pub use notes::rigid_motions;
pub use paper::{film_strip, glass_strip, papers_surface};
pub use printed::{Nature, PaperFigures, Remark};
pub use statistics::Statistics;
pub use strip::{Scattering, Strip, finger_impedance};
pub use touch::{Touch, table1};
pub use tradeoffs::{ByBand, ByNoise, ByRate, ByWindow};
pub use waves::Wave;
pub use weyl::expected_modes;
pub use window::{Recommended, Windows, milliseconds};
pub use with_actuators::WithActuators;

use crate::{Modes, PhysicsError, SurfaceModes};
use std::sync::Arc;
use unripple_core::Surface;

/// The design figures of a surface, with its modes solved for and counted.
///
/// # Errors
/// [`PhysicsError::Range`] for a surface without actuators, or with a band that is empty or holds no mode. A surface whose modes cannot be
/// computed is no error: modes are then counted by Weyl's law, and [`Design::mode_count_exact_reason`] says why.
///
/// ```
/// let design = unripple_physics::design(&unripple_physics::design::papers_surface())?;
/// assert!((design.celerity_max_m_s - 43.65).abs() < 0.01);
/// // The window by the formula of the paper, on its own film.
/// assert!(design.paper.as_ref().is_some_and(|paper| (paper.window_s - 0.0360).abs() < 1e-4));
/// println!("{design}");
/// # Ok::<(), unripple_physics::PhysicsError>(())
/// ```
pub fn design(surface: &Surface) -> Result<Design, PhysicsError> {
    match ground::modes(surface) {
        Ok(modes) => design_on(surface, &modes),
        Err(error) => {
            on(&ground::Ground::of(surface, ground::alone(surface, &error), || Windows::of(surface))?)
        }
    }
}

/// The design figures that [`design()`] gives, from modes already computed: all of the band, and where actuators load the sheet, up to one
/// and a half times its top, as [`response_modes`](crate::response_modes) gives them.
///
/// # Errors
/// Those of [`design()`].
pub fn design_on(surface: &Surface, modes: &Arc<Modes>) -> Result<Design, PhysicsError> {
    let top = surface.emission.band[1];
    // What they cannot be computed for is said where it is needed; a design has its other figures.
    let solved = SurfaceModes::on(surface, top, modes.clone());
    let solved = solved.unwrap_or_else(|_| SurfaceModes::of_sheet(modes, top));
    on(&ground::Ground::of(surface, Ok(solved), || Windows::on_modes(surface, modes.clone()))?)
}

/// The design figures of a surface without solving for its modes, which is much faster: modes are counted by Weyl's law, and the
/// contrast follows from statistics. `reason` is stored in [`Design::mode_count_exact_reason`].
///
/// # Errors
/// Those of [`design()`].
pub fn design_by_law(surface: &Surface, reason: impl Into<String>) -> Result<Design, PhysicsError> {
    let reason = reason.into();
    on(&ground::Ground::of(surface, Err(reason.clone()), || Windows::by_law(surface, reason))?)
}

fn on(ground: &ground::Ground<'_>) -> Result<Design, PhysicsError> {
    let mut design = Design::on(ground);
    design.with_actuators = ground.with_actuators.clone();
    design.notes = notes::notes(ground, &design);
    design.paper = paper::is_papers_film(ground.surface).then(|| remarks::paper_figures(ground, &design));
    Ok(design)
}
