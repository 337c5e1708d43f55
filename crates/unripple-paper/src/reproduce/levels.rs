//! Section 4: displacement and electric power of the focus.

use super::section::{row, three};
use super::{Compared, PaperSetup, Picture, Predicted, Section, coils};
use serde::Serialize;
use serde_json::json;
use std::f64::consts::{PI, TAU};
use unripple::act::power;
use unripple::core::Drive;
use unripple::field::{Aim, Field, Measured};
use unripple::focus::{Method, Options, Target, focus};
use unripple::physics::design::{Deformation, Strip, deformation};
use unripple_plot::{Along, Axis, Dash, Figure, Ink, Layer, Line, Plot, Rgb, Rule, prefixed};
use unripple_tasks::TaskError;
use unripple_tasks::judge;

/// The paper's two amplitudes, in metres: the one that it measured, and the one that it says could be
/// reached by scaling up.
const LEVELS: [f64; 2] = [40e-6, 200e-6];
/// Force per current of the paper's actuators, in N/A, as the paper prints it.
const FORCE_CONSTANT: f64 = 6.0;
/// Resistance of their coils, in Ω, as the paper prints it.
const RESISTANCE: f64 = 6.2;

/// The drive of one method at its limit, with the metrics of its field.
struct Played {
    method: Method,
    drive: Drive,
    measured: Measured,
    /// Mean mechanical power that the actuators give to the sheet, in W.
    power: f64,
}

/// Force and power that one level takes with one method.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Level {
    method: &'static str,
    displacement_m: f64,
    peak_force_n: f64,
    rms_force_n: f64,
    /// Mean heat in all coils over the window with the printed force constant, in W.
    mean_coil_heat_printed_w: f64,
    /// Mean heat in all coils over the window with the largest force constant that such coils can reach, in
    /// W.
    mean_coil_heat_reachable_w: f64,
    /// Mean mechanical power over the window, in W.
    mean_mechanical_power_w: f64,
    contrast: Option<f64>,
}

/// Makes the part of the page on the 40 µm and 200 µm cases of section 4: force, power, strain and whether
/// linear theory holds.
pub fn section(setup: &PaperSetup) -> Result<Section, TaskError> {
    let played = [Method::TimeReversal, Method::OneBit].map(|method| play(setup, method));
    let [reversed, one_bit] = played;
    let played = [reversed?, one_bit?];
    let reachable = coils::judged(setup).reachable;
    let levels: Vec<Level> = played.iter().flat_map(|p| LEVELS.map(|level| p.at(level, reachable))).collect();
    let limits = deformation(&setup.surface);
    Ok(Section {
        title: "Section 4: 40 µm and 200 µm".into(),
        text: vec![scaling(setup, reachable), powers(setup)],
        figures: vec![Picture::still(
            "levels",
            figure(&played, &limits),
            "Peak displacement against the peak force of each actuator, a single focus. Above the film's thickness the \
             lines are what linear theory would say. Yield is that of a wave of the shortest wavelength.",
        )],
        compared: compared(&limits, &played[0]),
        predicted: predicted(setup, &levels, &limits),
        table: table(&levels, reachable),
        data: json!({ "levels": levels, "deformation": limits, "force_constant_reachable_n_per_a": reachable }),
    })
}

fn play(setup: &PaperSetup, method: Method) -> Result<Played, TaskError> {
    let options =
        Options { method, window: setup.window, limit: setup.surface.emission.limit, ..Options::default() };
    let focused = focus(&setup.responses, &[Target::at(setup.target)], &options).map_err(TaskError::input)?;
    let drive = focused.drive.as_emitted();
    let field = Field::new(&setup.responses, &drive, judge::CELLS).map_err(TaskError::input)?;
    let measured = field.measure(&[Aim::at(setup.target, setup.window)], None).map_err(TaskError::input)?;
    let known = power(&setup.surface, &field, drive.duration())?;
    let power =
        known.ok_or_else(|| TaskError::Work("power: expected responses from modes, found samples".into()))?;
    drop(field);
    Ok(Played { method, drive, measured, power })
}

impl Played {
    /// Peak displacement at the target, in metres.
    fn displacement(&self) -> f64 {
        self.measured.targets.first().map_or(f64::NAN, |t| t.peak_displacement_m.abs())
    }

