//! Fig. 2 of the paper: one actuator in a reverberant cavity, and a triangle.

mod focus;
mod ratio;
mod triangle;

pub use triangle::triangle;

use self::focus::focused;
use self::ratio::ratio;
use super::fields::{cells, first};
use super::modes::{FORCE, actuator, driven_at, modal};
use super::places::place;
use super::section::{Compared, Picture, Predicted, Section};
use super::setup::PaperSetup;
use serde_json::{Value, json};
use unripple::core::{ModalResponses, Pole, window_samples};
use unripple::field::{self, Aim, Field, Snapshot, TargetFigures};
use unripple::focus::Target;
use unripple::physics::design::closed;
use unripple_plot::{Along, Axis, Colours, Figure, Ink, Legend, Line, Plot, Rule, Traces, prefixed};
use unripple_tasks::TaskError;
use unripple_tasks::figures::{Scene, drawn};
use unripple_tasks::judge::CELLS;

/// Index of the only actuator that is driven.
const ACTUATOR: usize = 0;

/// Decay time of the more reverberant film, relative to that of the paper's film.
const LONGER: f64 = 5.0;

/// Time after the focus for which the tail is evaluated, in seconds.
const FOLLOWED: f64 = 1.2;

/// Length over which the rms level of the tail is averaged, in seconds.
const SMOOTHED: f64 = 5e-3;

/// Level, relative to the peak, below which the tail counts as over.
const OVER: f64 = 0.01;

/// A focus of one actuator, with its field and the tail that follows.
struct Alone {
    tau: f64,
    trace: Vec<f64>,
    figures: TargetFigures,
    shot: Snapshot,
    cells: field::Grid,
}

impl Alone {
    /// Focuses on the setup's target through a surface with decay `factor` times as long, and follows the tail.
    fn make(setup: &PaperSetup, modal: &ModalResponses, factor: f64) -> Result<Self, TaskError> {
        let slower = |pole: &Pole| Pole { sigma: pole.sigma / factor, ..*pole };
        let poles: Vec<Pole> = modal.poles.iter().map(slower).collect();
        let tau = 1.0 / poles.iter().map(|pole| pole.sigma).fold(f64::INFINITY, f64::min);
        let ringing = ModalResponses { poles, ..modal.clone() };
        let responses = driven_at(&ringing, actuator(modal, ACTUATOR)?);
        let focused = focused(setup, &responses, Target::at(setup.target))?;
        let drive = focused.drive.as_emitted();
        let field = Field::new(&responses, &drive, CELLS).map_err(TaskError::work)?;
        let mut measured =
            field.measure(&[Aim::at(setup.target, setup.window)], None).map_err(TaskError::work)?;
        let traces = field.traces(&[setup.target], setup.window + FOLLOWED).map_err(TaskError::work)?;
        let trace = traces.into_iter().next().map(|trace| trace.velocity).unwrap_or_default();
        let shot = snapshot(&mut measured.maps.at_peak)?;
        Ok(Self { tau, trace, figures: first(measured.targets)?, shot, cells: cells(&field)? })
    }

    fn data(&self, setup: &PaperSetup) -> Value {
        json!({ "decay_time_s": self.tau, "figures": self.figures, "tail_s": self.over_after(setup) })
    }

    /// Rms velocity over [`SMOOTHED`] seconds around each sample, relative to the peak.
    fn levels(&self, rate: f64) -> Vec<f64> {
        let half = window_samples(SMOOTHED / 2.0, rate);
        let mut sums = vec![0.0];
        for v in &self.trace {
            sums.push(sums[sums.len() - 1] + v * v);
        }
        let last = self.trace.len();
        let level = |i: usize| {
            let (from, to) = (i.saturating_sub(half), (i + half + 1).min(last));
            ((sums[to] - sums[from]) / (to - from) as f64).sqrt() / self.figures.peak_velocity_m_s
        };
        (0..last).map(level).collect()
    }

    /// Time after the focus at which the tail's level is last above [`OVER`], in seconds; `None` if that is
    /// beyond the evaluated time.
    fn over_after(&self, setup: &PaperSetup) -> Option<f64> {
        let levels = self.levels(setup.rate);
        let last = levels.iter().rposition(|level| *level > OVER)?;
        let free = last + 1 + window_samples(SMOOTHED, setup.rate) < levels.len();
        free.then(|| last as f64 / setup.rate - setup.window)
    }
}

