//! What a lattice of resonators does to waves: its dispersion relation, band gap, and how small a focus it makes.
//!
//! In a lattice far finer than the wave, resonators of mass ratio μ, natural frequency ω_0 and quality factor Q multiply the mass of the
//! sheet by B = 1 + μ (1 + jω/Qω_0) / (1 - (ω/ω_0)² + jω/Qω_0), so that ρ_s ω² B = Rk² + Dk⁴ (Liu et al., *Science* 289, 1734, 2000;
//! without losses, B = 1 + μ/(1 - (ω/ω_0)²)). Below ω_0, B is large and waves are short; from ω_0 to ω_0 √(1 + μ) it is negative, and no
//! wave travels. The area of a focus of one frequency goes as 1/k², on a plate without tension as 1/√B. Resonators of scattered
//! frequencies have the mean of their reactions: what their differences scatter out of the wave counts as lost.

use super::Note;
use crate::Medium;
use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt::{Formatter, Result};
use unripple_core::{Air, Lattice, Surface};
use unripple_linalg::c64;

/// Frequencies of the table of waves, relative to that of the resonators: below it as waves become short, and beyond the gap of lattices of
/// usual mass.
const ROWS: [f64; 9] = [0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 1.0, 1.5, 2.0];

/// Number of frequencies among which that of the smallest focus is found, from half the resonators' frequency to 1e-5 below it, in a
/// geometric series. With twice this value, areas are found to 0.3 instead of 0.6 %.
const TRIED: usize = 2000;

/// Distance from the resonators' frequency of the first and of the last frequency tried, relative to it.
const APART: [f64; 2] = [0.5, 1e-5];

/// Number of values of the scattered frequency over which reactions are averaged, within three standard deviations to either side; more where
/// resonances are narrower than their scatter.
const DRAWN: f64 = 60.0;

/// The waves in a lattice of resonators, in SI units. Air and the damping of the sheet itself are left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LatticeFigures {
    /// Number of resonators that stand on the sheet.
    pub resonators: usize,
    /// Distance of neighbours along x and along y, in m.
    pub pitch_m: [f64; 2],
    /// Mass of the resonators per area over that of the sheet, dimensionless.
    pub mass_ratio: f64,
    /// Natural frequency of the resonators, in Hz.
    pub frequency_hz: f64,
    /// Quality factor of the resonators, dimensionless.
    pub quality_factor: f64,
    /// Standard deviation of their frequencies relative to the mean, a ratio.
    pub scatter: f64,
    /// Frequencies between which no wave travels without losses, in Hz: ω_0/2π to √(1 + μ) times that.
    pub band_gap_hz: [f64; 2],
    /// Waves at several frequencies below and above the gap.
    pub waves: Vec<LatticeWave>,
    /// The smallest focus that a wave makes which is at least two pitches long: without losses, with the quality factor, and with the
    /// scatter of frequencies as well. With losses the wave has to reach the middle of the lattice too: it falls to no less than 1/e on
    /// the way from the nearer side. `None` where no frequency below the resonators' has such a wave.
    pub smallest: Smallest,
}

/// The wave of one frequency in a lattice.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LatticeWave {
    /// Frequency, in Hz.
    pub frequency_hz: f64,
    /// The factor B = 1 + μ/(1 - (ω/ω_0)²) of the mass without losses; `None` at the resonators' frequency.
    pub mass_factor: Option<f64>,
    /// Wavelength 2π/Re k with losses and scatter, in m.
    pub wavelength_m: f64,
    /// Wavelength on the sheet without resonators, in m.
    pub bare_wavelength_m: f64,
    /// Distance 1/|Im k| in which the wave falls to 1/e by losses and scatter, in m; `None` where it does not fall.
    pub attenuation_length_m: Option<f64>,
    /// Area of a focus of this frequency on the sheet without resonators over that in the lattice, dimensionless: (Re k)² over the square of
    /// the bare wavenumber.
    pub area_ratio: f64,
}

/// The smallest focus under three assumptions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Smallest {
    /// Without losses, and all resonators alike.
    pub ideal: Option<LatticeWave>,
    /// With the quality factor of the resonators.
    pub damped: Option<LatticeWave>,
    /// With their quality factor and the scatter of their frequencies.
    pub scattered: Option<LatticeWave>,
}

/// A lattice on a sheet, for the dispersion relation.
struct Continuum<'a> {
    lattice: &'a Lattice,
    medium: Medium,
    ratio: f64,
    /// Reciprocal of the quality factor.
    loss: f64,
    scatter: f64,
}

/// The figures of all lattices on a surface.
pub(super) fn lattices(surface: &Surface) -> Vec<LatticeFigures> {
    surface.sheet.uneven.lattices.iter().map(|lattice| LatticeFigures::of(lattice, surface)).collect()
}

