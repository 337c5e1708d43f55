//! Closed-form figures of a surface, recomputed after each edit.

use crate::physics::design::Design;
use serde::Serialize;

/// One computed quantity of a surface, as `unripple design` prints it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// Key of the quantity in JSON.
    pub key: &'static str,
    /// Name of the quantity in reports.
    pub label: &'static str,
    /// Value of the quantity, in `unit`.
    pub value: f64,
    /// The unit; empty for a pure number.
    pub unit: &'static str,
    /// The value as it is printed, without the unit.
    pub text: String,
}

/// The main figures of a design, for display after each edit; the most important first.
pub fn figures(design: &Design) -> Vec<Figure> {
    let d = design;
    let figure = |key, label, value: f64, unit, decimals: usize| Figure {
        key,
        label,
        value,
        unit,
        text: format!("{value:.decimals$}"),
    };
    let (modes, by) = match d.mode_count_exact {
        Some(count) => (count as f64, "modes in the band, counted"),
        None => (d.mode_count_weyl, "modes in the band, by Weyl's law"),
    };
    let mut all = vec![
        figure("contrast_predicted", "contrast predicted", d.contrast_predicted, "", 1),
        figure("contrast_endless", "the same, at the best window", d.contrast_endless, "", 1),
        figure("window_recommended", "window recommended", d.window_recommended_s * 1e3, "ms", 1),
        figure("modes", by, modes, "", 0),
        figure("celerity_min", "phase velocity, bottom of the band", d.celerity_min_m_s, "m/s", 2),
        figure("celerity_max", "phase velocity, top of the band", d.celerity_max_m_s, "m/s", 2),
        figure("lambda_min", "shortest wavelength", d.lambda_min_m * 1e3, "mm", 2),
        figure("spot_diameter", "spot, full width at half maximum", d.spot_diameter_m * 1e3, "mm", 1),
        figure("pulse_duration", "pulse, full width at half maximum", d.pulse_duration_s * 1e3, "ms", 3),
        figure("heisenberg_time", "Heisenberg time", d.heisenberg_time_s * 1e3, "ms", 0),
        figure("decay_time", "decay time", d.decay_time_s * 1e3, "ms", 1),
    ];
    // Weyl's law counts many modes well, but not the first.
    if d.mode_count_exact.is_some() {
        all.push(figure("first_mode", "first mode", d.first_mode_hz, "Hz", 1));
    }
    if let Some(touch) = d.touch.last() {
        let label = "power to move a finger by 10 µm at the shortest wavelength";
        all.push(figure("finger_power", label, touch.power_w, "W", 3));
    }
    let thickness = d.deformation.linear_limit_thickness_m * 1e6;
    all.push(figure(
        "linear_limit_thickness",
        "linear theory up to a displacement of (thickness)",
        thickness,
        "µm",
        0,
    ));
    if let Some(limit) = d.deformation.linear_limit_tension_m {
        let label = "a focus raises the tension by a tenth at";
        all.push(figure("linear_limit_tension", label, limit * 1e6, "µm", 0));
    }
    all
}
