//! Contrast against window, bandwidth, number of actuators and noise (the paper's tradeoffs).

use super::section::row;
use super::{Compared, PaperSetup, Picture, Predicted, Section};
use crate::study::{
    self, CELLS, ContrastModel, Sampling, StudyError, against_band, against_noise, against_window,
};
use serde_json::{Value, json};
use std::f64::consts::PI;
use unripple::core::{FOCAL_RADIUS, Surface};
use unripple::physics::Medium;
use unripple::physics::design::Cavity;
use unripple_plot::{Axis, Dash, Figure, Ink, Layer, Line, Mark, Plot, Points, Rgb, Rule};
use unripple_tasks::TaskError;

/// Simulated numbers of actuators, in powers of two, since contrast grows with their square root.
const ACTUATORS: [usize; 6] = [1, 2, 4, 8, 16, 32];
/// Simulated windows, in seconds: from before the contrast settles to where it no longer grows, about
/// evenly in their logarithm.
const WINDOWS: [f64; 8] = [0.005, 0.0075, 0.0125, 0.020, 0.030, 0.050, 0.085, 0.150];
/// Simulated tops of the band, as shares of the top of the surface's band.
const BANDS: [f64; 7] = [0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];
/// Simulated ratios of the rms noise to the rms response.
const NOISES: [f64; 7] = [0.03, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2];
/// Largest number of groups into which placements are divided to find the standard error of their mean.
/// Fewer would leave their spread uncertain, more make groups of too few placements.
const GROUPS: usize = 10;
/// Number of pieces of a smooth curve: more cannot be seen at the width of a column.
const STEPS: usize = 80;

/// Mean contrast over random placements with its standard error, and the predictions of the closed forms.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Statistic {
    /// Number of actuators N.
    pub actuators: usize,
    /// Value of the parameter that was varied, in SI units.
    pub varied: f64,
    /// Mean of the simulated contrast over placements and targets.
    pub simulated: f64,
    /// Standard error of `simulated`.
    pub error: f64,
    /// Contrast predicted by the refined closed form, [`Cavity`].
    pub predicted: f64,
    /// Contrast predicted by the plain closed form, without the refinements for mode density, mode shapes
    /// and the first return of waves.
    pub plain: f64,
}

impl From<StudyError> for TaskError {
    fn from(error: StudyError) -> Self {
        Self::work(error)
    }
}

/// Repeats a study over groups of placements, each group with its own seed; returns means over all
/// placements, with standard errors from the spread of the groups.
pub fn statistics<F>(placements: usize, study: F) -> Result<Vec<Statistic>, TaskError>
where
    F: Fn(&Sampling) -> Result<Vec<study::Compared>, StudyError>,
{
    let groups = placements.clamp(1, GROUPS);
    let sizes: Vec<usize> = (0..groups).map(|g| (placements + g) / groups).collect();
    let sampled =
        |(size, seed): (&usize, u64)| study(&Sampling { placements: *size, seed, ..Sampling::default() });
    let found = sizes.iter().zip(1..).map(sampled).collect::<Result<Vec<_>, _>>()?;
    let Some(first) = found.first() else { return Ok(Vec::new()) };
    let join = |(i, row): (usize, &study::Compared)| {
        let weighted = |f: &dyn Fn(f64) -> f64| -> f64 {
            let terms = sizes.iter().zip(&found).map(|(size, rows)| *size as f64 * f(rows[i].simulated));
            terms.sum::<f64>() / placements as f64
        };
        let mean = weighted(&|c| c);
        let error = (weighted(&|c| (c - mean).powi(2)) / (groups - 1) as f64).sqrt();
        Statistic {
            actuators: row.actuators,
            varied: row.varied,
            simulated: mean,
            error,
            predicted: row.predicted,
            plain: row.plain,
        }
    };
    Ok(first.iter().enumerate().map(join).collect())
}

