//! The sound of surfaces against closed forms and an independent quadrature.

use crate::common::{Film, Sines, drive};
use crate::small::small;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use unripple_core::{
    Conditions, Drive, ModalResponses, Outline, Point, Pole, Port, Responses, SampledResponses, Shape, Shapes,
};
use unripple_field::{FieldError, Listener, Pressure, Radiated};
use unripple_linalg::Mat;

/// Air at 20 °C: density in kg/m³ and speed of sound in m/s.
const AIR: [f64; 2] = [1.204, 343.2];

/// Samples per second, and per period of the tones of these tests: their frequencies are multiples of 100 Hz.
const RATE: f64 = 48e3;
const PERIOD: usize = 480;

/// A single mode that moves the whole surface alike.
#[derive(Debug)]
struct Piston;

impl Shapes for Piston {
    fn modes(&self) -> usize {
        1
    }

    fn at(&self, _: Point, row: &mut [f64]) {
        row.fill(1.0);
    }
}

/// A mass of 1 kg in the place of a mode, on which one actuator acts.
fn mass(shapes: impl Shapes + 'static, shape: Shape) -> Responses {
    let outline = Outline::new(shape);
    Responses::Modal(ModalResponses {
        ports: vec![Port { name: "a1".into(), at: Point::new(0.1, 0.1) }],
        poles: vec![Pole::new(0.0, 0.0)],
        input: Mat::full(1, 1, 1.0),
        shapes: Arc::new(shapes),
        conditions: Conditions { rate: RATE, band: [0.0, 1e4], lambda_min: 0.03, outline },
        frequency_error: 0.0,
        mode_errors: Vec::new(),
    })
}

/// The force of a tone of `hz` on the mass, two periods of it, and the amplitude of the velocity that it gives: the sum of impulses, not an
/// integral.
fn tone(hz: f64) -> (Drive, f64) {
    let step = TAU * hz / RATE;
    let force = (0..2 * PERIOD).map(|i| (step * i as f64).cos()).collect();
    (Drive::new(RATE, vec!["a1".into()], vec![force]).unwrap(), 1.0 / (2.0 * RATE * (step / 2.0).sin()))
}

fn listener(above: Point, height: f64, wavelength: f64) -> Listener {
    Listener { above, height, density: AIR[0], celerity: AIR[1], wavelength }
}

/// Rms of the sound pressure of a tone, in Pa.
fn heard(responses: &Responses, listener: &Listener, hz: f64) -> f64 {
    let radiated = Radiated::new(responses, listener).unwrap().unwrap();
    let sound = radiated.pressure(&tone(hz).0, Some(PERIOD as f64 / RATE)).unwrap();
    assert!((sound.duration * RATE / PERIOD as f64 - 1.0).abs() < 1e-12);
    (sound.exposure / sound.duration).sqrt()
}

/// A ratio of pressures in dB.
fn db(ratio: f64) -> f64 {
    20.0 * ratio.log10()
}

/// Kinsler et al., *Fundamentals of Acoustics* (4th ed.), eq. 7.4.5: on the axis of a piston in a baffle.
#[test]
fn a_piston_has_the_pressure_on_its_axis_of_the_closed_form() {
    let radius = 0.1;
    let piston = mass(Piston, Shape::Circle { radius });
    for hz in [300.0, 1100.0, 2700.0, 4400.0] {
        for height in [0.05, 0.3, 1.0] {
            let k = TAU * hz / AIR[1];
            let above = Point::new(radius, radius);
            let found = heard(&piston, &listener(above, height, AIR[1] / hz), hz);
            let phase = k / 2.0 * (height.hypot(radius) - height);
            let exact = 2.0 * AIR[0] * AIR[1] * tone(hz).1 * phase.sin().abs() / 2f64.sqrt();
            let apart = db(found / exact).abs();
            assert!(apart < 0.05, "ka = {}, {height} m: {found} Pa, exactly {exact} Pa", k * radius);
        }
    }
}

