//! Unripple's own OSC addresses.

use super::frame::{int, number};
use super::receiver::OscReceiver;
use crate::{Heard, Key, Wish};
use rosc::OscType;
use std::net::SocketAddr;
use unripple_core::Point;

/// A request of a message under `/unripple/`.
#[derive(Clone, Debug, PartialEq)]
enum Asked {
    Touch { finger: i64, at: Point, force: Option<f64> },
    Lift(i64),
    Clear,
    Wish(Option<Wish>),
}

impl Asked {
    /// Reads a request; nothing if the types are wrong, `Err` if there is no such address.
    fn read(what: &str, args: &[OscType]) -> Result<Option<Self>, ()> {
        let asked = match what {
            "touch" => Self::touch(args),
            "lift" => args.first().and_then(int).map(Self::Lift),
            "clear" => Some(Self::Clear),
            "effect" => match args.first() {
                Some(OscType::String(name)) => Some(Self::Wish(Wish::effect(name))),
                _ => None,
            },
            "gain" => args.first().and_then(number).map(|db| Self::Wish(Wish::gain(db))),
            _ => return Err(()),
        };
        Ok(asked)
    }

    /// `finger x_mm y_mm [force_n]`
    fn touch(args: &[OscType]) -> Option<Self> {
        let (x, y) = (number(args.get(1)?)?, number(args.get(2)?)?);
        let force = match args.get(3) {
            Some(force) => Some(number(force)?),
            None => None,
        };
        Some(Self::Touch { finger: int(args.first()?)?, at: Point::from_mm(x, y), force })
    }
}

impl OscReceiver {
    /// One message under `/unripple/`. A sender is an address of a machine, whatever port it uses: command-line tools use
    /// another for each message.
    pub(super) fn own(&mut self, from: SocketAddr, what: &str, args: &[OscType], heard: &mut Heard) {
        let asked = match Asked::read(what, args) {
            Ok(Some(asked)) => asked,
            Ok(None) => {
                self.fingers.counts.malformed += 1;
                return;
            }
            Err(()) => {
                self.fingers.counts.unknown += 1;
                return;
            }
        };
        let Some(sender) = self.sender(SocketAddr::new(from.ip(), 0)) else {
            return;
        };
        let peer = self.senders.peer(sender);
        let key = |session| Key { peer, stream: 0, session };
        match asked {
            Asked::Touch { finger, at, force } => {
                // A refusal is counted where it is made.
                let _ = self.fingers.put(key(finger), at, force, heard);
            }
            Asked::Lift(finger) => {
                let there = self.fingers.lift(key(finger), heard);
                self.fingers.counts.unknown += u64::from(!there);
            }
            Asked::Clear => {
                self.fingers.lift_where(|key| key.peer == peer, heard);
            }
            Asked::Wish(None) => self.fingers.counts.numbers += 1,
            Asked::Wish(Some(wish)) => self.fingers.take_wish(wish, heard),
        }
    }
}
