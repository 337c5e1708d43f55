//! Sheets that vary: profiles, grains, laminates, discs across triangles.

use super::meshes;
use super::patch::{energy, interpolated};
use super::solve::{omegas, surface};
use crate::PhysicsError;
use crate::elements::Space;
use crate::fabric::Fabric;
use std::f64::consts::PI;
use unripple_core::*;

/// The disc, of the sheet's own material unless changed.
fn disc(sheet: &Sheet, at: Point, radius: f64, thickness: f64) -> Scatterer {
    let (young, density, poisson) = (sheet.young, sheet.density, sheet.poisson);
    Scatterer { at, kind: ScattererKind::Disc { radius, thickness, young, density, poisson } }
}

fn near(found: f64, exact: f64, most: f64) {
    assert!((found / exact - 1.0).abs() < most, "{found} {exact}");
}

#[test]
fn two_like_layers_are_one_thick_one() {
    let mut sheet = surface(1.0, 1.0, 0.0, 0.3);
    let at = Point::new(0.5, 0.5);
    sheet.sheet.uneven.scatterers = vec![disc(&sheet.sheet, at, 0.2, sheet.sheet.thickness)];
    let fabric = Fabric::of(&sheet).unwrap();
    let (bare, thick) = (fabric.at(Point::new(0.9, 0.9)), fabric.at(Point::new(0.5, 0.4)));
    near(thick.mass, 2.0 * bare.mass, 1e-12);
    for (t, b) in thick.bending.iter().zip(bare.bending).filter(|(_, b)| *b != 0.0) {
        near(*t, 8.0 * b, 1e-12);
    }
}

#[test]
fn unlike_layers_bend_about_their_common_neutral_axis() {
    // Of two layers of one Poisson's ratio: each about its own middle, and the couple of the two (Timoshenko's bimetal).
    let mut sheet = surface(1.0, 1.0, 0.0, 0.3);
    let at = Point::new(0.5, 0.5);
    let (young, thickness) = (3.0 * sheet.sheet.young, 0.4e-3);
    let kind = ScattererKind::Disc { radius: 0.1, thickness, young, density: 0.0, poisson: 0.3 };
    sheet.sheet.uneven.scatterers = vec![Scatterer { at, kind }];
    let found = Fabric::of(&sheet).unwrap().at(at).bending;
    let (h, e) = (sheet.sheet.thickness, sheet.sheet.young);
    let (a, b) = (e * h, young * thickness);
    let couple = a * b / (a + b) * (0.5 * (h + thickness)).powi(2);
    let exact = (e * h.powi(3) / 12.0 + young * thickness.powi(3) / 12.0 + couple) / 0.91;
    near(found[0], exact, 1e-12);
    near(found[1], 0.3 * exact, 1e-12);
    near(found[5], 0.35 * exact, 1e-12);
}

#[test]
fn bending_of_profiles_and_discs_is_exact() {
    // u = x² and ν = 0: 4∫D over the circle, D = (1 + x/4)³, and 7 more where a disc doubles the thickness.
    let mut sheet = surface(2.0, 1.0, 0.0, 0.0);
    let mesh = meshes::circle(1.0, 3, Edge::Free);
    let space = Space::new(&mesh, true);
    let u = interpolated(&mesh, |p| [p.x * p.x, 2.0 * p.x, 0.0, 2.0, 0.0, 0.0]);
    sheet.sheet.uneven.thickness = Profile::new(&[vec![1.0, 1.25, 1.5]]);
    let bent = energy(&space.assemble(&Fabric::of(&sheet).unwrap()).bending, &u);
    near(bent, 4.0 * PI * (1.25f64.powi(3) + 3.0 * 1.25 * 0.0625 / 4.0), 1e-11);
    sheet.sheet.uneven.thickness = None;
    sheet.sheet.uneven.scatterers =
        vec![disc(&sheet.sheet, Point::new(0.8, 1.1), 0.35, sheet.sheet.thickness)];
    let bent = energy(&space.assemble(&Fabric::of(&sheet).unwrap()).bending, &u);
    near(bent, 4.0 * PI * (1.0 + 7.0 * 0.35 * 0.35), 1e-11);
}

#[test]
fn a_disc_over_everything_is_another_sheet() {
    let mut sheet = surface(1.0, 1.0, 0.0, 0.3);
    let mesh = meshes::rectangle([1.0; 2], [3; 2], 0.2, [Edge::Supported; 4]);
    let space = Space::new(&mesh, true);
    let bare = omegas(&space, &Fabric::of(&sheet).unwrap(), 0.0, 4);
    sheet.sheet.uneven.scatterers =
        vec![disc(&sheet.sheet, Point::new(0.5, 0.5), 2.0, sheet.sheet.thickness)];
    let both = omegas(&space, &Fabric::of(&sheet).unwrap(), 0.0, 4);
    both.iter().zip(bare).for_each(|(b, a)| near(*b, 2.0 * a, 1e-9));
}

