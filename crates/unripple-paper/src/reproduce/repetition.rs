//! Contrast of a repeated focus against its period.

use super::contrast::{Statistic, curve, departure, of, series, statistics};
use super::{Compared, PaperSetup, Picture, Predicted, Section};
use crate::study::{self, CELLS, ContrastModel, Sampling, against_period};
use serde_json::json;
use unripple::core::{Decay, Surface};
use unripple::physics::design::{Cavity, closed};
use unripple_plot::{Axis, Dash, Figure, Ink, Layer, Line, Mark, Plot};
use unripple_tasks::TaskError;

/// Simulated periods, as multiples of the surface's decay time.
const PERIODS: [f64; 9] = [0.25, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0];

/// Statistics and closed form of the film with one decay time.
struct Case {
    decay_time: f64,
    rows: Vec<Statistic>,
    cavity: Cavity,
    /// Modes in the band.
    modes: f64,
}

/// Makes the part of the page on section 3.2: contrast of a repeated focus, with the surface's decay time
/// and with the one that the paper recommends.
pub fn section(setup: &PaperSetup, placements: usize) -> Result<Section, TaskError> {
    let own = &setup.surface;
    let actuators = own.actuators.len();
    let short = setup.window / actuators as f64;
    let mut damped = own.clone();
    damped.sheet.decay = Decay::Time(short);
    let long = Cavity::of(own, own.emission.band[1]).decay_time();
    let periods = PERIODS.map(|share| share * long);
    let study = |surface: &Surface, model: &ContrastModel, s: &Sampling| {
        against_period(model, surface, setup.window, &periods, &[actuators], s)
    };
    let slow = case(own, long, study, placements)?;
    let quick = case(&damped, short, study, placements)?;
    Ok(Section {
        title: "Section 3.2: reverberation and repetition".into(),
        text: vec![format!(
            "Waves of one focus are still there at the next. The paper advises a decay time of about T/N, which is \
             {} here. A surface that dies out so fast repeats without loss, but each focus is gathered from less.",
            ms(short)
        )],
        figures: vec![Picture::still(
            "contrast-period",
            figure([&slow, &quick], setup.window, actuators as f64),
            format!(
                "Contrast of a focus repeated for ever against its period, {actuators} actuators and {}, for the \
                 surface's decay time and for the paper's advice. Marks: simulation over {placements} placements, bars \
                 the standard error. Lines: closed form. Dotted: the plain closed form.",
                ms(setup.window)
            ),
        )],
        compared: vec![compared(&slow, &quick)],
        predicted: vec![predicted(&slow, &quick)],
        data: json!({
            "decay_time_s": long,
            "against_period_s": slow.rows,
            "decay_time_paper_s": short,
            "against_period_s_with_papers_decay": quick.rows,
        }),
        ..Section::default()
    })
}

fn case<F>(surface: &Surface, decay_time: f64, study: F, placements: usize) -> Result<Case, TaskError>
where
    F: Fn(&Surface, &ContrastModel, &Sampling) -> Vec<study::Compared>,
{
    let model = ContrastModel::of(surface, CELLS)?;
    let modes = model.modes() as f64;
    let cavity = Cavity::of(surface, surface.emission.band[1]).counted(modes);
    let all = statistics(placements, |sampling| Ok(study(surface, &model, sampling)))?;
    Ok(Case { decay_time, rows: of(&all, surface.actuators.len()), cavity, modes })
}

fn ms(seconds: f64) -> String {
    format!("{} ms", (seconds * 1e5).round() / 1e2)
}

fn figure(cases: [&Case; 2], window: f64, n: f64) -> Figure {
    let mut layers: Vec<Layer> = Vec::new();
    for (i, case) in cases.into_iter().enumerate() {
        let (ink, mark) = (Ink::Palette(i), if i == 0 { Mark::Disc } else { Mark::Square });
        let (tau, bandwidth) = (case.decay_time, case.cavity.bandwidth());
        let plain =
            curve(&case.rows, |period| closed::repeated(n, bandwidth, tau, window, case.modes, period));
        layers.push(Line { ink, dash: Dash::Dotted, ..plain }.into());
        let line = curve(&case.rows, |period| case.cavity.repeated(n, window, period));
        layers.extend(series(&case.rows, line, &format!("τ = {}", ms(tau)), ink, mark));
    }
    Figure {
        width_mm: 120.0,
        description: "Contrast against period of repetition: with a long decay it rises with the period and levels off; with a \
                      short one it is the same at any period, and higher at the shortest only"
            .into(),
        ..Figure::of(Plot {
            x: Axis::log("Period (ms)").times(1e3),
            y: Axis::new("Contrast").from(0.0),
            layers,
            ..Plot::default()
        })
    }
}

fn compared(slow: &Case, quick: &Case) -> Compared {
    let ends = |rows: &[Statistic]| [rows.first(), rows.last()].map(|r| r.map_or(f64::NAN, |r| r.simulated));
    let [[fast_slow, rare_slow], [fast_quick, rare_quick]] = [slow, quick].map(|case| ends(&case.rows));
    let [fast, rare] = [slow.rows.first(), slow.rows.last()].map(|r| ms(r.map_or(f64::NAN, |r| r.varied)));
    let (long, short) = (ms(slow.decay_time), ms(quick.decay_time));
    let mut pairs = slow.rows.iter().zip(&quick.rows);
    let better = pairs.find(|(own, damped)| own.simulated >= damped.simulated);
    let from =
        better.map_or("no period tried".into(), |(own, _)| format!("periods from {} on", ms(own.varied)));
    Compared::new(
        "decay time to aim for",
        format!("about T/N ({short})"),
        format!("{long} is better for {from}"),
        format!(
            "every {fast}, contrast is {fast_slow:.1} with {long} and {fast_quick:.1} with T/N; every {rare}, {rare_slow:.1} and \
             {rare_quick:.1}. T/N pays only where foci follow each other within the window"
        ),
    )
}

fn predicted(slow: &Case, quick: &Case) -> Predicted {
    let refined = |case: &Case| departure(&case.rows, |r| r.predicted);
    Predicted::new(
        "closed form from simulation, over the period",
        format!("{:+.1} % at most; {:+.1} % with T/N", refined(slow), refined(quick)),
        format!(
            "the plain closed form, which counts every earlier and later pulse in full: {:+.1} % at most",
            departure(&slow.rows, |r| r.plain)
        ),
    )
}
