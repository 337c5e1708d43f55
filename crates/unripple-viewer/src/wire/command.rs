//! Commands of pages, as JSON.

use serde::{Deserialize, Deserializer};

/// Bytes of the longest message that is read. A surface edit has a few hundred bytes; what is longer is refused.
pub(crate) const LONGEST: usize = 64 << 10;

/// Places in one message: more targets than anybody presses at once.
const MOST_PLACES: usize = 16;

/// Farthest that a place may be from the origin, in mm: anything that is a surface is nearer.
const FARTHEST: f64 = 100_000.0;

/// Longest name that is listened to, in bytes. Longer ones are refused.
const LONGEST_NAME: usize = 64;

/// A command of a page. Lengths in mm, times in ms where the key says so, else in s.
///
/// ```
/// use unripple_viewer::Command;
///
/// let press = r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#;
/// assert!(matches!(Command::read(press), Ok(Command::Touch { finger: 0, .. })));
/// let refused = Command::read(r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,1e9]}"#).unwrap_err();
/// assert!(refused.to_string().contains("expected at most 100000"));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Command {
    /// A finger on the picture of the surface.
    Touch {
        /// The page's number for the finger.
        finger: u32,
        /// Phase of the touch.
        phase: Phase,
        /// Where the finger is, in mm.
        at_mm: [f64; 2],
    },
    /// How time passes, and which moment is shown.
    Transport(Transport),
    /// How the surface is played and shown.
    Settings(Settings),
    /// A place whose motion is followed.
    Probe(Probe),
    /// Changes of the surface.
    Edit(Box<Edit>),
    /// Back to the surface before the last edit.
    Undo,
    /// The edit that was undone, again.
    Redo,
    /// A built-in surface.
    Open {
        /// Name of the built-in surface.
        name: String,
    },
    /// The figures of one act, as the command line has them.
    Measure(Measure),
    /// Two methods on the same touch; or back to the live surface.
    Compare {
        /// Where, in mm.
        #[serde(default)]
        at: Vec<[f64; 2]>,
        /// Names of the two methods.
        #[serde(default)]
        methods: Vec<String>,
        /// The window; the surface's own where absent.
        #[serde(default)]
        window_ms: Option<f64>,
        /// The edit of the surface that the page shows, as it was told; the newest where absent.
        #[serde(default)]
        edit: Option<u64>,
        /// Back to the live surface.
        #[serde(default)]
        off: bool,
    },
    /// Something that takes a while: a calibration, what the doctor says.
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
    /// It touched the surface.
    Down,
    /// It moved on the surface.
    Move,
    /// It left the surface.
    Up,
}

/// How time passes, and which moment is shown. What is absent stays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Transport {
    /// Seconds of the surface in a second of the page.
    pub speed: Option<f64>,
    /// Whether time stands still.
    pub paused: Option<bool>,
    /// So many remembered states on, or back.
    pub step: Option<i64>,
    /// The moment to be shown, in s of the surface's clock.
    pub shown_s: Option<f64>,
    /// Whether to go back to the present.
    pub live: Option<bool>,
}

/// How the surface is played and shown. What is absent stays.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Method by which drives are made.
    pub method: Option<String>,
    /// Effect that a touch sets off.
    pub effect: Option<String>,
    /// The window; 0 or `null` for the one that the surface suggests.
    #[serde(deserialize_with = "or_none")]
    pub window_ms: Option<f64>,
    /// Pulses per second while a finger rests.
    pub rate_hz: Option<f64>,
    /// `displacement` or `velocity`.
    pub quantity: Option<String>,
    /// Whether fingers weigh on the surface.
    pub load: Option<bool>,
}

/// A place whose motion is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Probe {
    /// A place to follow, in mm.
    pub add: Option<[f64; 2]>,
    /// Number of the probe that is followed no longer.
    pub remove: Option<u32>,
}

/// Changes of a surface. What is absent stays.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Edit {
    /// A material by name.
    pub material: Option<String>,
    /// Thickness of the sheet, in mm.
    pub thickness_mm: Option<f64>,
    /// Tension of the sheet, in N/m.
    pub tension_n_per_m: Option<f64>,
    /// One decay time for all frequencies, in ms.
    pub decay_time_ms: Option<f64>,
    /// Top of the band, in Hz.
    pub band_top_hz: Option<f64>,
    /// A rectangle of this width and height.
    pub rectangle_mm: Option<[f64; 2]>,
    /// A circle of this radius.
    pub circle_mm: Option<f64>,
    /// Two half circles and the straight length between them: that length, then the radius.
    pub stadium_mm: Option<[f64; 2]>,
    /// How the rim is held: `clamped`, `supported` or `free`.
    pub edge: Option<String>,
    /// So many actuators, at irregular places near the rim.
    pub actuators: Option<usize>,
    /// An actuator that moves to `at_mm`.
    pub actuator: Option<usize>,
    /// Place to which the actuator moves, in mm.
    pub at_mm: Option<[f64; 2]>,
    /// Whether that is final: the live surface follows then.
    pub settled: Option<bool>,
}

/// One act to be measured.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Measure {
    /// A number of the page's own, which the answer carries.
    pub id: u64,
    /// Where, in mm.
    pub at: Vec<[f64; 2]>,
    /// The method; that of the settings where absent.
    pub method: Option<String>,
    /// The window; the command line's own where absent.
    pub window_ms: Option<f64>,
    /// The peak at the first target; as much as linear theory allows where absent.
    pub peak_um: Option<f64>,
    /// The edit of the surface that the page shows, as it was told; the newest where absent.
    pub edit: Option<u64>,
}

/// Something that takes a while.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Job {
    /// `calibrate`, `doctor` or `devices`.
    pub start: Option<String>,
    /// Ends one, by its number.
    pub stop: Option<u64>,
    /// Of a calibration: seed of the unknowns by which the true surface differs from its file.
    pub unknowns: Option<u64>,
    /// Of a calibration: distance between points, in mm.
    pub grid_mm: Option<f64>,
    /// Of a calibration: name of the library.
    pub name: Option<String>,
}

/// Why a message is refused.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// It is too long.
    #[error("message: expected at most {LONGEST} bytes, found {found}")]
    Long {
        /// Its length in bytes.
        found: usize,
    },
    /// It is not of the protocol.
    #[error("message: {0}")]
    Malformed(#[from] serde_json::Error),
    /// A value is out of range.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// Name of the value.
        what: &'static str,
        /// What would do.
        expected: String,
        /// What there is.
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
            Self::Undo | Self::Redo | Self::Seen { .. } => Ok(()),
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
