//! The JSON protocol of touches over WebSocket.

use crate::Wish;
use serde::{Deserialize, Deserializer};
use serde_json::json;
use unripple_core::{Outline, Phase, Point};

/// The JSON schema of the touch protocol, version 1, for clients that check what they send.
pub const SCHEMA: &str = include_str!("../../schema/touch-1.json");

/// The version of the protocol that is spoken; a client that asks for another is refused.
const VERSION: u64 = 1;
/// The longest explanation of an error that is sent, in characters. Longer ones are cut.
const LONGEST: usize = 200;

/// A message of a WebSocket client.
///
/// ```
/// use unripple_core::{Phase, Point};
/// use unripple_touch::Message;
///
/// let text = r#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[62,90],"force_n":0.3}"#;
/// let at = Some(Point::from_mm(62.0, 90.0));
/// assert_eq!(Message::read(text), Ok(Message::Touch { finger: 1, phase: Phase::Down, at, force: Some(0.3) }));
/// assert!(Message::read(r#"{"v":2,"type":"hello"}"#).unwrap_err().contains("expected version 1"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A finger comes down, moves or is lifted.
    Touch {
        /// The client's number for the finger.
        finger: u32,
        /// Phase of the touch.
        phase: Phase,
        /// Place of the finger, in m; may be missing when the finger is lifted.
        at: Option<Point>,
        /// Force of the finger, in N, if known.
        force: Option<f64>,
    },
    /// All fingers of the client are lifted.
    Clear,
    /// A request for an effect or a level.
    Wish(Wish),
    /// A request for the server's version and the size of the surface.
    Hello,
}

#[derive(Deserialize)]
struct Version {
    v: u64,
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
enum Wire {
    Touch {
        #[serde(rename = "v")]
        _v: u64,
        finger: u32,
        phase: WirePhase,
        #[serde(default, deserialize_with = "given")]
        at_mm: Option<[f64; 2]>,
        #[serde(default, deserialize_with = "given")]
        force_n: Option<f64>,
    },
    Clear {
        #[serde(rename = "v")]
        _v: u64,
    },
    Effect {
        #[serde(rename = "v")]
        _v: u64,
        name: String,
    },
    Gain {
        #[serde(rename = "v")]
        _v: u64,
        db: f64,
    },
    Hello {
        #[serde(rename = "v")]
        _v: u64,
    },
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum WirePhase {
    Down,
    Move,
    Up,
}

/// A value that may be left out, but is not null.
fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

impl Message {
    /// Decodes a message. The error is an explanation for the client.
    pub fn read(text: &str) -> Result<Self, String> {
        // An array would be taken for the values in order.
        if !text.trim_start().starts_with('{') {
            return Err("expected an object".to_owned());
        }
        let version: Version = serde_json::from_str(text).map_err(|error| short(&error.to_string()))?;
        if version.v != VERSION {
            return Err(format!("expected version 1, found {}", version.v));
        }
        let wire = serde_json::from_str(text).map_err(|error| short(&error.to_string()))?;
        match wire {
            Wire::Touch { finger, phase, at_mm, force_n, .. } => touch(finger, phase, at_mm, force_n),
            Wire::Clear { .. } => Ok(Self::Clear),
            Wire::Hello { .. } => Ok(Self::Hello),
            Wire::Effect { name, .. } => {
                let expected = "name: expected 1 to 64 bytes without control characters";
                Wish::effect(&name).map(Self::Wish).ok_or_else(|| expected.to_owned())
            }
            Wire::Gain { db, .. } => {
                let expected = || format!("db: expected -120 to 40, found {db}");
                Wish::gain(db).map(Self::Wish).ok_or_else(expected)
            }
        }
    }
}

fn touch(
    finger: u32,
    phase: WirePhase,
    at_mm: Option<[f64; 2]>,
    force: Option<f64>,
) -> Result<Message, String> {
    let phase = match phase {
        WirePhase::Down => Phase::Down,
        WirePhase::Move => Phase::Move,
        WirePhase::Up => Phase::Up,
    };
    if at_mm.is_none() && phase != Phase::Up {
        return Err("expected at_mm, found none".to_owned());
    }
    let at = at_mm.map(|[x, y]| Point::from_mm(x, y));
    Ok(Message::Touch { finger, phase, at, force })
}

fn short(text: &str) -> String {
    text.chars().take(LONGEST).collect()
}

/// The answer to [`Message::Hello`]: the server's version and the size of the surface.
pub(super) fn hello(surface: &Outline) -> String {
    let (width, height) = surface.extent();
    let version = env!("CARGO_PKG_VERSION");
    let size = [width * 1e3, height * 1e3];
    json!({"v": VERSION, "type": "hello", "server": "unripple", "version": version, "size_mm": size})
        .to_string()
}

/// The answer to an invalid message: what was wrong with it.
pub(super) fn error(what: &str) -> String {
    json!({"v": VERSION, "type": "error", "what": short(what)}).to_string()
}
