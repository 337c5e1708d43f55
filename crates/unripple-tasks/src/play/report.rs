//! Report of the task `play`: what was played and felt.

use serde::Serialize;
use std::fmt::Write;
use unripple::act::Note;
use unripple::core::{Server, State, Surface};
use unripple_calibrate::Drift;

use unripple_devices::Feeling;
use unripple_live::{Engine, Level, Percentiles, PlayState, Stage, Window};
use unripple_player::Count;

/// Report of a session of `play`, in SI units.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    surface: String,
    window_s: f64,
    /// Window that `design` recommends where the delay from touch to focus does not matter, in s.
    window_unhurried_s: f64,
    #[serde(skip)]
    window: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    full_level_db: Option<f64>,
    seconds: f64,
    fingers_down: u64,
    touches: u64,
    refused_touches: u64,
    cues: u64,
    failed_cues: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    last_failure: Option<String>,
    drives_made: u64,
    started: u64,
    limited: u64,
    least_limit: Option<f32>,
    waves_limited: u64,
    beyond_limit: u64,
    stale: u64,
    late: u64,
    refused: u64,
    lost_commands: u64,
    lost_blocks: u64,
    heavy_blocks: u64,
    block_s: f64,
    first_sample_s: Four,
    unknown_times: u64,
    focus_s: Four,
    making_s: Four,
    computing_s: Four,
    block_work_s: Four,
    felt: Felt,
    #[serde(skip_serializing_if = "Option::is_none")]
    tension: Option<Tension>,
    #[serde(skip_serializing_if = "Option::is_none")]
    priority: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    server: Option<ServerSays>,
    /// Notes on doubts about the library of responses that was used.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<Note>,
    /// What each finger felt when this was last sampled.
    #[serde(skip)]
    pub(super) feelings: Vec<Feeling>,
    /// Whether what fingers feel is known, as on a virtual surface.
    #[serde(skip)]
    tells_feelings: bool,
    /// Whether the library of responses has no scale, so that absolute levels are unknown.
    #[serde(skip)]
    pub without_scale: bool,
}

/// What a sound server reports of itself and of the session.
#[derive(Clone, Debug, Serialize)]
struct ServerSays {
    /// Duration of a process cycle at the end of the session.
    period_s: f64,
    /// Latency from our ports to the output, as the server reports it; not included in the other times of
    /// the report.
    playback_latency_s: f64,
    /// Number of late cycles that the server counted, whichever client caused them.
    late_cycles: u64,
    /// Number of cycles that ended before this program had done its part.
    own_late_cycles: u64,
    /// Time that the server skipped between cycles.
    skipped_s: f64,
    /// Real-time priority of the server's thread that calls this program.
    #[serde(skip_serializing_if = "Option::is_none")]
    real_time_priority: Option<u8>,
}

impl ServerSays {
    fn of(server: &Server, rate: f64) -> Self {
        Self {
            period_s: server.period as f64 / rate,
            playback_latency_s: server.playback as f64 / rate,
            late_cycles: server.late,
            own_late_cycles: server.own_late,
            skipped_s: server.skipped as f64 / rate,
            real_time_priority: server.priority,
        }
    }

    fn text(&self) -> String {
        let Self { period_s, playback_latency_s, late_cycles, own_late_cycles, skipped_s, .. } = self;
        let [period, latency, skipped] = [period_s, playback_latency_s, skipped_s].map(|s| 1e3 * s);
        format!(
            "\ntimes are those at the server's ports; it reports a playback latency of another {latency:.3} ms\nthe server: a \
             period of {period:.3} ms, {late_cycles} late cycles by its count of all clients, {skipped:.1} ms skipped between \
             cycles\nour own part of a cycle was late {own_late_cycles} times\n"
        )
    }
}

/// The 50th, 90th, 99th and 99.9th percentile and the maximum of a time; `null` if nothing was measured.
#[derive(Clone, Debug, Default, Serialize)]
struct Four {
    p50: Option<f64>,
    p90: Option<f64>,
    p99: Option<f64>,
    p999: Option<f64>,
    worst: Option<f64>,
}

impl Four {
    fn of(times: &Percentiles) -> Self {
        match times.four() {
            Some([p50, p99, p999, worst]) => Self {
                p50: Some(p50),
                p90: times.at(0.9),
                p99: Some(p99),
                p999: Some(p999),
                worst: Some(worst),
            },
            None => Self::default(),
        }
    }

