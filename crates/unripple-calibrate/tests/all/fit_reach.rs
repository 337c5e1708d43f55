//! What a fitted model says at places of its own, beside what would be measured there: above the surface's band too.

use crate::heard_bench;

use heard_bench::*;
use unripple_calibrate::{FitOptions, fit};

#[test]
fn a_fitted_model_reaches_as_far_as_what_it_was_fitted_to() {
    let mut surface = film();
    surface.emission.band[1] = 800.0;
    let mut truth = Truth { snr: 80.0, ..Truth::of(surface.clone()) };
    let measured = truth.pairs();
    let options = FitOptions { band: Some([100.0, 720.0]), profile: 0, strays: 0, ..FitOptions::default() };
    let fitted = fit(&surface, &measured, &options).unwrap();
    let points = places(&surface, 4);
    let known = truth.probed(&points, &points, &[1.0; 4]);
    let model = fitted.sampled(&points, known.samples()).unwrap();
    for (point, at) in points.iter().enumerate() {
        let (mut off, mut all) = (0.0, 0.0);
        for actuator in 0..8 {
            let pairs = known.response(actuator, point).iter().zip(model.response(actuator, point));
            for (there, here) in pairs {
                off += f64::from(here - there).powi(2);
                all += f64::from(*there).powi(2);
            }
        }
        let share = (off / all).sqrt();
        println!("{at}: {:.1} % is missed", 100.0 * share);
        assert!(share < 0.05, "{at}: {share}");
    }
}
