//! Notes of a design: which contrast to trust, what closed forms leave out, where the model reaches its limits.

use std::f64::consts::TAU;
use unripple_core::{ActuatorKind, CoilDrive, Patch, Point, Scatterer, ScattererKind, Surface};
use unripple_physics::design::{Windows, design_by_law, kirchhoff_over_mindlin, limits, papers_surface};
use unripple_physics::{Design, Medium, design};

fn paper() -> Design {
    design(&papers_surface()).unwrap()
}

/// A reader sees three contrasts for one window, and is told which to trust and why they differ.
#[test]
fn of_several_contrasts_one_is_to_be_trusted() {
    let told = |design: &Design| {
        let note = design.notes.iter().find(|note| note.topic == "which contrast").expect("a note");
        assert!(design.to_string().contains(&note.text));
        note.text.clone()
    };
    let d = paper();
    let said = told(&d);
    let modal = Windows::of(&papers_surface()).recommended().contrast;
    assert_eq!(d.contrast_predicted, modal);
    assert!(
        said.starts_with(&format!("{modal:.1} is the more reliable: the mean over many targets")),
        "{said}"
    );
    assert!(said.contains(&format!("{:.1} is the result of the plain form", d.contrast_plain)), "{said}");
    let d = design_by_law(&papers_surface(), "asked for").unwrap();
    let said = told(&d);
    assert!(said.starts_with(&format!("{:.1}, by statistics of the band", d.contrast_predicted)), "{said}");
    assert!(said.contains(&format!("{:.1}, the result of the plain form", d.contrast_plain)), "{said}");
}

/// The note on what is left out, if there is one.
fn left_out(design: &Design) -> Option<&str> {
    design.notes.iter().find(|note| note.topic == "left out").map(|note| note.text.as_str())
}

/// The paper's film up to 1 kHz with magnets in coils, one of them lighter.
fn with_coils(driven_by: CoilDrive) -> Surface {
    let mut surface = papers_surface();
    surface.emission.band = [0.0, 1000.0];
    for (actuator, moving_mass) in surface.actuators.iter_mut().zip([20e-6].into_iter().chain([60e-6; 7])) {
        let (force_constant, resistance, inductance) = (1.0, 8.0, 0.1e-3);
        actuator.contact_radius = 0.75e-3;
        actuator.kind =
            ActuatorKind::MovingMagnet { force_constant, resistance, inductance, moving_mass, driven_by };
    }
    surface
}

#[test]
fn what_the_closed_forms_leave_out_is_named() {
    assert_eq!(left_out(&paper()), None);
    let loaded = design(&with_coils(CoilDrive::Voltage)).unwrap();
    let text = left_out(&loaded).unwrap();
    for part in ["20 to 60 mg (8 actuators)", "0.125 N·s/m", "0.1 mH of coils", "computed with all of that"]
    {
        assert!(text.contains(part), "{part} is missing from {text}");
    }
    // The figures themselves are those without coils.
    let mut bare = papers_surface();
    bare.emission.band = [0.0, 1000.0];
    assert_eq!(loaded.mode_count_exact, design(&bare).unwrap().mode_count_exact);
    // A held current leaves the mass alone.
    let held = design_by_law(&with_coils(CoilDrive::Current), "asked for").unwrap();
    let text = left_out(&held).unwrap();
    assert!(text.contains("mg") && !text.contains("mH") && text.contains("leaves it out as well"), "{text}");

    let mut patched = papers_surface();
    patched.actuators[0].kind =
        ActuatorKind::Piezo { patch: Patch::Round { radius: 5e-3 }, moment: 1e-3, mass: 0.0 };
    patched.actuators[1].contact_radius = 2e-3;
    let (at, kind) = (Point::from_mm(70.0, 60.0), ScattererKind::Mass(1e-4));
    patched.sheet.uneven.scatterers.push(Scatterer { at, kind });
    let patched = design_by_law(&patched, "asked for").unwrap();
    let text = left_out(&patched).unwrap();
    for part in ["act by moments (1 actuator)", "2 mm radius (1 actuator)", "fixed to it"] {
        assert!(text.contains(part), "{part} is missing from {text}");
    }
}

/// Ratio of Kirchhoff's frequency to Mindlin's by another route: the determinant of deflection and rotation as functions of ω, its lowest
/// zero found by bisection, in units in which the thickness, density and modulus are 1.
fn by_bisection(share: f64, poisson: f64) -> f64 {
    let k = TAU * share;
    let (bending, shear) = (1.0 / (12.0 * (1.0 - poisson * poisson)), 5.0 / 6.0 / (2.0 * (1.0 + poisson)));
    let determinant = |omega: f64| {
        let square = omega * omega;
        (shear * k * k - square) * (bending * k * k + shear - square / 12.0) - (shear * k).powi(2)
    };
    let (mut low, mut high) = (0.0, bending.sqrt() * k * k);
    assert!(determinant(low) > 0.0 && determinant(high) < 0.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if determinant(middle) > 0.0 { low = middle } else { high = middle }
    }
    bending.sqrt() * k * k / low
}

#[test]
fn thick_sheets_and_wide_contacts_are_named() {
    let mut surface = papers_surface();
    let sheet = &mut surface.sheet;
    (sheet.young, sheet.density, sheet.thickness, sheet.tension) = (70e9, 2500.0, 4e-3, 0.0);
    for (share, poisson) in [(0.02, 0.22), (0.05, 0.3), (0.1, 0.22), (0.29, 0.3)] {
        surface.sheet.poisson = poisson;
        let k = TAU * share / surface.sheet.thickness;
        let found = kirchhoff_over_mindlin(&surface.sheet, k);
        assert!((found / by_bisection(share, poisson) - 1.0).abs() < 1e-9, "{found}");
        // The band's top has that wavelength.
        surface.emission.band = [100.0, Medium::of(&surface.sheet).omega(k) / TAU];
        surface.emission.rate = 4.0 * surface.emission.band[1];
        // That such waves radiate is another note.
        let notes: Vec<_> = limits(&surface).into_iter().filter(|note| note.topic != "radiation").collect();
        assert_eq!(notes.len(), usize::from(share > 0.0501), "{notes:?}");
        assert!(notes.iter().all(|note| note.text.contains("Mindlin") && note.text.contains(" % above")));
    }
    // 46 %, as an independent computation has it.
    assert!((kirchhoff_over_mindlin(&surface.sheet, TAU * 0.29 / 4e-3) - 1.46).abs() < 0.015);

    let mut wide = papers_surface();
    wide.actuators[2].contact_radius = 5e-3;
    let notes = limits(&wide);
    assert!(notes.len() == 1 && notes[0].text.starts_with("a3 is up to 10 mm wide"), "{notes:?}");
    wide.actuators[4].kind =
        ActuatorKind::Piezo { patch: Patch::Round { radius: 6e-3 }, moment: 1e-3, mass: 0.0 };
    assert!(limits(&wide)[0].text.starts_with("a3 and 1 more are up to 12 mm wide"));
    assert!(design(&wide).unwrap().notes.iter().any(|note| note.topic == "wide contacts"));
}
