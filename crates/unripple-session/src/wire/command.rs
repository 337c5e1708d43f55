//! Commands that pages send, as JSON.

use serde::{Deserialize, Deserializer};

/// Bytes of the longest message that is read. A surface edit has a few hundred bytes; what is longer is refused.
pub const LONGEST: usize = 64 << 10;

/// Places in one message: more targets than anybody presses at once.
const MOST_PLACES: usize = 16;

/// Farthest that a place may be from the origin, in mm: anything that is a surface is nearer.
const FARTHEST: f64 = 100_000.0;

/// Longest name that is listened to, in bytes. Longer ones are refused.
const LONGEST_NAME: usize = 64;

/// A command that a page sends. Lengths in mm, times in ms where the key says so, else in s.
///
/// ```
/// use unripple_session::Command;
///
/// let press = r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#;
/// assert!(matches!(Command::read(press), Ok(Command::Touch { finger: 0, .. })));
/// let refused = Command::read(r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,1e9]}"#).unwrap_err();
/// assert!(refused.to_string().contains("expected at most 100000"));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Command {
    /// A finger touches the picture of the surface, moves or is lifted.
    Touch {
        /// The page's number for the finger.
        finger: u32,
        /// Phase of the touch.
        phase: Phase,
        /// Where the finger is, in mm.
        at_mm: [f64; 2],
    },
    /// Set how time passes, and which instant is shown.
    Transport(Transport),
    /// Set how the surface is played and shown.
    Settings(Settings),
    /// Add or remove a place whose motion is followed.
    Probe(Probe),
    /// Change the surface.
    Edit(Box<Edit>),
    /// Undo the last edit of the surface.
    Undo,
    /// Redo the edit that was undone last.
    Redo,
    /// Replace the surface by a built-in one.
    Open {
        /// Name of the built-in surface.
        name: String,
    },
    /// Compute and evaluate a focus, with the figures of the command line.
    Measure(Measure),
    /// Show two focusing methods on the same targets side by side, or the live surface again.
    Compare {
        /// The page's own number for the request.
        #[serde(default)]
        id: u64,
        /// Places of the targets, in mm.
        #[serde(default)]
        at: Vec<[f64; 2]>,
        /// Names of the two methods.
        #[serde(default)]
        methods: Vec<String>,
        /// The window, in ms; the recommended one where absent or 0.
        #[serde(default)]
        window_ms: Option<f64>,
        /// Number of the edit that made the surface which the page shows; the newest where absent.
        #[serde(default)]
        edit: Option<u64>,
        /// Whether to show the live surface again.
        #[serde(default)]
        off: bool,
    },
    /// Cancel a measurement or comparison that this page has requested.
    Stop {
        /// The page's own number for the request.
        id: u64,
    },
    /// Start or stop a long task, such as a calibration or the doctor.
    Job(Job),
    /// The page has drawn the frame of this number.
    Seen {
        /// Number of the frame.
        frame: u64,
    },
}

/// The phase of a finger's touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Phase {
    /// The finger touched the surface.
    Down,
    /// The finger moved on the surface.
    Move,
    /// The finger left the surface.
    Up,
}

/// How time passes, and which instant is shown. Absent fields leave their settings unchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Transport {
    /// Speed, in s of the surface per second of the page.
    pub speed: Option<f64>,
    /// Whether time is paused.
    pub paused: Option<bool>,
    /// Number of stored states by which to go on (or back, if negative).
    pub step: Option<i64>,
    /// The instant to show, in s of the surface's clock.
    pub shown_s: Option<f64>,
    /// Whether to show the present again.
    pub live: Option<bool>,
}

/// How the surface is played and shown. Absent fields leave their settings unchanged.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Name of the focusing method by which drives are computed.
    pub method: Option<String>,
    /// Name of the effect that a touch triggers.
    pub effect: Option<String>,
    /// The window, in ms; 0 or `null` for the one recommended for the surface.
    #[serde(deserialize_with = "or_none")]
    pub window_ms: Option<f64>,
    /// Pulses per second while a finger rests.
    pub rate_hz: Option<f64>,
    /// Quantity that pictures show: `displacement` or `velocity`.
    pub quantity: Option<String>,
    /// Whether resting fingers load the simulated surface.
    pub load: Option<bool>,
    /// Level of all effects, in dB relative to their own; 0 is as much as linear theory allows.
    pub gain_db: Option<f64>,
}

