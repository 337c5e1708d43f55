//! Fits a surface to natural frequencies.

use super::{Ask, Losses, Mode, Other, Report, Untold, Value, figure};
use crate::figures::Columns;
use crate::{Progress, TaskError, cost, figures, folder, go_on};
use unripple::act::Note;
use unripple::core::{Cost, Surface};
use unripple::physics::{Accuracy, SurfaceModes};
use unripple_calibrate::frequencies::{FrequencyFit, FrequencyOptions, Heard, Quantity, fit_frequencies};
use unripple_store::{OutputDir, parse_surface, to_toml};

/// Largest number of frequencies: with more, a surface is fitted to a recording.
const MOST: usize = 200;

/// Solutions for modes that a fit takes, roughly: those of its starts and steps with all differences.
const SOLUTIONS: f64 = 40.0;

/// Accuracy of these solutions, a ratio.
const ACCURACY: f64 = 1e-4;

/// Excess of the residuals over the stated error that is worth a note.
const LARGE: f64 = 2.0;

/// Fits quantities of a surface to measured natural frequencies, and writes the fitted surface file, a report and figures to a folder if
/// the request names one.
///
/// ```
/// use unripple_tasks::{Silent, fit_modes};
///
/// // The first four frequencies of the paper's film under 220 N/m instead of 200.
/// let hz = [171.4, 270.8, 270.8, 343.0];
/// let modes = hz.map(|frequency_hz| fit_modes::ModeAsk { frequency_hz, decay_time_s: None }).to_vec();
/// let report = fit_modes::run(&fit_modes::Ask { modes, ..fit_modes::Ask::default() }, &mut Silent)?;
/// let tension = &report.quantities[0];
/// assert!(tension.quantity == "tension" && (210.0..230.0).contains(&tension.value), "{tension:?}");
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// [`TaskError::Ask`] of options that make no sense; [`TaskError::Input`] if frequencies tell nothing of the surface; those of reading the
/// surface, of its modes and of writing the folder; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    let columns = Columns::of(ask.columns)?;
    let heard = heard(ask)?;
    let out = folder::begin(ask.output.as_deref(), ask)?;
    let surface = ask.surface.load()?;
    let options =
        FrequencyOptions { free: free(ask, &surface)?, error: error(ask)?, sides_known: ask.sides_known };
    announce(&surface, &heard, progress);
    go_on(progress)?;
    progress.stage("fit");
    let found = fit_frequencies(&surface, &heard, &options)?;
    go_on(progress)?;
    let mut report = reported(ask, &surface, &heard, &found);
    if let Some((out, record)) = out {
        if !ask.no_figures {
            progress.stage("figures");
            report.files = figures::write(&out, &columns.fit(figure::all(&report)))?;
        }
        surfaces(&out, &mut report)?;
        record.write(&out, &report)?;
        out.write("report.md", report.markdown().as_bytes())?;
        folder::finish(out, progress)?;
    }
    Ok(report)
}

/// The measured modes, after a check of their numbers.
fn heard(ask: &Ask) -> Result<Vec<Heard>, TaskError> {
    let refused = |expected: &str, found: String| Err(TaskError::ask("modes", expected, found));
    if !(1..=MOST).contains(&ask.modes.len()) {
        return refused("1 to 200 frequencies", ask.modes.len().to_string());
    }
    for mode in &ask.modes {
        if !(0.1..=1e6).contains(&mode.frequency_hz) {
            return refused("frequencies from 0.1 to 1e6 Hz", mode.frequency_hz.to_string());
        }
        if let Some(time) = mode.decay_time_s.filter(|time| !(1e-5..=1e3).contains(time)) {
            return refused("decay times from 0.01 to 1e6 ms", format!("{} ms", 1e3 * time));
        }
    }
    Ok(ask.modes.iter().map(|mode| Heard { hz: mode.frequency_hz, decay_time: mode.decay_time_s }).collect())
}

/// The stated relative error of the frequencies.
fn error(ask: &Ask) -> Result<f64, TaskError> {
    match (1e-5..=0.2).contains(&ask.error) {
        true => Ok(ask.error),
        false => Err(TaskError::ask("error", "0.001 to 20 per cent", 100.0 * ask.error)),
    }
}

