//! What must hold on any surface, from its modes to its field: reciprocity, linearity, superposition, energy.

use proptest::prelude::*;
use unripple::core::{
    Actuator, ActuatorKind, Air, Decay, Drive, Edge, Edges, Emission, Finger, Outline, Point, Responses,
    Shape, Sheet, Surface, Uneven,
};
use unripple::field::{Aim, Field};
use unripple::focus::{Options, Target, focus};
use unripple::physics::{ResponseOptions, responses, sample};

const RATE: f64 = 16e3;

fn edge() -> impl Strategy<Value = Edge> {
    prop_oneof![Just(Edge::Clamped), Just(Edge::Supported), Just(Edge::Free)]
}

fn decay() -> impl Strategy<Value = Decay> {
    prop_oneof![
        (0.005..0.2).prop_map(Decay::Time),
        (0.01..0.1, 0.005..0.05).prop_map(|(low, high)| Decay::Table(vec![(100.0, low), (1000.0, high)])),
        (0.005..0.05).prop_map(Decay::LossFactor),
    ]
}

/// Places as shares of the sides, away from the rim, where a held edge does not move.
fn place() -> impl Strategy<Value = (f64, f64)> {
    (0.1..0.9, 0.1..0.9)
}

fn surface() -> impl Strategy<Value = Surface> {
    let sides = (0.08..0.2, 0.08..0.2);
    let sheet = (20.0..400.0, 0.05e-3..0.3e-3, decay(), prop_oneof![Just(Air::None), Just(Air::BothSides)]);
    (sides, proptest::collection::vec(edge(), 4), sheet, proptest::collection::vec(place(), 1..4)).prop_map(
        |((width, height), edges, (tension, thickness, decay, air), places)| Surface {
            name: "random".into(),
            outline: Outline::new(Shape::Rectangle { width, height }).with_edges(Edges::PerSide(edges)),
            sheet: Sheet {
                material: "BoPET".into(),
                young: 4e9,
                density: 1400.0,
                poisson: 0.3,
                strength: None,
                thickness,
                tension,
                decay,
                air,
                uneven: Uneven::default(),
            },
            emission: Emission { band: [0.0, 900.0], rate: RATE, limit: 1.0, rms_limit: None },
            finger: Finger::default(),
            accuracy: None,
            actuators: places
                .iter()
                .enumerate()
                .map(|(i, (x, y))| Actuator {
                    name: format!("a{}", i + 1),
                    at: Point::new(x * width, y * height),
                    kind: ActuatorKind::Force,
                    contact_radius: 0.0,
                })
                .collect(),
        },
    )
}

fn on(surface: &Surface, (x, y): (f64, f64)) -> Point {
    let (width, height) = surface.outline.extent();
    Point::new(x * width, y * height)
}

fn modelled(surface: &Surface) -> Responses {
    responses(surface, &ResponseOptions { accuracy: 1e-4.into(), ..ResponseOptions::default() }).unwrap()
}

/// Velocity at a place under a drive, sample by sample.
fn heard(responses: &Responses, drive: &Drive, at: Point) -> Vec<f64> {
    let field = Field::new(responses, drive, 0.5).unwrap();
    field.traces(&[at], drive.duration() - 1.0 / drive.rate()).unwrap().swap_remove(0).velocity
}

