//! Spectra of a focus's drive and of the motion at its targets, in bands.

use serde_json::{Value, json};
use unripple::act::Acted;
use unripple::dsp::band_energies;

/// Number of bands that are drawn, a few pixels wide each in a panel of the page, and their upper end as a multiple of
/// the top of the surface's band.
const BANDS: usize = 120;
const BEYOND: f64 = 1.5;

/// Levels below this, in dB, are drawn as this.
const FLOOR: f64 = -120.0;

/// The spectra of a focus as JSON: levels in bands of equal width, of each channel of the drive and each target's
/// velocity, relative to its strongest band, in dB.
pub fn spectrum(acted: &Acted, top_hz: f64) -> Value {
    let rate = acted.drive.rate();
    let top = (BEYOND * top_hz).min(rate / 2.0);
    let centre = |band: usize| (band as f64 + 0.5) * top / BANDS as f64;
    // Silence after a short signal makes its lines narrower than the bands.
    let least = (2.0 * rate * BANDS as f64 / top).ceil() as usize;
    let bands = |signal: &[f64]| {
        let silence = std::iter::repeat_n(0.0, least.saturating_sub(signal.len()));
        let padded: Vec<f64> = signal.iter().copied().chain(silence).collect();
        levels(&band_energies(&padded, rate, top, BANDS))
    };
    json!({
        "hz": (0..BANDS).map(centre).collect::<Vec<f64>>(),
        "drive_db": acted.drive.channels().iter().map(|channel| bands(channel)).collect::<Vec<_>>(),
        "target_db": acted.judged.traces.iter().map(|trace| bands(&trace.velocity)).collect::<Vec<_>>(),
    })
}

fn levels(energies: &[f64]) -> Vec<f64> {
    let most = energies.iter().fold(0.0, |m: f64, x| m.max(*x));
    let level = |energy: &f64| (10.0 * (energy / most).log10()).max(FLOOR);
    let tenth = |db: f64| (10.0 * db).round() / 10.0;
    energies.iter().map(|energy| if most > 0.0 { tenth(level(energy)) } else { FLOOR }).collect()
}
