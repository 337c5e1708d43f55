//! Decoder of TUIO 1.1, TUIO 2.0 and the addresses under `/unripple/`, from packets to fingers.

use super::frame::Frame;
use super::packet;
use super::profile::Profile;
use super::senders::{LISTS, Senders};
use super::sequence::Verdict;
use crate::{Counts, Fingers, Heard, Key, Options, TouchError};
use rosc::OscMessage;
use std::net::SocketAddr;
use std::ops::Range;

/// Decoder of OSC packets of TUIO 1.1, TUIO 2.0 and the addresses under `/unripple/`, independent of the transport.
///
/// Any bytes may be put in: what cannot be read, or means nothing, is counted. Fingers are distinguished by the
/// address of their sender, the name that the sender gives itself, and the sender's number for the finger.
///
/// ```
/// use unripple_core::{Outline, Point, Shape};
/// use unripple_touch::{Heard, Options, OscReceiver};
///
/// let sheet = Outline::new(Shape::Rectangle { width: 0.15, height: 0.10 });
/// let (mut receiver, mut heard) = (OscReceiver::new(Options::new(&sheet))?, Heard::default());
/// let from = "127.0.0.1:50000".parse().unwrap();
/// receiver.begin(0.0);
/// // Finger 1 at (62, 90) mm.
/// receiver.packet(from, b"/unripple/touch\0,iff\0\0\0\0\0\0\0\x01\x42\x78\0\0\x42\xb4\0\0", &mut heard);
/// receiver.packet(from, b"nonsense", &mut heard);
/// receiver.end(&mut heard);
/// assert_eq!(heard.touches[0].at, Point::from_mm(62.0, 90.0));
/// assert_eq!(receiver.counts().malformed, 1);
/// # Ok::<(), unripple_touch::TouchError>(())
/// ```
#[derive(Clone, Debug)]
pub struct OscReceiver {
    pub(super) fingers: Fingers,
    pub(super) senders: Senders,
    pub(super) frames: [Frame; LISTS],
    messages: Vec<Range<usize>>,
}

/// The sender of a packet: its address, the index of the sender and that of its name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Speaker {
    pub(super) address: SocketAddr,
    pub(super) sender: Option<usize>,
    pub(super) name: usize,
    /// Whether there was no room for the sender, so that the packet is ignored.
    pub(super) refused: bool,
}

impl OscReceiver {
    /// A receiver without any finger. Fails if an option is out of range.
    pub fn new(options: Options) -> Result<Self, TouchError> {
        let (senders, frames) = (Senders::default(), Default::default());
        Ok(Self { fingers: Fingers::new(options)?, senders, frames, messages: Vec::new() })
    }

    /// Begins a poll at `now`, in s.
    pub fn begin(&mut self, now: f64) {
        self.fingers.begin(now);
    }

    /// Reads one packet.
    pub fn packet(&mut self, from: SocketAddr, bytes: &[u8], heard: &mut Heard) {
        self.fingers.counts.packets += 1;
        let mut messages = std::mem::take(&mut self.messages);
        if packet::split(bytes, &mut messages) {
            let mut speaker = Speaker { address: from, sender: None, name: 0, refused: false };
            for range in &messages {
                match packet::message(&bytes[range.clone()]) {
                    Some(message) => self.message(&mut speaker, &message, heard),
                    None => self.fingers.counts.malformed += 1,
                }
            }
            self.finish(&speaker, heard);
        } else {
            self.fingers.counts.malformed += 1;
        }
        self.messages = messages;
    }

    /// Ends a poll: lifts the fingers whose time-out has passed, and forgets senders that have been silent for twice
    /// as long.
    pub fn end(&mut self, heard: &mut Heard) {
        self.fingers.expire(heard);
        // Later than its fingers, so that no sender is forgotten while one is there.
        let before = self.fingers.awake() - 2.0 * self.fingers.options().timeout;
        self.senders.forget(before);
    }

    /// Time at which time-outs must be checked again, in s.
    pub(super) fn due(&self, now: f64) -> Option<f64> {
        self.fingers.due(now)
    }

    /// Counts of what was accepted and refused so far.
    pub fn counts(&self) -> Counts {
        self.fingers.counts
    }

    /// Number of fingers, senders and names of senders that are kept in memory.
    pub fn tracked(&self) -> usize {
        self.fingers.count() + self.senders.count()
    }

    /// Counts an error of the socket that packets come from.
    pub(super) fn fail(&mut self) {
        self.fingers.counts.failed += 1;
    }

