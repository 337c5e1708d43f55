//! The sources of touches of a session: ports, screens, recordings, synthetic fingers.

use super::ask::TouchAsk;
use crate::TaskError;
use std::fs::File;
use std::io::BufWriter;
use std::net::SocketAddr;
use std::sync::{Arc, Mutex};
use unripple::core::Surface;
use unripple_live::Listener;
use unripple_store::{Underway, new_file};
use unripple_touch::{
    Heard, Options, OscPort, Playback, Recorder, Recording, Screen, Source, Sources, Synthetic,
    SyntheticOptions, TouchError, WebSocketOptions, WebSocketPort,
};

/// Time for which playing continues after a recorded session, in s, so that what it triggered is over.
const AFTER: f64 = 0.5;

/// Default number of synthetic fingers if there is no other source of touches. Two show that foci do not
/// disturb each other.
const ALONE: usize = 2;

/// The sources of touches, and the recording of them.
#[derive(Default)]
pub(super) struct Touches {
    recording: Option<Arc<Mutex<Tape>>>,
    /// Guard that removes the recording's file again unless the session begins.
    unused: Option<Underway>,
    /// Duration of a recorded session, in s.
    pub lasts: Option<f64>,
    /// Descriptions of all sources and warnings, a line each.
    pub told: Vec<String>,
}

/// A recording in progress, or why it failed.
struct Tape {
    recorder: Option<Recorder<BufWriter<File>>>,
    failed: Option<TouchError>,
}

impl Tape {
    fn hear(&mut self, now: f64, heard: &Heard) {
        if let Some(recorder) = self.recorder.as_mut().filter(|_| self.failed.is_none()) {
            self.failed = recorder.record(now, heard).err();
        }
    }

    fn finish(&mut self) -> Result<(), TouchError> {
        let done = self.recorder.take().map_or(Ok(()), |recorder| recorder.finish().map(|_| ()));
        self.failed.take().map_or(done, Err)
    }
}

impl Touches {
    /// Opens all sources of touches that a request names.
    pub fn open(options: &TouchAsk, surface: &Surface) -> Result<(Self, Sources), TaskError> {
        let mut touches = Self::default();
        let mut sources = Sources::new(&surface.outline);
        let heard = Options::new(&surface.outline);
        let mut all: Vec<Box<dyn Source>> = Vec::new();
        if let Some(port) = options.tuio {
            all.push(Box::new(OscPort::bind(SocketAddr::new(options.listen, port), heard.clone())?));
        }
        if let Some(port) = options.websocket {
            let address = SocketAddr::new(options.listen, port);
            all.push(Box::new(WebSocketPort::bind(address, heard.clone(), WebSocketOptions::default())?));
        }
        for path in &options.screen {
            all.push(Box::new(Screen::open(path, heard.clone())?));
        }
        if let Some(path) = &options.session {
            let recording = Recording::open(path)?;
            touches.lasts = Some(recording.duration() + AFTER);
            all.push(Box::new(Playback::new(recording, &surface.outline)?));
        }
        let fingers = options.fingers.unwrap_or(if all.is_empty() { ALONE } else { 0 });
        if fingers > 0 {
            let synthetic = SyntheticOptions { fingers, seed: options.seed, ..SyntheticOptions::default() };
            all.push(Box::new(Synthetic::new(&surface.outline, synthetic)?));
        }
        for source in all {
            touches.told.push(format!("touches from {}", source.name()));
            sources.push(source);
        }
        touches.told.extend(exposed(options));
        if let Some(path) = &options.record {
            let (file, unused) = new_file(path)?;
            let recorder = Some(Recorder::new(BufWriter::new(file), 0.0)?);
            touches.recording = Some(Arc::new(Mutex::new(Tape { recorder, failed: None })));
            touches.unused = Some(unused);
        }
        Ok((touches, sources))
    }

    /// The callback that records all touches and requests, if the request names a file for the recording.
    pub fn listener(&self) -> Option<Listener> {
        let tape = self.recording.clone()?;
        Some(Box::new(move |now, heard| {
            if let Ok(mut tape) = tape.lock() {
                tape.hear(now, heard);
            }
        }))
    }

    /// Keeps the recording's file even if the session fails later; to be called when the session begins.
    pub fn begin(&mut self) {
        if let Some(unused) = self.unused.take() {
            unused.keep();
        }
    }

    /// Ends the recording of touches, and returns an error if it failed.
    pub fn finish(&mut self) -> Result<(), TaskError> {
        let Some(tape) = self.recording.take() else { return Ok(()) };
        let finished = tape.lock().map_err(TaskError::work)?.finish();
        finished.map_err(TaskError::work)
    }
}

/// Warning that other machines can send touches, if a port is open to them.
fn exposed(options: &TouchAsk) -> Option<String> {
    // IPv6 may write an address of IPv4, the loopback one too.
    let open = !options.listen.to_canonical().is_loopback();
    (open && (options.tuio.is_some() || options.websocket.is_some())).then(|| {
        format!(
            "warning: `listen` {}: whoever can reach this address over the network can move fingers on this surface; leave `listen` out to \
             take touches from this machine alone, or let a firewall admit only the machines that send them",
            options.listen
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ports_that_others_can_reach_are_warned_of() {
        let warned = |listen: &str, tuio: Option<u16>, websocket: Option<u16>| {
            let listen = listen.parse().unwrap();
            exposed(&TouchAsk { tuio, websocket, listen, ..TouchAsk::default() })
        };
        for listen in ["0.0.0.0", "192.0.2.7", "::", "2001:db8::7", "::ffff:192.0.2.7"] {
            for (tuio, websocket) in [(Some(3333), None), (None, Some(8765)), (Some(3333), Some(8765))] {
                let warning = warned(listen, tuio, websocket).unwrap();
                assert!(warning.starts_with(&format!("warning: `listen` {listen}: ")), "{warning}");
            }
            assert_eq!(warned(listen, None, None), None, "no port is open at {listen}");
        }
        for listen in ["127.0.0.1", "127.8.0.1", "::1", "::ffff:127.0.0.1"] {
            assert_eq!(warned(listen, Some(3333), Some(8765)), None, "{listen}");
        }
    }
}
