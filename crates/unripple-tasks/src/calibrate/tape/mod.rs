//! Calibration by files: sweeps to be played elsewhere are written as WAV, and the recordings of them are read back; or recordings of taps
//! and blows are read.

mod answer;
mod channels;
mod fault;
mod library;
mod marks;
mod measure;
mod plan;
mod planned;
mod read;
mod rig;
mod strikes;
mod struck;
mod takes;
mod wiring;

use super::ask::By;
use super::campaign::Campaign;
use super::points::{self, middle};
use super::{Report, figure, levels, report};
use crate::TaskError;
use channels::{few, layout};
use fault::Fault;
use planned::{PlannedPoints, Wanted};
use read::Reader;
use std::path::{Path, PathBuf};
use takes::Takes;
use unripple::core::PROBE;
use unripple_calibrate::measure::{MeasureOptions, Session, Wires};
use unripple_store::Library;

pub(super) use plan::drive as sweeps;

/// A calibration by recordings, with the recordings that it needs.
struct TapeCalibration<'a> {
    campaign: Campaign<'a>,
    wanted: Vec<Wanted>,
    takes: Takes,
    folder: &'a Path,
    /// Numbers of the points that have a readable recording, once the recordings have been read.
    good: Vec<usize>,
}

/// Result of evaluating the recordings that exist.
#[derive(Default)]
struct Outcome {
    report: Option<report::Report>,
    library: Option<Library>,
    faults: Vec<Fault>,
    notes: Vec<String>,
}

/// Writes the plan and the file to play, and computes as much of the library as the existing recordings
/// allow.
pub(super) fn run(mut campaign: Campaign<'_>) -> Result<Report, TaskError> {
    let (ask, surface) = (campaign.ask, campaign.surface);
    let Some(folder) = ask.device.tape.as_deref() else {
        return Err(TaskError::Input(
            "`device` tape: expected `tape` DIR, a folder for recordings, found none".into(),
        ));
    };
    if ask.by != By::Probe {
        return struck::run(campaign, folder);
    }
    let before = plan::found(folder)?;
    // A bad recording is not better when it is read again, and one that was made is read as it was made.
    campaign.settings = MeasureOptions { retries: 0, ..campaign.settings };
    if let Some(before) = &before {
        plan::apply(before, ask, &mut campaign.settings);
    }
    campaign.warn();
    let layout = layout(ask, surface, campaign.scales.full_scale(surface))?;
    let wires = Wires::by_name(&campaign.model.ports, &layout, &ask.wires)?;
    campaign.places = points::places(ask, surface, !wires.sensors.is_empty())?;
    few(campaign.places.probed, campaign.settings.repeats)?;
    if campaign.places.probed > 0 && wires.probe.is_none() {
        let found = layout.inputs.join(", ");
        return Err(TaskError::Input(format!(
            "`tape_inputs`: expected one that is called `{PROBE}`, found {found}"
        )));
    }
    let session = Session::new(surface, &layout, wires.clone(), &campaign.settings)?;
    let drive = plan::drive(&session, &layout, middle(surface))?;
    let reader = Reader { layout, band: session.band(), resample: ask.resample };
    let takes = Takes::new(folder.into(), reader, wires, drive);
    let planned = before.as_ref().map(PlannedPoints::of).unwrap_or_default();
    let hears_itself = !takes.telling().is_empty();
    let wanted = planned.wanted(&campaign.places, hears_itself, campaign.settings.repeats);
    let told = plan::told(&surface.name, takes.layout(), &takes.drive, &campaign.settings, &wanted);
    plan::put(folder, &told, &takes.drive, before.as_ref())?;

    let mut calibration = TapeCalibration { campaign, wanted, takes, folder, good: Vec::new() };
    if ask.check_levels {
        return Report::of_levels(&levels::look(
            &calibration.recordings(),
            &calibration.takes.reader.layout.inputs,
        )?);
    }
    let outcome = if calibration.can_begin() { calibration.measure(&session)? } else { Outcome::default() };
    let drawn = match &outcome.library {
        Some(library) => figure::write(&mut calibration.campaign, library),
        None => Ok(()),
    };
    calibration.answer(outcome, &told, drawn)
}

impl TapeCalibration<'_> {
    fn there(&self, wanted: &Wanted) -> bool {
        self.folder.join(&wanted.file).is_file()
    }

    /// The planned recordings whose files exist.
    fn present(&self) -> Vec<Wanted> {
        self.wanted.iter().filter(|one| self.there(one)).cloned().collect()
    }

    /// Paths of the recordings that exist, and whether each is the recording of the actuators.
    fn recordings(&self) -> Vec<(PathBuf, bool)> {
        self.present().iter().map(|one| (self.folder.join(&one.file), one.at.is_none())).collect()
    }

    /// Whether evaluation can begin: some recording exists, and so does that of the actuators, if the plan
    /// has one.
    fn can_begin(&self) -> bool {
        let present = self.present();
        let own = self.wanted.iter().any(|one| one.at.is_none());
        !present.is_empty() && (!own || present.iter().any(|one| one.at.is_none()))
    }
}
