//! What grain, profiles, scatterers and patches of a file mean, and the way back.

use crate::good::GOOD;
use std::f64::consts::{FRAC_PI_6, PI};
use unripple_core::{
    ActuatorKind, Grain, Patch, Point, Profile, Resonator, Scatterer, ScattererKind, Surface,
};
use unripple_store::{parse_surface, to_toml};

/// The good film with other lines; it comes back from its own file.
fn surface(from: &str, to: &str, more: &str) -> Surface {
    let text = GOOD.replace(from, to) + more;
    let surface = parse_surface(&text, "film.toml").unwrap_or_else(|faults| panic!("{faults:#}"));
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
    surface
}

fn sheet(lines: &str) -> unripple_core::Uneven {
    surface("air = \"none\"", lines, "").sheet.uneven
}

fn grain(lines: &str) -> Grain {
    sheet(lines).grain.unwrap()
}

#[test]
fn grain_and_its_defaults() {
    assert_eq!(sheet("").grain, None);
    let whole = grain("young_across_gpa = 5.1\nshear_gpa = 1.7\ngrain_deg = -30");
    assert_eq!(whole, Grain { direction: -FRAC_PI_6, young_across: 5.1e9, shear: 1.7e9 });
    // Of a sheet as stiff across as along, the default is the isotropic E / 2 (1 + ν).
    let same = grain("young_across_gpa = 4");
    assert_eq!((same.direction, same.young_across), (0.0, 4e9));
    assert!((same.shear / (4e9 / 2.6) - 1.0).abs() < 1e-15);
    let other = grain("young_across_gpa = 6\npoisson_ratio = 0.25").shear;
    assert!((other / (24e9 / (4.0 + 6.0 + 2.0 * 0.25 * 6.0)) - 1.0).abs() < 1e-15);
}

#[test]
fn profiles() {
    let uneven = sheet(
        "thickness_profile = [[1.0, 1.02, 1.0], [0.98, 1, 0.97]]\ntension_profile = [[1], [1.1]]\n\
         added_mass_kg_m2 = 0.02",
    );
    let rows = |profile: &Option<Profile>| -> Vec<Vec<f64>> {
        profile.as_ref().unwrap().rows().map(<[f64]>::to_vec).collect()
    };
    assert_eq!(rows(&uneven.thickness), [[1.0, 1.02, 1.0], [0.98, 1.0, 0.97]]);
    assert_eq!(rows(&uneven.tension), [[1.0], [1.1]]);
    assert_eq!(rows(&uneven.added_mass), [[0.02]]);
    assert_eq!(rows(&sheet("added_mass_kg_m2 = [[0, 1], [2, 3]]").added_mass), [[0.0, 1.0], [2.0, 3.0]]);
    // The lowest row comes first.
    let low = uneven.thickness.unwrap().at(Point::from_mm(0.0, 0.0), (0.15, 0.1));
    assert_eq!(low, 1.0);
    let many = format!("thickness_profile = [{}]", format!("[{}],", "1,".repeat(256)).repeat(256));
    assert_eq!(rows(&sheet(&many).thickness).len(), 256);
}

#[test]
fn scatterers() {
    let more = "[[scatterer]]\nat_mm = [50, 40]\nkind = \"mass\"\nmass_mg = 12.5\n\
                [[scatterer]]\nat_mm = [0, 10]\nkind = \"disc\"\nradius_mm = 4\nthickness_mm = 0.5\nmaterial = \"steel\"\n\
                [[scatterer]]\nat_mm = [70, 10]\nkind = \"disc\"\nradius_mm = 4\nthickness_mm = 0.5\n\
                young_gpa = 3\ndensity_kg_m3 = 1200\npoisson_ratio = 0.4\n";
    let list = surface("", "", more).sheet.uneven.scatterers;
    assert_eq!(list[0], Scatterer { at: Point::from_mm(50.0, 40.0), kind: ScattererKind::Mass(12.5e-6) });
    let disc = |young, density, poisson| ScattererKind::Disc {
        radius: 0.004,
        thickness: 0.5e-3,
        young,
        density,
        poisson,
    };
    assert_eq!(list[1].kind, disc(200e9, 7900.0, 0.29));
    assert_eq!(list[2].kind, disc(3e9, 1200.0, 0.4));
}