fn close(a: &[f64], b: &[f64], tolerance: f64) -> Result<(), TestCaseError> {
    let scale = a.iter().fold(1e-12, |m: f64, x| m.max(x.abs()));
    for (x, y) in a.iter().zip(b) {
        prop_assert!((x - y).abs() <= tolerance * scale, "{} {}", x, y);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// h_AB = h_BA: actuator and point may be exchanged.
    #[test]
    fn responses_are_reciprocal(surface in surface(), b in place()) {
        let b = on(&surface, b);
        let there = modelled(&surface);
        let mut exchanged = surface.clone();
        let a = exchanged.actuators[0].at;
        exchanged.actuators[0].at = b;
        let back = modelled(&exchanged);
        let (Responses::Modal(there), Responses::Modal(back)) = (&there, &back) else { unreachable!() };
        let (h, g) = (sample(there, &[b], 400), sample(back, &[a], 400));
        let wide = |r: &[f32]| r.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
        close(&wide(h.response(0, 0)), &wide(g.response(0, 0)), 1e-5)?;
    }

    /// The field of a sum is the sum of the fields, and of a multiple the multiple.
    #[test]
    fn fields_are_linear(surface in surface(), at in place(), gain in -3.0..3.0, seed in any::<u64>()) {
        let (at, responses) = (on(&surface, at), modelled(&surface));
        let mut random = unripple_paper::study::Random::seeded(seed);
        let names: Vec<String> = surface.actuators.iter().map(|a| a.name.clone()).collect();
        let mut noise = || names.iter().map(|_| (0..200).map(|_| random.normal()).collect()).collect::<Vec<Vec<f64>>>();
        let (p, q) = (noise(), noise());
        let both = p.iter().zip(&q).map(|(p, q)| p.iter().zip(q).map(|(p, q)| p + gain * q).collect()).collect();
        let of = |channels: Vec<Vec<f64>>| heard(&responses, &Drive::new(RATE, names.clone(), channels).unwrap(), at);
        let (first, second, sum) = (of(p), of(q), of(both));
        let added: Vec<f64> = first.iter().zip(&second).map(|(a, b)| a + gain * b).collect();
        close(&added, &sum, 1e-9)?;
    }

    /// At the target and at T the field of time reversal is Σ∫h², its own drive's energy at unit scale.
    #[test]
    fn the_peak_is_the_energy(surface in surface(), at in place()) {
        let (at, responses) = (on(&surface, at), modelled(&surface));
        let options = Options { window: 0.02, accuracy: 1e-9, ..Options::default() };
        let drive = focus(&responses, &[Target::at(at)], &options).unwrap().drive;
        let field = Field::new(&responses, &drive, 1.0).unwrap();
        let peak = field.measure(&[Aim::at(at, 0.02)], None).unwrap().targets[0].peak_velocity_m_s;
        let Responses::Modal(modal) = &responses else { unreachable!() };
        let library = sample(modal, &[at], drive.samples());
        let all = (0..modal.ports.len()).flat_map(|a| library.response(a, 0)).map(|h| f64::from(*h));
        let (largest, energy) = all.fold((0.0, 0.0), |(m, e): (f64, f64), h| (m.max(h.abs()), e + h * h / RATE));
        prop_assert!((peak * largest / energy - 1.0).abs() < 1e-4, "{} {}", peak, energy / largest);
    }

    /// Two targets together are the sum of each alone, up to the scale they share.
    #[test]
    fn targets_superpose(surface in surface(), a in place(), b in place(), gain in 0.2..2.0) {
        let (a, b, responses) = (on(&surface, a), on(&surface, b), modelled(&surface));
        let options = Options { window: 0.01, accuracy: 1e-9, ..Options::default() };
        let channels = |targets: &[Target]| focus(&responses, targets, &options).unwrap().drive.channels().concat();
        let (first, second) = (channels(&[Target::at(a)]), channels(&[Target::at(b)]));
        let both = channels(&[Target::at(a), Target::at(b).with_gain(gain)]);
        // Both lie in the plane that the two span: the residual of the best fit vanishes.
        let dot = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>();
        let (ff, ss, fs) = (dot(&first, &first), dot(&second, &second), dot(&first, &second));
        let (fb, sb) = (dot(&first, &both), dot(&second, &both));
        let det = ff * ss - fs * fs;
        prop_assume!(det > 1e-6 * ff * ss);
        let (u, w) = ((fb * ss - sb * fs) / det, (sb * ff - fb * fs) / det);
        let fit: Vec<f64> = first.iter().zip(&second).map(|(f, s)| u * f + w * s).collect();
        close(&both, &fit, 1e-6)?;
    }
}