fn snapshot(shots: &mut Vec<Snapshot>) -> Result<Snapshot, TaskError> {
    if shots.is_empty() {
        return Err(TaskError::Work("no field was measured at the focus".into()));
    }
    Ok(shots.swap_remove(0))
}

/// Makes the part of the page on Fig. 2a: one actuator gives a good focus with a short window, followed by
/// a long tail of noise.
pub fn one_actuator(setup: &PaperSetup) -> Result<Section, TaskError> {
    let modal = modal(&setup.responses)?;
    let papers = Alone::make(setup, modal, 1.0)?;
    let ringing = Alone::make(setup, modal, LONGER)?;
    let figures = vec![
        Picture::still(
            "fig2a",
            focus_and_tail(setup, modal, [&papers, &ringing])?,
            alone_caption(setup, modal, &papers, &ringing)?,
        ),
        Picture::still(
            "fig2a-tail",
            decay(setup, [&papers, &ringing]),
            tail_caption(setup, &papers, &ringing),
        ),
    ];
    let text = format!(
        "The paper's figure does not say how reverberant its cavity is. Here it is the film of its section 4 twice: as it is (amplitude decay \
         time τ = {:.0} ms), and ringing {LONGER:.0} times longer (τ = {:.0} ms), the same modes otherwise. Both are driven from one \
         actuator with the same T = {:.0} ms.",
        papers.tau * 1e3,
        ringing.tau * 1e3,
        setup.window * 1e3
    );
    Ok(Section {
        title: "Fig. 2a: one actuator in a highly reverberant cavity".into(),
        figures,
        compared: alone_compared(setup, modal, &papers, &ringing),
        predicted: vec![Predicted::new(
            "largest noise anywhere outside, from 0 to 2T",
            both([&papers, &ringing], |film| {
                film.figures.worst_spot.map_or("-".into(), |w| format!("peak / {w:.1}"))
            }),
            "a maximum, which the rms of contrast does not show",
        )],
        text: vec![text],
        data: json!([papers.data(setup), ringing.data(setup)]),
        ..Section::default()
    })
}

fn focus_and_tail(
    setup: &PaperSetup,
    modal: &ModalResponses,
    films: [&Alone; 2],
) -> Result<Figure, TaskError> {
    let [_, ringing] = films;
    let only = actuator(modal, ACTUATOR)?;
    let mut surface = setup.surface.clone();
    surface.actuators.retain(|a| a.name == only.name);
    let scene = Scene::new(&surface, &[vec![setup.target]], 0.0);
    let (multiplier, unit) = prefixed(ringing.figures.peak_velocity_m_s, "m/s");
    let colours = Colours { title: format!("Velocity ({unit})"), multiplier, ..Colours::default() };
    let map = scene.map(
        drawn(&ringing.cells, &ringing.shot.velocity),
        format!("t = T, τ = {:.0} ms", ringing.tau * 1e3),
        colours,
    );
    let trace = |(i, film): (usize, &&Alone)| unripple_plot::Trace {
        label: format!("τ = {:.0} ms", film.tau * 1e3),
        values: film.trace.clone(),
        ink: Ink::Palette(1 - i),
    };
    let tails = Traces {
        x: Axis::new("Time from focus (ms)").times(1e3),
        start: -setup.window,
        step: 1.0 / setup.rate,
        traces: films.iter().enumerate().map(trace).collect(),
        unit,
        multiplier,
        title: "velocity at the target".into(),
        lane_mm: Some(26.0),
        ..Traces::default()
    };
    Ok(Figure {
        width_mm: 178.0,
        columns: 2,
        panels: vec![map.into(), tails.into()],
        description: "Velocity of the film at the focus of one actuator, and the tail of noise that follows"
            .into(),
        ..Figure::default()
    })
}

fn decay(setup: &PaperSetup, films: [&Alone; 2]) -> Figure {
    let mut layers = vec![Rule { at: OVER, along: Along::X, ..Rule::default() }.into()];
    for (i, film) in films.into_iter().enumerate() {
        let levels: Vec<f64> =
            film.levels(setup.rate).into_iter().map(|l| if l > 0.0 { l } else { f64::NAN }).collect();
        let x = (0..levels.len()).map(|i| i as f64 / setup.rate - setup.window).collect();
        let label = format!("τ = {:.0} ms", film.tau * 1e3);
        layers.push(Line { x, y: levels, label, ink: Ink::Palette(1 - i), ..Line::default() }.into());
    }
    let plot = Plot {
        x: Axis::new("Time from focus (ms)").times(1e3),
        y: Axis::log("Rms velocity, of the peak").from(OVER / 10.0).to(1.0),
        layers,
        legend: Legend::Above,
        height_mm: Some(42.0),
        ..Plot::default()
    };
    Figure { description: "How the noise at the target dies out after the focus".into(), ..Figure::of(plot) }
}

