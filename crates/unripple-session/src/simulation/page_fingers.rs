//! Fingers of pages that are down. One that is lifted stays on the surface until the focus of its press has been shown: in slow motion a
//! tap is over long before.

use super::page_touches::Pressed;
use crate::wire::Phase;
use std::collections::BTreeMap;
use unripple::core::Point;

/// How long a focus is shown before its finger goes, in s of the surface: a pulse lasts about 1 ms.
pub const SHOWN: f64 = 2e-3;

/// A finger of which its page has said nothing for so long, in s of the page, is lifted. Pages say every five seconds which fingers they
/// hold, so that only those of a page that has come to a standstill, or has lost count of them, are lifted.
const SILENT: f64 = 30.0;

/// Numbers from which fingers count that were pressed again before the focus of their last tap: pages count theirs from 0 to 999.
const AGAIN: u32 = 1000;

/// How many such numbers there are: enough that none is given twice while its finger is there.
const NUMBERS: u32 = 1_000_000;

/// Numbers of fingers of each page.
pub const FINGERS: u64 = (AGAIN + NUMBERS) as u64;

/// Largest number of taps of a page whose focus has yet to be shown; the oldest of more are given up. Focuses that come so close together
/// blur into one another.
const MOST_TAPS: usize = 8;

/// A finger that is down, or whose tap is still to be played.
#[derive(Clone, Copy, Debug)]
struct Finger {
    at: Point,
    /// Time at which the surface heard of the press, in s of its clock; `None` before.
    since: Option<f64>,
    lifted: bool,
    /// Seconds since its page said something of it.
    unheard: f64,
}

/// The fingers of all pages that are down, and those that still wait for their focus.
#[derive(Debug, Default)]
pub struct PageFingers {
    down: BTreeMap<(u64, u32), Finger>,
    /// Time for which a press stays at least, in s of the surface.
    hold: f64,
    /// Taps that were set aside so far.
    aside: u32,
    /// Whether the surface has yet to hear of a change.
    changed: bool,
}

impl PageFingers {
    /// Continues on another surface, which has not heard of any finger yet; a press stays there for `hold` s at least.
    pub fn renew(&mut self, hold: f64) {
        self.hold = hold;
        self.down.values_mut().for_each(|finger| finger.since = None);
        self.changed = !self.down.is_empty();
    }

    /// Takes a touch of a finger (m), given by the numbers of its page and of the finger on that page; `now` is the surface's time in s.
    pub fn touch(&mut self, id: (u64, u32), phase: Phase, at: Point, now: f64) {
        if phase == Phase::Up {
            if let Some(finger) = self.down.get_mut(&id) {
                finger.lifted = true;
            }
            return self.settle(now);
        }
        if phase == Phase::Down && self.down.get(&id).is_some_and(|finger| finger.lifted) {
            self.set_aside(id);
        }
        let fresh = Finger { at, since: None, lifted: false, unheard: 0.0 };
        let finger = self.down.entry(id).or_insert(fresh);
        *finger = Finger { since: finger.since, ..fresh };
        self.changed = true;
    }

    /// Lifts the fingers of a page at once.
    pub fn leave(&mut self, page: u64) {
        self.keep(|(whose, _), _| *whose != page);
    }

    /// Lets `seconds` of the page's time pass: fingers are lifted of which their page says nothing any more.
    pub fn wait(&mut self, seconds: f64) {
        for finger in self.down.values_mut() {
            finger.unheard += seconds;
            finger.lifted |= finger.unheard > SILENT;
        }
    }

    /// Removes the lifted fingers whose focus has been shown at the surface's time `now`, in s.
    pub fn settle(&mut self, now: f64) {
        let hold = self.hold;
        let shown = |finger: &Finger| finger.since.is_some_and(|since| now >= since + hold);
        self.keep(|_, finger| !(finger.lifted && shown(finger)));
    }

    /// All fingers, if the surface has not been told of them as they are; it hears of them at its time `now`, in s.
    pub fn take(&mut self, now: f64) -> Option<Pressed> {
        if !std::mem::take(&mut self.changed) {
            return None;
        }
        for finger in self.down.values_mut() {
            finger.since.get_or_insert(now);
        }
        Some(self.places().collect())
    }

