//! Applies an edit to a surface.

use super::places;
use crate::wire::Edit;
use unripple::core::{Decay, Edge, Edges, Material, Outline, Point, Shape, Surface};

/// Returns a copy of a surface with an edit applied. The result is not checked here: an unknown name of a
/// material is copied, and an unknown edge condition changes nothing.
pub fn apply(surface: &Surface, edit: &Edit) -> Surface {
    let mut surface = surface.clone();
    sheet(&mut surface, edit);
    if let Some(shape) = shape(edit) {
        reshape(&mut surface, shape);
    }
    if let Some(edge) = edit.edge.as_deref().and_then(edge) {
        surface.outline.edges = Edges::All(edge);
    }
    if let Some(count) = edit.actuators {
        places::fill(&mut surface, count);
    }
    if let (Some(index), Some([x, y])) = (edit.actuator, edit.at_mm)
        && let Some(actuator) = surface.actuators.get_mut(index)
    {
        actuator.at = Point::new(thousandth(x), thousandth(y));
    }
    surface
}

/// A thousandth of a value, from its decimal digits: neither a product with 1e-3 nor a quotient by 1e3 has the digits that were typed.
fn thousandth(value: f64) -> f64 {
    format!("{value}e-3").parse().unwrap_or(value / 1e3)
}

fn sheet(surface: &mut Surface, edit: &Edit) {
    let sheet = &mut surface.sheet;
    if let Some(name) = &edit.material {
        sheet.material.clone_from(name);
        if let Some(material) = Material::named(name) {
            sheet.material = material.name.into();
            sheet.young = material.young;
            sheet.density = material.density;
            sheet.poisson = material.poisson;
            sheet.strength = Some(material.strength);
        }
    }
    sheet.thickness = edit.thickness_mm.map_or(sheet.thickness, thousandth);
    sheet.tension = edit.tension_n_per_m.unwrap_or(sheet.tension);
    if let Some(ms) = edit.decay_time_ms {
        sheet.decay = Decay::Time(thousandth(ms));
    }
    surface.emission.band[1] = edit.band_top_hz.unwrap_or(surface.emission.band[1]);
}

fn shape(edit: &Edit) -> Option<Shape> {
    let m = thousandth;
    let rectangle = edit.rectangle_mm.map(|[w, h]| Shape::Rectangle { width: m(w), height: m(h) });
    let circle = edit.circle_mm.map(|radius| Shape::Circle { radius: m(radius) });
    let stadium = edit.stadium_mm.map(|[s, r]| Shape::Stadium { straight: m(s), radius: m(r) });
    rectangle.or(circle).or(stadium)
}

/// The edge condition of this name, `clamped`, `supported` or `free`; `None` for any other name.
pub fn edge(name: &str) -> Option<Edge> {
    match name {
        "clamped" => Some(Edge::Clamped),
        "supported" => Some(Edge::Supported),
        "free" => Some(Edge::Free),
        _ => None,
    }
}

/// Gives the sheet another outline. Actuators are moved in proportion, and onto the sheet where they would lie beside it.
fn reshape(surface: &mut Surface, shape: Shape) {
    let (width, height) = surface.outline.extent();
    let edges = match &surface.outline.edges {
        Edges::All(edge) => *edge,
        Edges::PerSide(list) => list.first().copied().unwrap_or(Edge::Clamped),
    };
    let holes = std::mem::take(&mut surface.outline.holes);
    surface.outline = Outline { holes, ..Outline::new(shape).with_edges(Edges::All(edges)) };
    let (wide, high) = surface.outline.extent();
    for actuator in &mut surface.actuators {
        let at = Point::new(actuator.at.x * wide / width, actuator.at.y * high / height);
        actuator.at = places::onto(&surface.outline, at);
    }
}