fn shown(time: Option<f64>) -> String {
    time.map_or_else(|| format!("more than {:.0} ms", FOLLOWED * 1e3), |t| format!("{:.0} ms", t * 1e3))
}

fn alone_caption(
    setup: &PaperSetup,
    modal: &ModalResponses,
    papers: &Alone,
    ringing: &Alone,
) -> Result<String, TaskError> {
    let only = actuator(modal, ACTUATOR)?;
    Ok(format!(
        "Fig. 2a. One actuator, {} at {} (square), focusing on {} (cross) with a force of {:.0} mN at most. (a) Velocity \
         when the waves meet, where the film rings with τ = {:.0} ms: contrast {}. (b) Velocity at the target, in the \
         paper's film (contrast {}) and in the more reverberant one.",
        only.name,
        place(only.at),
        place(setup.target),
        FORCE * 1e3,
        ringing.tau * 1e3,
        ratio(ringing.figures.contrast),
        ratio(papers.figures.contrast)
    ))
}

fn tail_caption(setup: &PaperSetup, papers: &Alone, ringing: &Alone) -> String {
    format!(
        "The tail of Fig. 2a: rms velocity at the target over {:.0} ms, of the peak. It is last above {:.0} % (dashed) {} after the \
         focus in the paper's film and {} after it in the more reverberant one.",
        SMOOTHED * 1e3,
        OVER * 100.0,
        shown(papers.over_after(setup)),
        shown(ringing.over_after(setup))
    )
}

/// Text with a quantity of both films, each with its decay time.
fn both(films: [&Alone; 2], of: impl Fn(&Alone) -> String) -> String {
    films.map(|film| format!("{} (τ = {:.0} ms)", of(film), film.tau * 1e3)).join(", ")
}

fn alone_compared(
    setup: &PaperSetup,
    modal: &ModalResponses,
    papers: &Alone,
    ringing: &Alone,
) -> Vec<Compared> {
    let band = modal.conditions.band;
    let form =
        |window| closed::contrast(1.0, band[1] - band[0], ringing.tau, window, modal.poles.len() as f64);
    let films = [papers, ringing];
    vec![
        Compared::new(
            "focus of one actuator: contrast",
            "good",
            both(films, |film| ratio(film.figures.contrast)),
            format!(
                "closed form for the longer ringing: {:.1} with this T, {:.1} with ten times it; a short recording gives most of what \
                 there is to gain, ringing longer hardly any",
                form(setup.window),
                form(10.0 * setup.window)
            ),
        ),
        Compared::new(
            format!("tail above {:.0} % of the peak", OVER * 100.0),
            "long",
            both(films, |film| shown(film.over_after(setup))),
            "the waves ring on after the focus and die out with τ: a focus repeated sooner meets what is left of the one before",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Past the focus the level falls as e^{-t/τ}: from just after it to [`OVER`] takes τ ln(level/OVER).
    #[test]
    fn tails_last_as_long_as_their_decay_times_say() {
        let setup = PaperSetup::new().unwrap();
        let modal = modal(&setup.responses).unwrap();
        for factor in [1.0, 3.0] {
            let film = Alone::make(&setup, modal, factor).unwrap();
            let levels = film.levels(setup.rate);
            let at = |t: f64| window_samples(setup.window + t, setup.rate);
            let early = &levels[at(10e-3)..at(30e-3)];
            let level = early.iter().sum::<f64>() / early.len() as f64;
            let expected = 20e-3 + film.tau * (level / OVER).ln();
            let found = film.over_after(&setup).unwrap();
            assert!((found / expected - 1.0).abs() < 0.2, "{found} against {expected}");
        }
    }

    #[test]
    fn a_triangle_stands_out_everywhere_along_it() {
        let setup = PaperSetup::new().unwrap();
        let data = triangle(&setup).unwrap().data;
        let contrast = data["figures"]["contrast"].as_f64().unwrap();
        let least = data["least_and_greatest_velocity_of_mean"][0].as_f64().unwrap();
        assert!(least * contrast > 1.0, "{least} of {contrast}");
    }
}
