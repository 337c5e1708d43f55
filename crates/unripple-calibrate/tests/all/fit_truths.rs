//! Fits to many random truths: errors that hold, and no wrong answer that is called good. `UNRIPPLE_TRUTHS=100` tries that many.

use crate::heard_bench;

use heard_bench::*;
use unripple_calibrate::{Estimate, FitOptions, Fitted, Measured, Verdict, fit};
use unripple_core::{Decay, Edge, Edges, Point, Random, Responses, Surface};
use unripple_physics::{ResponseOptions, responses, sample};

/// Top of the band, where a fit takes seconds.
const TOP: f64 = 800.0;

/// Standard errors of an interval that holds 95 % of a normal distribution.
const NINETY_FIVE: f64 = 1.96;

/// A film that differs from what is believed by as much as such films do.
fn random_truth(believed: &Surface, random: &mut Random) -> Truth {
    let mut surface = believed.clone();
    surface.sheet.tension *= (0.06 * random.normal()).exp();
    surface.sheet.young *= (0.06 * random.normal()).exp();
    surface.sheet.decay = Decay::Time(random.between(0.045, 0.09));
    for actuator in &mut surface.actuators {
        actuator.at.x += 1e-3 * random.normal();
        actuator.at.y += 1e-3 * random.normal();
        actuator.at = surface.outline.nearest(actuator.at);
    }
    let snr = random.between(35.0, 60.0);
    let random = Random::seeded((random.between(0.0, 1.0) * 1e9) as u64);
    Truth { snr, random, late: 0.3, ..Truth::of(surface) }
}

/// Every interval's value, error and truth.
fn intervals(fitted: &Fitted, truth: &Surface) -> Vec<(&'static str, Estimate, f64)> {
    let medium = unripple_physics::Medium::of(&truth.sheet);
    let Decay::Time(decay) = truth.sheet.decay else { panic!("one decay time") };
    let mut all = vec![
        ("tension", fitted.tension, medium.tension),
        ("bending", fitted.bending_stiffness, medium.bending_stiffness),
        ("anisotropy", fitted.anisotropy, 0.0),
    ];
    all.extend(fitted.decay.iter().map(|(_, time)| ("decay", *time, decay)));
    for (actuator, load) in truth.actuators.iter().zip(&fitted.actuators) {
        all.push(("x", load.at[0], actuator.at.x));
        all.push(("y", load.at[1], actuator.at.y));
        all.push(("mass", load.mass, 0.0));
        all.push(("damping", load.damping, 0.0));
    }
    all
}

#[test]
fn intervals_hold_and_no_wrong_answer_is_good() {
    let count = std::env::var("UNRIPPLE_TRUTHS").map_or(4, |n| n.parse().unwrap());
    let mut believed = film();
    believed.emission.band[1] = TOP;
    let mut random = Random::seeded(2024);
    let mut tally = std::collections::BTreeMap::<&str, [usize; 2]>::new();
    let mut wrong = Vec::new();
    let mut doubtful = 0;
    for n in 0..count {
        let mut truth = random_truth(&believed, &mut random);
        let measured = truth.pairs();
        let fitted =
            fit(&believed, &measured, &FitOptions { profile: 1, strays: 0, ..FitOptions::default() });
        let fitted = fitted.unwrap();
        stay_on(&believed, &fitted);
        let far = |(at, load): (&unripple_core::Actuator, &unripple_calibrate::FittedLoad)| {
            Point::new(load.at[0].value, load.at[1].value).distance(at.at)
        };
        let worst = truth.surface.actuators.iter().zip(&fitted.actuators).map(far).fold(0.0, f64::max);
        let tension = fitted.tension.value / truth.surface.sheet.tension;
        let good = fitted.verdict == Verdict::Good;
        println!(
            "{n}: {:.0} dB, tension {tension:.5} of the true, places to {:.3} mm, unexplained {:.2} %, {}",
            truth.snr,
            1e3 * worst,
            100.0 * fitted.unexplained(),
            if good { "good" } else { "doubtful" }
        );
        doubtful += usize::from(!good);
        if !good {
            continue;
        }
        // A tenth of the shortest wavelength costs 1 % of contrast.
        if worst > 1.5e-3 || (tension - 1.0).abs() > 0.01 {
            wrong.push(n);
        }
        for (name, Estimate { value, error }, true_value) in intervals(&fitted, &truth.surface) {
            let [held, all] = tally.entry(name).or_default();
            *held += usize::from((value - true_value).abs() < NINETY_FIVE * error);
            *all += 1;
        }
    }
    for (name, [held, all]) in &tally {
        println!("{name}: {held} of {all} intervals hold, {:.1} %", 100.0 * *held as f64 / *all as f64);
    }
    let [held, all] = tally.values().fold([0, 0], |[h, a], [x, y]| [h + x, a + y]);
    println!(
        "all: {held} of {all}, {:.1} %; {doubtful} of {count} doubtful",
        100.0 * held as f64 / all as f64
    );
    assert!(wrong.is_empty(), "called good, and wrong: {wrong:?}");
    assert!(10 * doubtful <= count, "{doubtful} doubtful");
    let share = held as f64 / all as f64;
    assert!(share > if count < 20 { 0.85 } else { 0.90 } && (count < 20 || share < 0.99), "{share}");
}

