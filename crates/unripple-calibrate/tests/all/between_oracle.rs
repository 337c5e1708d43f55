//! Responses between points against true ones, and the focus that they give, on the paper's film measured with errors.

use crate::between_bench;

use between_bench::*;
use unripple_calibrate::{Between, Interpolation};
use unripple_core::{Point, Responses, SampledResponses};
use unripple_devices::Perturbation;
use unripple_focus::Method;
use unripple_physics::design::papers_surface;
use unripple_physics::sample;

/// 100 ms, the decay time and a half, and half as long.
const LONG: usize = 4801;
const SHORT: usize = 2401;

/// A measurement, places off its grid, and what the places do.
struct Case {
    truth: Truth,
    measured: SampledResponses,
    places: Vec<Point>,
}

impl Case {
    fn of(truth: Truth, per_wavelength: f64, samples: usize, errors: Errors) -> Self {
        let points = grid(truth.lambda() / per_wavelength);
        let measured = truth.measured(&points, samples, errors, 11);
        Self { truth, measured, places: targets(4, 5) }
    }

    fn plan(&self, way: Interpolation, errors: Errors) -> Between<'_> {
        Between::plan(&self.measured, told(), &options(way, errors)).unwrap()
    }

    /// Share of the true responses' contrast that interpolated ones reach.
    fn share(&self, between: &Between, method: Method) -> f64 {
        let known = match method {
            Method::TimeReversal => Responses::Sampled(between.onto(&self.places).unwrap()),
            _ => onto(between, &self.places, self.truth.lambda() / 2.0),
        };
        let [found, ideal] =
            [&known, &self.truth.whole].map(|known| mean(&self.truth.contrasts(known, method, &self.places)));
        found / ideal
    }
}

#[test]
fn half_a_wavelength_is_enough_on_a_surface_that_is_not_as_told() {
    let case = Case::of(Truth::unknown(), 2.0, LONG, USUAL);
    let between = case.plan(Interpolation::Kernel, USUAL);
    let shares = [Method::TimeReversal, Method::Concentrate].map(|method| case.share(&between, method));
    println!("pitch λ/2: share of time reversal's and of concentration's contrast {shares:.3?}");
    assert!(shares[0] >= 0.98 && shares[1] >= 0.85);
}

#[test]
fn errors_are_as_predicted() {
    let case = Case::of(Truth::papers(), 2.0, LONG, USUAL);
    let real = sample(&case.truth.modal, &case.places, case.measured.samples());
    for way in Interpolation::ALL {
        let between = case.plan(way, USUAL);
        let found = off(&between.onto(&case.places).unwrap(), &real);
        let squares: Vec<f64> =
            case.places.iter().map(|p| between.error(*p).unwrap().relative.powi(2)).collect();
        let ratio = found / mean(&squares).sqrt();
        println!("{}: off {found:.4}, over what was predicted {ratio:.2}", way.name());
        assert!((1.0 / 1.5..1.5).contains(&ratio), "{}: {ratio}", way.name());
    }
}

/// Stray masses scatter waves that no field of the sheet's own waves has: what is stated grows with what is wrong.
#[test]
fn beside_a_stray_mass_more_is_wrong_and_so_is_stated() {
    let case = Case::of(Truth::unknown(), 1.94, LONG, USUAL);
    let between = case.plan(Interpolation::Kernel, USUAL);
    let surface = Perturbation::default().truth(&papers_surface()).unwrap().surface;
    let masses: Vec<Point> = surface.sheet.uneven.scatterers.iter().map(|mass| mass.at).collect();
    let around =
        |at: &Point| [6e-3, 10e-3, 15e-3, 20e-3].map(|r| Point::new(at.x + 0.8 * r, at.y - 0.6 * r)).to_vec();
    let near: Vec<Point> = masses.iter().flat_map(around).collect();
    let far = |p: &Point| masses.iter().all(|mass| mass.distance(*p) > 0.04);
    let away: Vec<Point> = targets(40, 5).into_iter().filter(far).take(12).collect();
    for (name, places) in [("beside", near), ("away", away)] {
        let real = sample(&case.truth.modal, &places, case.measured.samples());
        let interpolated = between.onto(&places).unwrap();
        let (mut squares, mut worst) = ([0.0, 0.0], 0.0_f64);
        for (n, place) in places.iter().enumerate() {
            let [found, real] = [&interpolated, &real].map(|all| all.select(&[n]).unwrap());
            let (off, stated) = (off(&found, &real), between.error(*place).unwrap().relative);
            println!("{name} {place}: off {off:.3}, stated {stated:.3}");
            squares = [squares[0] + off.powi(2), squares[1] + stated.powi(2)];
            worst = worst.max(off / stated);
        }
        let ratio = (squares[0] / squares[1]).sqrt();
        println!("{name}: off over stated {ratio:.2}, at the worst place {worst:.2}");
        assert!(ratio < 1.5 && worst < 3.0, "{name}: {ratio}, {worst}");
    }
}

#[test]
fn two_thirds_of_a_wavelength_serve_time_reversal_on_a_surface_that_is_not_as_told() {
    let case = Case::of(Truth::unknown(), 1.5, SHORT, USUAL);
    let [kernel, linear] = [Interpolation::Kernel, Interpolation::Linear]
        .map(|way| case.share(&case.plan(way, USUAL), Method::TimeReversal));
    println!("pitch λ/1.5: share of time reversal's contrast {kernel:.3}, linear {linear:.3}");
    assert!(kernel >= 0.90 && kernel > linear);
}

#[test]
fn a_millimetre_off_still_focuses() {
    let errors = Errors { position: 1e-3, ..USUAL };
    let case = Case::of(Truth::papers(), 2.0, SHORT, errors);
    let between = case.plan(Interpolation::Kernel, errors);
    let share = case.share(&between, Method::TimeReversal);
    let real = sample(&case.truth.modal, &case.places, case.measured.samples());
    let found = off(&between.onto(&case.places).unwrap(), &real);
    let squares: Vec<f64> = case.places.iter().map(|p| between.error(*p).unwrap().relative.powi(2)).collect();
    let ratio = found / mean(&squares).sqrt();
    println!(
        "points 1 mm off: share of time reversal's contrast {share:.3}, off {found:.4}, over predicted {ratio:.2}"
    );
    assert!(share >= 0.95 && (1.0 / 1.5..1.5).contains(&ratio));
}
