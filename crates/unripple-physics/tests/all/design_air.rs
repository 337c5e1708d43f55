//! Designs of a pane in a band above coincidence, where it radiates sound: decay times with radiation, and a note where air is left out.

use std::f64::consts::TAU;
use unripple_core::{Air, Decay, Edge, Edges, Surface};
use unripple_physics::design::{design_by_law, limits, papers_surface};
use unripple_physics::{Design, Modes, design};

/// Decay time of the pane without air, in s.
const OWN: f64 = 0.030;

/// Frequency in Hz above which waves on the pane are faster than sound.
const COINCIDENCE: f64 = 16_863.0;

/// A supported pane of 0.7 mm glass in a band from 10 kHz to `top_hz`.
fn pane(air: Air, top_hz: f64) -> Surface {
    let mut surface = papers_surface();
    surface.outline.edges = Edges::All(Edge::Supported);
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.poisson) = (72e9, 2500.0, 0.22);
    (sheet.thickness, sheet.tension, sheet.decay, sheet.air) = (0.7e-3, 0.0, Decay::Time(OWN), air);
    (surface.emission.band, surface.emission.rate) = ([10e3, top_hz], 4.0 * top_hz);
    surface
}

/// The textbook's decay rate (1/s) by radiation from one side, n ρ_0 c_0/(2 ρ_s √(1 - f_c/f)), well above coincidence.
fn radiated(hz: f64) -> f64 {
    1.204 * 343.2 / (2.0 * 2500.0 * 0.7e-3 * (1.0 - COINCIDENCE / hz).sqrt())
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "expected {expected}, found {found}");
}

#[test]
fn decay_times_are_those_of_modes_that_radiate() {
    for (air, sides) in [(Air::OneSide, 1.0), (Air::BothSides, 2.0)] {
        let surface = pane(air, 30e3);
        let modes = Modes::solve(&surface, 30e3, 1e-4).unwrap();
        let rates: Vec<f64> =
            modes.poles().iter().filter(|pole| pole.omega > TAU * 10e3).map(|pole| pole.sigma).collect();
        let count = rates.len() as f64;
        let mean = rates.iter().sum::<f64>() / count;
        // Statistics of the band differ from these modes as one sample from another: by a standard error of their mean.
        let error =
            (rates.iter().map(|rate| (rate - mean).powi(2)).sum::<f64>() / count).sqrt() / count.sqrt();
        println!("{air:?}: {count} modes, {mean:.1} ± {error:.1} 1/s");
        for d in [design(&surface).unwrap(), design_by_law(&surface, "asked for").unwrap()] {
            let found = d.decay_time_s;
            assert!((1.0 / found - mean).abs() < error && found < 0.3 * OWN, "{found}");
            assert!(d.to_string().contains(&format!("{:<37}{:.1} ms", "decay time", 1e3 * found)), "{d}");
            let waves = &d.dispersion;
            let own = waves.iter().filter(|w| w.frequency_hz < 0.98 * COINCIDENCE);
            assert!(
                own.clone().count() > 2 && own.clone().all(|w| (w.decay_time_s / OWN - 1.0).abs() < 1e-9)
            );
            let top = waves.last().unwrap();
            close(top.decay_time_s, 1.0 / (1.0 / OWN + sides * radiated(30e3)), 0.01);
        }
    }
}

/// The note on radiation that is left out, if there is one.
fn noted(surface: &Surface) -> Option<String> {
    limits(surface).into_iter().find(|note| note.topic == "radiation").map(|note| note.text)
}

#[test]
fn radiation_that_is_left_out_is_named() {
    let surface = pane(Air::None, 30e3);
    let text = noted(&surface).expect("a note");
    let ms = |sides: f64| format!("{:.1} ms", 1e3 / (sides * radiated(30e3)));
    for part in [format!("{COINCIDENCE} Hz"), "30000 Hz".into(), ms(1.0), ms(2.0), "30 ms".into()] {
        assert!(text.contains(&part), "{part} is missing from {text}");
    }
    let named = |d: Design| {
        assert!(d.notes.iter().any(|note| note.text == text), "{:?}", d.notes);
        assert!(d.to_string().contains(&text), "{d}");
    };
    named(design_by_law(&surface, "asked for").unwrap());
    // Of slower waves there is nothing to say, nor where air is told.
    for surface in [pane(Air::None, 16e3), pane(Air::OneSide, 30e3), pane(Air::BothSides, 30e3)] {
        assert_eq!(noted(&surface), None);
    }
}

/// Waves on a film under much tension are faster than sound at every frequency, so that there is no coincidence.
#[test]
fn films_faster_than_sound_radiate_at_every_frequency() {
    let mut film = papers_surface();
    assert_eq!(noted(&film), None);
    film.sheet.tension = 40e3;
    let text = noted(&film).expect("a note");
    assert!(text.contains("at every frequency"), "{text}");
}