impl LatticeFigures {
    /// The figures of a lattice on the sheet of a surface.
    pub fn of(lattice: &Lattice, surface: &Surface) -> Self {
        let medium = Medium::of(&surface.sheet).with_air(Air::None);
        let ratio = lattice.areal_density() / medium.areal_density;
        let whole = Continuum {
            lattice,
            medium,
            ratio,
            loss: 1.0 / lattice.quality_factor,
            scatter: lattice.scatter,
        };
        let damped = Continuum { scatter: 0.0, ..whole };
        let ideal = Continuum { loss: 0.0, ..damped };
        let frequency = lattice.frequency;
        Self {
            resonators: lattice.resonators(&surface.outline).len(),
            pitch_m: lattice.pitch(),
            mass_ratio: ratio,
            frequency_hz: frequency,
            quality_factor: lattice.quality_factor,
            scatter: lattice.scatter,
            band_gap_hz: [frequency, frequency * (1.0 + ratio).sqrt()],
            waves: ROWS.iter().map(|x| whole.wave(*x)).collect(),
            smallest: Smallest {
                ideal: ideal.smallest(),
                damped: damped.smallest(),
                scattered: whole.smallest(),
            },
        }
    }
}

impl Continuum<'_> {
    /// The mean B of the resonators at `x` times their mean frequency.
    fn mass_factor(&self, x: f64) -> c64 {
        let one = |x: f64| {
            let lossy = c64::new(0.0, x * self.loss);
            (lossy + 1.0) / (lossy + (1.0 - x * x))
        };
        if self.scatter == 0.0 {
            return one(x) * self.ratio + 1.0;
        }
        // A quarter of the width of a resonance between two values.
        let narrow = (24.0 * self.scatter / self.loss).clamp(DRAWN, 100.0 * DRAWN).ceil();
        let (mut sum, mut weights) = (c64::new(0.0, 0.0), 0.0);
        for i in 0..=narrow as usize {
            let deviation = 6.0 * i as f64 / narrow - 3.0;
            let weight = (-0.5 * deviation * deviation).exp();
            sum += one(x / (1.0 + self.scatter * deviation)) * weight;
            weights += weight;
        }
        sum * (self.ratio / weights) + 1.0
    }

    /// The complex wavenumber (rad/m) at `x` times the resonators' frequency; its imaginary part is not positive.
    fn wavenumber(&self, x: f64) -> c64 {
        let Medium { areal_density, tension, bending_stiffness, .. } = self.medium;
        let omega = TAU * self.lattice.frequency * x;
        let inert = self.mass_factor(x) * (areal_density * omega * omega);
        let square = if bending_stiffness > 0.0 {
            // Without cancellation where tension rules.
            let root = (inert * (4.0 * bending_stiffness) + tension * tension).sqrt();
            inert * 2.0 / (root + tension)
        } else {
            inert / tension
        };
        let k = square.sqrt();
        if k.im > 0.0 { -k } else { k }
    }

    fn wave(&self, x: f64) -> LatticeWave {
        let frequency = self.lattice.frequency * x;
        let bare = self.medium.wavenumber(TAU * frequency);
        let k = self.wavenumber(x);
        let real = k.re.abs();
        let ideal = 1.0 + self.ratio / (1.0 - x * x);
        LatticeWave {
            frequency_hz: frequency,
            mass_factor: Some(ideal).filter(|factor| factor.is_finite()),
            wavelength_m: TAU / real,
            bare_wavelength_m: TAU / bare,
            attenuation_length_m: Some(1.0 / k.im.abs()).filter(|length| length.is_finite()),
            area_ratio: (real / bare).powi(2),
        }
    }

    /// The wave below the resonators' frequency whose focus is the smallest.
    fn smallest(&self) -> Option<LatticeWave> {
        let [x, y] = self.lattice.pitch();
        let [columns, rows] = self.lattice.cells;
        let middle = 0.5 * (x * columns as f64).min(y * rows as f64);
        let shortest = 2.0 * x.max(y);
        let [first, last] = APART;
        let apart = |i: usize| first * (last / first).powf(i as f64 / (TRIED - 1) as f64);
        (0..TRIED)
            .map(|i| self.wave(1.0 - apart(i)))
            .filter(|wave| wave.wavelength_m >= shortest)
            .filter(|wave| wave.attenuation_length_m.is_none_or(|length| length >= middle))
            .max_by(|a, b| a.area_ratio.total_cmp(&b.area_ratio))
    }
}

