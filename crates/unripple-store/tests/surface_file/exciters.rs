//! Exciters in surface files: units, the two ways to give a spring, the way back to a file, and faults.

use crate::good::{GOOD, faults};
use std::f64::consts::TAU;
use unripple_core::{ActuatorKind, CoilDrive};
use unripple_store::{parse_surface, to_toml};

/// The keys of an exciter but for what holds its housing.
const COIL: &str = "contact_radius_mm = 12\nforce_constant_n_per_a = 2.5\nresistance_ohm = 4\ninductance_mh = 0.05\n\
    moving_mass_mg = 1200\nhousing_g = 40\nquality_factor = 3\ndriven_by = \"voltage\"\n";

/// The good file with an exciter in place of its force.
fn with(keys: &str) -> String {
    GOOD.replace("kind = \"force\"\n", &format!("kind = \"exciter\"\n{keys}"))
}

/// The one fault of the good file with an exciter.
fn says(keys: &str) -> String {
    let list = faults(&with(keys));
    assert_eq!(list.len(), 1, "{keys}: {list:#?}");
    format!("{}:{}: {}", list[0].line, list[0].column, list[0])
}

#[test]
fn every_key_in_its_unit() {
    let surface = parse_surface(&with(&format!("{COIL}resonance_hz = 150\n")), "film.toml").unwrap();
    let exciter = &surface.actuators[0];
    assert_eq!((exciter.contact_radius, exciter.kind.name()), (0.012, "exciter"));
    assert_eq!(
        exciter.kind,
        ActuatorKind::Exciter {
            force_constant: 2.5,
            resistance: 4.0,
            inductance: 0.05e-3,
            moving_mass: 1200e-6,
            housing_mass: 0.04,
            resonance: 150.0,
            quality_factor: 3.0,
            driven_by: CoilDrive::Voltage,
        }
    );
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
}

#[test]
fn what_may_be_left_out() {
    let keys = "force_constant_n_per_a = 2\nresistance_ohm = 8\nhousing_g = 5\nresonance_hz = 90\nquality_factor = 2\n";
    let surface = parse_surface(&with(keys), "film.toml").unwrap();
    let ActuatorKind::Exciter { inductance, moving_mass, driven_by, .. } = surface.actuators[0].kind else {
        panic!("{:?}", surface.actuators[0])
    };
    assert_eq!((inductance, moving_mass, driven_by), (0.0, 0.0, CoilDrive::Current));
    let list = faults(&with(""));
    let keys: Vec<&str> = list.iter().map(|f| f.key.rsplit('.').next().unwrap()).collect();
    let needed = ["force_constant_n_per_a", "resistance_ohm", "housing_g", "resonance_hz", "quality_factor"];
    assert_eq!(keys, needed);
}

/// A spring of k N/m under a housing of M kg: 2π f = √(k/M).
#[test]
fn a_spring_stands_for_a_resonance() {
    let surface = parse_surface(&with(&format!("{COIL}spring_n_per_mm = 36\n")), "film.toml").unwrap();
    let ActuatorKind::Exciter { resonance, .. } = surface.actuators[0].kind else { panic!() };
    assert!(((TAU * resonance).powi(2) * 0.04 / 36e3 - 1.0).abs() < 1e-14, "{resonance}");
    assert_eq!(parse_surface(&to_toml(&surface), "copy.toml").unwrap(), surface);
    // What a table gives stands above what the defaults give, whichever of the two it is.
    for (common, own) in
        [("resonance_hz = 90", "spring_n_per_mm = 36"), ("spring_n_per_mm = 36", "resonance_hz = 90")]
    {
        let text = with(&format!("{COIL}{own}\n"))
            .replace("[[actuator]]", &format!("[actuator_defaults]\n{common}\n[[actuator]]"));
        let ActuatorKind::Exciter { resonance, .. } =
            parse_surface(&text, "film.toml").unwrap().actuators[0].kind
        else {
            panic!()
        };
        assert_eq!(resonance == 90.0, own == "resonance_hz = 90", "{own}");
    }
}

#[test]
fn faults_of_exciters() {
    assert!(says(COIL).ends_with(
        " actuator[0].resonance_hz: expected a number from 1 to 100000 Hz, or spring_n_per_mm instead, found no such key"
    ));
    assert_eq!(
        says(&format!("{COIL}resonance_hz = 150\nspring_n_per_mm = 36\n")),
        "28:19: actuator[0].spring_n_per_mm: expected one of them, found resonance_hz and spring_n_per_mm"
    );
    assert_eq!(
        says(&format!("{COIL}spring_n_per_mm = 0.001\n")),
        "27:19: actuator[0].spring_n_per_mm: expected a spring on which the housing resonates at a number from 1 to 100000 Hz, \
         found one on which it does at 0.796 Hz"
    );
    let whole = format!("{COIL}resonance_hz = 150\n");
    for (from, to, said) in [
        (
            "housing_g = 40",
            "housing_g = 0",
            "24:13: actuator[0].housing_g: expected a number from 0.01 to 100000 g, found 0 (nearest: 0.01)",
        ),
        (
            "resonance_hz = 150",
            "resonance_hz = 0.5",
            "27:16: actuator[0].resonance_hz: expected a number from 1 to 100000 Hz, found 0.5 (nearest: 1)",
        ),
        (
            "quality_factor = 3",
            "quality_factor = 0",
            "25:18: actuator[0].quality_factor: expected a number from 0.1 to 1000, found 0 (nearest: 0.1)",
        ),
    ] {
        assert_eq!(says(&whole.replace(from, to)), said);
    }
    let other = GOOD.replace("kind = \"force\"\n", "kind = \"force\"\nhousing_g = 40\n");
    assert_eq!(faults(&other)[0].expected, "this key only where kind = \"exciter\"");
    assert!(says(&format!("{whole}radius_mm = 5\n")).contains("this key only where kind = \"piezo\""));
}
