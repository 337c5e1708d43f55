//! Touches from screens, networks and recordings.
//!
//! A [`Source`] is polled and reports [`Touch`](unripple_core::Touch)es and [`Wish`]es, which are requests for an
//! effect or a level. [`Sources`] joins several sources, and [predicts](Sources::predict) the places of moving
//! fingers. No source blocks, none reads a clock, none takes unbounded memory or time, and what they refuse is
//! counted by kind ([`Counts`]).
//!
//! | source | receives |
//! |---|---|
//! | [`OscPort`] | TUIO 1.1 and 2.0, and the addresses under `/unripple/`, over UDP |
//! | [`WebSocketPort`] | the JSON protocol of [`SCHEMA`] |
//! | [`Screen`] | a multi-touch screen of Linux |
//! | [`Playback`] | a [`Recording`], made with a [`Recorder`] |
//! | [`Synthetic`] | simulated fingers that tap and slide |
//!
//! Each source of external data has a decoder that works without a socket or a device ([`OscReceiver`], [`Message`],
//! [`Slots`]), and a set of [`Fingers`].

mod counts;
mod error;
mod fingers;
mod heard;
mod mapping;
mod motion;
mod options;
mod osc;
mod recording;
mod screen;
mod source;
mod sources;
mod synthetic;
mod websocket;

pub use counts::Counts;
pub use error::TouchError;
pub use fingers::{Fingers, Key, Refusal};
pub use heard::{Heard, Wish};
pub use mapping::Mapping;
pub use motion::Motion;
pub use options::Options;
pub use osc::{OscPort, OscReceiver};
pub use recording::{Playback, Recorder, Recording};
pub use screen::{Axis, Contacts, Event, Report, Screen, Slots};
pub use source::Source;
pub use sources::Sources;
pub use synthetic::{Synthetic, SyntheticOptions};
pub use websocket::{Message, SCHEMA, WebSocketOptions, WebSocketPort};
