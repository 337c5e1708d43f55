//! Mode counts and wave properties from which the figures of a design are computed.

use super::paper::WAVELENGTH;
use super::weyl::Weyl;
use super::{Cavity, Recommended, Windows, WithActuators};
use crate::responses::is_loaded;
use crate::{Medium, Modes, PhysicsError, SurfaceModes, accuracy};
use std::f64::consts::TAU;
use std::sync::Arc;
use unripple_core::{OutOfRange, Surface};

/// The quantities from which all figures of a design are computed.
pub(super) struct Ground<'a> {
    /// The surface for which the figures are computed.
    pub surface: &'a Surface,
    /// Wave properties of the sheet: mass, tension, stiffness and air.
    pub medium: Medium,
    /// Statistics of the band, with the number of modes scaled to the exact count if there is one.
    pub cavity: Cavity,
    /// Exact mode count relative to the count by Weyl's law.
    pub scale: f64,
    /// Number of modes in the band, or the reason why they were not counted.
    pub counted: Result<usize, String>,
    /// The modes as coupled to all that is attached to the sheet, counted; `None` where nothing is, or they are not known.
    pub with_actuators: Option<WithActuators>,
    /// Frequency of the first mode, in Hz.
    pub first_mode_hz: f64,
    /// Wavenumber at the top of the band, in rad/m.
    pub k_top: f64,
    /// Number of actuators.
    pub actuators: f64,
    /// The recommended window.
    pub window: Recommended,
    /// Contrast against window, from which the recommended window was chosen.
    pub windows: Windows,
    /// Contrast with the recommended window relative to the contrast by the statistics of the modes.
    statistics_scale: f64,
    /// Contrast with the recommended window, computed from the modes as coupled to all that is attached to
    /// the sheet; `None` where the window is chosen by statistics.
    pub loaded_contrast: Option<f64>,
}

impl<'a> Ground<'a> {
    /// The quantities for a surface. `solved` are its modes, or the reason why there are none; `windows` gives the contrasts from which a
    /// window is chosen.
    pub fn of(
        surface: &'a Surface,
        solved: Solved,
        windows: impl FnOnce() -> Windows,
    ) -> Result<Self, PhysicsError> {
        check(surface)?;
        let top = surface.emission.band[1];
        let medium = Medium::of(&surface.sheet);
        let by_law = Cavity::of(surface, top);
        let with_actuators = solved.as_ref().ok().and_then(|modes| WithActuators::of(surface, modes));
        let counted = solved.map(|modes| counted(surface, &modes));
        let first = counted.as_ref().ok().and_then(|(_, first)| *first);
        let first_mode_hz = first.unwrap_or_else(|| medium.omega(Weyl::of(surface).first_wavenumber()) / TAU);
        // Weyl's law is used only where modes have not been counted: it is inaccurate for few modes.
        let few = counted.as_ref().map_or_else(|_| by_law.modes() < 1.0, |(count, _)| *count == 0);
        if few {
            let low = surface.emission.band[0];
            let expected = match &counted {
                Ok(_) => "at least 1".into(),
                Err(_) => format!("at least 1 (the first is at about {first_mode_hz:.1} Hz by Weyl's law)"),
            };
            let what = format!("modes of the sheet from {low} to {top} Hz");
            return Err(PhysicsError::Range(OutOfRange::new(what, expected, 0.0)));
        }
        let scale = counted.as_ref().map_or(1.0, |(count, _)| *count as f64 / by_law.modes());
        let modes = scale * by_law.modes();
        let cavity = Cavity::ringing(surface, first_mode_hz, top).counted(modes);
        let actuators = surface.actuators.len() as f64;
        let windows = windows();
        let window = windows.recommended();
        let mut ground = Self {
            surface,
            medium,
            scale,
            counted: counted.map(|(count, _)| count),
            with_actuators,
            first_mode_hz,
            k_top: medium.wavenumber(TAU * top),
            actuators,
            loaded_contrast: windows.is_modal().then_some(window.contrast).filter(|c| c.is_finite()),
            window,
            windows,
            statistics_scale: 1.0,
            cavity,
        };
        let own = ground.by_statistics(&[actuators], ground.window.seconds)[0];
        ground.statistics_scale = ground.contrast() / own;
        Ok(ground)
    }

    /// Number of modes in the band by Weyl's law.
    pub fn weyl_count(&self) -> f64 {
        let law = Weyl::of(self.surface);
        let below = |hz: f64| law.below(self.medium.wavenumber(TAU * hz)).max(0.0);
        below(self.surface.emission.band[1]) - below(self.surface.emission.band[0])
    }

    /// Number of modes per hertz at the top of the band.
    pub fn density_at_top(&self) -> f64 {
        let density = TAU * Weyl::of(self.surface).per_wavenumber(self.k_top);
        density.max(0.0) / self.medium.group_celerity(self.k_top)
    }

    /// Phase velocity at the bottom of the band, in m/s, or the phase velocity of the first mode if it is 0
    /// at the bottom.
    pub fn celerity_min(&self) -> f64 {
        let at = |hz: f64| self.medium.phase_celerity(self.medium.wavenumber(TAU * hz));
        let bottom = at(self.surface.emission.band[0]);
        if bottom > 0.0 { bottom } else { at(self.first_mode_hz) }
    }

