//! Surfaces that tests share.
#![allow(dead_code)]

use unripple_core::*;

/// A rectangle of BoPET as in Hudin et al. 2012, without actuators.
pub fn film(edges: Edges) -> Surface {
    Surface {
        name: "film".into(),
        outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }).with_edges(edges),
        sheet: Sheet {
            material: "BoPET".into(),
            young: 4e9,
            density: 1400.0,
            poisson: 0.3,
            strength: None,
            thickness: 0.125e-3,
            tension: 200.0,
            decay: Decay::Time(0.07),
            air: Air::None,
            uneven: Uneven::default(),
        },
        emission: Emission { band: [0.0, 3e3], rate: 48e3, limit: 1.0, rms_limit: None },
        finger: Finger::default(),
        accuracy: None,
        actuators: Vec::new(),
    }
}

/// A film with actuators at these places, in mm.
pub fn film_with_actuators(at_mm: &[(f64, f64)]) -> Surface {
    let actuators = at_mm
        .iter()
        .enumerate()
        .map(|(i, (x, y))| Actuator {
            name: format!("a{}", i + 1),
            at: Point::from_mm(*x, *y),
            kind: ActuatorKind::Force,
            contact_radius: 0.0,
        })
        .collect();
    Surface { actuators, ..film(Edges::All(Edge::Clamped)) }
}

/// A plate 1 m wide of that aspect (height over width) whose ω is the dimensionless ω a² √(ρ_s/D).
pub fn unit_plate(aspect: f64, poisson: f64, edges: Edges) -> Surface {
    let mut surface = film(edges);
    surface.outline.shape = Shape::Rectangle { width: 1.0, height: aspect };
    let sheet = &mut surface.sheet;
    (sheet.thickness, sheet.density, sheet.tension, sheet.poisson) = (1e-3, 1e3, 0.0, poisson);
    sheet.young = 12.0 * (1.0 - poisson * poisson) / sheet.thickness.powi(3);
    surface
}

/// Edges from their initials (c, s, f), from the bottom, anticlockwise.
pub fn edges(initials: &str) -> Edges {
    Edges::PerSide(
        initials
            .chars()
            .map(|c| match c {
                'c' => Edge::Clamped,
                's' => Edge::Supported,
                _ => Edge::Free,
            })
            .collect(),
    )
}
