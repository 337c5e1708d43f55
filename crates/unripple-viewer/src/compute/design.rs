//! The design figures of a surface, sent stage by stage as they follow an edit.

use super::{ComputeWorker, Hear, tell};
use crate::edition::Edition;
use serde_json::{Map, Value, json};
use std::time::Instant;
use unripple::act::ActError;
use unripple::contrast_map::ContrastMap;
use unripple::core::{Point, Surface};
use unripple::drafting::{Draft, Spot};

/// Cells of the map along the longer side. Twice as many take four times as long.
const ACROSS: usize = 24;

/// Where a focus is evaluated on a surface that nobody has touched, as shares of its sides: (62, 90) mm on the paper's.
const PLACE: [f64; 2] = [62.0 / 150.0, 0.6];

impl ComputeWorker {
    /// Computes the design figures of a surface and sends them, the quickest first; stops when a newer edit has been
    /// made.
    pub(super) fn design(&mut self, edition: &Edition, hear: &mut Hear) {
        let surface = &edition.surface;
        let mut told = Stage::new(edition.edit);
        if let Ok(figures) = Draft::by_law(surface) {
            told.add("figures", json!(figures));
            show(&told, hear);
        }
        let place = self.place.filter(|place| surface.outline.contains(*place));
        let place = place.unwrap_or_else(|| usual(surface));
        let found = self.stages(&mut told, edition, place, hear);
        if let Err(error) = found {
            told.add("fault", json!(error.to_string()));
        }
        told.add("done", json!(true));
        show(&told, hear);
    }

    fn stages(
        &mut self,
        told: &mut Stage,
        edition: &Edition,
        place: Point,
        hear: &mut Hear,
    ) -> Result<(), ActError> {
        let draft = self.draft(edition)?;
        told.add("figures", json!(draft.figures()));
        show(told, hear);
        if self.is_overtaken(edition) {
            return Ok(());
        }
        told.add("act", spot(&draft.spot(place, None)?));
        show(told, hear);
        if self.is_overtaken(edition) {
            return Ok(());
        }
        told.add("map", map(&draft.map(None, ACROSS)?));
        Ok(())
    }
}

fn show(told: &Stage, hear: &mut Hear) {
    tell(hear, "design", &Value::Object(told.found.clone()));
}

/// What has been found so far.
struct Stage {
    began: Instant,
    found: Map<String, Value>,
}

impl Stage {
    fn new(edit: u64) -> Self {
        let mut found = Map::new();
        found.insert("is".into(), json!("design"));
        found.insert("edit".into(), json!(edit));
        found.insert("done".into(), json!(false));
        Self { began: Instant::now(), found }
    }

    fn add(&mut self, key: &str, value: Value) {
        self.found.insert(key.into(), value);
        self.found.insert("seconds".into(), json!(self.began.elapsed().as_secs_f64()));
    }
}

fn usual(surface: &Surface) -> Point {
    let (width, height) = surface.outline.extent();
    surface.outline.nearest(Point::new(PLACE[0] * width, PLACE[1] * height))
}

fn spot(spot: &Spot) -> Value {
    json!({
        "at_mm": [spot.at.x * 1e3, spot.at.y * 1e3],
        "window_ms": spot.window * 1e3,
        "contrast": spot.contrast,
        "peak_velocity_m_s": spot.peak_velocity,
    })
}

fn map(map: &ContrastMap) -> Value {
    let contrast: Vec<Option<f64>> =
        map.contrast.iter().map(|c| c.map(|c| (c * 1e3).round() / 1e3)).collect();
    let grid = &map.grid;
    let pitch = [grid.width * 1e3, grid.height * 1e3];
    json!({
        "columns": grid.columns,
        "rows": grid.rows,
        "origin_mm": pitch.map(|mm| mm / 2.0),
        "pitch_mm": pitch,
        "contrast": contrast,
    })
}
