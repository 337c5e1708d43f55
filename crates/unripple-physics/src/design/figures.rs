//! All figures of `design`, in SI units.

use super::ground::Ground;
use super::paper::WAVELENGTH;
use super::tradeoffs::{by_band, by_noise, by_rate, by_window};
use super::{ByBand, ByNoise, ByRate, ByWindow, Deformation, Note, Touch, Wave, closed, table1};
use super::{deformation::deformation, touch::own_touches, waves::waves};
use std::f64::consts::TAU;

/// Rows of the dispersion table, evenly spaced in frequency. Doubled, it has twice the rows.
const WAVES: usize = 12;

/// The tradeoffs of a surface: what `unripple design` prints. SI units.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Design {
    /// Name of the surface, for people.
    pub surface: String,
    /// Number of actuators N.
    pub actuators: usize,
    /// Lowest and highest frequency, in Hz.
    pub band_hz: [f64; 2],
    /// Phase celerity at the bottom of the band, in m/s; at the first mode where waves stand still at 0 Hz (plates, air).
    pub celerity_min_m_s: f64,
    /// Phase celerity at the top of the band, in m/s.
    pub celerity_max_m_s: f64,
    /// Phase celerity of a wave of 15 mm, in m/s.
    pub celerity_at_15mm_m_s: f64,
    /// Shortest wavelength, in metres.
    pub lambda_min_m: f64,
    /// Frequency above which waves outrun sound in air and radiate, in Hz.
    pub coincidence_hz: Option<f64>,
    /// The dispersion relation: waves over the band.
    pub dispersion: Vec<Wave>,
    /// Modes in the band, counted; `None` where modes cannot be computed.
    pub mode_count_exact: Option<usize>,
    /// Why there is no exact count.
    pub mode_count_exact_reason: Option<String>,
    /// Modes in the band by Weyl's law Sk²/4π - Pk/4π, P the fixed rim minus the free.
    pub mode_count_weyl: f64,
    /// First mode, in Hz; by Weyl's law where modes cannot be computed.
    pub first_mode_hz: f64,
    /// Modes per hertz over the band n̄ = M/B: the time that tells neighbouring modes apart, in seconds.
    pub heisenberg_time_s: f64,
    /// The same at the top of the band, (2Sk - P)/2c_g, in seconds.
    pub heisenberg_time_top_s: f64,
    /// Decay time of the amplitude, averaged over modes, in seconds.
    pub decay_time_s: f64,
    /// The paper's window (2S k_max + P)/(2 N c_min) with k_max = 2π/15 mm, in seconds.
    pub window_paper_s: f64,
    /// The shortest window in which the actuators reach nine tenths of the largest contrast ([`Windows`](super::Windows)), in seconds.
    pub window_recommended_s: f64,
    /// Why it is that, in words.
    pub window_recommended_why: String,
    /// Exponent of T in the contrast around that window; a half for the √T law.
    pub window_exponent: f64,
    /// Contrast at the recommended window ([`Cavity::contrast`](super::Cavity::contrast)).
    pub contrast_predicted: f64,
    /// Contrast at the recommended window, plain form ([`closed::contrast`]).
    pub contrast_plain: f64,
    /// The same at the window where contrast is largest.
    pub contrast_endless: f64,
    /// Contrast against window and number of actuators.
    pub contrast_by_window: Vec<ByWindow>,
    /// Contrast against bandwidth, number of actuators and window kept.
    pub contrast_by_band: Vec<ByBand>,
    /// Contrast against noise, number of actuators and window kept.
    pub contrast_by_noise: Vec<ByNoise>,
    /// The decay time that section 3.2 aims for, T/N, in seconds.
    pub decay_time_paper_s: f64,
    /// Contrast of a single focus with that decay time.
    pub contrast_at_papers_decay: f64,
    /// Contrast against rate of repetition, number of actuators and window kept.
    pub contrast_by_rate: Vec<ByRate>,
    /// Full width at half maximum of a focus, in metres.
    pub spot_diameter_m: f64,
    /// The same for the top of the band alone, in metres.
    pub spot_diameter_one_frequency_m: f64,
    /// Full width at half maximum of a focus in time, in seconds.
    pub pulse_duration_s: f64,
    /// Bending, strain and the end of linear theory.
    pub deformation: Deformation,
    /// The paper's table 1.
    pub table1: Vec<Touch>,
    /// The same for this sheet, at 15 mm and at its shortest wavelength.
    pub touch: Vec<Touch>,
    /// Where the paper's numbers contradict each other or ours.
    pub notes: Vec<Note>,
}

impl Design {
    /// The recommended window in a clause: so many milliseconds, and why.
    pub fn window_text(&self) -> String {
        let ms = super::window::milliseconds(self.window_recommended_s);
        format!("{ms} ms, {}", self.window_recommended_why)
    }

    /// Every figure but the notes, which comment on the others.
    pub(super) fn on(ground: &Ground) -> Self {
        let Ground { surface, medium, cavity, actuators: n, window, .. } = ground;
        let (n, chosen, window) = (*n, window, window.seconds);
        let lambda_min = TAU / ground.k_top;
        let [low, top] = surface.emission.band;
        let paper_decay = window / n;
        let contrast = cavity.contrast(n, window);
        Self {
            surface: surface.name.clone(),
            actuators: surface.actuators.len(),
            band_hz: [low, top],
            celerity_min_m_s: ground.celerity_min(),
            celerity_max_m_s: medium.phase_celerity(ground.k_top),
            celerity_at_15mm_m_s: medium.phase_celerity(TAU / WAVELENGTH),
            lambda_min_m: lambda_min,
            coincidence_hz: medium.coincidence_hz(),
            dispersion: waves(surface, WAVES),
            mode_count_exact: ground.counted.as_ref().ok().copied(),
            mode_count_exact_reason: ground.counted.as_ref().err().cloned(),
            mode_count_weyl: ground.weyl_count(),
            first_mode_hz: ground.first_mode_hz,
            heisenberg_time_s: cavity.modes() / (top - low),
            heisenberg_time_top_s: ground.density_at_top(),
            decay_time_s: cavity.decay_time(),
            window_paper_s: ground.window_paper(),
            window_recommended_s: window,
            window_recommended_why: chosen.why.clone(),
            window_exponent: ground.exponent(),
            contrast_predicted: contrast,
            contrast_plain: closed::contrast(n, top - low, cavity.decay_time(), window, cavity.modes()),
            contrast_endless: contrast * chosen.largest / chosen.contrast,
            contrast_by_window: by_window(cavity),
            contrast_by_band: by_band(surface, ground.scale, n, window),
            contrast_by_noise: by_noise(cavity, n, window),
            decay_time_paper_s: paper_decay,
            contrast_at_papers_decay: cavity.clone().with_decay_time(paper_decay).contrast(n, window),
            contrast_by_rate: by_rate(cavity, n, window, paper_decay),
            spot_diameter_m: closed::spot_diameter(lambda_min),
            spot_diameter_one_frequency_m: closed::spot_of_one_frequency(lambda_min),
            pulse_duration_s: closed::pulse_duration(top - low, cavity.growth()),
            deformation: deformation(surface),
            table1: table1(),
            touch: own_touches(surface, lambda_min),
            notes: Vec::new(),
        }
    }
}
