//! Truth: the sums and closed forms that define responses.

use crate::modes_common;

use modes_common::*;
use std::f64::consts::PI;
use std::sync::Arc;
use unripple_core::*;
use unripple_physics::{PhysicsError, ResponseOptions, responses, sample};

fn modal(surface: &Surface, options: &ResponseOptions) -> ModalResponses {
    match responses(surface, options).unwrap() {
        Responses::Modal(modal) => modal,
        Responses::Sampled(_) => panic!("not modal"),
    }
}

#[test]
fn supported_film_against_its_double_series() {
    let mut surface = film_with_actuators(&[(12.0, 31.0), (95.0, 137.0)]);
    surface.outline.edges = Edges::All(Edge::Supported);
    let modal = modal(&surface, &ResponseOptions::default());
    let points = [Point::from_mm(62.0, 90.0), Point::from_mm(101.0, 20.0)];
    let sampled = sample(&modal, &points, 300);
    let (mass, sigma) = (0.175 * 0.0225, 1.0 / 0.07);
    let d = 4e9 * 0.125e-3f64.powi(3) / (12.0 * (1.0 - 0.09));
    for (a, actuator) in surface.actuators.iter().enumerate() {
        for (p, point) in points.iter().enumerate() {
            for i in [0, 1, 17, 299] {
                let t = i as f64 / 48e3;
                let mut exact = 0.0;
                for (m, n) in (1..25).flat_map(|m| (1..25).map(move |n| (f64::from(m), f64::from(n)))) {
                    let k2 = (m * m + n * n) * (PI / 0.15).powi(2);
                    let omega = (k2 * (200.0 + d * k2) / 0.175).sqrt();
                    if omega > 2.0 * PI * 3000.0 {
                        continue;
                    }
                    let shape = |p: &Point| (m * PI * p.x / 0.15).sin() * (n * PI * p.y / 0.15).sin();
                    let ringing = (omega * omega - sigma * sigma).sqrt();
                    let velocity =
                        (-sigma * t).exp() * ((ringing * t).cos() - sigma / ringing * (ringing * t).sin());
                    exact += 4.0 / mass * shape(&actuator.at) * shape(point) * velocity;
                }
                let found = f64::from(sampled.response(a, p)[i]);
                assert!((found - exact).abs() < 5e-3, "{a} {p} {i}: {found} {exact}");
            }
        }
    }
}

#[test]
fn the_library_is_the_modal_sum() {
    let surface = film_with_actuators(&[(12.0, 31.0), (9.0, 84.0), (40.0, 140.0)]);
    let modal = modal(&surface, &ResponseOptions { accuracy: 1e-4.into(), ..Default::default() });
    let points: Vec<Point> = (0..130).map(|i| Point::from_mm(1.0 + f64::from(i), 75.5)).collect();
    let sampled = sample(&modal, &points, 700);
    for p in [0, 63, 64, 129] {
        let mut row = vec![0.0; modal.poles.len()];
        modal.shapes.at(points[p], &mut row);
        for a in 0..3 {
            let scale: f64 = (0..row.len()).map(|m| (row[m] * modal.input[(a, m)]).abs()).sum();
            for i in [0, 1, 350, 699] {
                let exact: f64 = (0..row.len())
                    .map(|m| row[m] * modal.input[(a, m)] * modal.poles[m].velocity(i as f64 / 48e3))
                    .sum();
                let found = f64::from(sampled.response(a, p)[i]);
                assert!((found - exact).abs() < 3e-6 * scale, "{p} {a} {i}: {found} {exact}");
            }
        }
    }
}

#[test]
fn the_band_and_the_top() {
    let mut surface = film_with_actuators(&[(12.0, 31.0)]);
    surface.emission.band = [400.0, 1000.0];
    let narrow = modal(&surface, &ResponseOptions::default());
    let wide = modal(&surface, &ResponseOptions { max_hz: Some(2000.0), ..Default::default() });
    let hz = |r: &ModalResponses| r.poles.iter().map(|p| p.omega / (2.0 * PI)).collect::<Vec<_>>();
    assert!(hz(&narrow).iter().all(|f| (400.0..=1000.0).contains(f)));
    assert!(hz(&wide)[0] >= 400.0 && wide.poles.len() > 2 * narrow.poles.len());
    assert_eq!(wide.conditions, narrow.conditions);
    // The modes in common read the same.
    let point = [Point::from_mm(33.0, 71.0)];
    let shapes: Arc<dyn Shapes> = narrow.shapes.clone();
    let (few, many) = (shapes.at_all(&point), wide.shapes.at_all(&point));
    for m in 0..few.ncols() {
        assert!((few[(0, m)].abs() - many[(0, m)].abs()).abs() < 1e-3 * 2.0 / (0.175f64 * 0.0225).sqrt());
    }
    assert_eq!(shapes.modes(), few.ncols());
    let mut row = vec![0.0; few.ncols()];
    shapes.at(point[0], &mut row);
    assert!(row.iter().enumerate().all(|(m, w)| (w - few[(0, m)]).abs() < 1e-9));
}