/// A place whose motion is to be followed, or no longer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Probe {
    /// A place to follow, in mm.
    pub add: Option<[f64; 2]>,
    /// Number of the probe that is followed no longer.
    pub remove: Option<u32>,
}

/// Changes of a surface. Absent fields leave it as it is.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Edit {
    /// Name of the sheet's material.
    pub material: Option<String>,
    /// Thickness of the sheet, in mm.
    pub thickness_mm: Option<f64>,
    /// Tension of the sheet, in N/m.
    pub tension_n_per_m: Option<f64>,
    /// One decay time for all frequencies, in ms.
    pub decay_time_ms: Option<f64>,
    /// Top of the band, in Hz.
    pub band_top_hz: Option<f64>,
    /// New outline: a rectangle of this width and height, in mm.
    pub rectangle_mm: Option<[f64; 2]>,
    /// New outline: a circle of this radius, in mm.
    pub circle_mm: Option<f64>,
    /// New outline: two half circles joined by straight sides; length of these and radius, in mm.
    pub stadium_mm: Option<[f64; 2]>,
    /// How the rim is held: `clamped`, `supported` or `free`.
    pub edge: Option<String>,
    /// Number of actuators; new ones are placed at irregular places near the rim.
    pub actuators: Option<usize>,
    /// Index of an actuator that is moved to `at_mm`, from 0.
    pub actuator: Option<usize>,
    /// Place to which the actuator moves, in mm.
    pub at_mm: Option<[f64; 2]>,
    /// Whether the edit is complete; only then the played surface follows it. By default it is.
    pub settled: Option<bool>,
}

/// A focus to compute and evaluate.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Measure {
    /// The page's own number for the request, which the answer repeats.
    pub id: u64,
    /// Places of the targets, in mm.
    pub at: Vec<[f64; 2]>,
    /// Name of the focusing method; time reversal where absent.
    pub method: Option<String>,
    /// The window, in ms; the recommended one where absent or 0.
    pub window_ms: Option<f64>,
    /// Peak displacement at the first target, in µm; where absent or 0, as much as linear theory allows.
    pub peak_um: Option<f64>,
    /// Number of the edit that made the surface which the page shows; the newest where absent.
    pub edit: Option<u64>,
}

/// A long task to start or stop.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Job {
    /// Task to start: `calibrate`, `doctor` or `devices`.
    pub start: Option<String>,
    /// Number of the task to stop.
    pub stop: Option<u64>,
    /// For a calibration: seed by which the simulated surface differs at random from its file.
    pub unknowns: Option<u64>,
    /// For a calibration: spacing of the points, in mm.
    pub grid_mm: Option<f64>,
    /// For a calibration: name of the library.
    pub name: Option<String>,
}

/// Reason why a message is refused.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// The message is too long.
    #[error("message: expected at most {LONGEST} bytes, found {found}")]
    Long {
        /// Length of the message, in bytes.
        found: usize,
    },
    /// The message is not one of the protocol.
    #[error("message: {0}")]
    Malformed(#[from] serde_json::Error),
    /// A value is out of range.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// Name of the value.
        what: &'static str,
        /// Description of the values that are accepted.
        expected: String,
        /// The value that was found.
        found: String,
    },
}

impl Command {
    /// Reads a message.
    ///
    /// # Errors
    /// [`Refused`], with what was expected and what was found.
    pub fn read(text: &str) -> Result<Self, Refused> {
        if text.len() > LONGEST {
            return Err(Refused::Long { found: text.len() });
        }
        let command: Self = serde_json::from_str(text)?;
        command.check()?;
        Ok(command)
    }

