//! Responses warped to another tension, against those of a sheet under that tension.

use unripple_calibrate::Warp;
use unripple_core::{Point, Responses};
use unripple_physics::design::papers_surface;
use unripple_physics::{Medium, ResponseOptions, responses, sample};

fn miss(found: &[f64], truth: &[f64]) -> f64 {
    let square = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>();
    (square(&mut found.iter().zip(truth).map(|(a, b)| a - b)) / square(&mut truth.iter().copied())).sqrt()
}

#[test]
fn warped_responses_are_those_of_another_tension() {
    let nominal = papers_surface();
    let mut slack = nominal.clone();
    slack.sheet.tension *= 0.97;
    let [Responses::Modal(known), Responses::Modal(truth)] =
        [&nominal, &slack].map(|surface| responses(surface, &ResponseOptions::default()).unwrap())
    else {
        unreachable!()
    };
    let at = [Point::from_mm(62.0, 90.0)];
    let signal = |r: &unripple_core::ModalResponses, n: usize| -> Vec<f64> {
        sample(r, &at, n).response(0, 0).iter().map(|v| f64::from(*v)).collect()
    };
    let truth = signal(&truth, 1441);
    let warp = Warp::new(&Medium::of(&nominal.sheet));
    let modal = miss(&signal(&warp.modal(&known, 0.97), 1441), &truth);
    let sampled = warp.signal(&signal(&known, 4800), 48e3, 0.97, 1.0 / 0.07);
    let sampled = miss(&sampled[..1441], &truth);
    let nothing = miss(&signal(&known, 1441), &truth);
    println!("modal {modal:.4}, sampled {sampled:.4}, not warped {nothing:.3}");
    assert!(modal < 0.1 && sampled < 0.12 && nothing > 0.5);
}
