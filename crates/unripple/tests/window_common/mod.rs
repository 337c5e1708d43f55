//! Five kinds of surfaces, and the places that their contrast is averaged over.

use std::f64::consts::TAU;
use unripple_core::{Actuator, ActuatorKind, Air, Decay, Edge, Edges, Outline, Point, Shape, Sheet, Surface};
use unripple_physics::design::papers_surface;

/// Loss factors that are tried on each kind of surface.
pub const LOSS_FACTORS: [f64; 4] = [0.001, 0.005, 0.02, 0.1];

/// Targets that contrast is averaged over.
const TARGETS: usize = 96;

/// A surface with another loss factor.
pub fn with_loss(surface: &Surface, loss_factor: f64) -> Surface {
    let mut lossy = surface.clone();
    lossy.sheet.decay = Decay::LossFactor(loss_factor);
    lossy
}

/// Targets by Halton's sequence, shifted off the axes of symmetry: at least a shortest wavelength, or on small surfaces 0.8 S/P, from
/// the rim, and half of one from actuators.
pub fn targets(surface: &Surface, wavelength: f64) -> Vec<Point> {
    let outline = &surface.outline;
    let (width, height) = outline.extent();
    let margin = wavelength.min(0.8 * outline.area() / outline.perimeter());
    let around = |p: &Point, i: u32| {
        let angle = TAU * f64::from(i) / 24.0;
        Point::new(p.x + margin * angle.cos(), p.y + margin * angle.sin())
    };
    let at =
        |i: u32| Point::new(width * (halton(i, 2) + 0.137).fract(), height * (halton(i, 3) + 0.271).fract());
    (1..20_000)
        .map(at)
        .filter(|p| outline.contains(*p) && (0..24).all(|i| outline.contains(around(p, i))))
        .filter(|p| surface.actuators.iter().all(|a| a.at.distance(*p) >= 0.5 * wavelength))
        .take(TARGETS)
        .collect()
}

fn halton(mut index: u32, base: u32) -> f64 {
    let (mut share, mut sum) = (1.0, 0.0);
    while index > 0 {
        share /= f64::from(base);
        sum += share * f64::from(index % base);
        index /= base;
    }
    sum
}

fn sheet(young: f64, density: f64, poisson: f64, (mm, tension): (f64, f64)) -> Sheet {
    Sheet { young, density, poisson, thickness: mm * 1e-3, tension, air: Air::None, ..papers_surface().sheet }
}

fn surface(name: &str, outline: Outline, sheet: Sheet, top: f64, places: &[(f64, f64)]) -> Surface {
    let mut made = papers_surface();
    let force = |(i, (x, y)): (usize, &(f64, f64))| Actuator {
        name: format!("a{i}"),
        at: Point::from_mm(*x, *y),
        kind: ActuatorKind::Force,
        contact_radius: 0.0,
    };
    made.name = name.into();
    (made.outline, made.sheet) = (outline, sheet);
    (made.emission.band, made.emission.rate) = ([0.0, top], if top > 10e3 { 96e3 } else { 48e3 });
    made.actuators = places.iter().enumerate().map(force).collect();
    made
}

fn rectangle(width: f64, height: f64, edge: Edge) -> Outline {
    Outline::new(Shape::Rectangle { width, height }).with_edges(Edges::All(edge))
}

/// The paper's film.
pub fn film() -> Surface {
    papers_surface()
}

/// A pane of glass, 200 x 120 x 0.7 mm.
pub fn glass() -> Surface {
    let places = [
        (14.0, 27.0),
        (17.0, 88.0),
        (58.0, 107.0),
        (131.0, 104.0),
        (187.0, 79.0),
        (184.0, 35.0),
        (119.0, 13.0),
        (47.0, 16.0),
    ];
    let outline = rectangle(0.2, 0.12, Edge::Supported);
    surface("glass", outline, sheet(72e9, 2500.0, 0.22, (0.7, 0.0)), 20e3, &places)
}

/// An aluminium panel on springs, 140 x 70 x 0.8 mm.
pub fn panel() -> Surface {
    let places = [(11.0, 17.0), (128.0, 12.0), (133.0, 58.0), (23.0, 61.0)];
    let outline = rectangle(0.14, 0.07, Edge::Elastic { lift: 5e5, tilt: 2.0 });
    surface("panel", outline, sheet(70e9, 2700.0, 0.33, (0.8, 0.0)), 8e3, &places)
}

/// A drum skin of 330 mm.
pub fn drum() -> Surface {
    let places = [(310.0, 190.0), (230.0, 312.0), (90.0, 300.0), (14.0, 150.0), (105.0, 25.0), (250.0, 40.0)];
    let outline = Outline::new(Shape::Circle { radius: 0.165 });
    surface("drum", outline, sheet(4e9, 1390.0, 0.38, (0.19, 3000.0)), 2500.0, &places)
}

/// A wooden table top, 1200 x 800 x 18 mm, on a soft bed.
pub fn table() -> Surface {
    let places = [
        (60.0, 90.0),
        (70.0, 410.0),
        (50.0, 690.0),
        (340.0, 60.0),
        (420.0, 740.0),
        (640.0, 50.0),
        (700.0, 730.0),
        (930.0, 70.0),
        (1010.0, 745.0),
        (1140.0, 130.0),
        (1150.0, 370.0),
        (1130.0, 640.0),
        (250.0, 330.0),
        (610.0, 410.0),
        (930.0, 390.0),
        (420.0, 600.0),
    ];
    let outline = rectangle(1.2, 0.8, Edge::Elastic { lift: 1e4, tilt: 0.0 });
    surface("table", outline, sheet(11e9, 600.0, 0.3, (18.0, 0.0)), 2000.0, &places)
}
