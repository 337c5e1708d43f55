//! Power of the wave that moves a finger by 10 µm, and the impedances involved.

use super::Strip;
use super::paper::{CONTACT, DISPLACEMENT, WAVELENGTH, film_strip, glass_strip};
use super::strip::finger_impedance;
use std::f64::consts::TAU;
use unripple_core::{Finger, Surface};

/// Wavelengths for which a surface's own figures are computed, as multiples of its shortest wavelength:
/// power falls fast with wavelength. A third would tell little more.
const MULTIPLES: [f64; 2] = [1.0, 2.0];

/// Power of the wave that moves a finger by 10 µm, on a strip of sheet as wide as the contact, and the impedances involved
/// (Hudin et al. 2012, section 3.5 and table 1).
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Touch {
    /// Name of the strip, for people.
    pub strip: String,
    /// Wavelength, in metres.
    pub wavelength_m: f64,
    /// Phase velocity, in m/s.
    pub celerity_m_s: f64,
    /// Frequency, in Hz.
    pub frequency_hz: f64,
    /// Impedance of the strip abs(Z_S), in N·s/m.
    pub impedance_n_s_per_m: f64,
    /// Impedance of the finger abs(Z_F) at the wave's frequency, in N·s/m.
    pub finger_impedance_n_s_per_m: f64,
    /// Power of the incident wave, in W (equation 4 of the paper).
    pub power_w: f64,
    /// Share of the incident power that the finger absorbs.
    pub absorbed_power: f64,
    /// The power printed in the paper, in W; `None` for strips that are not in its table 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub printed_power_w: Option<f64>,
}

/// The rows of table 1 of Hudin et al. (2012): glass and film at a wavelength of 15 mm, with a contact of 10 mm and the paper's finger.
pub fn table1() -> Vec<Touch> {
    let finger = Finger::default();
    let k = TAU / WAVELENGTH;
    vec![
        Touch { printed_power_w: Some(500.0), ..touch("glass 1 mm", &glass_strip(), &finger, k) },
        Touch { printed_power_w: Some(1.5), ..touch("BoPET 0.125 mm, 2 N", &film_strip(), &finger, k) },
    ]
}

/// The power of the wave that moves the surface's finger by 10 µm on a strip of the surface's own sheet, at
/// the shortest wavelength `lambda_min` (m) and at twice that.
pub(super) fn own_touches(surface: &Surface, lambda_min: f64) -> Vec<Touch> {
    let sheet = &surface.sheet;
    let width =
        if surface.finger.contact_radius > 0.0 { 2.0 * surface.finger.contact_radius } else { CONTACT };
    let strip = Strip::of_sheet(sheet.young, sheet.density, sheet.thickness, sheet.tension, width);
    let name = format!("{} {} mm", sheet.material, sheet.thickness * 1e3);
    MULTIPLES.map(|times| touch(&name, &strip, &surface.finger, TAU / (times * lambda_min))).to_vec()
}

/// The figures of one strip at the wavenumber `k` (rad/m).
fn touch(name: &str, strip: &Strip, finger: &Finger, k: f64) -> Touch {
    let hz = k * strip.celerity(k) / TAU;
    let (resistance, reactance) = finger_impedance(finger, TAU * hz);
    Touch {
        strip: name.into(),
        wavelength_m: TAU / k,
        celerity_m_s: strip.celerity(k),
        frequency_hz: hz,
        impedance_n_s_per_m: strip.impedance(k),
        finger_impedance_n_s_per_m: resistance.hypot(reactance),
        power_w: strip.power(finger, k, DISPLACEMENT),
        absorbed_power: strip.scattering(finger, hz).absorbed_power,
        printed_power_w: None,
    }
}