/// Makes the part of the page on section 3.1: contrast against window, actuators, bandwidth and noise,
/// simulated and by closed form.
pub fn section(setup: &PaperSetup, placements: usize) -> Result<Section, TaskError> {
    let surface = &setup.surface;
    let model = ContrastModel::of(surface, CELLS)?;
    let kept = (surface.actuators.len(), setup.window);
    let top = surface.emission.band[1];
    let tops = BANDS.map(|share| share * top);
    let cavity = Cavity::of(surface, top).counted(model.modes() as f64);
    let windows = statistics(placements, |s| Ok(against_window(&model, surface, &WINDOWS, &ACTUATORS, s)))?;
    let bands = statistics(placements, |s| against_band(&model, surface, &tops, kept, s))?;
    let noises = statistics(placements, |s| Ok(against_noise(&model, surface, &NOISES, kept, s)))?;
    let averaged =
        format!("mean of {placements} placements of the actuators along the rim, four targets each");
    Ok(Section {
        title: "Section 3.1: contrast".into(),
        text: text(surface, setup.window),
        figures: vec![
            Picture::still(
                "contrast-window",
                window_figure(&windows, &cavity),
                format!(
                    "Contrast against the window T for 1 to 32 actuators. Marks: simulation, {averaged}, bars its standard \
                     error. Lines: closed form, nothing fitted. Dotted: the slope of √T."
                ),
            ),
            Picture::still(
                "contrast-band-noise",
                others_figure(&bands, &noises, |ratio| cavity.noisy(kept.0 as f64, kept.1, ratio)),
                format!(
                    "Contrast against the top of the band (a) and against noise in the transducers (b), {} actuators and \
                     {:.0} ms. Marks: simulation, {averaged}. Lines: closed form.",
                    kept.0,
                    setup.window * 1e3
                ),
            ),
        ],
        compared: [
            exponents(&windows, setup.window, model.modes() as f64 / top),
            vec![halving(&windows, &noises, setup.window)],
        ]
        .concat(),
        predicted: departures(&windows, &bands, surface),
        table: table(&windows, setup.window),
        data: data(&windows, &bands, &noises),
    })
}

fn data(windows: &[Statistic], bands: &[Statistic], noises: &[Statistic]) -> Value {
    json!({ "against_window_s": windows, "against_band_hz": bands, "against_noise_ratio": noises })
}

/// Smooth line of the closed form `form` over the range of `rows`.
pub fn curve(rows: &[Statistic], form: impl Fn(f64) -> f64) -> Line {
    let ends = rows.first().zip(rows.last()).map_or([1.0; 2], |(a, b)| [a.varied, b.varied]);
    let place = |i: usize| ends[0] * (ends[1] / ends[0]).powf(i as f64 / STEPS as f64);
    let x: Vec<f64> = (0..=STEPS).map(place).collect();
    Line { y: x.iter().map(|x| form(*x)).collect(), x, ..Line::default() }
}

/// Marks with error bars for the simulated values, with the line of the closed form, in one colour.
pub fn series(rows: &[Statistic], line: Line, label: &str, ink: Ink, mark: Mark) -> [Layer; 2] {
    let line = Line { label: label.into(), ink, dash: Dash::Solid, ..line };
    let points = Points {
        x: rows.iter().map(|r| r.varied).collect(),
        y: rows.iter().map(|r| r.simulated).collect(),
        error: rows.iter().map(|r| [r.error, r.error]).collect(),
        label: label.into(),
        ink,
        mark,
    };
    [line.into(), points.into()]
}