#[test]
fn resonators_and_lattices() {
    let more = "[[scatterer]]\nat_mm = [50, 40]\nkind = \"resonator\"\nmass_g = 2.5\nfrequency_hz = 180\nquality_factor = 40\n\
                [[lattice]]\nfrom_mm = [10, 10]\nto_mm = [51, 35]\npitch_mm = 10\nmass_ratio = 0.5\nfrequency_hz = 250\n\
                quality_factor = 30\nscatter_percent = 1.5\nseed = 7\n\
                [[lattice]]\nfrom_mm = [60, 10]\nto_mm = [80, 40]\ncolumns = 4\nrows = 3\nmass_g = 0.1\nfrequency_hz = 90\n\
                quality_factor = 10\n";
    let film = surface("", "", more);
    let uneven = &film.sheet.uneven;
    let alone =
        Resonator { at: Point::from_mm(50.0, 40.0), mass: 2.5e-3, frequency: 180.0, quality_factor: 40.0 };
    assert_eq!(uneven.resonators, [alone]);
    assert!(uneven.scatterers.is_empty() && uneven.is_uniform() && uneven.resonates());
    let [pitched, counted] = uneven.lattices[..] else { panic!() };
    // 41 x 25 mm hold 4 x 2 cells of 10 mm, in the middle.
    assert_eq!(pitched.cells, [4, 2]);
    assert!(pitched.pitch().iter().all(|pitch| (pitch - 0.01).abs() < 1e-15));
    assert!(pitched.corners[0].distance(Point::from_mm(10.5, 12.5)) < 1e-15);
    let cell = film.sheet.density * film.sheet.thickness * 1e-4;
    assert!((pitched.mass / (0.5 * cell) - 1.0).abs() < 1e-12);
    assert_eq!((pitched.scatter, pitched.seed), (0.015, 7));
    assert_eq!((counted.cells, counted.mass, counted.scatter, counted.seed), ([4, 3], 1e-4, 0.0, 1));
    assert_eq!(film.resonators().len(), 1 + 8 + 12);
}

#[test]
fn a_point_mass_needs_a_sheet_that_resists_bending() {
    let mass = "[[scatterer]]\nat_mm = [50, 40]\nkind = \"mass\"\nmass_mg = 12.5\n";
    let stuff = "young_gpa = 0\ndensity_kg_m3 = 1400\npoisson_ratio = 0.3";
    let film = format!("{}{mass}", GOOD.replace("material = \"BoPET\"", stuff));
    let faults = parse_surface(&film, "film.toml").unwrap_err();
    assert_eq!(faults.faults().len(), 1, "{faults:#}");
    let fault = &faults.faults()[0];
    assert!(fault.key.ends_with(".kind") && fault.expected.contains("gives way at a point"), "{faults:#}");
    let stiff = film.replace("young_gpa = 0\n", "young_gpa = 4\n");
    parse_surface(&stiff, "film.toml").unwrap_or_else(|faults| panic!("{faults:#}"));
}

