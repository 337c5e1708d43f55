//! What measurements at places tell of a surface, against the scatter of what is fitted to noisy ones; and what is refused.

use unripple_calibrate::{
    CalibrateError, FitOptions, Information, InformationOptions, Measured, Sensing, Tap, fit, information,
};
use unripple_core::{Point, Random, Responses, Surface};
use unripple_linalg::{Lu, Mat, product};
use unripple_physics::design::papers_surface;
use unripple_physics::{ResponseOptions, responses, sample};

const RATE: f64 = 8e3;
const TOP: f64 = 400.0;

/// Number of noisy measurements. The scatter of a value is known to within a fifth by so many.
const FITS: usize = 16;

/// The paper's film in a tenth of its band, with four of its actuators.
fn film() -> Surface {
    let mut film = papers_surface();
    film.actuators.truncate(4);
    (film.emission.band, film.emission.rate) = ([0.0, TOP], RATE);
    film
}

fn options(sensing: Sensing) -> InformationOptions {
    let fit = FitOptions { profile: 0, strays: 0, ..FitOptions::default() };
    InformationOptions { sensing, snr_db: 45.0, fit }
}

fn places() -> Vec<Point> {
    [(61.0, 47.0), (101.0, 118.0), (43.0, 92.0)].map(|(x, y)| Point::from_mm(x, y)).to_vec()
}

/// Standard deviation of what a fit to measurements at all places finds of unknowns whose true values are those expected: the priors draw the
/// values to these. In the unknowns' units.
fn scatter(found: &Information) -> Vec<f64> {
    let count = found.unknowns.len();
    let sum = Mat::from_fn(count, count, |i, j| found.at.iter().map(|one| one[(i, j)]).sum::<f64>());
    let with_priors = Mat::from_fn(count, count, |i, j| sum[(i, j)] + if i == j { 1.0 } else { 0.0 });
    let inverse = Lu::new(with_priors.as_ref()).inverse();
    let covariance = product(product(inverse.as_ref(), sum.as_ref()).as_ref(), inverse.as_ref());
    found.unknowns.iter().enumerate().map(|(u, unknown)| unknown.prior * covariance[(u, u)].sqrt()).collect()
}

/// Taps of a unit impulse of force at each place, without noise: the signals of all sensors.
fn tapped(film: &Surface, places: &[Point]) -> Vec<Vec<Vec<f64>>> {
    let above = ResponseOptions { max_hz: Some(1.4 * TOP), ..ResponseOptions::default() };
    let Responses::Modal(modal) = responses(film, &above).unwrap() else { panic!("not modal") };
    let sampled = sample(&modal, places, (0.25 * RATE) as usize);
    // A push that lasts a sample or two, which says the same in the band.
    let pulse: Vec<f64> = (0..9).map(|i| (-((i as f64 / RATE - 5e-4) / 2e-4).powi(2)).exp()).collect();
    let area: f64 = pulse.iter().sum();
    let heard = |a: usize, p: usize| -> Vec<f64> {
        let h = sampled.response(a, p);
        let one = |i: usize| (0..=i.min(8)).map(|j| f64::from(h[i - j]) * pulse[j] / area).sum::<f64>();
        (0..h.len()).map(one).collect()
    };
    (0..places.len()).map(|p| (0..film.actuators.len()).map(|a| heard(a, p)).collect()).collect()
}

