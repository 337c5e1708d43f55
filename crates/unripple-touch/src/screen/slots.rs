//! The evdev multi-touch protocol B: slots and tracking ids.

/// One input event of the kernel, as in `linux/input.h`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Kind: 0 for `EV_SYN`, 3 for `EV_ABS`.
    pub kind: u16,
    /// Code of the event within its kind.
    pub code: u16,
    /// Value of the event, in the device's own unit.
    pub value: i32,
}

/// Kinds and codes of events, as `linux/input-event-codes.h` has them.
const EV_SYN: u16 = 0;
const EV_ABS: u16 = 3;
const SYN_REPORT: u16 = 0;
const SYN_DROPPED: u16 = 3;
const SLOT: u16 = 0x2f;
const X: u16 = 0x35;
const Y: u16 = 0x36;
const TRACKING_ID: u16 = 0x39;
const PRESSURE: u16 = 0x3a;

/// Slots that are followed; screens have ten or so.
const MOST: usize = 64;

/// The state of one slot of a multi-touch screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Slot {
    /// Tracking id of the contact in the slot; contacts whose id was lost get a negative one.
    pub(super) contact: Option<i64>,
    pub(super) x: Option<i32>,
    pub(super) y: Option<i32>,
    pub(super) pressure: Option<i32>,
    /// Whether events were lost, so that there may be a contact of unknown tracking id.
    lost: bool,
}

/// State of a touch screen's report, the group of events up to a `SYN_REPORT`, after one of its events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Report {
    /// The report is not complete.
    Open,
    /// The report is complete: the slots agree with the screen.
    Whole,
    /// Events were lost: the caller lifts all contacts and calls [`Slots::resume`].
    Lost,
}

/// The contact slots of a screen of protocol type B, followed by its events
/// (`Documentation/input/multi-touch-protocol.rst` of the kernel).
///
/// ```
/// use unripple_touch::{Event, Slots};
///
/// let mut slots = Slots::new();
/// // A contact in slot 0, at (300, 200), and the end of the report.
/// for (kind, code, value) in [(3, 0x39, 45), (3, 0x35, 300), (3, 0x36, 200), (0, 0, 0)] {
///     slots.push(Event { kind, code, value });
/// }
/// assert_eq!(slots.contacts().collect::<Vec<_>>(), [(0, 45, (300, 200), None)]);
/// ```
#[derive(Clone, Debug)]
pub struct Slots {
    slots: Vec<Slot>,
    current: usize,
    dropping: bool,
    unnamed: i64,
}

impl Slots {
    /// Slots of a screen that nothing touches.
    pub fn new() -> Self {
        Self { slots: vec![Slot::default(); MOST], current: 0, dropping: false, unnamed: 0 }
    }

    /// Processes the next event. The contacts are consistent whenever it returns [`Report::Whole`].
    pub fn push(&mut self, event: Event) -> Report {
        match (event.kind, event.code) {
            (EV_SYN, SYN_DROPPED) => self.dropping = true,
            (EV_SYN, SYN_REPORT) if self.dropping => return Report::Lost,
            (EV_SYN, SYN_REPORT) => return Report::Whole,
            (EV_ABS, code) if !self.dropping => self.absolute(code, event.value),
            _ => {}
        }
        Report::Open
    }

    /// Resumes after lost events; the next events belong to `slot`. Contacts are known again once they move.
    pub fn resume(&mut self, slot: usize) {
        let lost = Slot { lost: true, ..Slot::default() };
        self.slots.fill(lost);
        (self.current, self.dropping) = (slot, false);
    }

    /// Slot, tracking id, place (x, y) and pressure of every contact whose place is known, in the screen's own units.
    pub fn contacts(&self) -> impl Iterator<Item = (usize, i64, (i32, i32), Option<i32>)> + '_ {
        let known = |(i, slot): (usize, &Slot)| Some((i, slot.contact?, (slot.x?, slot.y?), slot.pressure));
        self.slots.iter().enumerate().filter_map(known)
    }

    fn absolute(&mut self, code: u16, value: i32) {
        if code == SLOT {
            // Slots beyond the most are left aside.
            self.current = usize::try_from(value).unwrap_or(usize::MAX);
            return;
        }
        let Some(slot) = self.slots.get_mut(self.current) else {
            return;
        };
        match code {
            TRACKING_ID if value < 0 => *slot = Slot { pressure: None, contact: None, lost: false, ..*slot },
            TRACKING_ID => {
                // A coordinate that does not change is not reported again, so that of the previous contact still
                // holds.
                (slot.contact, slot.lost) = (Some(i64::from(value)), false);
            }
            X => slot.x = Some(value),
            Y => slot.y = Some(value),
            PRESSURE => slot.pressure = Some(value),
            _ => {}
        }
        if slot.lost && slot.x.is_some() && slot.y.is_some() {
            self.unnamed -= 1;
            (slot.contact, slot.lost) = (Some(self.unnamed), false);
        }
    }
}

impl Default for Slots {
    fn default() -> Self {
        Self::new()
    }
}