fn window_figure(rows: &[Statistic], cavity: &Cavity) -> Figure {
    let mut layers: Vec<Layer> = Vec::new();
    for (i, n) in ACTUATORS.iter().enumerate() {
        let ink = Ink::Graded(i as f64 / (ACTUATORS.len() - 1) as f64);
        let rows = of(rows, *n);
        let line = curve(&rows, |window| cavity.contrast(*n as f64, window));
        layers.extend(series(&rows, line, &format!("N = {n}"), ink, Mark::Disc));
    }
    if let Some(start) = of(rows, 32).first() {
        let x = vec![start.varied, 4.0 * start.varied];
        let y = vec![1.12 * start.simulated, 2.0 * 1.12 * start.simulated];
        let (ink, dash) = (Ink::Rgb(Rgb::GREY), Dash::Dotted);
        layers.push(Line { x, y, label: "∝ √T".into(), ink, dash, ..Line::default() }.into());
    }
    Figure {
        width_mm: 120.0,
        description: "Contrast against window for 1, 2, 4, 8, 16 and 32 actuators: simulated marks on the lines of the \
                      closed form, all flatter than the square root of T"
            .into(),
        ..Figure::of(Plot {
            x: Axis::log("Window T (ms)").times(1e3),
            y: Axis::log("Contrast"),
            layers,
            ..Plot::default()
        })
    }
}

fn others_figure(bands: &[Statistic], noises: &[Statistic], noisy: impl Fn(f64) -> f64) -> Figure {
    let panel = |rows: &[Statistic], line: Line, x: Axis, rule: Option<Rule>| {
        let mut layers: Vec<Layer> = rule.into_iter().map(Layer::from).collect();
        layers.extend(series(rows, line, "", Ink::Palette(0), Mark::Disc));
        Plot { x, y: Axis::new("Contrast").from(0.0), layers, ..Plot::default() }
    };
    // The count of modes is a staircase in the band, so that this form is known where it was simulated.
    let by_band = Line {
        x: bands.iter().map(|r| r.varied).collect(),
        y: bands.iter().map(|r| r.predicted).collect(),
        ..Line::default()
    };
    let equal = Rule { at: 1.0, label: "as loud as the response".into(), ..Rule::default() };
    Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![
            panel(bands, by_band, Axis::new("Top of the band (kHz)").times(1e-3), None).into(),
            panel(noises, curve(noises, noisy), Axis::log("Noise over response, rms"), Some(equal)).into(),
        ],
        description: "Contrast rises with bandwidth, and falls with transducer noise only once that is about as strong as \
                      the responses themselves"
            .into(),
        ..Figure::default()
    }
}

/// The rows with this number of actuators.
pub fn of(rows: &[Statistic], actuators: usize) -> Vec<Statistic> {
    rows.iter().filter(|r| r.actuators == actuators).copied().collect()
}

fn at(rows: &[Statistic], actuators: usize, varied: f64) -> Option<Statistic> {
    rows.iter().find(|r| r.actuators == actuators && (r.varied / varied - 1.0).abs() < 1e-9).copied()
}

/// Exponents of simulation and closed form between two rows whose parameters have the ratio `ratio`.
fn slopes(from: Option<Statistic>, to: Option<Statistic>, ratio: f64) -> Option<[f64; 2]> {
    let (from, to) = (from?, to?);
    let slope = |a: f64, b: f64| (b / a).ln() / ratio.ln();
    Some([slope(from.simulated, to.simulated), slope(from.predicted, to.predicted)])
}

fn exponents(windows: &[Statistic], window: f64, heisenberg: f64) -> Vec<Compared> {
    let found = |s: Option<[f64; 2]>| {
        s.map_or("-".into(), |[here, form]| format!("{here:.2} simulated, {form:.2} by closed form"))
    };
    let in_window = |from: f64, to: f64| found(slopes(at(windows, 8, from), at(windows, 8, to), to / from));
    let (shortest, short, long, longest) = (WINDOWS[0], WINDOWS[3], WINDOWS[5], WINDOWS[7]);
    vec![
        Compared::new(
            format!("exponent of T, {:.0} to {:.0} ms, N = 8", shortest * 1e3, short * 1e3),
            "1/2",
            in_window(shortest, short),
            format!(
                "√T needs T far below the Heisenberg time, {:.0} ms, and the decay time",
                heisenberg * 1e3
            ),
        ),
        Compared::new(
            format!("exponent of T, {:.0} to {:.0} ms, N = 8", long * 1e3, longest * 1e3),
            "contrast reaches a limit",
            in_window(long, longest),
            "agrees: what is recorded after the decay time adds nothing",
        ),
        Compared::new(
            format!("exponent of N, 1 to 8, T = {:.0} ms", window * 1e3),
            "1/2",
            found(slopes(at(windows, 1, window), at(windows, 8, window), 8.0)),
            "the tail of the focus itself, the same for any N, takes a share of what is outside",
        ),
    ]
}