#[test]
fn patches_and_discs() {
    let force = surface("kind = \"force\"", "contact_radius_mm = 2.5", "");
    assert_eq!((force.actuators[0].kind, force.actuators[0].contact_radius), (ActuatorKind::Force, 0.0025));
    let patch = |lines: &str, sheet: &str| {
        let text = GOOD.replace("air = \"none\"", sheet);
        let text = text.replace("kind = \"force\"", &format!("kind = \"piezo\"\nradius_mm = 5\n{lines}"));
        let surface = parse_surface(&text, "film.toml").unwrap_or_else(|faults| panic!("{faults:#}"));
        assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
        let ActuatorKind::Piezo { patch: Patch::Round { radius }, moment, mass } = surface.actuators[0].kind
        else {
            panic!()
        };
        assert_eq!((radius, surface.actuators[0].contact_radius), (0.005, 0.0));
        (moment, mass)
    };
    assert_eq!(patch("moment_n_per_v = -0.01\npatch_mass_mg = 3", ""), (-0.01, 3e-6));
    assert_eq!(patch("moment_n_per_v = 0.01", ""), (0.01, 0.0));
    let made = "d31_pm_per_v = -190\npatch_young_gpa = 62\npatch_thickness_mm = 0.2\n";
    let (moment, mass) = patch(&format!("{made}patch_density_kg_m3 = 7800"), "");
    let exact = 190e-12 * 62e9 * (0.125e-3 + 0.2e-3) / 2.0 / 0.7;
    assert!((moment / exact - 1.0).abs() < 1e-14, "{moment} {exact}");
    assert!((mass / (PI * 25e-6 * 0.2e-3 * 7800.0) - 1.0).abs() < 1e-14);
    let (thicker, none) = patch(made, "thickness_profile = [[2.0]]");
    assert!((thicker / (190e-12 * 62e9 * 0.45e-3 / 2.0 / 0.7) - 1.0).abs() < 1e-14 && none == 0.0);
}

#[test]
fn patches_are_rectangles_too() {
    let read = |lines: &str| {
        let lines = format!("kind = \"piezo\"\nmoment_n_per_v = 0.01\n{lines}");
        parse_surface(&GOOD.replace("kind = \"force\"", &lines), "film.toml")
    };
    let good = |lines: &str| {
        let surface = read(lines).unwrap_or_else(|faults| panic!("{faults:#}"));
        assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
        surface.actuators[0].kind
    };
    let of = |sides, angle, mass| ActuatorKind::Piezo {
        patch: Patch::Rectangular { sides, angle },
        moment: 0.01,
        mass,
    };
    assert_eq!(good("rectangle_mm = [6, 4]"), of([0.006, 0.004], 0.0, 0.0));
    assert_eq!(good("rectangle_mm = [6, 4]\nangle_deg = 30"), of([0.006, 0.004], FRAC_PI_6, 0.0));
    let ActuatorKind::Piezo { mass, .. } =
        good("rectangle_mm = [6, 4]\npatch_thickness_mm = 0.2\npatch_density_kg_m3 = 7800")
    else {
        panic!()
    };
    assert!((mass / (24e-6 * 0.2e-3 * 7800.0) - 1.0).abs() < 1e-14);
    // An actuator's own form goes before that of the defaults.
    let with = |defaults: &str, lines: &str| {
        let text = GOOD.replace("kind = \"force\"", &format!("kind = \"piezo\"\n{lines}"));
        let defaults = format!("[actuator_defaults]\nmoment_n_per_v = 0.01\n{defaults}\n[[actuator]]");
        parse_surface(&text.replacen("[[actuator]]", &defaults, 1), "film.toml")
            .unwrap_or_else(|faults| panic!("{faults:#}"))
            .actuators[0]
            .kind
    };
    assert_eq!(with("radius_mm = 3", "rectangle_mm = [6, 4]"), of([0.006, 0.004], 0.0, 0.0));
    let round = ActuatorKind::Piezo { patch: Patch::Round { radius: 0.003 }, moment: 0.01, mass: 0.0 };
    assert_eq!(with("rectangle_mm = [6, 4]\nangle_deg = 30", "radius_mm = 3"), round);
    assert_eq!(with("rectangle_mm = [6, 4]\nangle_deg = 30", ""), of([0.006, 0.004], FRAC_PI_6, 0.0));
    for (lines, wanted) in [
        ("rectangle_mm = [6, 4]\nradius_mm = 3", "expected one of them"),
        ("radius_mm = 3\nangle_deg = 5", "angle_deg without rectangle_mm"),
        ("rectangle_mm = [600, 4]", "which reaches beyond the rim"),
        ("rectangle_mm = [6]", "[width, height] in mm"),
        ("angle_deg = 5\nrectangle_mm = 6", "[width, height] in mm"),
        ("patch_mass_mg = 1", "or rectangle_mm"),
    ] {
        let faults = format!("{:#}", read(lines).unwrap_err());
        assert!(faults.contains(wanted), "{lines}: {faults}");
    }
}
