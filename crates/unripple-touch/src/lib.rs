//! Touches from screens, networks and recordings.
//!
//! What a touch sets off is not decided here, but in `unripple-effects`.
//!
//! # In reading order
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
//! | [`Pushed`] | what a program pushes with a [`Pusher`] |
//! | [`Synthetic`] | simulated fingers that tap and slide |
//!
//! Each source of external data has a decoder that works without a socket or a device ([`OscReceiver`], [`Message`],
//! [`Slots`]), and a set of [`Fingers`].
//!
//! ```
//! use unripple_core::{Outline, Point, Shape};
//! use unripple_touch::{Heard, Playback, Recording, Sources};
//!
//! // A finger that slides to the right at 0.2 m/s.
//! let text = r#"{"format":"unripple-touches","version":1}
//! {"at_ms":0,"finger":7,"phase":"down","at_mm":[60,50]}
//! {"at_ms":10,"finger":7,"phase":"move","at_mm":[62,50]}
//! {"at_ms":20,"finger":7,"phase":"move","at_mm":[64,50]}
//! {"at_ms":500,"finger":7,"phase":"up","at_mm":[64,50]}"#;
//! let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
//! let mut sources = Sources::new(&sheet);
//! sources.push(Box::new(Playback::new(Recording::read(text)?, &sheet)?));
//!
//! let mut heard = Heard::default();
//! sources.poll(0.0, &mut heard);
//! sources.poll(0.021, &mut heard);
//! let last = heard.touches[2];
//! assert_eq!((heard.touches.len(), last.at), (3, Point::from_mm(64.0, 50.0)));
//! // Where the finger will be 10 ms after its last touch.
//! let ahead = sources.predict(last.finger, last.time, 0.010).unwrap();
//! assert!(ahead.distance(Point::from_mm(66.0, 50.0)) < 1e-6);
//! # Ok::<(), unripple_touch::TouchError>(())
//! ```

mod counts;
mod error;
mod fingers;
mod heard;
mod mapping;
mod motion;
mod options;
mod osc;
mod pushed;
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
pub use pushed::{Pushed, Pusher, pushed};
pub use recording::{Playback, Recorder, Recording};
pub use screen::{Axis, Contacts, Event, Report, Screen, Slots};
pub use source::Source;
pub use sources::Sources;
pub use synthetic::{Synthetic, SyntheticOptions};
pub use websocket::{Message, SCHEMA, WebSocketOptions, WebSocketPort};
