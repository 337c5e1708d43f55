//! The report of a calibration by recordings made elsewhere: what was measured, what is still to be
//! recorded, what is wrong.

use super::{Outcome, TapeCalibration, Wanted, fault::Fault, plan::PLAY, planned::listed};
use crate::TaskError;
use crate::calibrate::outcome::doubted;
use crate::calibrate::{Report, report};
use serde_json::{Value, json};
use std::fmt::Write;

impl TapeCalibration<'_> {
    /// Makes the report: what was measured, what is still to be recorded, and what is wrong.
    pub fn answer(
        &self,
        outcome: Outcome,
        told: &Value,
        drawn: Result<(), TaskError>,
    ) -> Result<Report, TaskError> {
        let missing: Vec<&Wanted> = self.wanted.iter().filter(|one| !self.there(one)).collect();
        let surplus = self.surplus();
        for file in &surplus {
            let folder = self.folder.display();
            self.campaign.tell(&format!("warning: {file} in {folder} is not in the plan, and not used"));
        }
        let mut report = match &outcome.report {
            Some(report) => serde_json::to_value(report).map_err(TaskError::work)?,
            None => json!({}),
        };
        if let Some(report) = report.as_object_mut() {
            let faults: Vec<Value> = outcome.faults.iter().map(Fault::json).collect();
            let files: Vec<&String> = missing.iter().map(|one| &one.file).collect();
            let tape = json!({
                "folder": self.folder.display().to_string(),
                "play": told["play"],
                "duration_s": told["duration_s"],
                "missing": files,
                "surplus": surplus,
                "wrong": faults,
            });
            report.insert("tape".into(), tape);
            let notes = outcome.notes.iter().map(|note| json!(note));
            match report.get_mut("notes").and_then(Value::as_array_mut) {
                Some(known) => known.extend(notes),
                None => drop(report.insert("notes".into(), notes.collect())),
            }
        }
        let mut text = outcome.report.as_ref().map_or_else(String::new, report::Report::text);
        text += &self.wanting(&missing, told);
        let doubtful = outcome.library.as_ref().and_then(doubted);
        let faults: Vec<String> = outcome.faults.iter().map(|fault| format!("  {fault}")).collect();
        let failure = match faults.len() {
            0 => doubtful,
            count => {
                let mut text = format!("{} cannot be used:\n{}", recordings(count), faults.join("\n"));
                if let Some(doubts) = doubtful {
                    let _ = write!(text, "\n{doubts}");
                }
                Some(text)
            }
        };
        Ok(Report::of_tape(report, text, failure.or(drawn.err().map(|error| error.to_string()))))
    }

    /// WAV files in the folder that the plan does not list.
    fn surplus(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder).into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let sound = names.filter(|name| name.to_lowercase().ends_with(".wav") && name != PLAY);
        let mut surplus: Vec<String> =
            sound.filter(|name| self.wanted.iter().all(|one| one.file != *name)).collect();
        surplus.sort();
        surplus
    }

    /// Text on what is still to be recorded, and how.
    fn wanting(&self, missing: &[&Wanted], told: &Value) -> String {
        if missing.is_empty() {
            return String::new();
        }
        let list = |key: &str| {
            let names = told[key].as_array().into_iter().flatten().filter_map(Value::as_str);
            names.collect::<Vec<_>>().join(", ")
        };
        let full = match self.campaign.ask.device.output_scale {
            Some(full) => format!("{full} of the actuators' unit"),
            None => "the surface's limit".into(),
        };
        let text = format!(
            "{} to be made in {}, while play.wav plays ({:.1} s, channels {}; full scale is {full}),\n\
             as WAV at {} Hz with the channels {}, from before it begins until after it ends:\n",
            recordings(missing.len()),
            self.folder.display(),
            told["duration_s"].as_f64().unwrap_or(0.0),
            list("outputs"),
            told["sample_rate_hz"].as_f64().unwrap_or(0.0),
            list("inputs"),
        );
        let probe = |one: &Wanted| {
            let at = one.at.map_or_else(|| "anywhere".to_owned(), |at| format!("at {at}"));
            format!("the probe {at}")
        };
        text + &listed(missing, probe, ", see plan.json")
    }
}

fn recordings(count: usize) -> String {
    if count == 1 { "1 recording".into() } else { format!("{count} recordings") }
}