    fn check(&self) -> Result<(), Refused> {
        match self {
            Self::Touch { finger, at_mm, .. } => {
                within("finger", f64::from(*finger), [0.0, 999.0])?;
                place("at_mm", at_mm)
            }
            Self::Transport(transport) => transport.check(),
            Self::Settings(settings) => settings.check(),
            Self::Probe(probe) => probe.add.as_ref().map_or(Ok(()), |at| place("add", at)),
            Self::Edit(edit) => edit.check(),
            Self::Open { name } => short("name", name),
            Self::Measure(measure) => {
                places(&measure.at)?;
                measure.method.as_ref().map_or(Ok(()), |name| short("method", name))?;
                some("window_ms", measure.window_ms, [0.0, 10_000.0])?;
                some("peak_um", measure.peak_um, [0.0, 1e6])
            }
            Self::Compare { at, methods, window_ms, off, .. } => {
                if *off {
                    return Ok(());
                }
                places(at)?;
                methods.iter().try_for_each(|name| short("methods", name))?;
                within("methods", methods.len() as f64, [2.0, 2.0])?;
                some("window_ms", *window_ms, [0.0, 10_000.0])
            }
            Self::Job(job) => {
                some("grid_mm", job.grid_mm, [0.1, 1000.0])?;
                job.start.iter().chain(&job.name).try_for_each(|name| short("job", name))
            }
            Self::Undo | Self::Redo | Self::Stop { .. } | Self::Seen { .. } => Ok(()),
        }
    }
}

impl Transport {
    fn check(&self) -> Result<(), Refused> {
        some("speed", self.speed, [1e-5, 1.0])?;
        some("step", self.step.map(|step| step as f64), [-1e6, 1e6])?;
        some("shown_s", self.shown_s, [-1e9, 1e9])
    }
}

impl Settings {
    /// Whether these settings change how the surface is played.
    pub fn plays(&self) -> bool {
        let names = self.method.is_some() || self.effect.is_some();
        names || self.load.is_some() || self.window_ms.is_some() || self.rate_hz.is_some()
    }

    fn check(&self) -> Result<(), Refused> {
        let names = [&self.method, &self.effect, &self.quantity];
        names.into_iter().flatten().try_for_each(|name| short("name", name))?;
        some("window_ms", self.window_ms, [0.0, 1000.0])?;
        some("gain_db", self.gain_db, [-60.0, 0.0])?;
        some("rate_hz", self.rate_hz, [0.1, 500.0])
    }
}

impl Edit {
    fn check(&self) -> Result<(), Refused> {
        let names = [&self.material, &self.edge];
        names.into_iter().flatten().try_for_each(|name| short("name", name))?;
        let lengths = self.rectangle_mm.iter().chain(&self.stadium_mm).flatten().chain(&self.circle_mm);
        lengths.copied().try_for_each(|mm| within("length in mm", mm, [0.0, FARTHEST]))?;
        some("actuators", self.actuators.map(|n| n as f64), [1.0, 64.0])?;
        some("thickness_mm", self.thickness_mm, [0.0, 1000.0])?;
        some("tension_n_per_m", self.tension_n_per_m, [0.0, 1e7])?;
        some("decay_time_ms", self.decay_time_ms, [0.0, 1e6])?;
        some("band_top_hz", self.band_top_hz, [0.0, 1e6])?;
        self.at_mm.as_ref().map_or(Ok(()), |at| place("at_mm", at))?;
        match (self.actuator, self.at_mm) {
            (Some(_), None) | (None, Some(_)) => Err(Refused::Range {
                what: "actuator",
                expected: "an actuator with at_mm".into(),
                found: "one without the other".into(),
            }),
            _ => Ok(()),
        }
    }
}

/// A number, or `null` for 0: what is there is not what is absent.
fn or_none<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    Ok(Some(Option::deserialize(deserializer)?.unwrap_or(0.0)))
}

fn places(at: &[[f64; 2]]) -> Result<(), Refused> {
    within("places", at.len() as f64, [1.0, MOST_PLACES as f64])?;
    at.iter().try_for_each(|at| place("at", at))
}

fn place(what: &'static str, at: &[f64; 2]) -> Result<(), Refused> {
    at.iter().try_for_each(|mm| within(what, *mm, [-FARTHEST, FARTHEST]))
}

fn some(what: &'static str, value: Option<f64>, range: [f64; 2]) -> Result<(), Refused> {
    value.map_or(Ok(()), |value| within(what, value, range))
}

fn within(what: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), Refused> {
    if value >= least && value <= most {
        return Ok(());
    }
    let expected = if value < least { format!("at least {least}") } else { format!("at most {most}") };
    Err(Refused::Range { what, expected, found: value.to_string() })
}

fn short(what: &'static str, name: &str) -> Result<(), Refused> {
    if (1..=LONGEST_NAME).contains(&name.len()) && !name.chars().any(char::is_control) {
        return Ok(());
    }
    let expected = format!("a name of 1 to {LONGEST_NAME} bytes");
    Err(Refused::Range { what, expected, found: format!("{} bytes", name.len()) })
}
