//! Messages to pages on the surface and on its playing options.

use crate::edition::Edition;
use crate::simulation::{CELLS, Cells, Instrument, PULSES, Spec};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use unripple::core::{
    Actuator, ActuatorKind, Decay, Edge, Edges, FOCAL_RADIUS, MATERIALS, Material, Outline, Point, Shape,
    Surface,
};
use unripple::focus::Method;
use unripple::physics::{Medium, sampled_hz};
use unripple_store::{builtin_effects, to_toml};

/// Points along each rim that is drawn: at the size of a screen a circle of so many looks round.
const RIM: usize = 256;

/// The values in messages to pages that stay the same when the surface is edited or replaced.
#[derive(Clone, Debug)]
pub struct Settled {
    /// Name of the surface's file or library.
    pub source: String,
    /// The device's name.
    pub device: String,
    /// Address of the page for other machines.
    pub address: Option<String>,
}

/// The message that describes a surface, as JSON; lengths in mm.
pub fn surface(edition: &Edition, (undo, redo): (bool, bool), source: &str, library: bool) -> Value {
    let surface = &edition.surface;
    let lambda = Medium::of(&surface.sheet).lambda_min(surface.emission.band[1]);
    let (width, height) = surface.outline.extent();
    let mut rings = vec![ring(&surface.outline.rim(RIM))];
    rings.extend(surface.outline.hole_rims(RIM).iter().map(|rim| ring(rim)));
    let limit = surface.emission.limit;
    json!({
        "is": "surface",
        "edit": edition.edit,
        "name": surface.name,
        "source": source,
        "library": library,
        "toml": to_toml(surface),
        "extent_mm": mm(Point::new(width, height)),
        "rings_mm": rings,
        "grid": grid(&surface.outline),
        "inside": inside(&surface.outline),
        "actuators": surface.actuators.iter().map(|a| actuator(a, limit)).collect::<Vec<_>>(),
        "lambda_min_mm": lambda * 1e3,
        "focal_radius_mm": FOCAL_RADIUS * lambda * 1e3,
        "values": values(surface),
        "materials": Material::names(),
        "can_undo": undo,
        "can_redo": redo,
    })
}

fn mm(at: Point) -> [f64; 2] {
    [at.x * 1e3, at.y * 1e3]
}

fn ring(rim: &[Point]) -> Vec<[f64; 2]> {
    rim.iter().map(|at| mm(*at).map(|x| (x * 1e3).round() / 1e3)).collect()
}

fn grid(outline: &Outline) -> Value {
    let Cells { columns, rows, pitch } = Cells::of(outline, CELLS);
    let pitch = pitch.map(|m| m * 1e3);
    json!({ "columns": columns, "rows": rows, "origin_mm": pitch.map(|mm| mm / 2.0), "pitch_mm": pitch })
}

/// Whether each cell is on the surface: a bit each, row by row from the bottom, in Base64.
fn inside(outline: &Outline) -> String {
    let cells = Cells::of(outline, CELLS);
    let mut bits = vec![0u8; (cells.columns * cells.rows).div_ceil(8)];
    for (cell, _) in cells.centres().enumerate().filter(|(_, at)| outline.contains(*at)) {
        bits[cell / 8] |= 1 << (cell % 8);
    }
    STANDARD.encode(bits)
}

fn actuator(actuator: &Actuator, limit: f64) -> Value {
    let unit = unit(&actuator.kind);
    json!({ "name": actuator.name, "at_mm": mm(actuator.at), "kind": actuator.kind.name(), "unit": unit, "limit": limit })
}

/// Unit of what an actuator is driven with.
fn unit(kind: &ActuatorKind) -> &'static str {
    unripple::act::unit(kind)
}

/// Values that pages can edit.
fn values(surface: &Surface) -> Value {
    let (shape, size) = match &surface.outline.shape {
        Shape::Rectangle { width, height } => ("rectangle", vec![*width, *height]),
        Shape::Circle { radius } => ("circle", vec![*radius]),
        Shape::Stadium { straight, radius } => ("stadium", vec![*straight, *radius]),
        Shape::Polygon(_) => ("polygon", Vec::new()),
        Shape::Path(_) => ("path", Vec::new()),
    };
    let edge = match surface.outline.edges {
        Edges::All(Edge::Clamped) => Some("clamped"),
        Edges::All(Edge::Supported) => Some("supported"),
        Edges::All(Edge::Free) => Some("free"),
        _ => None,
    };
    let decay = match surface.sheet.decay {
        Decay::Time(time) => Some(time * 1e3),
        _ => None,
    };
    let material = MATERIALS.iter().find(|m| m.name == surface.sheet.material).map(|m| m.name);
    json!({
        "material": material,
        "thickness_mm": surface.sheet.thickness * 1e3,
        "tension_n_per_m": surface.sheet.tension,
        "decay_time_ms": decay,
        "band_top_hz": surface.emission.band[1],
        "band_most_hz": sampled_hz(surface, f64::INFINITY, 0.0),
        "shape": shape,
        "size_mm": size.iter().map(|m| m * 1e3).collect::<Vec<_>>(),
        "edge": edge,
        "actuators": surface.actuators.len(),
    })
}

/// The message on the playing options of a surface, as JSON.
pub fn settings(told: &Settled, instrument: &Instrument) -> Value {
    let spec = &instrument.spec;
    let method = |method: Method| json!({ "name": method.name(), "needs_modes": !method.reverses() });
    let effects = std::iter::once(json!({ "name": PULSES, "title": "Pulses at the finger" }));
    let builtin =
        builtin_effects().iter().map(|effect| json!({ "name": effect.name, "title": effect.about }));
    json!({
        "is": "settings",
        "method": spec.method.name(),
        "methods": Method::ALL.map(method),
        "effect": spec.effect,
        "effects": effects.chain(builtin).collect::<Vec<_>>(),
        "window_ms": spec.window.map(|seconds| seconds * 1e3),
        "window_auto_ms": instrument.suggested.seconds * 1e3,
        "contrast_expected": instrument.window.contrast,
        "rate_hz": spec.rate,
        "load": spec.load,
        "address": told.address,
        "level": instrument.level.to_string(),
        "modes": instrument.plant.modes(),
        "device": { "name": told.device, "real": spec.device.is_some() },
    })
}

/// The message on the playing options that pages have chosen, as JSON: of those in the settings, the ones that a page can choose. They are
/// played as soon as an instrument is built with them.
pub fn chosen(spec: &Spec) -> Value {
    json!({
        "is": "chosen",
        "method": spec.method.name(),
        "effect": spec.effect,
        "window_ms": spec.window.map(|seconds| seconds * 1e3),
        "rate_hz": spec.rate,
        "load": spec.load,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_ends_where_samples_no_longer_tell_modes_apart() {
        let mut film = unripple::physics::design::papers_surface();
        for (rate, most) in [(48e3, 21_600.0), (12e3, 5400.0), (192e3, 86_400.0)] {
            film.emission.rate = rate;
            let found = values(&film)["band_most_hz"].as_f64().unwrap();
            assert!((found / most - 1.0).abs() < 1e-12, "{rate}: {found}");
        }
    }
}
