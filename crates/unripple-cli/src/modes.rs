//! `unripple modes`: frequencies and decay times.

use crate::args::ModesOptions;
use crate::error::CliError;
use crate::targets::positive;
use crate::{input, output};
use serde_json::json;
use std::fmt::Write;
use unripple::physics::Modes;

/// Modes listed for people; `--json` lists all.
const LISTED: usize = 40;

pub fn run(options: &ModesOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let top = positive(options.max_hz.unwrap_or(surface.emission.band[1]), "--max-hz", "Hz")?;
    let modes = Modes::solve(&surface, top, options.accuracy).map_err(CliError::input)?;
    let (frequencies, decays) = (modes.frequencies_hz(), modes.decay_times());
    let finite: Vec<Option<f64>> = decays.iter().map(|t| t.is_finite().then_some(*t)).collect();
    let report = json!({
        "surface": surface.name,
        "max_hz": top,
        "count": frequencies.len(),
        "frequencies_hz": frequencies,
        "decay_times_s": finite,
        "bending_shares": modes.bending_shares(),
        "relative_error": modes.error(),
    });
    let mut text = format!("{}: {} modes up to {top} Hz\n", surface.name, frequencies.len());
    text += "  mode   frequency Hz   decay time ms   bending share %\n";
    for (i, hz) in frequencies.iter().enumerate().take(LISTED) {
        let share = 100.0 * modes.bending_shares()[i];
        let _ = writeln!(text, "{:6} {hz:14.4} {:15.3} {share:17.3}", i + 1, decays[i] * 1e3);
    }
    if frequencies.len() > LISTED {
        let _ = writeln!(text, "   ... and {} more; --json lists all", frequencies.len() - LISTED);
    }
    output::answer(as_json, &report, &text)
}
