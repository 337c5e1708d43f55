//! The design figures of a surface, sent stage by stage as they follow an edit.

use super::{ComputeWorker, Hear, Unfinished, tell};
use crate::edition::Edition;
use serde_json::{Map, Value, json};
use std::sync::Arc;
use unripple::contrast_map::ContrastMap;
use unripple::core::clock::Instant;
use unripple::core::{Point, Surface};
use unripple::drafting::{Draft, Spot};
use unripple_tasks::{Progress, TaskError};

/// Cells of the map along the longer side. Twice as many take four times as long.
const ACROSS: usize = 24;

/// Where a focus is evaluated on a surface that nobody has touched, as shares of its sides: (62, 90) mm on the paper's.
const PLACE: [f64; 2] = [62.0 / 150.0, 0.6];

impl ComputeWorker {
    /// Computes the design figures of a surface and sends them, the quickest first; stops when a newer edit has been
    /// made, or when `progress` reports a cancellation.
    pub(super) fn design(&mut self, edition: &Arc<Edition>, progress: &mut dyn Progress, hear: &mut Hear) {
        let surface = &edition.surface;
        let mut told = Stage::new(edition.edit);
        if let Ok(figures) = Draft::by_law(surface) {
            told.add("figures", json!(figures));
            show(&told, hear);
        }
        let place = self.place.filter(|place| surface.outline.contains(*place));
        let place = place.unwrap_or_else(|| usual(surface));
        if let Err(Unfinished::Refused(why)) = self.stages(&mut told, edition, place, progress, hear) {
            told.add("fault", json!(why));
        }
        told.add("done", json!(true));
        show(&told, hear);
    }

    fn stages(
        &mut self,
        told: &mut Stage,
        edition: &Arc<Edition>,
        place: Point,
        progress: &mut dyn Progress,
        hear: &mut Hear,
    ) -> Result<(), Unfinished> {
        let draft = self.draft(edition, progress)?;
        told.add("figures", json!(draft.figures()));
        show(told, hear);
        if self.is_overtaken(edition) {
            return Ok(());
        }
        let same = draft.clone();
        let found = self.aside(progress, move |_| same.spot(place, None).map_err(TaskError::work))?;
        told.add("act", spot(&found));
        show(told, hear);
        if self.is_overtaken(edition) {
            return Ok(());
        }
        let found = self.aside(progress, move |_| draft.map(None, ACROSS).map_err(TaskError::work))?;
        told.add("map", map(&found));
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
