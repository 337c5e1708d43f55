//! Modes of outlines other than rectangles against exact and published values.

use crate::modes_common;
use crate::round_common;

use modes_common::film;
use round_common::frequencies;
use std::f64::consts::TAU;
use unripple_core::*;
use unripple_plates::{Modes, PhysicsError};

const ROUND: f64 = 0.07;

/// Two half circles without straight sides between them: a mesh is needed.
fn round(edge: Edge) -> Surface {
    let shape = Shape::Stadium { straight: 0.0, radius: ROUND };
    let outline = Outline::new(shape).with_edges(Edges::All(edge));
    Surface { outline, ..film(Edges::All(Edge::Clamped)) }
}

/// Glass of 1 mm.
fn plate(mut surface: Surface) -> Surface {
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.thickness, sheet.tension) = (69e9, 2300.0, 1e-3, 0.0);
    surface
}

fn polygon(vertices: &[(f64, f64)], edge: Edge) -> Surface {
    let vertices = vertices.iter().map(|(x, y)| Point::new(*x, *y)).collect();
    let outline = Outline::new(Shape::Polygon(vertices)).with_edges(Edges::All(edge));
    Surface { outline, ..film(Edges::All(Edge::Clamped)) }
}

fn hz(surface: &Surface, max_hz: f64, accuracy: f64) -> Vec<f64> {
    Modes::solve(surface, max_hz, accuracy).unwrap().frequencies_hz()
}