/// The Rayleigh integral in the frequency domain, by the midpoint rule on squares of half a millimetre.
#[test]
fn modes_of_a_plate_radiate_as_a_fine_sum_says() {
    let (width, height, distance) = (0.24, 0.16, 0.3);
    for (numbers, hz) in [((1.0, 1.0), 700.0), ((3.0, 2.0), 2100.0), ((5.0, 3.0), 4000.0)] {
        let sines = Sines { width, height, areal_density: 1.0, numbers: vec![numbers] };
        let plate = mass(sines, Shape::Rectangle { width, height });
        let wavelength = f64::min(AIR[1] / hz, 2.0 / (numbers.0 / width).hypot(numbers.1 / height));
        for above in [Point::new(0.11, 0.07), Point::new(0.05, 0.13)] {
            let found = heard(&plate, &listener(above, distance, wavelength), hz);
            let (k, cell) = (TAU * hz / AIR[1], 5e-4);
            let (mut re, mut im) = (0.0, 0.0);
            for i in 0..480 * 320 {
                let at = Point::new((f64::from(i % 480) + 0.5) * cell, (f64::from(i / 480) + 0.5) * cell);
                let r = at.distance(above).hypot(distance);
                let shape = 2.0 / (width * height).sqrt()
                    * (numbers.0 * PI * at.x / width).sin()
                    * (numbers.1 * PI * at.y / height).sin();
                re += shape * (k * r).cos() / r * cell * cell;
                im += shape * (k * r).sin() / r * cell * cell;
            }
            let exact = hz * AIR[0] * tone(hz).1 * f64::hypot(re, im) / 2f64.sqrt();
            assert!(db(found / exact).abs() < 0.05, "{numbers:?} from {above}: {found} Pa, {exact} Pa");
        }
    }
}

/// A drive of `samples`, of pulses without sharp ends at each actuator, and rest after it.
fn pulses(modal: &ModalResponses, samples: usize) -> Drive {
    let pulse = |a: usize, i: usize| match i < 90 {
        true => (PI * i as f64 / 90.0).sin().powi(2) * (0.3 * (a + 1) as f64 * i as f64).cos(),
        false => 0.0,
    };
    let channel = |a: usize| (0..samples).map(|i| pulse(a, i)).collect();
    drive(modal, (0..modal.ports.len()).map(channel).collect())
}

fn sound(film: &Film, drive: &Drive, period: Option<f64>) -> Pressure {
    let responses = film.responses();
    let above = Point::new(film.width / 2.0, film.height / 2.0);
    let wavelength = responses.conditions().lambda_min;
    let radiated = Radiated::new(&responses, &listener(above, 0.3, wavelength)).unwrap().unwrap();
    radiated.pressure(drive, period).unwrap()
}

/// Free vibration after a drive is followed otherwise than what is driven, and both give the same.
#[test]
fn an_event_that_dies_out_is_one_period_of_events_far_apart() {
    let film = small();
    let modal = film.modal();
    let long = (8.0 * film.decay_time * film.rate) as usize;
    let whole = pulses(&modal, long);
    let repeated = sound(&film, &whole, Some(whole.duration()));
    let single = sound(&film, &pulses(&modal, 90), None);
    for (one, other) in [
        (single.exposure, repeated.exposure),
        (single.a_weighted_exposure, repeated.a_weighted_exposure),
        (single.peak().powi(2), repeated.peak().powi(2)),
    ] {
        assert!((10.0 * (one / other).log10()).abs() < 0.05, "{one} {other}");
    }
    assert!(single.a_weighted_exposure < single.exposure);
}

