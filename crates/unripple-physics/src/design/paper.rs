//! The surface of the paper (Hudin et al. 2012) and the conditions of its table 1.

use super::Strip;
use unripple_core::{
    Actuator, ActuatorKind, Air, Decay, Emission, Finger, Outline, Point, Shape, Sheet, Surface, Uneven,
};

/// Relative difference up to which two dimensions or constants are the same: far above rounding, far below any change made on purpose.
const SAME: f64 = 1e-6;

/// Wavelength for which the paper's table 1 and window are computed, in metres. With twice this wavelength,
/// phase velocities in the table would differ from those printed.
pub(super) const WAVELENGTH: f64 = 15e-3;

/// Width of the contact in the paper's table, in metres. With twice this width, strips and powers would be twice those
/// printed.
pub(super) const CONTACT: f64 = 10e-3;

/// Displacement of the finger in the paper's table, in metres. With twice this displacement, powers would be four times those
/// printed.
pub(super) const DISPLACEMENT: f64 = 10e-6;

/// The membrane of Hudin et al. (2012) with eight ideal force actuators at places without symmetry: the built-in surface `hudin-2012`.
///
/// The tension is 200 N/m: the 30 N/m printed in the paper contradicts its celerities, first mode and table 1.
pub fn papers_surface() -> Surface {
    let places = [
        (12.0, 31.0),
        (9.0, 84.0),
        (40.0, 140.0),
        (95.0, 137.0),
        (141.0, 106.0),
        (138.0, 44.0),
        (103.0, 11.0),
        (50.0, 9.0),
    ];
    let actuators = (1..)
        .zip(places)
        .map(|(i, (x, y))| Actuator {
            name: format!("a{i}"),
            at: Point::from_mm(x, y),
            kind: ActuatorKind::Force,
            contact_radius: 0.0,
        })
        .collect();
    Surface {
        name: "hudin-2012".into(),
        outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
        sheet: Sheet {
            material: "BoPET".into(),
            young: 4e9,
            density: 1400.0,
            poisson: 0.3,
            strength: Some(100e6),
            thickness: 0.125e-3,
            tension: 200.0,
            decay: Decay::Time(0.07),
            air: Air::None,
            uneven: Uneven::default(),
        },
        emission: Emission { band: [0.0, 3000.0], rate: 48e3, limit: 1.0, rms_limit: None },
        finger: Finger::default(),
        accuracy: None,
        actuators,
    }
}

/// Whether a surface is the paper's film in its frame with eight actuators, with any tension and any
/// losses: the paper's numbers apply to no other surface.
pub(super) fn is_papers_film(surface: &Surface) -> bool {
    let own = papers_surface();
    let same = |a: f64, b: f64| (a / b - 1.0).abs() < SAME;
    let ((width, height), (own_width, own_height)) = (surface.outline.extent(), own.outline.extent());
    let (sheet, film) = (&surface.sheet, &own.sheet);
    matches!(surface.outline.shape, Shape::Rectangle { .. })
        && same(width, own_width)
        && same(height, own_height)
        && surface.outline.edges == own.outline.edges
        && surface.outline.holes.is_empty()
        && same(sheet.young, film.young)
        && same(sheet.density, film.density)
        && same(sheet.poisson, film.poisson)
        && same(sheet.thickness, film.thickness)
        && sheet.tension > 0.0
        && sheet.uneven.is_uniform()
        && surface.actuators.len() == own.actuators.len()
}

/// The glass strip of the paper's table 1: 69 GPa, 2300 kg/m³, 1 mm thick, 10 mm wide, without tension.
pub fn glass_strip() -> Strip {
    Strip::of_sheet(69e9, 2300.0, 1e-3, 0.0, CONTACT)
}

/// The film strip of the paper's table 1: 4 GPa, 1400 kg/m³, 0.125 mm thick, 10 mm wide, under a tension of 2 N.
pub fn film_strip() -> Strip {
    Strip::of_sheet(4e9, 1400.0, 0.125e-3, 2.0 / CONTACT, CONTACT)
}
