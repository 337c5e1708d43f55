//! Fig. 4 of the paper: two foci at once, one repeated at 5 Hz and one at 2 Hz.

mod figures;
mod repeated;

use self::figures::{closely, closely_caption, overview, overview_caption};
use self::repeated::{AMPLITUDE, Pulse, RATES, Repeated, Tracked, mean};
use super::fields::largest;
use super::modes::{closed_contrast, modal};
use super::section::{Compared, Picture, Predicted, Section};
use super::setup::PaperSetup;
use serde_json::json;
use unripple::physics::design::closed;
use unripple_dsp::rms;
use unripple_tasks::TaskError;

/// Makes the part of the page on Fig. 4: pulses at point E five times and at point D twice a second, and
/// the motion elsewhere.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let repeated = Repeated::make(setup)?;
    let point = |p: &Tracked| {
        let noise = p.noise(setup);
        json!({
            "name": p.name, "at_m": [p.at.x, p.at.y], "hz": p.hz, "pulses_m": p.pulses(setup),
            "noise_rms_m": rms(&noise), "noise_peak_m": largest(&noise),
        })
    };
    let points: Vec<_> = repeated.points.iter().map(point).collect();
    let figures = vec![
        Picture::still("fig4", overview(setup, &repeated), overview_caption(setup, &repeated)),
        Picture::still("fig4-pulses", closely(setup, &repeated), closely_caption()),
    ];
    Ok(Section {
        title: "Fig. 4: two foci, at 5 Hz and at 2 Hz".into(),
        figures,
        compared: compared(setup, &repeated),
        predicted: predicted(setup, &repeated)?,
        table: table(setup, &repeated),
        data: json!({ "period_s": repeated.period, "largest_force_n": repeated.drive.peak(), "pulses": repeated.pulses, "points": points }),
        text: vec![
            format!(
                "One drive repeats a focus at E {} times and another at D {} times a second, for {:.2} s; both come together once in {:.0} s. \
                 The weight of D and the level of the whole are set so that the pulses measured from the emitted drive are {:.0} µm high \
                 on average at both. All figures are taken once the motion is steady.",
                RATES[0],
                RATES[1],
                repeated.drive.duration(),
                repeated.period,
                AMPLITUDE * 1e6
            ),
            "The caption of the paper's figure names the foci E (5 Hz) and D (2 Hz), its text E (2 Hz) and F (5 Hz). The caption is followed \
             here. Where the five points lay is not given; these are our own."
                .into(),
        ],
    })
}

fn um(metres: f64) -> String {
    format!("{:.1}", metres * 1e6)
}

fn table(setup: &PaperSetup, repeated: &Repeated) -> Vec<Vec<String>> {
    let headings =
        ["point", "at mm", "focus at", "pulses µm: mean (least–greatest)", "noise rms µm", "noise peak µm"];
    let row = |point: &Tracked| {
        let (pulses, noise) = (point.pulses(setup), point.noise(setup));
        let (least, greatest) =
            pulses.iter().fold((f64::INFINITY, 0.0), |(l, g): (f64, f64), p| (l.min(*p), g.max(*p)));
        vec![
            point.name.to_owned(),
            format!("({:.0}, {:.0})", point.at.x * 1e3, point.at.y * 1e3),
            point.hz.map_or("-".into(), |hz| format!("{hz} Hz")),
            if pulses.is_empty() {
                "-".into()
            } else {
                format!("{} ({}–{})", um(mean(&pulses)), um(least), um(greatest))
            },
            um(rms(&noise)),
            um(largest(&noise)),
        ]
    };
    let headings = headings.map(str::to_owned).to_vec();
    std::iter::once(headings).chain(repeated.points.iter().map(row)).collect()
}

fn compared(setup: &PaperSetup, repeated: &Repeated) -> Vec<Compared> {
    let heights: Vec<String> =
        repeated.foci().map(|p| format!("{} in {}", um(mean(&p.pulses(setup))), p.name)).collect();
    let noise = |points: &mut dyn Iterator<Item = &Tracked>| {
        let levels: Vec<[f64; 2]> = points.map(|p| p.noise(setup)).map(|n| [rms(&n), largest(&n)]).collect();
        [0, 1].map(|i| levels.iter().map(|l| um(l[i])).collect::<Vec<_>>().join(", "))
    };
    let [rms_foci, _] = noise(&mut repeated.foci());
    let [rms_others, peak_others] = noise(&mut repeated.others());
    vec![
        Compared::new(
            "pulses (displacement), µm",
            "40",
            heights.join(", "),
            format!("set so, in {} rounds; equal as measured from the emitted drive", repeated.rounds),
        ),
        Compared::new(
            "noise at other points, µm",
            "as in the foci",
            format!(
                "rms {rms_others}, at most {peak_others} (A, B, C); in the foci between pulses rms {rms_foci} (E, D)"
            ),
            "agrees: noise is everywhere of about one size; rms over all of the steady part, quieter spells between pulses included",
        ),
    ]
}

fn predicted(setup: &PaperSetup, repeated: &Repeated) -> Result<Vec<Predicted>, TaskError> {
    let contrasts = |of: fn(&Pulse) -> f64| {
        let when = |together| {
            let pulses = repeated.pulses.iter().filter(|p| p.together == together);
            pulses.map(|p| format!("{:.1} in {}", of(p), p.name)).collect::<Vec<_>>().join(", ")
        };
        format!("alone {}; together {}", when(false), when(true))
    };
    let count = setup.surface.actuators.len();
    let single = closed_contrast(setup, modal(&setup.responses)?, count);
    let form = single
        .map_or("-".into(), |c| format!("{c:.1} for one focus, {:.1} for two at once", closed::foci(c, 2.0)));
    Ok(vec![
        Predicted::new(
            "contrast of a pulse, velocity",
            contrasts(|p| p.contrast),
            format!("once steady; closed form {form}"),
        ),
        Predicted::new(
            "contrast of a pulse, displacement",
            contrasts(|p| p.displacement_contrast),
            "lower than in velocity: displacement favours the lowest modes, of which there are few to cancel each other",
        ),
        Predicted::new(
            "largest force, mN",
            format!("{:.1}", repeated.drive.peak() * 1e3),
            "per actuator, ideal forces without moving mass",
        ),
    ])
}
