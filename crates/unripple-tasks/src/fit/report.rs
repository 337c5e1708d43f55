//! Report of the task `fit`.

use serde::Serialize;
use std::fmt::Write;
use unripple::core::Surface;
use unripple_calibrate::{Estimate, Fitted, FittedLoad, Verdict};

/// Report on a fitted model, in SI units.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    program: &'static str,
    version: &'static str,
    command: &'static str,
    library: String,
    surface: String,
    verdict: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<String>,
    unexplained: f64,
    residual_over_noise: f64,
    tension_n_per_m: Value,
    bending_stiffness_n_m: Value,
    anisotropy: Value,
    profile: Vec<Term>,
    decay: Vec<DecayTime>,
    actuators: Vec<Load>,
    strays: Vec<Load>,
    /// Reasons why probed points contradict the model; these points are left out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
    /// Reasons to doubt the measurement as a whole.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<String>,
    /// Other notes on the fit.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    modes: usize,
    seconds: f64,
    /// The library that was written, if one was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<Written>,
    /// Why the fit counts as failed, if it does.
    #[serde(skip)]
    pub(super) failure: Option<String>,
}

/// The library that the fit wrote.
#[derive(Clone, Debug, Serialize)]
pub struct Written {
    /// Path of the library's folder.
    pub library: String,
    /// Number of points in the library.
    pub points: usize,
}

/// A value and its standard error.
#[derive(Clone, Copy, Debug, Serialize)]
struct Value {
    value: f64,
    error: f64,
}

#[derive(Clone, Debug, Serialize)]
struct Term {
    half_waves: [u32; 2],
    share: Value,
}

#[derive(Clone, Debug, Serialize)]
struct DecayTime {
    frequency_hz: f64,
    time_s: Value,
}

#[derive(Clone, Debug, Serialize)]
struct Load {
    name: String,
    at_m: [Value; 2],
    /// Distance from the place in the surface file, in m; absent for a stray mass.
    #[serde(skip_serializing_if = "Option::is_none")]
    off_m: Option<f64>,
    mass_kg: Value,
    damping_n_s_per_m: Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    drive_gain: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sense_gain: Option<Value>,
}

impl From<Estimate> for Value {
    fn from(Estimate { value, error }: Estimate) -> Self {
        Self { value, error }
    }
}

impl Value {
    /// `3.21 ± 0.05` in some unit.
    fn text(self, scale: f64, digits: usize) -> String {
        format!("{:.digits$} ± {:.digits$}", self.value * scale, self.error * scale)
    }
}

impl Load {
    fn of(name: String, load: &FittedLoad) -> Self {
        Self {
            name,
            at_m: load.at.map(Value::from),
            off_m: None,
            mass_kg: load.mass.into(),
            damping_n_s_per_m: load.damping.into(),
            drive_gain: None,
            sense_gain: None,
        }
    }

    fn text(&self) -> String {
        let [x, y] = self.at_m.map(|c| c.value * 1e3);
        let mut text = format!("  {:<8} {x:7.2}, {y:6.2} mm", self.name);
        if let Some(off) = self.off_m {
            let _ = write!(text, ", off by {:.2}", off * 1e3);
        }
        let _ = write!(text, "; mass {} mg", self.mass_kg.text(1e6, 2));
        let _ = write!(text, ", damping {} mN·s/m", self.damping_n_s_per_m.text(1e3, 2));
        if let (Some(drive), Some(sense)) = (self.drive_gain, self.sense_gain) {
            let _ = write!(text, ", drive gain {:.4}, sensor gain {:.4}", drive.value, sense.value);
        }
        text
    }
}

impl Report {
    pub(super) fn of(library: &str, nominal: &Surface, fitted: &Fitted, seconds: f64) -> Self {
        let (verdict, why) = match &fitted.verdict {
            Verdict::Good => ("good", None),
            Verdict::Doubtful { why, .. } => ("doubtful", Some(why.clone())),
        };
        let actuators = nominal.actuators.iter().zip(&fitted.actuators).map(|(actuator, load)| {
            let [x, y] = load.at.map(|c| c.value);
            Load {
                off_m: Some((x - actuator.at.x).hypot(y - actuator.at.y)),
                drive_gain: Some(load.drive.into()),
                sense_gain: Some(load.sense.into()),
                ..Load::of(actuator.name.clone(), load)
            }
        });
        let profile = fitted.profile.iter().map(|(waves, e)| Term { half_waves: *waves, share: (*e).into() });
        let decay =
            fitted.decay.iter().map(|(hz, time)| DecayTime { frequency_hz: *hz, time_s: (*time).into() });
        Self {
            program: "unripple",
            version: env!("CARGO_PKG_VERSION"),
            command: "fit",
            library: library.to_owned(),
            surface: nominal.name.clone(),
            verdict,
            why,
            unexplained: fitted.unexplained(),
            residual_over_noise: fitted.excess,
            tension_n_per_m: fitted.tension.into(),
            bending_stiffness_n_m: fitted.bending_stiffness.into(),
            anisotropy: fitted.anisotropy.into(),
            profile: profile.collect(),
            decay: decay.collect(),
            actuators: actuators.collect(),
            strays: (fitted.strays.iter().enumerate())
                .map(|(n, load)| Load::of(format!("stray {}", n + 1), load))
                .collect(),
            left_out: Vec::new(),
            doubts: Vec::new(),
            notes: Vec::new(),
            modes: fitted.modal().poles.len(),
            seconds,
            written: None,
            failure: None,
        }
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = format!(
            "{}: fitted to {} in {:.0} s: {}",
            self.surface, self.library, self.seconds, self.verdict
        );
        if let Some(why) = &self.why {
            let _ = write!(text, " ({why})");
        }
        let _ = writeln!(
            text,
            "\n  unexplained  {:.2} % of the signal amplitude, residual {:.1} times the noise",
            100.0 * self.unexplained,
            self.residual_over_noise
        );
        let _ = writeln!(text, "  tension      {} N/m", self.tension_n_per_m.text(1.0, 3));
        let _ = writeln!(text, "  anisotropy   {} %", self.anisotropy.text(100.0, 3));
        let _ = writeln!(text, "  bending      {} mN·m", self.bending_stiffness_n_m.text(1e3, 4));
        if let Some(most) = self.profile.iter().map(|t| t.share.value.abs()).max_by(f64::total_cmp) {
            let _ = writeln!(
                text,
                "  variation    {} cosine terms of the tension, up to {:.2} % each",
                self.profile.len(),
                100.0 * most
            );
        }
        for decay in &self.decay {
            let _ = writeln!(
                text,
                "  decay        {} ms at {:.0} Hz",
                decay.time_s.text(1e3, 1),
                decay.frequency_hz
            );
        }
        for load in self.actuators.iter().chain(&self.strays) {
            let _ = writeln!(text, "{}", load.text());
        }
        for why in &self.left_out {
            let _ = writeln!(text, "  left out     {why}");
        }
        for doubt in &self.doubts {
            let _ = writeln!(text, "  doubtful     {doubt}");
        }
        for note in &self.notes {
            let _ = writeln!(text, "  note         {note}");
        }
        if let Some(written) = &self.written {
            let _ = writeln!(text, "wrote {}: {} points", written.library, written.points);
        }
        text
    }

    fn failure(&self) -> Option<String> {
        self.failure.clone()
    }
}
