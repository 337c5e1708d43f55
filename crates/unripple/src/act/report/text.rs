//! Reports as text and as Markdown.

use super::{CoilHeat, Report, played};
use crate::Touch;
use crate::act::{Felt, Sound, at_most, note};
use crate::field::{Similarity, TakenOn, TargetFigures, Threshold};
use std::fmt::Write;

impl Report {
    /// The report as text for a terminal: one block of metrics per target (for waveforms and strokes, lines
    /// on how well they are followed), then drive and notes.
    pub fn text(&self) -> String {
        let mut text = format!("{}{}\n", self.surface, self.how());
        for target in self.foci() {
            let [x, y] = target.at_m;
            let many = if target.points > 1 { format!(", {} points", target.points) } else { String::new() };
            let _ = writeln!(
                text,
                "\ntarget ({:.2}, {:.2}) mm{many}, in focus at {:.3} ms",
                x * 1e3,
                y * 1e3,
                target.instant_s * 1e3
            );
            if let Some(line) = self.elsewhere(target) {
                let _ = writeln!(text, "  {line}");
            }
            for [name, velocity, displacement, felt] in rows(target) {
                let _ = writeln!(text, "  {name:<22}{velocity:>16}{displacement:>18}{felt:>14}");
            }
        }
        self.played().iter().for_each(|line| text.extend(["\n", line, "\n"]));
        for finger in &self.fingers {
            let _ = writeln!(text, "\n{}", finger_line(finger));
        }
        let _ = writeln!(text, "\n{}", self.drive_line());
        for line in [self.ssim_line(), self.sound_line()].into_iter().flatten() {
            let _ = writeln!(text, "{line}");
        }
        if let Some(line) = self.level_line() {
            let _ = writeln!(text, "{line}");
        }
        if let Some(line) = self.felt_line() {
            let _ = writeln!(text, "{line}");
        }
        if let Some(line) = self.error_line() {
            let _ = writeln!(text, "{line}");
        }
        for note in &self.notes {
            let _ = writeln!(text, "note ({}): {}", note.topic, note.text);
        }
        text
    }

    /// The report as Markdown, with links to its pictures.
    pub fn markdown(&self) -> String {
        let mut text = format!("# {}{}\n\n", self.surface, self.how());
        self.foci().iter().for_each(|target| self.target(target, &mut text));
        self.played().iter().for_each(|line| text.extend([line, "\n\n"]));
        for finger in &self.fingers {
            let _ = writeln!(text, "{}\n", finger_line(finger));
        }
        if let Some(line) = self.felt_line() {
            let _ = writeln!(text, "{line}\n");
        }
        for line in [self.ssim_line(), self.sound_line()].into_iter().flatten() {
            let _ = writeln!(text, "{line}\n");
        }
        let _ = writeln!(text, "## Drive\n\n{}\n", self.drive_line());
        for line in self.level_line().into_iter().chain(self.error_line()) {
            let _ = writeln!(text, "{line}\n");
        }
        text += "| channel | actuator | at mm | unit |\n|---:|---|---|---|\n";
        for (i, a) in self.actuators.iter().enumerate() {
            let _ = writeln!(
                text,
                "| {} | {} | ({:.2}, {:.2}) | {} |",
                i + 1,
                a.name,
                a.at_m[0] * 1e3,
                a.at_m[1] * 1e3,
                a.unit
            );
        }
        if !self.notes.is_empty() {
            text += "\n## Notes\n\n";
            for note in &self.notes {
                let _ = writeln!(text, "- **{}**: {}", note.topic, note.text);
            }
        }
        for file in self.files.iter().filter(|file| file.ends_with(".png")) {
            let _ = write!(text, "\n![{}]({file})\n", file.trim_end_matches(".png"));
        }
        if self.foci().is_empty() {
            return text;
        }
        text += "\nContrast: the peak over the rms outside every focal disc at the same instant. Background contrast: the peak \
            over the rms there during the whole time evaluated. Worst spot: the peak over the largest magnitude there during \
            that time. As felt: displacement weighted by the threshold of touch, in dB above it; ratios in dB.\n";
        text
    }

    /// The block of one target in Markdown.
    fn target(&self, target: &TargetFigures, text: &mut String) {
        let [x, y] = target.at_m;
        let _ = writeln!(
            text,
            "## Target ({:.2}, {:.2}) mm, in focus at {:.3} ms\n",
            x * 1e3,
            y * 1e3,
            target.instant_s * 1e3
        );
        if target.points > 1 {
            let _ = writeln!(text, "{} points; levels are means over them.\n", target.points);
        }
        if let Some(line) = self.elsewhere(target) {
            let _ = writeln!(text, "{line}\n");
        }
        *text += "| | velocity | displacement | as felt |\n|---|---:|---:|---:|\n";
        for [name, velocity, displacement, felt] in rows(target).into_iter().skip(1) {
            let _ = writeln!(text, "| {name} | {velocity} | {displacement} | {felt} |");
        }
        text.push('\n');
    }