/// The lattices as text for people.
pub(super) fn text(lattices: &[LatticeFigures], f: &mut Formatter<'_>) -> Result {
    for lattice in lattices {
        let [x, y] = lattice.pitch_m.map(|pitch| pitch * 1e3);
        writeln!(f, "\nLattice of {} resonators, {x:.1} x {y:.1} mm apart", lattice.resonators)?;
        let line = |f: &mut Formatter<'_>, name: &str, value: String| writeln!(f, "  {name:<37}{value}");
        line(f, "mass over that of the sheet", format!("{:.3}", lattice.mass_ratio))?;
        let [low, high] = lattice.band_gap_hz;
        line(f, "no waves without losses", format!("{low:.1} to {high:.1} Hz"))?;
        let titles = ["Hz", "B", "λ mm", "bare λ mm", "to 1/e mm", "area 1/"];
        let [a, b, c, d, e, g] = titles;
        writeln!(f, "  {a:>8} {b:>9} {c:>9} {d:>11} {e:>11} {g:>9}")?;
        for wave in &lattice.waves {
            let factor = wave.mass_factor.map_or("-".into(), |factor| format!("{factor:.2}"));
            let reach = wave.attenuation_length_m.map_or("-".into(), |m| format!("{:.0}", m * 1e3));
            writeln!(
                f,
                "  {:>8.1} {factor:>9} {:>9.1} {:>11.1} {reach:>11} {:>9.2}",
                wave.frequency_hz,
                wave.wavelength_m * 1e3,
                wave.bare_wavelength_m * 1e3,
                wave.area_ratio
            )?;
        }
        let Smallest { ideal, damped, scattered } = lattice.smallest;
        let scatter = format!("and with {:.2} % of scatter", lattice.scatter * 100.0);
        let quality = format!("with a quality factor of {:.0}", lattice.quality_factor);
        let names = [("smallest focus without losses", ideal), (&quality, damped), (&scatter, scattered)];
        for (name, wave) in names {
            let none = || "no wave reaches the middle".into();
            line(f, name, wave.map_or_else(none, |wave| area(&wave)))?;
        }
    }
    Ok(())
}

fn area(wave: &LatticeWave) -> String {
    let (wavelength, hz) = (wave.wavelength_m * 1e3, wave.frequency_hz);
    format!("1/{:.1} of the bare area, {wavelength:.1} mm at {hz:.1} Hz", wave.area_ratio)
}

/// The note on what figures of a lattice mean; `None` without one.
pub(super) fn note(surface: &Surface) -> Option<Note> {
    let finest = surface.sheet.uneven.lattices.iter().flat_map(Lattice::pitch).fold(0.0, f64::max);
    (finest > 0.0).then(|| Note {
        topic: "lattice".into(),
        text: format!(
            "its waves are those of a continuum, which holds for waves far longer than two pitches ({:.1} mm); wavelengths, spot and \
             Weyl's law elsewhere are those of the sheet without resonators",
            2.0 * finest * 1e3
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::papers_surface;
    use unripple_core::Point;

    /// An aluminium plate with a lattice of 20 mm.
    fn plate(quality_factor: f64, scatter: f64) -> LatticeFigures {
        let mut surface = papers_surface();
        surface.sheet.young = 70e9;
        (surface.sheet.density, surface.sheet.thickness, surface.sheet.tension) = (2700.0, 1e-3, 0.0);
        surface.sheet.poisson = 0.33;
        let lattice = Lattice {
            corners: [Point::new(0.0, 0.0), Point::new(0.14, 0.14)],
            cells: [7, 7],
            mass: 0.5 * 2.7 * 4e-4,
            frequency: 250.0,
            quality_factor,
            scatter,
            seed: 1,
        };
        LatticeFigures::of(&lattice, &surface)
    }

    #[test]
    fn the_dispersion_relation_holds_and_the_gap_is_where_it_says() {
        let found = plate(1e9, 0.0);
        assert!((found.mass_ratio - 0.5).abs() < 1e-12);
        assert!((found.band_gap_hz[1] - 250.0 * 1.5_f64.sqrt()).abs() < 1e-9);
        let stiffness = 70e9 * 1e-9 / 12.0 / (1.0 - 0.33 * 0.33);
        for wave in found.waves.iter().filter(|wave| wave.frequency_hz < 249.0 || wave.frequency_hz > 310.0) {
            let (omega, k) = (TAU * wave.frequency_hz, TAU / wave.wavelength_m);
            let x = wave.frequency_hz / 250.0;
            let factor = 1.0 + 0.5 / (1.0 - x * x);
            assert!((stiffness * k.powi(4) / (2.7 * omega * omega * factor) - 1.0).abs() < 1e-6, "{wave:?}");
            assert!((wave.area_ratio / factor.sqrt() - 1.0).abs() < 1e-6, "{wave:?}");
        }
    }

    #[test]
    fn losses_and_scatter_each_leave_less_of_the_focus() {
        let [fine, lossy, scattered] = [plate(1e6, 0.0), plate(30.0, 0.0), plate(30.0, 0.01)];
        // Without losses the wave is as short as two pitches.
        let ideal = fine.smallest.ideal.unwrap();
        assert!((ideal.wavelength_m / 0.04 - 1.0).abs() < 0.01, "{ideal:?}");
        let damped = lossy.smallest.damped.unwrap();
        let both = scattered.smallest.scattered.unwrap();
        assert!(
            ideal.area_ratio > damped.area_ratio && damped.area_ratio > both.area_ratio,
            "{damped:?} {both:?}"
        );
        assert!(both.area_ratio > 1.0);
        assert_eq!(lossy.smallest.damped, lossy.smallest.scattered);
    }

    #[test]
    fn scatter_alone_attenuates_as_the_mean_of_its_resonators() {
        // With losses far above the scatter, the scatter hardly matters.
        let [alone, both] = [plate(5.0, 0.0), plate(5.0, 0.001)];
        for (a, b) in alone.waves.iter().zip(&both.waves) {
            assert!((a.wavelength_m / b.wavelength_m - 1.0).abs() < 1e-4, "{a:?} {b:?}");
        }
    }
}