#[test]
fn fits_scatter_as_the_information_predicts() {
    let (film, places) = (film(), places());
    let found = information(&film, &places, &options(Sensing::Taps)).unwrap();
    let predicted = scatter(&found);
    let clean = tapped(&film, &places);
    let mut random = Random::seeded(12);
    let mut values: Vec<Vec<f64>> = Vec::new();
    for _ in 0..FITS {
        let mut noisy = |signal: &Vec<f64>| -> Vec<f64> {
            signal.iter().map(|x| x + found.noise * random.normal()).collect()
        };
        let taps: Vec<Tap> = places
            .iter()
            .zip(&clean)
            .map(|(at, heard)| Tap {
                at: *at,
                heard: heard.iter().map(&mut noisy).collect(),
                noise: found.noise,
            })
            .collect();
        let fitted = fit(&film, &Measured::taps(RATE, taps), &options(Sensing::Taps).fit).unwrap();
        let at = fitted.actuators.iter().flat_map(|load| load.at.map(|c| c.value));
        values.push([(fitted.tension.value / film.sheet.tension).ln()].into_iter().chain(at).collect());
    }
    let mut names = vec!["tension".to_owned()];
    names
        .extend(film.actuators.iter().flat_map(|a| [format!("x of {}", a.name), format!("y of {}", a.name)]));
    let mut pooled = 0.0;
    for (i, name) in names.iter().enumerate() {
        let mean = values.iter().map(|v| v[i]).sum::<f64>() / FITS as f64;
        let variance = values.iter().map(|v| (v[i] - mean).powi(2)).sum::<f64>() / (FITS as f64 - 1.0);
        let u = found.unknowns.iter().position(|unknown| unknown.name == *name).unwrap();
        let ratio = variance / predicted[u].powi(2);
        println!("{name}: {:.3e}, predicted {:.3e}", variance.sqrt(), predicted[u]);
        // A value's own ratio is that of chi squared with 15 degrees of freedom: 0.19 to 3.0 but for one in a thousand, either way.
        assert!((0.15..3.5).contains(&ratio), "{name}: {ratio}");
        pooled += ratio / names.len() as f64;
    }
    assert!((0.6..1.6).contains(&pooled), "{pooled}");
}

#[test]
fn noise_makes_information_less_and_taps_tell_other_unknowns_than_sweeps() {
    let (film, places) = (film(), places());
    let quiet = information(&film, &places, &options(Sensing::Sweeps)).unwrap();
    let loud = information(&film, &places, &InformationOptions { snr_db: 25.0, ..options(Sensing::Sweeps) })
        .unwrap();
    assert!((loud.noise / quiet.noise - 10.0).abs() < 1e-9);
    for (a, b) in quiet.at.iter().zip(&loud.at) {
        assert!((a[(0, 0)] / b[(0, 0)] - 100.0).abs() < 1e-6);
    }
    let taps = information(&film, &places, &options(Sensing::Taps)).unwrap();
    let (drive, sense) = ("drive gain of a1".to_owned(), "sensor gain of a1".to_owned());
    assert!(quiet.untold.contains(&sense) && !quiet.untold.contains(&drive), "{:?}", quiet.untold);
    assert!(taps.untold.contains(&drive) && !taps.untold.contains(&sense), "{:?}", taps.untold);
    for name in ["latency", "gain of all sensors"] {
        assert!([&quiet, &taps].iter().all(|found| found.untold.contains(&name.to_owned())), "{name}");
    }
    // On a sheet without tension, nothing tells how it varies either.
    let mut plate = film.clone();
    (plate.sheet.tension, plate.sheet.thickness) = (0.0, 0.5e-3);
    let plate = information(&plate, &places, &options(Sensing::Sweeps)).unwrap();
    for name in ["tension", "anisotropy"] {
        assert!(plate.untold.contains(&name.to_owned()), "{:?}", plate.untold);
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let film = film();
    let sweeps = options(Sensing::Sweeps);
    let beyond = information(&film, &[Point::from_mm(-20.0, 50.0)], &sweeps).unwrap_err();
    assert!(matches!(beyond, CalibrateError::Outside { place: 0, .. }), "{beyond}");
    assert!(matches!(information(&film, &[], &sweeps), Err(CalibrateError::Count { what: "places", .. })));
    let mut one = film.clone();
    one.actuators.truncate(1);
    assert!(information(&one, &places(), &sweeps).is_ok());
    let error = information(&one, &places(), &options(Sensing::Taps)).unwrap_err();
    assert_eq!(error.to_string(), "actuators of the surface: expected at least 2, found 1");
    let wrong = InformationOptions { snr_db: f64::NAN, ..sweeps.clone() };
    assert!(matches!(information(&film, &places(), &wrong), Err(CalibrateError::Range(_))));
    let narrow = unripple_core::Memory::of(1e4).during(|| information(&film, &places(), &sweeps));
    assert!(narrow.is_err());
}