    fn text(&self, name: &str) -> String {
        let ms = |value: Option<f64>| value.map_or("-".into(), |s| format!("{:.3}", 1e3 * s));
        let Self { p50, p90, p99, p999, worst } = self;
        let columns = [p50, p90, p99, p999, worst].map(|value| format!("{:>9}", ms(*value)));
        format!("  {name:<34}{}\n", columns.concat())
    }
}

/// Statistics of what fingers felt, over all samples in which one felt anything.
#[derive(Clone, Debug, Default, Serialize)]
struct Felt {
    looks: usize,
    level_db_median: Option<f64>,
    level_db_most: Option<f64>,
    contrast_median: Option<f64>,
    #[serde(skip)]
    levels: Vec<f64>,
    #[serde(skip)]
    contrasts: Vec<f64>,
}

/// Estimate of the tension at the end.
#[derive(Clone, Debug, Serialize)]
struct Tension {
    ratio: f64,
    explained: bool,
}

impl Report {
    pub(super) fn new(surface: &Surface, window: &Window, level: &Level) -> Self {
        Self {
            surface: surface.name.clone(),
            window_s: window.seconds,
            window_unhurried_s: window.unhurried,
            window: window.to_string(),
            full_level_db: level.full.map(|full| full.felt_db),
            ..Self::default()
        }
    }

    /// Samples the fingers' sensations, the tension and the device's state, and returns a line on them; empty if there is nothing to say.
    pub fn look(&mut self, stage: &mut Stage, play_state: Option<&PlayState>) -> String {
        let mut line = format!("{:7.1} s", stage.time());
        self.feelings = stage.feelings();
        for feeling in &self.feelings {
            self.felt.add(feeling);
            line += &told(feeling, self.without_scale);
        }
        if let Some(drift) = stage.drift() {
            let explained = !drift.needs_calibration();
            self.tension = Some(Tension { ratio: drift.tension(), explained });
            let _ = match drift {
                Drift::Followed { tension, .. } => write!(line, "  tension {tension:.5}"),
                Drift::Unexplained { .. } => write!(line, "  tension unknown: calibrate again"),
            };
        }
        if let Some(play_state) = play_state {
            self.lost_blocks = play_state.lost;
            self.priority = Some(play_state.priority.clone());
            if play_state.state != State::Running {
                let _ = write!(line, "  device {}", play_state.state);
            }
            let load = stage.conductor().desk().meters().load();
            if load > 0.7 {
                let _ = write!(line, "  load {:.0} %: close to overload", 100.0 * load);
            }
        }
        match self.feelings.is_empty()
            && play_state.is_none_or(|play_state| play_state.state == State::Running)
        {
            true => String::new(),
            false => line,
        }
    }

    /// Completes the report at the end of the session.
    pub fn finish(mut self, engine: &mut Engine) -> Self {
        let rate = engine.heart().device().layout().rate;
        self.block_s = engine.heart().device().layout().block as f64 / rate;
        self.block_work_s = Four::of(engine.heart().work());
        self.heavy_blocks = engine.heart().heavy();
        let status = engine.heart().device().status();
        self.lost_blocks = status.lost;
        self.server = status.server.map(|server| ServerSays::of(&server, rate));
        self.block_s = self.server.as_ref().map_or(self.block_s, |server| server.period_s);
        let stage = engine.stage();
        self.tells_feelings = stage.tells_feelings();
        let counts = stage.counts();
        (self.fingers_down, self.touches) = (counts.downs, counts.touches);
        self.refused_touches = counts.errors();
        self.seconds = stage.time();
        self.computing_s = Four::of(stage.computing());
        let conductor = stage.conductor();
        let tally = conductor.tally();
        self.drives_made = conductor.drives().making().count();
        self.making_s = Four::of(conductor.drives().making());
        self.first_sample_s = Four::of(&tally.first_sample);
        self.focus_s = Four::of(&tally.focus);
        self.unknown_times = tally.first_sample.unknown();
        (self.cues, self.failed_cues, self.last_failure) = (tally.cues, tally.failed, tally.failure.clone());
        (self.started, self.limited, self.least_limit) = (tally.started, tally.limited, tally.least);
        (self.waves_limited, self.beyond_limit) = (tally.waves_limited, tally.beyond);
        self.stale = tally.stale;
        (self.late, self.refused) = (tally.late, tally.refused);
        self.lost_commands = tally.lost + conductor.desk().meters().count(Count::ReportsLost);
        self.felt.settle(self.without_scale);
        self
    }
}