/// What rings on when a drive is no longer followed counts: a surface that rings for 1 s against a sum over 7 s of it, with modes that are
/// close together (a nearly square sheet) and far apart.
#[test]
fn the_exposure_of_long_ringing_is_that_of_a_sum_over_many_decay_times() {
    let [width, height, rate] = [0.15, 0.149, 4e3];
    let modes = [((1.0, 1.0), 150.0), ((1.0, 3.0), 335.0), ((3.0, 1.0), 335.4), ((3.0, 3.0), 450.0)];
    let shapes =
        Sines { width, height, areal_density: 0.175, numbers: modes.iter().map(|mode| mode.0).collect() };
    let at = [Point::new(0.031, 0.052)];
    let modal = ModalResponses {
        ports: vec![Port { name: "a1".into(), at: at[0] }],
        poles: modes.iter().map(|mode| Pole::new(TAU * mode.1, 1.0)).collect(),
        input: shapes.at_all(&at),
        shapes: Arc::new(shapes),
        conditions: Conditions {
            rate,
            band: [0.0, 500.0],
            lambda_min: 0.07,
            outline: Outline::new(Shape::Rectangle { width, height }),
        },
        frequency_error: 0.0,
        mode_errors: Vec::new(),
    };
    let [short, long] = [12, 28_000].map(|samples| {
        let pulse = |i: usize| if i < 12 { (PI * i as f64 / 12.0).sin().powi(2) } else { 0.0 };
        drive(&modal, vec![(0..samples).map(pulse).collect()])
    });
    let responses = Responses::Modal(modal);
    let above = Point::new(width / 2.0, height / 2.0);
    let radiated = Radiated::new(&responses, &listener(above, 0.3, 0.07)).unwrap().unwrap();
    let single = radiated.pressure(&short, None).unwrap();
    let whole = radiated.pressure(&long, Some(long.duration())).unwrap();
    // Most of it was not followed.
    assert!(single.duration < 0.4, "{} s", single.duration);
    for (one, other) in
        [(single.exposure, whole.exposure), (single.a_weighted_exposure, whole.a_weighted_exposure)]
    {
        assert!((10.0 * (one / other).log10()).abs() < 0.1, "{one} {other}");
    }
}

#[test]
fn twice_the_drive_has_twice_the_pressure_and_none_is_silent() {
    let film = small();
    let modal = film.modal();
    let once = pulses(&modal, 90);
    let [one, two] = [once.clone(), once.clone().scaled(2.0)].map(|drive| sound(&film, &drive, None));
    assert!((two.exposure / one.exposure - 4.0).abs() < 1e-9 && (two.peak() / one.peak() - 2.0).abs() < 1e-9);
    let none = sound(&film, &once.scaled(0.0), None);
    assert_eq!((none.exposure, none.peak()), (0.0, 0.0));
}

/// With panels of a third of the length, the level changes by less than a report shows.
#[test]
fn a_finer_integral_changes_nothing() {
    let film = small();
    let responses = film.responses();
    let event = pulses(&film.modal(), 90);
    let above = Point::new(0.3 * film.width, 0.6 * film.height);
    let level = |wavelength: f64| {
        let radiated = Radiated::new(&responses, &listener(above, 0.3, wavelength)).unwrap().unwrap();
        10.0 * radiated.pressure(&event, None).unwrap().a_weighted_exposure.log10()
    };
    let shortest = responses.conditions().lambda_min;
    let [usual, fine] = [shortest, shortest / 3.0].map(level);
    assert!((usual - fine).abs() < 0.05, "{usual} {fine}");
}

#[test]
fn what_cannot_be_heard_is_refused_or_unknown() {
    let film = small();
    let responses = film.responses();
    let usual = listener(Point::new(0.0, 0.0), 0.3, 0.03);
    let wrong = [
        Listener { height: 0.0, ..usual },
        Listener { wavelength: f64::NAN, ..usual },
        Listener { celerity: -1.0, ..usual },
        Listener { density: 0.0, ..usual },
    ];
    for listener in wrong {
        let refused = Radiated::new(&responses, &listener).unwrap_err();
        assert!(matches!(refused, FieldError::Range(_)), "{refused}");
    }
    let short = Listener { wavelength: 1e-6, ..usual };
    assert!(matches!(Radiated::new(&responses, &short), Err(FieldError::Count { .. })));
    let modal = film.modal();
    let points = vec![Point::new(0.02, 0.02)];
    let data = vec![0.0; modal.ports.len() * 2];
    let library = SampledResponses::new(modal.ports.clone(), points, modal.conditions.clone(), 2, data);
    assert!(Radiated::new(&Responses::Sampled(library.unwrap()), &usual).unwrap().is_none());
    let radiated = Radiated::new(&responses, &usual).unwrap().unwrap();
    let event = pulses(&modal, 90);
    assert!(matches!(radiated.pressure(&event, Some(1.0)), Err(FieldError::Range(_))));
    let alien = Drive::new(film.rate, vec!["b".into()], vec![vec![1.0]]).unwrap();
    assert!(matches!(radiated.pressure(&alien, None), Err(FieldError::Channels { .. })));
}