/// Fitted actuators are on the sheet.
fn stay_on(surface: &Surface, fitted: &Fitted) {
    for (actuator, load) in surface.actuators.iter().zip(&fitted.actuators) {
        let at = Point::new(load.at[0].value, load.at[1].value);
        assert!(surface.outline.contains(at), "{} at {at}", actuator.name);
    }
}

/// A pane on springs with actuators on its very rim, which moves; and the same pane as it is believed to be, with them 1 mm inside.
fn at_the_rim() -> (Surface, Surface) {
    let mut truth = plate();
    truth.outline.edges = Edges::All(Edge::Elastic { lift: 1e5, tilt: 0.0 });
    truth.emission.band[1] = 1500.0;
    let places =
        [(0., 24.), (200., 44.), (0., 73.), (200., 100.), (58., 0.), (108., 120.), (144., 0.), (180., 120.)];
    let mut believed = truth.clone();
    for (n, (x, y)) in places.into_iter().enumerate() {
        truth.actuators[n].at = Point::from_mm(x, y);
        believed.actuators[n].at = Point::from_mm(x.clamp(1.0, 199.0), y.clamp(1.0, 119.0));
    }
    (truth, believed)
}

/// Where the truth is on the rim itself, a step of the fit, or noise alone, would put an actuator beyond it.
#[test]
fn fitted_actuators_stay_on_the_sheet() {
    let (truth, believed) = at_the_rim();
    let above = ResponseOptions { max_hz: Some(2200.0), ..ResponseOptions::default() };
    let Responses::Modal(modal) = responses(&truth, &above).unwrap() else { panic!("not modal") };
    let places: Vec<Point> = truth.actuators.iter().map(|actuator| actuator.at).collect();
    let heard = sample(&modal, &places, 9600);
    // Responses of an actuator to itself have an rms of 90 m/s/(N s): noise at -60 dB.
    let (noise, mut random) = (0.09, Random::seeded(11));
    let signal = |n: usize| -> Vec<f64> {
        heard.response(n / 8, n % 8).iter().map(|v| f64::from(*v) + noise * random.normal()).collect()
    };
    let measured = Measured::pairs(truth.emission.rate, (0..64).map(signal).collect(), noise);
    let options = FitOptions { profile: 0, strays: 0, ..FitOptions::default() };
    let fitted = fit(&believed, &measured, &options).unwrap();
    stay_on(&believed, &fitted);
    for (actuator, load) in truth.actuators.iter().zip(&fitted.actuators) {
        let far = Point::new(load.at[0].value, load.at[1].value).distance(actuator.at);
        assert!(far < 0.5e-3, "{}: {far}", actuator.name);
    }
}
