//! Models fitted to a surface that is not the model: another tension and an uneven one, another damping law, misplaced actuators,
//! gains that are off, two stray masses, noise; in a band of a third of the paper's, where it is quick.

use crate::fit_truth;

use fit_truth::*;
use unripple_calibrate::{FitOptions, Fitted, Measured, Verdict, fit};
use unripple_core::{Decay, Edge, Edges, Outline, Point, Responses, Shape};
use unripple_physics::{ResponseOptions, responses, sample};

const TOP: f64 = 1000.0;

fn found(truth: &Truth, measured: &Measured) -> Fitted {
    let options = FitOptions { strays: 2, ..FitOptions::default() };
    let fitted = fit(&truth.nominal, measured, &options).unwrap();
    assert_eq!(fitted.verdict, Verdict::Good);
    for (actuator, load) in truth.surface.actuators.iter().zip(&fitted.actuators) {
        let [x, y] = load.at.map(|c| c.value);
        assert!(Point::new(x, y).distance(actuator.at) < 0.4e-3, "{}", actuator.name);
    }
    let mut places = fitted.stray_places();
    places.sort_by(|a, b| a.x.total_cmp(&b.x));
    let masses = &Faults::default().masses;
    assert_eq!(places.len(), masses.len());
    for (place, (at, _)) in places.iter().zip(masses) {
        assert!(place.distance(*at) < 1e-3, "{place} {at}");
    }
    let Responses::Modal(modal) = fitted.responses() else { panic!("fitted responses are modal") };
    assert_eq!(modal.poles.len(), fitted.bending_shares().len());
    fitted
}

#[test]
fn models_fitted_from_pairs_and_from_taps_focus_as_the_truth_does() {
    let mut truth = Truth::new(&Faults::default(), TOP);
    let (tapped, judged) = (targets(8), &targets(12)[8..]);
    for measured in [truth.pairs(0.25), truth.taps(&tapped, 0.25)] {
        let fitted = found(&truth, &measured);
        let [reversal, inverse] = truth.shares(&fitted.responses(), judged);
        println!("excess {:.2}: {reversal:.3} {inverse:.3}", fitted.excess);
        assert!(reversal > 0.95 && inverse > 0.85);
        blended(&truth, &fitted);
    }
    // Without strays in the model it cannot be right, and says so.
    let blind = FitOptions { strays: 0, ..FitOptions::default() };
    let measured = truth.pairs(0.25);
    let fitted = fit(&truth.nominal, &measured, &blind).unwrap();
    println!("blind: {:?}", fitted.verdict);
    assert!(matches!(fitted.verdict, Verdict::Doubtful { .. }));
}

/// Responses blended with a measurement: it where there is one, the model far from it.
fn blended(truth: &Truth, fitted: &Fitted) {
    let [here, far] = [Point::from_mm(60.0, 80.0), Point::from_mm(110.0, 30.0)];
    let Responses::Modal(plant) = &truth.plant else { panic!("the truth is modal") };
    let measured = sample(plant, &[here], 480);
    let both = fitted.blend(&measured, &[here, far]).unwrap();
    let model = sample(fitted.modal(), &[far], 480);
    for a in 0..8 {
        let off = |x: &[f32], y: &[f32]| x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f32::max);
        assert!(off(both.response(a, 0), measured.response(a, 0)) < 1e-4);
        assert!(off(both.response(a, 1), model.response(a, 0)) < 1e-4);
    }
}

/// What is expected of an actuator's damping depends on the sheet: 20 mN·s/m are nothing to a glass plate.
#[test]
fn a_plate_whose_modes_have_a_loss_each_is_fitted() {
    let mut nominal = unripple_physics::design::papers_surface();
    nominal.outline =
        Outline::new(Shape::Rectangle { width: 0.2, height: 0.15 }).with_edges(Edges::All(Edge::Supported));
    nominal.sheet.decay = Decay::Time(0.02);
    (nominal.sheet.young, nominal.sheet.density, nominal.sheet.poisson) = (70e9, 2500.0, 0.22);
    (nominal.sheet.thickness, nominal.sheet.tension) = (0.7e-3, 0.0);
    nominal.emission.band[1] = 4000.0;
    let above = ResponseOptions { max_hz: Some(5600.0), ..ResponseOptions::default() };
    let Responses::Modal(mut modal) = responses(&nominal, &above).unwrap() else { panic!("not modal") };
    for (m, pole) in modal.poles.iter_mut().enumerate() {
        pole.sigma *= 1.0 + 0.1 * (7919.0 * m as f64).sin();
    }
    let places: Vec<Point> = nominal.actuators.iter().map(|actuator| actuator.at).collect();
    let heard = sample(&modal, &places, 12_000);
    let signal = |n: usize| heard.response(n / 8, n % 8).iter().map(|v| f64::from(*v)).collect();
    let measured = Measured::pairs(48e3, (0..64).map(signal).collect(), 0.05);
    let fitted = fit(&nominal, &measured, &FitOptions::default()).unwrap();
    println!("{:.1} times the noise, {:?}", fitted.excess, fitted.verdict);
    assert!(fitted.excess > 5.0, "the losses make no difference");
    assert_eq!(fitted.verdict, Verdict::Good);
    for load in &fitted.actuators {
        println!("damping {:.4} ± {:.4} N·s/m", load.damping.value, load.damping.error);
        assert!(load.damping.value.abs() < 4.0 * load.damping.error);
    }
}

#[test]
fn measurements_that_cannot_be_are_refused() {
    let nominal = unripple_physics::design::papers_surface();
    let options = FitOptions::default();
    let few = Measured::pairs(48e3, vec![vec![0.0; 100]; 9], 1.0);
    let error = fit(&nominal, &few, &options).unwrap_err();
    assert_eq!(error.to_string(), "responses from actuator to actuator: expected 64, found 9");
    let mut broken = Measured::pairs(48e3, vec![vec![0.0; 100]; 64], 1.0);
    if let Some(pairs) = &mut broken.pairs {
        pairs.responses[3][7] = f64::NAN;
    }
    assert!(fit(&nominal, &broken, &options).is_err());
    let empty = Measured::pairs(48e3, vec![Vec::new(); 64], 1.0);
    assert!(fit(&nominal, &empty, &options).is_err());
}
