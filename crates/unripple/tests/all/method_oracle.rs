//! What time reversal and its sign reach on the paper's surface.

use unripple::core::Point;
use unripple::field::{Aim, Field};
use unripple::focus::{Focuser, Method, Options, Target};
use unripple::physics::design::papers_surface;
use unripple::physics::{ResponseOptions, responses};
use unripple_paper::study::Random;

const WINDOW: f64 = 0.030;

/// The sign of time reversal at the limit is the highest peak that a limit allows: on this surface at least 9.5 dB
/// above time reversal at the same limit, averaged over twenty targets.
#[test]
fn one_bit_is_nine_and_a_half_decibels_louder() {
    let surface = papers_surface();
    let responses = responses(&surface, &ResponseOptions::default()).unwrap();
    let plan =
        |method| Focuser::new(&responses, &Options { method, window: WINDOW, ..Options::default() }).unwrap();
    let (reversal, one_bit) = (plan(Method::TimeReversal), plan(Method::OneBit));
    let mut random = Random::seeded(2012);
    let mut gains = Vec::new();
    for _ in 0..20 {
        let at = Point::new(random.between(0.02, 0.13), random.between(0.02, 0.13));
        let peak = |plan: &Focuser| {
            let drive = plan.focus(&[Target::at(at)]).unwrap().drive;
            assert!((drive.peak() - 1.0).abs() < 1e-12);
            let field = Field::new(&responses, &drive, 0.2).unwrap();
            field.traces(&[at], WINDOW).unwrap()[0].velocity.last().copied().unwrap()
        };
        gains.push(20.0 * (peak(&one_bit) / peak(&reversal)).log10());
    }
    let mean = gains.iter().sum::<f64>() / gains.len() as f64;
    let least = gains.iter().copied().fold(f64::INFINITY, f64::min);
    println!("one-bit over time reversal: mean {mean:.2} dB, least {least:.2} dB");
    assert!(mean >= 9.5, "{mean}");
}

/// Equation (2) of Hudin et al. (2012): at the target and at T the field is Σ∫h², summed over the actuators.
#[test]
fn the_peak_is_the_energy_of_the_responses() {
    let surface = papers_surface();
    let responses = responses(&surface, &ResponseOptions::default()).unwrap();
    let options = Options { window: WINDOW, accuracy: 1e-9, ..Options::default() };
    for (x, y) in [(62.0, 90.0), (20.0, 120.0), (75.0, 75.0)] {
        let at = Point::from_mm(x, y);
        let focused = unripple::focus::focus(&responses, &[Target::at(at)], &options).unwrap();
        let measured = Field::new(&responses, &focused.drive, 1.0)
            .unwrap()
            .measure(&[Aim::at(at, WINDOW)], None)
            .unwrap();
        // The drive is the reversed responses over their largest value, so Σ∫d² = Σ∫h²/max² and v = Σ∫h²/max.
        let unripple::core::Responses::Modal(modal) = &responses else { unreachable!() };
        let library = unripple::physics::sample(modal, &[at], focused.drive.samples());
        let largest =
            (0..8).flat_map(|a| library.response(a, 0)).fold(0.0, |m: f64, h| m.max(f64::from(h.abs())));
        let energy: f64 =
            (0..8).flat_map(|a| library.response(a, 0)).map(|h| f64::from(*h).powi(2)).sum::<f64>()
                / focused.drive.rate();
        let peak = measured.targets[0].peak_velocity_m_s;
        assert!((peak / (energy / largest) - 1.0).abs() < 1e-5, "{peak} {}", energy / largest);
        assert!((peak / (focused.drive.energy() * largest) - 1.0).abs() < 1e-5);
    }
}
