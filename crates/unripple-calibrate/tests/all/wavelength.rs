//! The wavelength from how responses correlate in space, held against the dispersion of the sheets that they are computed for.

use crate::measured_bench::WORLD;

use unripple_calibrate::{Wavelength, wavelength};
use unripple_core::{Point, Random, Responses, SampledResponses};
use unripple_physics::{Medium, sample};

/// Responses of the paper's film on a grid of a pitch in m around its middle, 10 x 10 points.
fn film(pitch: f64) -> SampledResponses {
    let Responses::Modal(plant) = &WORLD.plant else { panic!() };
    let along = |i: usize| 0.075 + pitch * (i as f64 - 4.5);
    let points: Vec<Point> = (0..100).map(|i| Point::new(along(i % 10), along(i / 10))).collect();
    sample(plant, &points, 4801)
}

#[test]
fn the_films_wavelength_is_within_its_error() {
    for pitch in [5e-3, 7.5e-3] {
        let responses = film(pitch);
        let found = wavelength(&responses).unwrap().unwrap();
        let real = Medium::of(&WORLD.truth.surface.sheet).lambda_min(found.hz);
        let Wavelength { metres, error, .. } = found;
        assert!((metres - real).abs() < (3.0 * error).max(0.03 * real), "{found:?}, expected {real}");
        assert!(error < 0.06 * real, "{found:?}");
        assert!((found.first_zero / metres - 0.38274).abs() < 1e-4);
    }
}

#[test]
fn what_does_not_correlate_has_no_wavelength() {
    let responses = film(7.5e-3);
    let mut random = Random::seeded(3);
    let noise = (0..100 * 8 * 4801).map(|_| random.normal() as f32).collect();
    let of = |points: usize, data: Vec<f32>| {
        let points = responses.points[..points].to_vec();
        let (ports, conditions) = (responses.ports.clone(), responses.conditions.clone());
        SampledResponses::new(ports, points, conditions, 4801, data).unwrap()
    };
    assert_eq!(wavelength(&of(100, noise)).unwrap(), None);
    // Too few points do not tell it, nor does a sheet at rest.
    assert_eq!(wavelength(&responses.select(&[0, 1, 2]).unwrap()).unwrap(), None);
    assert_eq!(wavelength(&of(20, vec![0.0; 20 * 8 * 4801])).unwrap(), None);
}
