//! Sheets of unit mass per area and bending stiffness, and their outlines, in metres.

use std::f64::consts::TAU;
use unripple_core::*;

/// A sheet of bending stiffness 1 N·m (0 for a membrane), mass 1 kg/m² and some tension (N/m), so that ρ_s ω² = D k⁴ + T k² is k⁴ + T k².
pub fn sheet(outline: Outline, bending: f64, tension: f64, poisson: f64) -> Surface {
    let thickness = 1e-3;
    let sheet = Sheet {
        material: "unit".into(),
        young: bending * 12.0 * (1.0 - poisson * poisson) / f64::powi(thickness, 3),
        density: 1.0 / thickness,
        poisson,
        strength: None,
        thickness,
        tension,
        decay: Decay::Time(1.0),
        air: Air::None,
        uneven: Uneven::default(),
    };
    Surface {
        name: "unit".into(),
        outline,
        sheet,
        emission: Emission { band: [0.0, 1.0], rate: 4.0, limit: 1.0, rms_limit: None },
        finger: Finger::default(),
        accuracy: None,
        actuators: Vec::new(),
    }
}

/// A polygon with one edge condition all round, moved so that its bounding box begins at the origin.
pub fn polygon(vertices: &[[f64; 2]], edges: Edges) -> Outline {
    let least = |axis: usize| vertices.iter().map(|v| v[axis]).fold(f64::INFINITY, f64::min);
    let (x, y) = (least(0), least(1));
    let points = vertices.iter().map(|v| Point::new(v[0] - x, v[1] - y)).collect();
    Outline::new(Shape::Polygon(points)).with_edges(edges)
}

/// A regular polygon of unit circumradius.
pub fn regular(count: u32, edge: Edge) -> Outline {
    let corner = |i: u32| {
        let angle = TAU * f64::from(i) / f64::from(count);
        [angle.cos(), angle.sin()]
    };
    polygon(&(0..count).map(corner).collect::<Vec<_>>(), Edges::All(edge))
}

/// A sector of unit radius and some angle (rad, less than a whole turn): its straight edges and its arc.
pub fn sector(angle: f64, straight: Edge, arc: Edge) -> Outline {
    let on_arc = |a: f64| Point::new(a.cos(), a.sin());
    let quarters = (1..4).map(|i| 0.25 * TAU * f64::from(i)).filter(|a| *a < angle);
    let reached: Vec<Point> =
        quarters.chain([0.0, angle]).map(on_arc).chain([Point::new(0.0, 0.0)]).collect();
    let least = |of: fn(&Point) -> f64| reached.iter().map(of).fold(f64::INFINITY, f64::min);
    // The bounding box begins at the origin.
    let centre = Point::new(-least(|p| p.x), -least(|p| p.y));
    let at = |a: f64| Point::new(centre.x + a.cos(), centre.y + a.sin());
    let sides = vec![
        Side::Line { from: centre, to: at(0.0) },
        Side::Arc { centre, radius: 1.0, start: 0.0, sweep: angle },
        Side::Line { from: at(angle), to: centre },
    ];
    Outline::new(Shape::Path(sides)).with_edges(Edges::PerSide(vec![straight, arc, straight]))
}

/// A circle of radius 1 that is solved on a mesh: two half circles without straight sides between them.
pub fn meshed_circle(edge: Edge) -> Outline {
    Outline::new(Shape::Stadium { straight: 0.0, radius: 1.0 }).with_edges(Edges::All(edge))
}

/// A ring of outer radius 1 and some inner radius.
pub fn ring(inner: f64, edges: [Edge; 2]) -> Outline {
    let mut hole = Hole::new(&Shape::Circle { radius: inner }, Point::new(1.0 - inner, 1.0 - inner));
    hole.edges = Edges::All(edges[0]);
    Outline::new(Shape::Circle { radius: 1.0 }).with_edges(Edges::All(edges[1])).with_hole(hole)
}