/// The quantities to fit, by their names.
fn free(ask: &Ask, surface: &Surface) -> Result<Vec<Quantity>, TaskError> {
    let one = |name: &String| -> Result<Quantity, TaskError> {
        let refused = |expected: String| TaskError::ask("free", expected, name);
        let quantity =
            Quantity::named(name).ok_or_else(|| refused(format!("one of {}", Quantity::names())))?;
        match quantity.value(surface) {
            Some(_) => Ok(quantity),
            None => {
                Err(refused("a quantity that the surface has, with a value above 0 to begin with".into()))
            }
        }
    };
    ask.free.iter().map(one).collect()
}

/// Tells what the fit costs, where it takes long.
fn announce(surface: &Surface, heard: &[Heard], progress: &mut dyn Progress) {
    let top = heard.iter().map(|heard| heard.hz).fold(0.0, f64::max);
    let accuracy = Accuracy::of(surface.accuracy, ACCURACY);
    // What cannot be estimated is refused where it is computed.
    let Ok(one) = SurfaceModes::cost(surface, 1.1 * top, accuracy) else { return };
    let cost = Cost { seconds: SOLUTIONS * one.seconds, ..one };
    cost::announce(cost, "fewer and lower frequencies, fewer quantities or a coarser `accuracy`", progress);
}

fn reported(ask: &Ask, surface: &Surface, heard: &[Heard], found: &FrequencyFit) -> Report {
    let best = &found.best;
    Report {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "fit_modes",
        surface: surface.name.clone(),
        sides: best.sides.clone(),
        error: ask.error,
        quantities: best.values.iter().map(Value::of).collect(),
        modes: best.modes.iter().map(Mode::of).collect(),
        missed_hz: best.missed_hz.clone(),
        spurious_hz: best.spurious.iter().map(|which| heard[*which].hz).collect(),
        cost: best.cost,
        excess: best.excess,
        losses: found.losses.as_ref().map(Losses::of),
        untold: found.untold.iter().map(Untold::of).collect(),
        others: found.others.iter().map(Other::of).collect(),
        starts: found.starts,
        surface_toml: to_toml(&best.surface),
        notes: notes(found),
        files: Vec::new(),
    }
}

/// What is assumed, and what is to be doubted.
fn notes(found: &FrequencyFit) -> Vec<Note> {
    let mut notes = Vec::new();
    let mut add = |topic: &'static str, text: String| notes.push(Note { topic, text });
    add("mass", "frequencies tell stiffness over mass: density and thickness are those of the file".into());
    if found.best.excess > LARGE {
        let text = format!(
            "they are {:.1} times what the stated error lets expect: the model leaves something out, or a frequency is another mode; \
             intervals are wider by this factor",
            found.best.excess
        );
        add("residuals", text);
    }
    let (modes, spurious) = (found.best.modes.len(), found.best.spurious.len());
    if is_much(spurious, modes) {
        let text = format!(
            "{spurious} of {} frequencies are taken for no mode: the values may be wrong; see which of them were heard clearly",
            modes + spurious
        );
        add("spurious", text);
    }
    let better = found.others.iter().filter(|other| other.explained.cost < found.best.cost - 1.0).count();
    if better > 0 {
        add(
            "sides",
            format!(
                "{better} of the others explain the frequencies better: see whether the sides are held as the file says"
            ),
        );
    }
    notes
}

/// Whether at least a third of the frequencies are no mode.
fn is_much(spurious: usize, modes: usize) -> bool {
    spurious > 0 && 2 * spurious >= modes
}

/// Writes the fitted surface file and those of the others. One whose values a file cannot hold is told, and not written.
fn surfaces(out: &OutputDir, report: &mut Report) -> Result<(), TaskError> {
    let others =
        report.others.iter().zip(1..).map(|(other, n)| (format!("other-{n}.toml"), &other.surface_toml));
    let own = std::iter::once(("fitted.toml".to_owned(), &report.surface_toml));
    let (mut files, mut notes) = (Vec::new(), Vec::new());
    for (name, toml) in own.chain(others) {
        match parse_surface(toml, &name) {
            Ok(_) => {
                out.write(&name, toml.as_bytes())?;
                files.push(name);
            }
            Err(faults) => notes.push(Note { topic: "file", text: format!("not written: {faults}") }),
        }
    }
    report.files.extend(files);
    report.notes.extend(notes);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::is_much;

    #[test]
    fn a_third_of_the_frequencies_is_much() {
        assert!(is_much(1, 2) && is_much(3, 4) && is_much(1, 0));
        assert!(!is_much(0, 0) && !is_much(0, 4) && !is_much(1, 3) && !is_much(2, 5));
    }
}