/// Largest relative difference; all of one must be in the other, but for what lies within it of the top.
fn worst(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn the_clamped_circle_of_film_has_205_modes_to_3_khz() {
    let surface = round(Edge::Clamped);
    let exact = frequencies(&surface.sheet, ROUND, Edge::Clamped, 3000.0);
    let found = hz(&surface, 3000.0, 1e-4);
    assert_eq!((exact.len(), found.len()), (205, 205));
    assert!(worst(&found, &exact) < 1e-4, "{:e}", worst(&found, &exact));
}

#[test]
fn round_plates_and_films_are_right_however_held() {
    for edge in [Edge::Clamped, Edge::Supported] {
        for surface in [round(edge), plate(round(edge))] {
            let top = if surface.sheet.tension > 0.0 { 2000.0 } else { 12e3 };
            let exact = frequencies(&surface.sheet, ROUND, edge, top);
            let found = hz(&surface, top, 1e-5);
            assert_eq!(found.len(), exact.len(), "{edge:?}");
            assert!(worst(&found, &exact) < 1e-5, "{edge:?} {:e}", worst(&found, &exact));
        }
    }
}

#[test]
fn a_free_round_plate_floats_on_three_rigid_modes() {
    let surface = plate(round(Edge::Free));
    let exact = frequencies(&surface.sheet, ROUND, Edge::Free, 12e3);
    let found = hz(&surface, 12e3, 1e-5);
    assert_eq!(found.len(), exact.len() + 3);
    assert!(found[..3].iter().all(|hz| *hz == 0.0), "{:?}", &found[..3]);
    assert!(worst(&found[3..], &exact) < 1e-5, "{:e}", worst(&found[3..], &exact));
}

#[test]
fn a_free_round_film_under_tension_keeps_one() {
    let surface = round(Edge::Free);
    let exact = frequencies(&surface.sheet, ROUND, Edge::Free, 1500.0);
    let found = hz(&surface, 1500.0, 1e-5);
    assert_eq!((found.len(), found[0]), (exact.len() + 1, 0.0));
    assert!(worst(&found[1..], &exact) < 1e-5, "{:e}", worst(&found[1..], &exact));
}

#[test]
fn textbook_circles_are_what_the_determinants_say() {
    // ω a² √(ρ_s/D) (Leissa, Vibration of Plates, 1969): clamped, then supported with ν = 0.3.
    let surface = plate(round(Edge::Clamped));
    let medium = unripple_plates::Medium::of(&surface.sheet);
    let scale = ROUND * ROUND * (medium.areal_density / medium.bending_stiffness).sqrt() * TAU;
    let clamped = frequencies(&surface.sheet, ROUND, Edge::Clamped, 12e3);
    for (hz, textbook) in
        [(clamped[0], 10.2158), (clamped[1], 21.26), (clamped[3], 34.88), (clamped[5], 39.771)]
    {
        assert!((hz * scale / textbook - 1.0).abs() < 2e-4, "{textbook}");
    }
    let mut surface = plate(round(Edge::Supported));
    surface.sheet.poisson = 0.3;
    let scale = ROUND * ROUND * TAU * {
        let medium = unripple_plates::Medium::of(&surface.sheet);
        (medium.areal_density / medium.bending_stiffness).sqrt()
    };
    let supported = frequencies(&surface.sheet, ROUND, Edge::Supported, 12e3);
    assert!((supported[0] * scale / 4.9351 - 1.0).abs() < 1e-4);
}

#[test]
fn the_l_shaped_membrane_is_the_published_one() {
    // Betcke and Trefethen, SIAM Review 47, 469 (2005): three unit squares, first eigenvalue of -Δ.
    let unit = 0.1;
    let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
    let mut surface = polygon(&corners.map(|(x, y)| (x * unit, y * unit)), Edge::Clamped);
    surface.sheet.young = 0.0;
    let celerity = (surface.sheet.tension / (surface.sheet.density * surface.sheet.thickness)).sqrt();
    let exact = 9.639_723_844_021_9_f64.sqrt() * celerity / unit / TAU;
    let found = hz(&surface, 1.5 * exact, 1e-6);
    assert!(((found[0] / exact).powi(2) - 1.0).abs() < 1e-5, "{:e}", (found[0] / exact).powi(2) - 1.0);
    // The third is that of one square: 2π².
    let square = 2f64.sqrt() * celerity / (2.0 * unit);
    let nearest =
        hz(&surface, 1.1 * square, 1e-6).iter().map(|f| (f / square - 1.0).abs()).fold(1.0, f64::min);
    assert!(nearest < 1e-6, "{nearest:e}");
}

#[test]
fn a_rectangle_is_the_same_by_both_methods() {
    for edge in [Edge::Clamped, Edge::Supported, Edge::Free] {
        let mut flat = polygon(&[(0.0, 0.0), (0.15, 0.0), (0.15, 0.11), (0.0, 0.11)], edge);
        let general = hz(&flat, 1200.0, 1e-5);
        flat.outline.shape = Shape::Rectangle { width: 0.15, height: 0.11 };
        let special = hz(&flat, 1200.0, 1e-8);
        assert_eq!(general.len(), special.len());
        let from = usize::from(edge == Edge::Free);
        assert!(worst(&general[from..], &special[from..]) < 1e-5, "{edge:?} {:e}", worst(&general, &special));
    }
}

#[test]
fn a_supported_polygon_has_the_shapes_and_shares_of_a_plate() {
    let mut polygon = polygon(&[(0.0, 0.0), (0.15, 0.0), (0.15, 0.11), (0.0, 0.11)], Edge::Supported);
    polygon.sheet.air = Air::OneSide;
    polygon.sheet.decay = Decay::LossFactor(0.01);
    let mut plain = polygon.clone();
    plain.outline.shape = Shape::Rectangle { width: 0.15, height: 0.11 };
    let [found, exact] = [&polygon, &plain].map(|surface| Modes::solve(surface, 1500.0, 1e-6).unwrap());
    assert!(worst(&found.frequencies_hz(), &exact.frequencies_hz()) < 1e-6);
    let [shapes, sines] = [&found, &exact].map(|modes| {
        let mut row = vec![0.0; modes.poles().len()];
        modes.at(Point::new(0.047, 0.031), &mut row);
        row
    });
    assert!(shapes.len() > 30 && shapes.len() == sines.len());
    let size = sines.iter().fold(0.0, |most: f64, shape| most.max(shape.abs()));
    for m in 0..shapes.len() {
        assert!((found.bending_shares()[m] / exact.bending_shares()[m] - 1.0).abs() < 1e-5);
        assert!((found.decay_times()[m] / exact.decay_times()[m] - 1.0).abs() < 1e-5);
        assert!((shapes[m].abs() - sines[m].abs()).abs() < 1e-3 * size, "{m}: {} {}", shapes[m], sines[m]);
    }
}

#[test]
fn a_stadium_and_a_polygon_are_themselves_refined() {
    let mut stadium = round(Edge::Clamped);
    stadium.outline = Outline::new(Shape::Stadium { straight: 0.06, radius: 0.04 });
    let hexagon = polygon(
        &[(0.0, 0.04), (0.05, 0.0), (0.14, 0.01), (0.16, 0.09), (0.09, 0.13), (0.02, 0.11)],
        Edge::Supported,
    );
    for surface in [stadium, hexagon] {
        let (loose, tight) = (hz(&surface, 1500.0, 1e-3), hz(&surface, 1500.0, 1e-6));
        assert_eq!(loose.len(), tight.len());
        assert!(worst(&loose, &tight) < 1e-3, "{:e}", worst(&loose, &tight));
    }
}

#[test]
fn what_nothing_brings_back_is_refused() {
    let mut surface = round(Edge::Free);
    surface.sheet.young = 0.0;
    let error = Modes::solve(&surface, 500.0, 1e-3).unwrap_err();
    assert!(
        matches!(error, PhysicsError::Unsupported { .. }) && error.to_string().contains("free all round")
    );
}

#[test]
fn a_mesh_too_large_is_refused_beforehand_with_its_size() {
    let error = Modes::solve(&round(Edge::Clamped), 400e3, 1e-3).unwrap_err();
    let PhysicsError::TooLarge { needed_gib, limit_gib, nearest_hz, .. } = error else { panic!("{error}") };
    assert!(needed_gib > limit_gib && (3e3..400e3).contains(&nearest_hz), "{needed_gib} {nearest_hz}");
    assert!(matches!(Modes::solve(&round(Edge::Clamped), 1e100, 1e-3), Err(PhysicsError::Range(_))));
}
