//! The mechanical power into a sheet, by other routes: what the damping of its modes takes and what stays in them, and the mobility under
//! actuators of several kinds at a steady tone.

use std::f64::consts::TAU;
use unripple::act::{Act, Level, model, power};
use unripple::core::{
    Actuator, ActuatorKind, CoilDrive, Drive, ModalResponses, Onset, Patch, Pole, Random, Responses, Surface,
};
use unripple::field::Field;
use unripple::focus::{Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::{Footprint, transducers};
use unripple_linalg::c64;

/// Samples per second: 16 times the top of the band.
const RATE: f64 = 12.8e3;

/// Images of a tone on either side of it that are counted; what is left is as one over their number.
const IMAGES: i32 = 100;

/// Samples of a period, 0.1 s, and how many of them: after 2 s a decay time of 70 ms has left 4e-13.
const PERIOD: [usize; 2] = [1280, 20];

/// The paper's film in a band up to 800 Hz, with actuators of another kind.
fn film(kind: Option<ActuatorKind>) -> Surface {
    let mut surface = papers_surface();
    (surface.emission.band, surface.emission.rate) = ([0.0, 800.0], RATE);
    if let Some(kind) = kind {
        surface.actuators.truncate(2);
        surface.actuators.iter_mut().for_each(|actuator: &mut Actuator| actuator.kind = kind);
    }
    surface
}

fn modal(responses: &Responses) -> &ModalResponses {
    let Responses::Modal(modal) = responses else { panic!("a surface without modes") };
    modal
}

fn drive(surface: &Surface, channels: Vec<Vec<f64>>) -> Drive {
    Drive::new(RATE, surface.actuators.iter().map(|a| a.name.clone()).collect(), channels).unwrap()
}

/// Energy (J) that the damping of all modes takes from sample `from` of a drive to its last one, and that is in them just before those
/// samples: each mode solved from its pole, and 2σv² integrated over each sample by Simpson's rule in 16 parts.
fn taken(modal: &ModalResponses, drive: &Drive, from: usize) -> (f64, [f64; 2]) {
    let (mut lost, mut held) = (0.0, [0.0; 2]);
    for (m, pole) in modal.poles.iter().enumerate() {
        assert_eq!(pole.onset, Onset::Velocity);
        let [mut u, mut v] = [0.0; 2];
        let part = pole.step(1.0 / (16.0 * RATE));
        let energy = |u: f64, v: f64| 0.5 * (v * v + (pole.omega * u).powi(2));
        for i in 0..drive.samples() {
            if i == from {
                held[0] += energy(u, v);
            }
            v += (0..drive.channels().len())
                .map(|a| modal.input[(a, m)] * drive.channels()[a][i])
                .sum::<f64>()
                / RATE;
            let mut squares = v * v;
            for step in 1..=16 {
                (u, v) = (part[0][0] * u + part[0][1] * v, part[1][0] * u + part[1][1] * v);
                let weight = if step == 16 {
                    1.0
                } else if step % 2 == 1 {
                    4.0
                } else {
                    2.0
                };
                squares += weight * v * v;
            }
            if i >= from {
                lost += 2.0 * pole.sigma * squares / (3.0 * 16.0 * RATE);
            }
        }
        held[1] += energy(u, v);
    }
    (lost, held)
}

/// Over a period of a repeated drive, the damping of the modes takes what the actuators give.
#[test]
fn a_steady_state_takes_what_its_damping_takes() {
    let surface = film(None);
    let responses = model(&surface, None, &[]).unwrap();
    let [period, count] = PERIOD;
    let mut random = Random::seeded(7);
    // Tones of the band, each with an amplitude and phase of its own for every actuator.
    let mut channel = || -> Vec<f64> {
        let tones: Vec<[f64; 2]> =
            (8..80).map(|_| [random.between(0.0, 1.0), random.between(0.0, TAU)]).collect();
        let at = |i: usize| {
            let tone = |(k, [size, phase]): (usize, &[f64; 2])| {
                size * (TAU * ((k + 8) * i) as f64 / period as f64 + phase).cos()
            };
            tones.iter().enumerate().map(tone).sum::<f64>()
        };
        let once: Vec<f64> = (0..period).map(at).collect();
        once.iter().copied().cycle().take(period * count).collect()
    };
    let drive = drive(&surface, surface.actuators.iter().map(|_| channel()).collect());
    let field = Field::new(&responses, &drive, 1.0).unwrap();
    let seconds = period as f64 / RATE;
    let found = power(&surface, &field, seconds).unwrap().unwrap();
    let (lost, held) = taken(modal(&responses), &drive, period * (count - 1));
    assert!((held[1] / held[0] - 1.0).abs() < 1e-9, "not steady: {held:?}");
    assert!((found / (lost / seconds) - 1.0).abs() < 1e-5, "{found} {}", lost / seconds);
}

/// Over a single pulse, what is given is in the modes at its end, or was taken by their damping.
#[test]
fn a_pulse_leaves_in_the_sheet_what_its_damping_has_not_taken() {
    let surface = film(None);
    let responses = model(&surface, None, &[]).unwrap();
    let (targets, options) = (
        [Target::at(unripple::core::Point::from_mm(62.0, 90.0))],
        Options { window: 20e-3, ..Options::default() },
    );
    let act = Act {
        surface: &surface,
        responses: &responses,
        targets: &targets,
        options: &options,
        level: Level::default(),
    };
    let acted = act.run().unwrap();
    let (lost, held) = taken(modal(&responses), &acted.drive, 0);
    let report = acted.report(&surface, &options);
    let found = report.mean_mechanical_power_w.unwrap();
    let expected = (lost + held[1]) / acted.drive.duration();
    assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
    assert!(report.text().contains("W of mechanical power into the sheet on average"), "{}", report.text());
    assert_eq!(report.without_scale().mean_mechanical_power_w, None);
}

/// Velocity of each contact for a tone of amplitude 1 at the first actuator, at s = jω.
fn velocities(surface: &Surface, modal: &ModalResponses, s: c64) -> Vec<c64> {
    let places: Vec<Footprint> = transducers(surface).unwrap().iter().map(|t| t.footprint.clone()).collect();
    let weights = Footprint::all_weights(&places, modal.shapes.as_ref());
    let moved = |pole: &Pole| {
        let below = s * s + s * (2.0 * pole.sigma) + pole.omega * pole.omega;
        match pole.onset {
            Onset::Velocity => s / below,
            Onset::Displacement => c64::new(-pole.omega, 0.0) / below,
        }
    };
    let of = |c: usize| {
        modal
            .poles
            .iter()
            .enumerate()
            .map(|(m, pole)| moved(pole) * (weights[(c, m)] * modal.input[(0, m)]))
            .sum()
    };
    (0..places.len()).map(of).collect()
}

#[test]
fn coils_on_a_current_and_patches_give_what_their_tones_do() {
    let coil = |driven_by, inductance| ActuatorKind::MovingMagnet {
        force_constant: 0.6,
        resistance: 6.0,
        inductance,
        moving_mass: 1e-5,
        driven_by,
    };
    let kinds = [
        (ActuatorKind::Force, Some(1.0)),
        (ActuatorKind::Piezo { patch: Patch::Round { radius: 5e-3 }, moment: 0.02, mass: 1e-5 }, Some(0.02)),
        (coil(CoilDrive::Current, 1e-3), Some(0.6)),
        // What a coil on a voltage gives depends on a velocity that these modes do not have.
        (coil(CoilDrive::Voltage, 1e-3), None),
    ];
    for (kind, gain) in kinds {
        let surface = film(Some(kind));
        let responses = model(&surface, None, &[]).unwrap();
        for hz in [170.0, 400.0, 630.0] {
            let [period, count] = PERIOD;
            let tone = (0..period * count).map(|i| (TAU * hz * i as f64 / RATE).cos()).collect();
            let drive = drive(&surface, vec![tone, vec![0.0; period * count]]);
            let field = Field::new(&responses, &drive, 1.0).unwrap();
            let found = power(&surface, &field, period as f64 / RATE).unwrap();
            let Some(gain) = gain else {
                assert_eq!(found, None);
                continue;
            };
            // A drive of samples holds the tone and its images about every multiple of the sample rate, each of which moves the sheet.
            let image = |k: i32| c64::new(0.0, TAU * (hz + f64::from(k) * RATE));
            let moved: f64 =
                (-IMAGES..=IMAGES).map(|k| velocities(&surface, modal(&responses), image(k))[0].re).sum();
            let (found, expected) = (found.unwrap(), 0.5 * gain * moved);
            assert!((found / expected - 1.0).abs() < 1e-3, "{kind:?}, {hz} Hz: {found} {expected}");
        }
    }
}
