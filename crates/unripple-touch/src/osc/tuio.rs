//! TUIO 1.1 messages.

use super::frame::int;
use super::profile::Profile;
use super::receiver::{OscReceiver, Speaker};
use super::sequence::Verdict;
use crate::Heard;
use rosc::OscType;

impl OscReceiver {
    /// One message of TUIO 1.1: `source`, `alive`, `set` or `fseq`.
    pub(super) fn tuio(&mut self, who: &mut Speaker, profile: Profile, args: &[OscType], heard: &mut Heard) {
        let Some((OscType::String(command), args)) = args.split_first() else {
            self.fingers.counts.malformed += 1;
            return;
        };
        let list = profile.list();
        let read = match (command.as_str(), args) {
            ("source", [OscType::String(name), ..]) => {
                self.introduce(who, name);
                true
            }
            ("alive", sessions) => !self.speak(who) || self.frames[list].list(sessions),
            ("set", args) => match profile.set(args) {
                Some(set) => {
                    if self.speak(who) {
                        self.frames[list].set(set);
                    }
                    true
                }
                None => false,
            },
            ("fseq", [number, ..]) => match int(number) {
                Some(id) => {
                    self.end_frame(who, list, id, heard);
                    true
                }
                None => false,
            },
            _ => false,
        };
        self.fingers.counts.malformed += u64::from(!read);
    }

    fn end_frame(&mut self, who: &mut Speaker, list: usize, id: i64, heard: &mut Heard) {
        // A frame sent again has no number of its own, but -1.
        if id != -1 && self.speak(who) {
            match self.judge(who, list, id as u32, 31) {
                Verdict::Next => {}
                Verdict::Late => self.frames[list].late = true,
                Verdict::Restart => self.restart(who, list, heard),
            }
        }
        self.apply(who, list, heard);
    }
}