    fn message(&mut self, speaker: &mut Speaker, message: &OscMessage, heard: &mut Heard) {
        let (address, args) = (message.addr.as_str(), message.args.as_slice());
        if let Some(profile) = address.strip_prefix("/tuio/").and_then(Profile::of) {
            self.tuio(speaker, profile, args, heard);
        } else if let Some(component) = address.strip_prefix("/tuio2/") {
            self.tuio2(speaker, component, args, heard);
        } else if let Some(what) = address.strip_prefix("/unripple/") {
            self.own(speaker.address, what, args, heard);
        } else {
            self.fingers.counts.unknown += 1;
        }
    }

    /// Index of the sender at an address; none, and counted, if there are too many senders.
    pub(super) fn sender(&mut self, address: SocketAddr) -> Option<usize> {
        let found = self.senders.find(address, self.fingers.awake());
        match found {
            Some((_, new)) => self.fingers.counts.senders += u64::from(new),
            None => self.fingers.counts.crowded += 1,
        }
        found.map(|(i, _)| i)
    }

    /// Sets the name that a sender gives itself.
    pub(super) fn introduce(&mut self, speaker: &mut Speaker, name: &str) {
        if !self.speak(speaker) {
            return;
        }
        match speaker.sender.and_then(|sender| self.senders.name(sender, name)) {
            Some(name) => speaker.name = name,
            None => {
                (speaker.sender, speaker.refused) = (None, true);
                self.fingers.counts.crowded += 1;
            }
        }
    }

    /// Classifies a frame by its number: next, late or a restart.
    pub(super) fn judge(&mut self, speaker: &Speaker, list: usize, id: u32, bits: u32) -> Verdict {
        let now = self.fingers.awake();
        match speaker.sender {
            Some(sender) => self.senders.sequence(sender, speaker.name, list).judge(id, bits, now),
            None => Verdict::Late,
        }
    }

    /// Finds the sender of a packet, once; false if there is no room for it.
    pub(super) fn speak(&mut self, speaker: &mut Speaker) -> bool {
        if speaker.sender.is_none() && !speaker.refused {
            speaker.sender = self.sender(speaker.address);
            speaker.refused = speaker.sender.is_none();
        }
        !speaker.refused
    }

    /// Lifts all fingers of a sender that has restarted.
    pub(super) fn restart(&mut self, speaker: &Speaker, list: usize, heard: &mut Heard) {
        if let Some((peer, stream)) = self.stream(speaker, list) {
            self.fingers.lift_where(|key| key.peer == peer && key.stream == stream, heard);
        }
    }

    fn stream(&self, speaker: &Speaker, list: usize) -> Option<(u32, u32)> {
        let sender = speaker.sender?;
        Some((self.senders.peer(sender), (speaker.name * LISTS + list) as u32))
    }

    /// Applies a frame to the fingers, and clears it.
    pub(super) fn apply(&mut self, speaker: &Speaker, list: usize, heard: &mut Heard) {
        let mut frame = std::mem::take(&mut self.frames[list]);
        if frame.late {
            self.fingers.counts.late += 1;
        } else if let Some((peer, stream)) = self.stream(speaker, list) {
            self.take(&frame, peer, stream, heard);
        }
        frame.clear();
        self.frames[list] = frame;
    }

    fn take(&mut self, frame: &Frame, peer: u32, stream: u32, heard: &mut Heard) {
        let ours = |key: &Key| key.peer == peer && key.stream == stream;
        let there = |session: i64| frame.alive.binary_search(&session).is_ok();
        if frame.listed {
            self.fingers.lift_where(|key| ours(key) && !there(key.session), heard);
            self.fingers.renew_where(|key| ours(key) && there(key.session));
        }
        for set in &frame.sets {
            let key = Key { peer, stream, session: set.session };
            if frame.listed && !there(set.session) {
                self.fingers.counts.unknown += 1;
            } else if set.pressure.is_some_and(|pressure| pressure < 0.0) {
                // It hovers.
                self.fingers.lift(key, heard);
            } else {
                // A refusal is counted where it is made.
                let _ = self.fingers.put_sensed(key, set.place, set.pressure, heard);
            }
        }
    }

    /// Applies the frames that a packet leaves open: the end of a packet ends its frames.
    fn finish(&mut self, speaker: &Speaker, heard: &mut Heard) {
        for list in 0..LISTS {
            if !self.frames[list].is_empty() || self.frames[list].late {
                self.apply(speaker, list, heard);
            }
        }
    }
}