    /// The line on the accuracy of the responses.
    fn error_line(&self) -> Option<String> {
        self.response_error.map(|error| format!("error of the responses: {}", at_most(error)))
    }

    /// The targets whose metrics are those of a focus: none for waveforms or a stroke.
    fn foci(&self) -> &[TargetFigures] {
        let played = self.stroke.is_some() || !self.waveforms.is_empty();
        if played { &[] } else { &self.targets }
    }

    /// The lines on waveforms, silence and a stroke.
    fn played(&self) -> Vec<String> {
        played::lines(&self.waveforms, &self.silent, self.stroke.as_ref(), &self.targets)
    }

    fn how(&self) -> String {
        let mut parts = Vec::new();
        parts.extend(self.method.map(|method| format!(", {method}")));
        parts.extend(self.window_s.map(|window| format!(", window {:.3} ms", window * 1e3)));
        parts.extend(self.period_s.map(|period| format!(", period {:.3} ms", period * 1e3)));
        parts.extend(self.judged_on.iter().map(|surface| format!(", simulated on {surface}")));
        parts.concat()
    }

    /// The line on the strongest motion outside the focal discs, and on how much of the surface that is.
    fn elsewhere(&self, target: &TargetFigures) -> Option<String> {
        let ([x, y], at, ratio) = (target.worst_spot_at_m?, target.worst_spot_time_s?, target.worst_spot?);
        let of = match self.taken_on {
            TakenOn::Grid => "of the surface",
            TakenOn::Library => "of the library's points",
        };
        Some(format!(
            "strongest elsewhere: {:.0} % of the peak velocity, at ({:.1}, {:.1}) mm and {:.3} ms; the focal discs leave {:.0} % {of}",
            100.0 / ratio,
            x * 1e3,
            y * 1e3,
            at * 1e3,
            100.0 * self.outside_share
        ))
    }

    /// The line on what is felt elsewhere than at the targets; none for a stroke, whose other pulses are
    /// elsewhere.
    fn felt_line(&self) -> Option<String> {
        let outside = self.felt_outside_db.filter(|_| self.stroke.is_none())?;
        let level = match outside > 0.0 {
            true => format!("up to {outside:.0} dB above"),
            false => format!("at least {:.0} dB below", -outside),
        };
        let of = "felt outside the focal discs";
        if self.notes.iter().any(|told| told.topic == note::FELT) {
            return Some(format!(
                "{of}: {level} the threshold of sustained vibration, which does not apply here (see the note)"
            ));
        }
        let reached = self.targets.iter().any(|target| target.felt_level_db.is_some_and(|level| level > 0.0));
        let what = match (outside > 0.0, reached) {
            (true, _) => "it may be felt elsewhere than at the targets",
            (false, true) => "nothing is felt except at the targets",
            (false, false) => "nothing is felt, not even at the targets",
        };
        let persons = Threshold::BETWEEN_PERSONS_DB;
        Some(format!(
            "{of}: {level} threshold: {what} (thresholds differ between persons by about ±{persons} dB)"
        ))
    }

    /// The line on how alike the vibration and the targets are.
    fn ssim_line(&self) -> Option<String> {
        let Similarity { peak_velocity, rms_velocity, target_gaussian_m } = self.ssim?;
        Some(format!(
            "structural similarity: {peak_velocity:.3} of the map of largest velocities, {rms_velocity:.3} of that of rms velocities, with a \
             Gaussian of standard deviation {:.2} mm at every target",
            target_gaussian_m * 1e3
        ))
    }

    fn sound_line(&self) -> Option<String> {
        self.sound.as_ref().map(Sound::text)
    }

    fn level_line(&self) -> Option<String> {
        let unit = self.actuators.first().map_or("", |a| a.unit);
        self.level.as_ref().map(|level| level.text(unit, self.thickness))
    }

    fn drive_line(&self) -> String {
        let unit = self.actuators.first().map_or("", |a| a.unit);
        let d = &self.drive;
        let power =
            self.mean_mechanical_power_w.map_or(String::new(), |power| format!(", {}", power_text(power)));
        let heat = self.coil_heat.map_or(String::new(), |heat| format!(", {}", heat_text(heat)));
        format!(
            "drive: peak {}{unit}, rms {}{unit}, energy {:.4e} {unit}²s, {:.2} % of it above the band{power}{heat}",
            prefixed(d.peak),
            prefixed(d.rms),
            d.energy,
            100.0 * d.share_above_band
        )
    }
}