    /// The paper's window (2S k_max + P)/(2 N c_min), in s, with k_max = 2π/15 mm.
    pub fn window_paper(&self) -> f64 {
        let (area, rim) = (self.surface.outline.area(), self.surface.outline.perimeter());
        (2.0 * area * TAU / WAVELENGTH + rim) / (2.0 * self.actuators * self.celerity_min())
    }

    /// Contrast with the recommended window: from the modes with the surface's own actuators, or by
    /// statistics of the band where the modes are not known.
    pub fn contrast(&self) -> f64 {
        self.loaded_contrast.unwrap_or_else(|| self.cavity.contrast(self.actuators, self.window.seconds))
    }

    /// Expected contrast for each number of `actuators` like those of the surface and a window in s: by the
    /// statistics of the surface's own modes, or of its band where the modes are not known. Scaled so that
    /// for the surface's own number of actuators it is the contrast of its modes ([`Windows::contrast`]) in
    /// any window, or where they are not known [`Ground::contrast`] in the recommended one: statistics alone
    /// are off by a factor of two in short windows where actuators damp the modes strongly.
    pub fn expected(&self, actuators: &[f64], window: f64) -> Vec<f64> {
        let scale = self.scale_of_statistics(window);
        self.by_statistics(actuators, window).iter().map(|contrast| scale * contrast).collect()
    }

    /// Factor from the statistics to what the modes give for the surface's own number of actuators in a
    /// window (s), or in the nearest one for which that was computed.
    fn scale_of_statistics(&self, window: f64) -> f64 {
        if !self.windows.is_modal() {
            return self.statistics_scale;
        }
        let nearest = self.windows.nearest(window);
        let scale = self.windows.contrast(nearest) / self.by_statistics(&[self.actuators], nearest)[0];
        if scale.is_finite() { scale } else { self.statistics_scale }
    }

    /// Expected contrast as in [`Ground::expected`], but not scaled.
    fn by_statistics(&self, actuators: &[f64], window: f64) -> Vec<f64> {
        let by_law = || actuators.iter().map(|n| self.cavity.contrast(*n, window)).collect();
        self.windows.expected(actuators, window).unwrap_or_else(by_law)
    }

    /// Factor by which contrasts computed from the band alone are multiplied to agree with
    /// [`Ground::contrast`].
    pub fn correction(&self) -> f64 {
        self.contrast() / self.cavity.contrast(self.actuators, self.window.seconds)
    }

    /// Exponent of the window T in the contrast around the recommended window, dimensionless; ½ is the √T
    /// law.
    pub fn exponent(&self) -> f64 {
        // A central difference over 5 % to either side.
        let (step, window) = (1.05, self.window.seconds);
        let at = |window: f64| self.expected(&[self.actuators], window)[0];
        (at(window * step) / at(window / step)).ln() / (2.0 * f64::ln(step))
    }
}

/// Refuses a surface without actuators or with an empty band.
fn check(surface: &Surface) -> Result<(), PhysicsError> {
    let [low, top] = surface.emission.band;
    if !(low >= 0.0 && top > low && top.is_finite()) {
        return Err(PhysicsError::Range(OutOfRange::new(
            "top of the band, in Hz",
            format!("a number above its bottom of {low}"),
            top,
        )));
    }
    if surface.actuators.is_empty() {
        return Err(PhysicsError::Range(OutOfRange::new("actuators", "at least 1", 0.0)));
    }
    Ok(())
}

/// The modes of a surface up to the top of its band, or the reason why they are not known.
pub(super) type Solved = Result<SurfaceModes, String>;

/// The modes of the sheet of a surface, as far up as what loads it needs.
pub(super) fn modes(surface: &Surface) -> Result<Arc<Modes>, PhysicsError> {
    check(surface)?;
    SurfaceModes::modes(surface, surface.emission.band[1], accuracy(surface)).map(Arc::new)
}

/// The modes of the sheet alone, for a surface of which [`modes`] failed with `error`.
pub(super) fn alone(surface: &Surface, error: &PhysicsError) -> Solved {
    // Of a sheet that nothing loads, the same solution would fail again.
    if check(surface).is_err() || !is_loaded(surface).unwrap_or(true) {
        return Err(error.to_string());
    }
    let top = surface.emission.band[1];
    let found = Modes::solve(surface, top, accuracy(surface)).map_err(|e| e.to_string())?;
    Ok(SurfaceModes::of_sheet(&found, top))
}

/// Number of modes of the sheet in the band, and the first frequency above 0, in Hz.
fn counted(surface: &Surface, modes: &SurfaceModes) -> (usize, Option<f64>) {
    let [low, top] = surface.emission.band;
    let frequencies = || modes.sheet.iter().map(|pole| pole.omega / TAU);
    let inside = frequencies().filter(|hz| (low..=top).contains(hz)).count();
    (inside, frequencies().find(|hz| *hz > 0.0))
}