#[test]
fn refuses_what_it_cannot_drive() {
    let fails = |change: fn(&mut Surface)| {
        let mut surface = film_with_actuators(&[(12.0, 31.0)]);
        change(&mut surface);
        responses(&surface, &ResponseOptions::default()).unwrap_err()
    };
    let patch = |radius, mass| ActuatorKind::Piezo { patch: Patch::Round { radius }, moment: 1.0, mass };
    let wide = fails(|s| {
        s.actuators[0].kind =
            ActuatorKind::Piezo { patch: Patch::Round { radius: 0.02 }, moment: 1.0, mass: 0.0 }
    });
    assert!(matches!(&wide, PhysicsError::Unsupported { .. }));
    assert!(
        wide.to_string().contains("12.00 mm from the rim") && wide.to_string().contains("actuator 0, `a1`")
    );
    for kind in [patch(0.0, 0.0), patch(f64::NAN, 0.0), patch(0.01, -1.0)] {
        let mut surface = film_with_actuators(&[(62.0, 31.0)]);
        surface.actuators[0].kind = kind;
        let refused = responses(&surface, &ResponseOptions::default());
        assert!(matches!(refused, Err(PhysicsError::Range(_))), "{kind:?}");
    }
    assert!(matches!(fails(|s| s.actuators[0].contact_radius = -1.0), PhysicsError::Range(_)));
    assert!(matches!(fails(|s| s.actuators[0].at.x = 0.2), PhysicsError::Unsupported { .. }));
    assert!(matches!(fails(|s| s.actuators[0].at.x = f64::NAN), PhysicsError::Unsupported { .. }));
    assert!(matches!(fails(|s| s.emission.rate = 5000.0), PhysicsError::Range(_)));
    assert!(matches!(fails(|s| s.emission.rate = f64::NAN), PhysicsError::Range(_)));
    assert!(matches!(fails(|s| s.emission.band = [3000.0, 3000.0]), PhysicsError::Range(_)));
    let options = ResponseOptions { max_hz: Some(100.0), ..Default::default() };
    let below = responses(&film_with_actuators(&[(12.0, 31.0)]), &options);
    assert!(matches!(below, Err(PhysicsError::Range(_))));
}

#[test]
fn refuses_fingers_that_cannot_be() {
    let surface = film_with_actuators(&[(12.0, 31.0)]);
    let with = |at, finger, reach| {
        let contacts = vec![Contact { at, finger }];
        responses(&surface, &ResponseOptions { contacts, reach, ..Default::default() })
    };
    let (middle, finger) = (Point::from_mm(62.0, 90.0), Finger::default());
    let outside = with(Point::from_mm(151.0, 90.0), finger, 1.5).unwrap_err();
    assert!(matches!(&outside, PhysicsError::Unsupported { .. }) && outside.to_string().contains("150.0000"));
    assert!(matches!(with(middle, finger, 1.0), Err(PhysicsError::Range(_))));
    for finger in [
        Finger { mass: -1e-3, ..finger },
        Finger { damping: f64::NAN, ..finger },
        Finger { stiffness: -1.0, ..finger },
        Finger { contact_radius: f64::INFINITY, ..finger },
    ] {
        assert!(matches!(with(middle, finger, 1.5), Err(PhysicsError::Range(_))), "{finger:?}");
    }
    for spoil in [0, 1] {
        let mut surface = film_with_actuators(&[(12.0, 31.0)]);
        surface.actuators[0].kind = ActuatorKind::MovingMagnet {
            force_constant: 6.0,
            resistance: if spoil == 0 { 0.0 } else { 6.2 },
            inductance: if spoil == 1 { -1.0 } else { 0.0 },
            moving_mass: 1e-4,
            driven_by: CoilDrive::Voltage,
        };
        let refused = responses(&surface, &ResponseOptions::default());
        assert!(matches!(refused, Err(PhysicsError::Range(_))));
    }
}

/// A force over a disc is the mean of forces at its points.
#[test]
fn a_force_over_a_disc() {
    let mut surface = film_with_actuators(&[(62.0, 31.0)]);
    surface.outline.edges = Edges::All(Edge::Supported);
    surface.actuators[0].contact_radius = 4e-3;
    let found = modal(&surface, &ResponseOptions::default());
    let mut read = vec![0.0; found.poles.len()];
    let mut mean = vec![0.0; found.poles.len()];
    for i in 0..4000 {
        let (r, angle) =
            (4e-3 * ((f64::from(i) + 0.5) / 4000.0).sqrt(), 2.399_963_229_728_653 * f64::from(i));
        found.shapes.at(Point::new(0.062 + r * angle.cos(), 0.031 + r * angle.sin()), &mut read);
        mean.iter_mut().zip(&read).for_each(|(m, w)| *m += w / 4000.0);
    }
    for (m, w) in mean.iter().enumerate() {
        assert!((found.input[(0, m)] - w).abs() < 2e-3 * 30.0, "{m}: {} {w}", found.input[(0, m)]);
    }
}

#[test]
fn no_actuators_no_points_no_samples() {
    let surface = film_with_actuators(&[]);
    let none = modal(&surface, &ResponseOptions { accuracy: 1e-2.into(), ..Default::default() });
    assert_eq!(sample(&none, &[Point::from_mm(1.0, 1.0)], 10).points.len(), 1);
    let one = modal(
        &film_with_actuators(&[(12.0, 31.0)]),
        &ResponseOptions { accuracy: 1e-2.into(), ..Default::default() },
    );
    assert_eq!(sample(&one, &[], 10).points.len(), 0);
    assert_eq!(sample(&one, &[Point::from_mm(1.0, 1.0)], 0).response(0, 0).len(), 0);
}