#[test]
fn the_mass_of_discs_across_triangles_is_exact() {
    let mut sheet = surface(2.0, 1.0, 0.0, 0.3);
    let places = [(1.0, 1.0, 0.3), (0.7, 1.2, 0.05), (1.35, 0.8, 0.41), (1.0, 1.0, 0.98)];
    for (x, y, radius) in places {
        sheet.sheet.uneven.scatterers = vec![disc(&sheet.sheet, Point::new(x, y), radius, 2e-3)];
        let forms =
            Space::new(&meshes::circle(1.0, 4, Edge::Free), true).assemble(&Fabric::of(&sheet).unwrap());
        near(whole(&forms.mass), PI * (1.0 + 2.0 * radius * radius), 1e-12);
    }
    // A disc over the rim: the lens of two circles of radii 1 and 0.5 with centres 1 apart.
    sheet.sheet.uneven.scatterers = vec![disc(&sheet.sheet, Point::new(2.0, 1.0), 0.5, 2e-3)];
    let forms = Space::new(&meshes::circle(1.0, 4, Edge::Free), true).assemble(&Fabric::of(&sheet).unwrap());
    let lens = 0.25 * f64::acos(0.25) + f64::acos(0.875) - 0.5 * f64::sqrt(0.9375);
    near(whole(&forms.mass), PI + 2.0 * lens, 1e-12);
}

/// The form of u = 1, its vertices' first unknowns being u, on a mesh without held rims.
fn whole(form: &unripple_linalg::sparse::SparseColMat<usize, f64>) -> f64 {
    let vertices = 61;
    let is_value = |u: usize| u < 6 * vertices && u.is_multiple_of(6);
    form.triplet_iter().filter(|t| is_value(t.row) && is_value(t.col)).map(|t| t.val).sum()
}

#[test]
fn profiles_are_integrated() {
    // A slope of the thickness: mass, and a strip's bending with D ~ h³, against one dimension.
    let mut sheet = surface(2.0, 1.0, 0.0, 0.0);
    let slope = Profile::new(&[vec![1.0, 1.25, 1.5], vec![1.0, 1.25, 1.5]]);
    sheet.sheet.uneven.thickness = slope.clone();
    let space = Space::new(&meshes::circle(1.0, 4, Edge::Free), true);
    near(whole(&space.assemble(&Fabric::of(&sheet).unwrap()).mass), 1.25 * PI, 1e-12);
    sheet.sheet.uneven.thickness = None;
    sheet.sheet.uneven.added_mass = slope;
    near(whole(&space.assemble(&Fabric::of(&sheet).unwrap()).mass), 2.25 * PI, 1e-12);
}

#[test]
fn a_fabric_of_constant_profiles_is_uniform() {
    let mut sheet = surface(1.0, 1.0, 2.0, 0.3);
    let mesh =
        meshes::rectangle([1.0; 2], [3; 2], 0.2, [Edge::Clamped, Edge::Free, Edge::Supported, Edge::Free]);
    let space = Space::new(&mesh, true);
    let plain = Fabric::of(&sheet).unwrap();
    assert!(plain.uniform().is_some() && plain.bends());
    let of = |f: f64| Profile::new(&[vec![f, f]]);
    (sheet.sheet.uneven.thickness, sheet.sheet.uneven.tension) = (of(2.0), of(8.0));
    let doubled = Fabric::of(&sheet).unwrap();
    assert!(doubled.uniform().is_none());
    let (a, b) = (omegas(&space, &plain, 0.0, 6), omegas(&space, &doubled, 0.0, 6));
    a.iter().zip(b).for_each(|(a, b)| near(b, 2.0 * a, 1e-9));
}

#[test]
fn values_that_cannot_be_are_refused() {
    let refused = |change: &dyn Fn(&mut Sheet)| {
        let mut sheet = surface(1.0, 1.0, 2.0, 0.3);
        change(&mut sheet.sheet);
        matches!(Fabric::of(&sheet), Err(PhysicsError::Range(_)))
    };
    let of = |f: f64| Profile::new(&[vec![1.0, f]]);
    let at = Point::new(0.5, 0.5);
    assert!(!refused(&|_| ()));
    assert!(refused(&|s| s.uneven.thickness = of(-0.1)));
    assert!(refused(&|s| s.uneven.tension = of(-0.1)));
    assert!(refused(&|s| s.uneven.added_mass = of(-1.5)));
    assert!(refused(&|s| s.poisson = 0.6));
    assert!(refused(&|s| s.uneven.scatterers = vec![disc(s, at, 0.0, 1e-3)]));
    assert!(refused(&|s| s.uneven.scatterers = vec![disc(s, at, f64::NAN, 1e-3)]));
    assert!(refused(&|s| s.uneven.scatterers = vec![Scatterer { at, kind: ScattererKind::Mass(-1.0) }]));
    for (young_across, shear) in [(0.0, 1e9), (1e9, 0.0), (f64::INFINITY, 1e9)] {
        assert!(refused(&|s| s.uneven.grain = Some(Grain { direction: 0.0, young_across, shear })));
    }
    // ν12 ν21 = ν12² E2/E1 = 1.08.
    assert!(refused(
        &|s| s.uneven.grain = Some(Grain { direction: 0.0, young_across: 12.0 * s.young, shear: 1e9 })
    ));
}