/// The largest relative deviation of a closed form (selected by `pick`) from the simulation, with its sign,
/// in per cent.
pub fn departure(rows: &[Statistic], pick: fn(&Statistic) -> f64) -> f64 {
    let departures = rows.iter().map(|r| 100.0 * (pick(r) / r.simulated - 1.0));
    departures.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
}

fn departures(windows: &[Statistic], bands: &[Statistic], surface: &Surface) -> Vec<Predicted> {
    let refined = |rows: &[Statistic]| departure(rows, |r| r.predicted);
    let narrow = bands.first().map_or(f64::NAN, |r| r.varied);
    let disc = PI * (FOCAL_RADIUS * Medium::of(&surface.sheet).lambda_min(narrow)).powi(2);
    vec![
        Predicted::new(
            "closed form from simulation, over T and N",
            format!("{:+.1} % at most", refined(windows)),
            format!("{} conditions; nothing in it is fitted", windows.len()),
        ),
        Predicted::new(
            "closed form from simulation, over the band",
            format!("{:+.1} % at most", refined(bands)),
            format!(
                "it speaks of many modes and a small disc; in a band to {narrow:.0} Hz the disc is as large as {:.0} % of the sheet",
                100.0 * disc / surface.outline.area()
            ),
        ),
    ]
}

/// The noise at which contrast is half of what it is without.
fn halving(windows: &[Statistic], noises: &[Statistic], window: f64) -> Compared {
    let clean = noises.first().and_then(|r| at(windows, r.actuators, window));
    let half = clean.map_or(f64::NAN, |r| r.simulated / 2.0);
    let crossing = noises.windows(2).find(|pair| pair[0].simulated >= half && pair[1].simulated < half);
    let ratio = crossing.map(|pair| {
        let share = (pair[0].simulated - half) / (pair[0].simulated - pair[1].simulated);
        pair[0].varied * (pair[1].varied / pair[0].varied).powf(share)
    });
    Compared::new(
        "transducer noise that halves the contrast",
        "none for perfect reconstruction",
        ratio.map_or("more than was tried".into(), |r| format!("{r:.1} times the response, rms")),
        "the focus adds up in phase over all of the recording and all actuators, noise does not",
    )
}

fn table(rows: &[Statistic], window: f64) -> Vec<Vec<String>> {
    let heading = format!("N, at T = {:.0} ms", window * 1e3);
    let headings = row([&heading, "contrast simulated", "closed form", "plain closed form"]);
    let cells = |n: &usize| {
        at(rows, *n, window).map(|r| {
            vec![
                n.to_string(),
                format!("{:.1} ± {:.1}", r.simulated, r.error),
                format!("{:.1}", r.predicted),
                format!("{:.1}", r.plain),
            ]
        })
    };
    std::iter::once(headings).chain(ACTUATORS.iter().filter_map(cells)).collect()
}

fn text(surface: &Surface, window: f64) -> Vec<String> {
    vec![
        format!(
            "The paper reasons that contrast grows as √(NT) while T is below the decay time. It does not print a curve; these \
             are ours, on {} with force actuators placed at random along the rim. Contrast is the focal velocity over \
             the rms velocity beyond 4/3 of the shortest wavelength at the same instant.",
            surface.name
        ),
        format!(
            "Plain closed form, with B the band, M its modes, n̄ = M/B and e = J₀² + J₁² of the disc's edge: \
             1/C² = (coth(T/τ) + 4τ/n̄)/(2NBτ) + e/M. The lines refine it with the growth of the mode density over the \
             band, the shapes of a rectangle's modes and the time of the first return. The square-root laws are the limit of T \
             far below both τ and n̄, and a {:.0} ms window on this surface is never there.",
            window * 1e3
        ),
    ]
}