fn told(feeling: &Feeling, without_scale: bool) -> String {
    let level = match feeling.level_db {
        Some(_) if without_scale => "level unknown".into(),
        level => level.map_or("  silent".into(), |db| format!("{db:5.1} dB")),
    };
    let contrast = feeling.contrast.map_or("    -".into(), |contrast| format!("{contrast:5.1}"));
    let (x, y) = (feeling.at.x * 1e3, feeling.at.y * 1e3);
    format!("  finger {} at {x:.0},{y:.0}: {level}, contrast {contrast}", feeling.finger)
}

impl Felt {
    /// The report as text; `told` if a virtual surface computed what is felt, `without_scale` if its level
    /// is unknown.
    fn text(&self, told: bool, without_scale: bool) -> String {
        if !told {
            return "felt: unknown, since only a virtual surface can simulate it\n".into();
        }
        let db = |value: Option<f64>| value.map_or("-".into(), |db| format!("{db:.1}"));
        let [median, most, contrast] =
            [self.level_db_median, self.level_db_most, self.contrast_median].map(db);
        if without_scale {
            return format!("felt: level unknown, contrast {contrast}\n");
        }
        format!("felt: {median} dB above threshold (largest {most}), contrast {contrast}\n")
    }

    fn add(&mut self, feeling: &Feeling) {
        self.levels.extend(feeling.level_db.filter(|db| *db > 0.0));
        self.contrasts.extend(feeling.contrast);
    }

    fn settle(&mut self, without_scale: bool) {
        self.levels.sort_unstable_by(f64::total_cmp);
        self.contrasts.sort_unstable_by(f64::total_cmp);
        let middle = |values: &[f64]| values.get(values.len() / 2).copied();
        self.looks = self.levels.len();
        if !without_scale {
            self.level_db_median = middle(&self.levels);
            self.level_db_most = self.levels.last().copied();
        }
        self.contrast_median = middle(&self.contrasts);
    }
}

impl crate::Report for Report {
    fn text(&self) -> String {
        let mut text = format!(
            "{}: {:.1} s played, {} fingers put down in {} touch events, {} cues, {} drives made\n",
            self.surface, self.seconds, self.fingers_down, self.touches, self.cues, self.drives_made
        );
        let _ = writeln!(text, "{}", self.window);
        text += &self.felt.text(self.tells_feelings, self.without_scale);
        let columns = ["p50", "p90", "p99", "p99.9", "worst"].map(|name| format!("{name:>9}"));
        let _ = writeln!(text, "\n  {:<34}{}", "in ms", columns.concat());
        text += &self.first_sample_s.text("touch to first sample");
        text += &self.focus_s.text("touch to focus");
        text += &self.making_s.text("computing a drive for a new place");
        text += &self.computing_s.text("all work for simultaneous touches");
        text += &self.block_work_s.text(&format!("processor, block of {:.3} ms", 1e3 * self.block_s));
        let _ = writeln!(
            text,
            "\nscaled down to the limit: {} events; all waveforms {} times",
            self.limited, self.waves_limited
        );
        for (count, what) in [
            (
                self.unknown_times,
                "answers to touches not among these times: reported too late to know when they left",
            ),
            (self.beyond_limit, "levels beyond the drive limit, played at that limit"),
            (self.failed_cues, "cues that could not be played"),
            (self.stale, "pulses dropped because they came too late"),
            (self.late, "commands late"),
            (self.refused, "commands refused by the player"),
            (self.lost_commands, "commands or reports lost"),
            (
                self.lost_blocks,
                "blocks lost: they left late or not at all, which is heard as a gap or a click",
            ),
            (self.heavy_blocks, "blocks that took more than 70 % of their time"),
            (self.refused_touches, "packets, places or fingers refused"),
        ] {
            if count > 0 {
                let _ = writeln!(text, "{count} {what}");
            }
        }
        text += &self.server.as_ref().map(ServerSays::text).unwrap_or_default();
        if let Some(failure) = &self.last_failure {
            let _ = writeln!(text, "the last that failed: {failure}");
        }
        if let Some(priority) = &self.priority {
            let _ = writeln!(text, "audio thread: {priority}");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::Report;
    use crate::Report as _;

    #[test]
    fn only_a_virtual_surface_says_what_is_felt() {
        let unknown = "\nfelt: unknown, since only a virtual surface can simulate it\n";
        let text = Report::default().text();
        assert!(text.contains(unknown), "{text}");
        let text = Report { tells_feelings: true, ..Report::default() }.text();
        assert!(text.contains("\nfelt: - dB above threshold (largest -), contrast -\n"), "{text}");
        let report = Report { tells_feelings: true, without_scale: true, ..Report::default() };
        assert!(report.text().contains("\nfelt: level unknown, contrast -\n"), "{}", report.text());
    }
}