    /// The drive scaled to a peak displacement `level` in metres, with the heat of coils of the printed
    /// force constant and of the `reachable` one (N/A).
    fn at(&self, level: f64, reachable: f64) -> Level {
        let scale = level / self.displacement();
        let (peak, rms) = (self.drive.peak() * scale, self.drive.rms() * scale);
        let channels = self.drive.channels().len() as f64;
        let heat = |force_constant: f64| channels * RESISTANCE * (rms / force_constant).powi(2);
        Level {
            method: self.method.name(),
            displacement_m: level,
            peak_force_n: peak,
            rms_force_n: rms,
            mean_coil_heat_printed_w: heat(FORCE_CONSTANT),
            mean_coil_heat_reachable_w: heat(reachable),
            mean_mechanical_power_w: self.power * scale * scale,
            contrast: self.measured.targets.first().and_then(|t| t.displacement_contrast),
        }
    }
}

/// A value with a prefixed unit.
fn shown(value: f64, unit: &str) -> String {
    let (multiplier, unit) = prefixed(value, unit);
    format!("{} {unit}", three(value * multiplier))
}

fn table(levels: &[Level], reachable: f64) -> Vec<Vec<String>> {
    let headings = row([
        "peak",
        "method",
        "peak force",
        "rms force",
        &format!("heat in all coils with the printed {FORCE_CONSTANT} N/A, mean"),
        &format!("heat in all coils with {} N/A, within reach, mean", three(reachable)),
        "mechanical power, mean",
        "contrast (displacement)",
    ]);
    let cells = |l: &Level| {
        vec![
            format!("{:.0} µm", l.displacement_m * 1e6),
            l.method.to_owned(),
            shown(l.peak_force_n, "N"),
            shown(l.rms_force_n, "N"),
            shown(l.mean_coil_heat_printed_w, "W"),
            shown(l.mean_coil_heat_reachable_w, "W"),
            shown(l.mean_mechanical_power_w, "W"),
            l.contrast.map_or("-".into(), |c| format!("{c:.1}")),
        ]
    };
    std::iter::once(headings).chain(levels.iter().map(cells)).collect()
}

fn predicted(setup: &PaperSetup, levels: &[Level], limits: &Deformation) -> Vec<Predicted> {
    let mut rows: Vec<Predicted> = Vec::new();
    for level in levels.iter().filter(|l| l.method == Method::TimeReversal.name()) {
        let um = level.displacement_m * 1e6;
        rows.push(Predicted::new(
            format!("{um:.0} µm: force of each actuator"),
            format!("{} peak, {} rms", shown(level.peak_force_n, "N"), shown(level.rms_force_n, "N")),
            "a bare sheet, no finger on it, ideal actuators",
        ));
        rows.push(touch(setup, level.displacement_m));
        rows.extend(strain(limits, level.displacement_m));
    }
    rows
}

fn compared(limits: &Deformation, reversed: &Played) -> Vec<Compared> {
    let scaled = Compared::new(
        "200 µm by scaling up",
        "same contrast",
        format!("linear up to {:.0} µm at most", end_of_linear(limits) * 1e6),
        format!(
            "the sheet is {:.0} µm thick: beyond that it stretches as much as it bends, tension and wave speed rise with the \
             displacement, and the focus comes early and weaker than the scaled one",
            limits.linear_limit_thickness_m * 1e6
        ),
    );
    std::iter::once(scaled).chain(area(reversed)).collect()
}

/// A strip of the film as wide as the finger's contact, and the wavenumber of its shortest waves, in rad/m.
fn strip(setup: &PaperSetup) -> (Strip, f64) {
    let sheet = &setup.surface.sheet;
    let width = 2.0 * setup.surface.finger.contact_radius;
    let strip = Strip::of_sheet(sheet.young, sheet.density, sheet.thickness, sheet.tension, width);
    (strip, TAU / setup.responses.conditions().lambda_min)
}

/// Power of a wave of the shortest wavelength that moves the finger by `amplitude` metres (equation 4).
fn touch(setup: &PaperSetup, amplitude: f64) -> Predicted {
    let (finger, (strip, k)) = (&setup.surface.finger, strip(setup));
    let power = strip.power(finger, k, amplitude);
    let taken = power * strip.scattering(finger, k * strip.celerity(k) / TAU).absorbed_power;
    Predicted::new(
        format!("{:.0} µm under a finger: power at the shortest wavelength", amplitude * 1e6),
        format!("{} W to it, {} W into it", three(power), three(taken)),
        "equation 4; it grows with the square of the amplitude, and falls fast with wavelength",
    )
}

