//! `unripple compare`: every method on the same targets.

mod figure;
mod front;
mod row;

use crate::args::CompareOptions;
use crate::error::CliError;
use crate::focus::finish;
use crate::reads::Reads;
use crate::targets::{self, of_window, seconds};
use crate::{figures, input, judge, output};
use row::Row;
use serde::Serialize;
use unripple::act::{Level, chosen_window};
use unripple::core::{Responses, Surface};
use unripple::focus::{Method, Options, Target};
use unripple_store::OutputDir;

/// Everything that is compared with.
pub struct Ground<'a> {
    pub surface: &'a Surface,
    /// What drives are made from.
    pub known: &'a Responses,
    /// What they are judged on.
    pub plant: &'a Responses,
    pub targets: &'a [Target],
    pub options: &'a Options,
    /// How strongly each method drives.
    pub level: Level,
}

/// All methods, one row each, and what a method's knob trades.
#[derive(Debug, Serialize)]
struct Comparison {
    program: &'static str,
    version: &'static str,
    command: &'static str,
    surface: String,
    window_s: f64,
    /// Why it is that, where nobody asked for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    window_why: Option<String>,
    judged_to_hz: f64,
    methods: Vec<Row>,
    fronts: Vec<front::Front>,
    /// What is felt elsewhere against the drive that it takes, time reversal first.
    felt: Vec<Row>,
    files: Vec<String>,
}

pub fn run(options: &CompareOptions, as_json: bool) -> Result<(), CliError> {
    let surface = input::surface(&options.surface)?;
    let out = options.output.as_ref();
    let out = out.map(|place| OutputDir::create_beside(place, &options.reads())).transpose()?;
    let known = judge::model(&surface, None, &[])?;
    let targets = targets::all(&options.targets, known.conditions().lambda_min)?;
    let judged_to = options.judge_hz.unwrap_or(2.0 * surface.emission.band[1]);
    let plant = judge::model(&surface, Some(judged_to), &[])?;
    let asked = seconds(options.window_ms, "--window-ms")?;
    let chosen = asked.is_none().then(|| chosen_window(&surface, &known));
    let window = asked.or(chosen.as_ref().map(|chosen| chosen.seconds)).unwrap_or_default();
    targets::carries(known.conditions(), window, "--window-ms")?;
    let (limit, rms_limit) = (surface.emission.limit, surface.emission.rms_limit);
    let settings = Options { window, limit, rms_limit, ..Options::default() };
    let level = targets::level(&options.targets)?;
    let ground = Ground {
        surface: &surface,
        known: &known,
        plant: &plant,
        targets: &targets,
        options: &settings,
        level,
    };
    let rows = Method::ALL.iter().map(|m| row::judge(&ground, *m)).collect::<Result<Vec<_>, _>>();
    let mut rows = rows.map_err(|error| of_window(error, asked.is_some()))?;
    row::relate(&mut rows);
    let fronts = front::all(&ground)?;
    let felt = front::felt(&ground)?;

    let mut files = Vec::new();
    let mut found = Comparison {
        program: "unripple",
        version: env!("CARGO_PKG_VERSION"),
        command: "compare",
        surface: surface.name.clone(),
        window_s: window,
        window_why: chosen.as_ref().map(|chosen| chosen.why.clone()),
        judged_to_hz: judged_to,
        methods: rows,
        fronts,
        felt,
        files: Vec::new(),
    };
    let conditions = row::Conditions { window, judged_to, level };
    let mut text = row::table(&found.methods, conditions);
    if let Some(chosen) = &chosen {
        text += &format!("\nwindow {}\n", chosen.text());
    }
    if let Some(out) = out {
        files.extend(figures::write(
            &out,
            &[("compare", figure::draw(&found.methods, &found.fronts, &found.felt))],
        )?);
        found.files = files;
        out.write("report.json", output::json(&found)?.as_bytes())?;
        out.write("report.md", row::markdown(&found.surface, &found.methods, conditions).as_bytes())?;
        finish(out)?;
    }
    output::answer(as_json, &found, &text)
}
