//! Truth: a finger and coils on the paper's surface.

use unripple_core::{CoilDrive, Point};
use unripple_paper::study::{Coils, coils, credibility, finger};
use unripple_physics::Medium;
use unripple_physics::design::papers_surface;

const WINDOW: f64 = 0.030;

/// The paper found signal and noise attenuated by 5 when a finger touched.
#[test]
fn a_finger_attenuates_focus_and_noise() {
    let rows = finger(&papers_surface(), Point::from_mm(62.0, 90.0), &[3e-3, 5e-3, 8e-3], WINDOW).unwrap();
    for row in &rows {
        println!("{row:?}");
    }
    for row in &rows {
        assert!(row.focus_velocity > 2.0 && row.focus_displacement > 2.0 && row.noise_under_finger > 2.0);
        // Elsewhere little changes: a finger takes some of the energy.
        assert!((0.9..2.0).contains(&row.noise_elsewhere));
        assert!(row.finger_energy_j > 0.0 && row.finger_energy_j < row.drive_energy_j, "{row:?}");
    }
    // The sheet in the middle of an even contact of 5 mm: the paper's factor.
    assert!((4.0..6.0).contains(&rows[2].centre_velocity), "{:?}", rows[2]);
    // Knowing the finger does no harm to the motion under it.
    assert!(rows.chunks(2).all(|pair| pair[1].velocity_m_s > 0.9 * pair[0].velocity_m_s));
}

#[test]
fn coils_of_the_papers_values() {
    let surface = papers_surface();
    let [current, voltage] = [CoilDrive::Current, CoilDrive::Voltage].map(Coils::papers);
    let weak = |coils: Coils| Coils { force_constant: 0.6, ..coils };
    let kinds = [Coils { moving_mass: 0.0, driven_by: None, ..current }, current, voltage, weak(voltage)];
    let rows = coils(&surface, &kinds, 0.75e-3, (Point::from_mm(62.0, 90.0), WINDOW)).unwrap();
    for row in &rows {
        println!("{row:?}");
    }
    let [ideal, current, voltage, weak] = rows[..] else { panic!("{rows:?}") };
    assert!((ideal.decay_time_s / 0.07 - 1.0).abs() < 1e-6);
    // Held currents leave the sheet its losses; masses carry none of their own, so that it rings a little longer.
    assert!(current.decay_time_s >= 0.07 * (1.0 - 1e-9));
    assert!(voltage.decay_time_s < current.decay_time_s && weak.decay_time_s < current.decay_time_s);
    let numbers = credibility(&voltage.coils, [1.5e-3, 0.5e-3], &Medium::of(&surface.sheet), 1000.0);
    println!("{numbers:?}");
    assert!(numbers.coil_damping > 20.0 * numbers.sheet_resistance && numbers.reachable < 0.6);
}