fn strain(limits: &Deformation, amplitude: f64) -> Option<Predicted> {
    let bend = limits.rows.iter().find(|bend| (bend.amplitude_m / amplitude - 1.0).abs() < 1e-9)?;
    let share =
        bend.share_of_yield.map_or("yield unknown".into(), |s| format!("{:.0} % of yield", 100.0 * s));
    let linear = if bend.linear { "linear theory holds" } else { "linear theory does not hold" };
    Some(Predicted::new(
        format!("{:.0} µm: strain of the film", amplitude * 1e6),
        format!("{:.3} %, {share}", 100.0 * bend.strain),
        format!(
            "tension, bending to {:.0} mm and stretching of a wave of the shortest wavelength, an upper bound; {linear}",
            bend.bending_radius_m * 1e3
        ),
    ))
}

fn area(reversed: &Played) -> Option<Compared> {
    let diameter = reversed.measured.targets.first()?.displacement_spot_diameter_m?;
    Some(Compared::new(
        "region displaced",
        "1 cm²",
        format!("{:.2} cm²", PI * diameter * diameter / 4.0 * 1e4),
        format!("full width at half maximum of the displacement, {:.1} mm", diameter * 1e3),
    ))
}

fn end_of_linear(limits: &Deformation) -> f64 {
    limits
        .linear_limit_tension_m
        .map_or(limits.linear_limit_thickness_m, |l| l.min(limits.linear_limit_thickness_m))
}

fn figure(played: &[Played], limits: &Deformation) -> Figure {
    let forces: Vec<f64> = (0..=40).map(|i| 1e-3 * 10f64.powf(i as f64 / 20.0)).collect();
    let across = |at: f64, label: &str, dash: Dash| -> Layer {
        Rule { at, along: Along::X, label: label.into(), dash, ink: Ink::Rgb(Rgb::GREY) }.into()
    };
    let mut layers: Vec<Layer> = Vec::new();
    layers.push(across(limits.linear_limit_thickness_m, "thickness", Dash::Dashed));
    layers.extend(limits.yield_amplitude_m.map(|at| across(at, "yield", Dash::DashDot)));
    layers.extend(LEVELS.map(|at| across(at, &format!("{:.0} µm", at * 1e6), Dash::Dotted)));
    for (i, p) in played.iter().enumerate() {
        let y = forces.iter().map(|force| p.displacement() / p.drive.peak() * force).collect();
        let label = p.method.name().into();
        layers.push(Line { x: forces.clone(), y, label, ink: Ink::Palette(i), ..Line::default() }.into());
    }
    Figure {
        width_mm: 120.0,
        description: "Peak displacement against peak force for time reversal and one-bit, with the sheet's thickness, its \
                      yield and the paper's two amplitudes"
            .into(),
        ..Figure::of(Plot {
            x: Axis::log("Peak force of each actuator (mN)").times(1e3),
            y: Axis::log("Peak displacement (µm)").times(1e6),
            layers,
            ..Plot::default()
        })
    }
}

/// Text on what scales with the level, and for what drive.
fn scaling(setup: &PaperSetup, reachable: f64) -> String {
    let [low, high] = LEVELS.map(|level| level * 1e6);
    format!(
        "The paper measured pulses of {low:.0} µm and says that {high:.0} µm follow by scaling up. In linear theory a drive scales \
         as it is, and so do force, strain and background; power goes with the square. Forces are for one pulse on the bare \
         film, {} actuators and a window of {:.0} ms. The heat in coils takes the paper's {RESISTANCE} Ω, and is given twice: with \
         the {FORCE_CONSTANT} N/A that the paper prints, and with the {} N/A that such a coil and magnet can reach (see the section \
         on coils), for the same forces.",
        setup.surface.actuators.len(),
        setup.window * 1e3,
        three(reachable)
    )
}

/// Text on the two powers, and why they differ by orders of magnitude.
fn powers(setup: &PaperSetup) -> String {
    let (finger, (strip, k)) = (&setup.surface.finger, strip(setup));
    let passed = strip.scattering(finger, k * strip.celerity(k) / TAU).transmission;
    format!(
        "The power of equation 4 is the crest of a steady wave of the shortest wavelength under a finger, which moves with \
         {passed:.2} of the wave's amplitude, while the mechanical power is the mean over the window of what all actuators give to \
         the bare film; they differ by orders of magnitude since the finger alone costs a factor of {:.0}, and since the film \
         stores what it is given for {:.0} ms and returns it in one short pulse, most of whose displacement is of longer waves.",
        passed.powi(-2),
        setup.window * 1e3
    )
}