    /// The places of all fingers, by the numbers of page and finger.
    pub fn places(&self) -> impl Iterator<Item = ((u64, u32), Point)> {
        self.down.iter().map(|(id, finger)| (*id, finger.at))
    }

    /// Gives a tap another number, since its page uses that of its finger again.
    fn set_aside(&mut self, id: (u64, u32)) {
        let Some(tap) = self.down.remove(&id) else { return };
        let page = id.0;
        self.down.insert((page, AGAIN + self.aside % NUMBERS), tap);
        self.aside = self.aside.wrapping_add(1);
        let taps = || self.down.range((page, AGAIN)..=(page, u32::MAX));
        let oldest = taps().next().map(|(id, _)| *id).filter(|_| taps().count() > MOST_TAPS);
        if let Some(oldest) = oldest {
            self.down.remove(&oldest);
        }
    }

    fn keep(&mut self, which: impl FnMut(&(u64, u32), &mut Finger) -> bool) {
        let before = self.down.len();
        self.down.retain(which);
        self.changed |= self.down.len() != before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: Point = Point { x: 0.062, y: 0.09 };
    const OTHER: Point = Point { x: 0.03, y: 0.05 };

    /// Fingers on a surface on which a press stays for 20 ms at least.
    fn fingers() -> PageFingers {
        let mut fingers = PageFingers::default();
        fingers.renew(20e-3);
        fingers
    }

    fn places(fingers: &PageFingers) -> Vec<Point> {
        fingers.places().map(|(_, at)| at).collect()
    }

    #[test]
    fn a_tap_stays_until_its_focus_and_is_told_once() {
        let mut fingers = fingers();
        fingers.touch((1, 0), Phase::Down, PLACE, 1.0);
        fingers.touch((1, 0), Phase::Up, PLACE, 1.0);
        // The surface stands still: it has not heard of the tap yet.
        fingers.settle(9.0);
        assert_eq!(fingers.take(9.0).map(|pressed| pressed.len()), Some(1));
        fingers.settle(9.019);
        assert!(fingers.take(9.019).is_none() && places(&fingers) == [PLACE]);
        fingers.settle(9.021);
        assert_eq!(fingers.take(9.021).map(|pressed| pressed.len()), Some(0));
        // One that rests longer goes when it is lifted.
        fingers.touch((1, 0), Phase::Down, PLACE, 10.0);
        assert!(fingers.take(10.0).is_some());
        fingers.touch((1, 0), Phase::Up, PLACE, 10.5);
        assert_eq!(fingers.take(10.5).map(|pressed| pressed.len()), Some(0));
    }

    #[test]
    fn a_finger_that_presses_again_before_its_focus_is_two() {
        let mut fingers = fingers();
        for at in [PLACE, OTHER] {
            fingers.touch((1, 0), Phase::Down, at, 0.0);
            assert!(fingers.take(0.0).is_some());
            fingers.touch((1, 0), Phase::Up, at, 0.0);
        }
        assert_eq!(places(&fingers), [OTHER, PLACE]);
        fingers.settle(0.1);
        assert!(places(&fingers).is_empty());
        for _ in 0..100 {
            fingers.touch((2, 0), Phase::Down, PLACE, 0.0);
            fingers.touch((2, 0), Phase::Up, PLACE, 0.0);
        }
        assert_eq!(places(&fingers).len(), MOST_TAPS + 1);
        fingers.leave(2);
        assert!(places(&fingers).is_empty());
    }

    #[test]
    fn a_finger_of_which_nothing_is_said_is_lifted() {
        let mut fingers = fingers();
        fingers.touch((1, 0), Phase::Down, PLACE, 0.0);
        fingers.touch((2, 0), Phase::Down, OTHER, 0.0);
        assert!(fingers.take(0.0).is_some());
        for _ in 0..8 {
            fingers.wait(SILENT / 6.0);
            fingers.touch((2, 0), Phase::Move, OTHER, 1.0);
        }
        fingers.settle(1.0);
        assert_eq!(places(&fingers), [OTHER]);
    }
}