/// Mean mechanical power into the sheet, in words.
fn power_text(power: f64) -> String {
    format!("{}W of mechanical power into the sheet on average", prefixed(power))
}

/// Mean heat in the coils, in words.
fn heat_text(heat: CoilHeat) -> String {
    let most = if heat.at_most { "at most " } else { "" };
    format!(
        "{most}{}W of heat in the coils on average, {}W in the one that takes most",
        prefixed(heat.total_w),
        prefixed(heat.largest_w)
    )
}

/// A number with the prefix of the unit that follows it.
fn prefixed(value: f64) -> String {
    let found = [("", 0.1), ("m", 1e-4), ("µ", 1e-7)].into_iter().find(|(_, least)| value.abs() >= *least);
    match found {
        Some(("", _)) => format!("{value:.4} "),
        Some(("m", _)) => format!("{:.3} m", value * 1e3),
        Some((prefix, _)) => format!("{:.3} {prefix}", value * 1e6),
        None => format!("{value:.3e} "),
    }
}

/// The line on a finger: its sensation and the power that it absorbs.
fn finger_line(finger: &Felt) -> String {
    let Touch { at_m: [x, y], peak_displacement_m, peak_force_n, peak_power_w, energy_j, .. } = finger.loaded;
    format!(
        "finger ({:.2}, {:.2}) mm: {:.2} µm, {:.3} N, {:.4} W at most, {:.3e} J absorbed; without it the velocity there would \
         be {:.2} times and the displacement {:.2} times as large",
        x * 1e3,
        y * 1e3,
        peak_displacement_m * 1e6,
        peak_force_n,
        peak_power_w,
        energy_j,
        finger.velocity_attenuation,
        finger.displacement_attenuation
    )
}

/// A value as text by `said`, or "unknown" if it is NaN.
fn known(value: f64, said: impl Fn(f64) -> String) -> String {
    if value.is_nan() { "unknown".into() } else { said(value) }
}

/// Rows of the table of a target's metrics: name, and values for velocity, displacement and felt level,
/// headings first.
fn rows(t: &TargetFigures) -> Vec<[String; 4]> {
    let ratio = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.2}"));
    let scaled = |x: Option<f64>, factor: f64, unit: &str| {
        x.map_or("-".into(), |x| format!("{:.3} {unit}", x * factor))
    };
    // Thresholds differ by ±6 dB between persons; ratios of levels are as certain as tenths.
    let felt = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.1} dB"));
    let row = |name: &str, v: String, u: String, f: String| [name.to_owned(), v, u, f];
    vec![
        row("", "velocity".into(), "displacement".into(), "as felt".into()),
        row(
            "peak",
            known(t.peak_velocity_m_s, |v| format!("{v:.4} m/s")),
            known(t.peak_displacement_m, |u| format!("{:.2} µm", u * 1e6)),
            felt(t.felt_level_db),
        ),
        row(
            "largest at",
            format!("{:.3} ms", t.peak_time_s * 1e3),
            format!("{:.3} ms", t.displacement_peak_time_s * 1e3),
            format!("{:.3} ms", t.felt_peak_time_s * 1e3),
        ),
        row("contrast", ratio(t.contrast), ratio(t.displacement_contrast), felt(t.felt_contrast_db)),
        row(
            "background contrast",
            ratio(t.background_contrast),
            ratio(t.displacement_background_contrast),
            felt(t.felt_background_db),
        ),
        row("worst spot", ratio(t.worst_spot), ratio(t.displacement_worst_spot), felt(t.felt_worst_spot_db)),
        row(
            "spot diameter",
            scaled(t.spot_diameter_m, 1e3, "mm"),
            scaled(t.displacement_spot_diameter_m, 1e3, "mm"),
            "-".into(),
        ),
        row(
            "spot area",
            scaled(t.spot_area_m2, 1e6, "mm²"),
            scaled(t.displacement_spot_area_m2, 1e6, "mm²"),
            "-".into(),
        ),
        row("focus offset", scaled(t.focus_offset_m, 1e3, "mm"), "-".into(), "-".into()),
        row(
            "pulse duration",
            scaled(t.pulse_duration_s, 1e3, "ms"),
            scaled(t.displacement_pulse_duration_s, 1e3, "ms"),
            "-".into(),
        ),
    ]
}
