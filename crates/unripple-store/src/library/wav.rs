//! A library exported as WAV files.

use super::Library;
use crate::{Committed, OutputDir, StoreError, write_wav};
use serde_json::{Value, json};
use std::path::Path;
use unripple_core::Drive;

impl Library {
    /// Writes every finished point as a WAV file of float32, one channel per actuator, with `library.json` beside
    /// them: rate, actuators, and each file's point, place and quality. An earlier export is replaced as a whole.
    ///
    /// # Errors
    /// As [`Library::get`], [`OutputDir::create`] and [`write_wav`].
    pub fn export_wav(&self, folder: impl AsRef<Path>) -> Result<Committed, StoreError> {
        let out = OutputDir::create(folder)?;
        let names: Vec<String> = self.plan.ports.iter().map(|port| port.name.clone()).collect();
        let digits = (self.plan.points.len() - 1).to_string().len();
        let mut files = Vec::new();
        for point in self.done() {
            let name = format!("point-{point:0digits$}.wav");
            let values = self.get(point)?;
            let channels =
                values.chunks_exact(self.plan.samples).map(|c| c.iter().map(|x| f64::from(*x)).collect());
            let carried = Drive::new(self.plan.conditions.rate, names.clone(), channels.collect());
            let file = self.arrays.responses.chunk(&self.root, point).display().to_string();
            let carried =
                carried.map_err(|error| StoreError::content(&file, "finite samples", error.to_string()))?;
            write_wav(out.path().join(&name), &carried)?;
            files.push(self.said_of(point, &name)?);
        }
        let text = serde_json::to_vec_pretty(&self.said(files)).unwrap_or_default();
        out.write("library.json", &text)?;
        out.commit()
    }

    fn said_of(&self, point: usize, name: &str) -> Result<Value, StoreError> {
        let at = self.plan.points[point];
        let quality: Vec<Value> = self
            .quality(point)?
            .iter()
            .map(|q| {
                json!({
                    "signal_to_noise_db": q.signal_to_noise_db,
                    "coherence": q.coherence,
                    "distortion": q.distortion,
                    "decay_time_s": q.decay_time,
                })
            })
            .collect();
        Ok(json!({ "file": name, "point": point, "at_m": [at.x, at.y], "quality": quality }))
    }

    fn said(&self, files: Vec<Value>) -> Value {
        let plan = &self.plan;
        let ports = plan.ports.iter().zip(&plan.drive_units);
        let actuators: Vec<Value> = ports
            .map(|(p, unit)| json!({ "name": p.name, "at_m": [p.at.x, p.at.y], "drive_unit": unit }))
            .collect();
        json!({
            "quantity": "normal velocity per impulse of drive",
            "unit": "m/s per (drive unit times second)",
            "sample_rate_hz": plan.conditions.rate,
            "band_hz": plan.conditions.band,
            "lambda_min_m": plan.conditions.lambda_min,
            "onset_s": plan.onset,
            "samples": plan.samples,
            "actuators": actuators,
            "provenance": plan.provenance,
            "files": files,
        })
    }
}
