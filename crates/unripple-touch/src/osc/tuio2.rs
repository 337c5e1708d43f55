//! TUIO 2.0 messages.

use super::frame::{Set, int, number};
use super::receiver::{OscReceiver, Speaker};
use super::sequence::Verdict;
use crate::Heard;
use rosc::OscType;

/// Index of the list of fingers of TUIO 2: the fourth, after the three of TUIO 1.
const LIST: usize = 3;

/// Messages of TUIO 2 that are of no finger, and are passed over.
const IGNORED: [&str; 12] =
    ["sym", "t3d", "p3d", "b3d", "chg", "ocg", "icg", "skg", "svg", "arg", "raw", "dat"];

impl OscReceiver {
    /// One message of TUIO 2.0.
    pub(super) fn tuio2(&mut self, who: &mut Speaker, component: &str, args: &[OscType], heard: &mut Heard) {
        let read = match component {
            "frm" => self.begin_frame(who, args, heard),
            // s_id tu_id c_id x y angle …
            "tok" => self.component(who, component_set(args, 3, None), true),
            // s_id tu_id c_id x y angle shear radius press …
            "ptr" => self.component(who, component_set(args, 3, Some(8)), true),
            // s_id x y angle width height area …
            "bnd" => self.component(who, component_set(args, 1, None), false),
            "alv" => {
                let read = !self.speak(who) || self.frames[LIST].list(args);
                self.apply(who, LIST, heard);
                read
            }
            other => {
                self.fingers.counts.unknown += u64::from(!IGNORED.contains(&other));
                true
            }
        };
        self.fingers.counts.malformed += u64::from(!read);
    }

    /// `f_id time dim source`
    fn begin_frame(&mut self, who: &mut Speaker, args: &[OscType], heard: &mut Heard) -> bool {
        let Some(id) = args.first().and_then(int) else {
            return false;
        };
        match args.get(3) {
            Some(OscType::String(name)) => self.introduce(who, name),
            Some(_) => return false,
            None => {
                self.speak(who);
            }
        }
        self.frames[LIST].clear();
        // The number 0 stands outside the count.
        if id == 0 || who.sender.is_none() {
            return true;
        }
        match self.judge(who, LIST, id as u32, 32) {
            Verdict::Next => {}
            Verdict::Late => self.frames[LIST].late = true,
            Verdict::Restart => self.restart(who, LIST, heard),
        }
        true
    }

    /// Adds a finger to the frame. Bounds alone count as a finger, but do not replace a pointer or token, whose place
    /// is more exact (`better`).
    fn component(&mut self, who: &mut Speaker, set: Option<Set>, better: bool) -> bool {
        let Some(set) = set else {
            return false;
        };
        let frame = &mut self.frames[LIST];
        let known = frame.sets.iter().any(|other| other.session == set.session);
        if (better || !known) && self.speak(who) {
            self.frames[LIST].set(set);
        }
        true
    }
}

/// Reads a component whose place is at some argument, and its pressure at another.
fn component_set(args: &[OscType], at: usize, pressure: Option<usize>) -> Option<Set> {
    let place = (number(args.get(at)?)?, number(args.get(at + 1)?)?);
    let pressure = match pressure {
        Some(at) => Some(number(args.get(at)?)?),
        None => None,
    };
    Some(Set { session: int(args.first()?)?, place, pressure })
}
