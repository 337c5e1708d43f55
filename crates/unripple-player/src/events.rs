//! Drives in the player: those that repeat, those that are being played, and the ledger of what has been
//! started.

use crate::copies::{Fade, Sounding};
use crate::kernels::Wide;
use crate::ledger::Ledger;
use crate::origin::Whose;
use crate::outlet::Outlet;
use crate::shelf::{Garbage, Shelf};
use crate::{Count, Options, PreparedDrive, Report, Voice, Why};
use pulp::Arch;
use std::collections::VecDeque;
use std::sync::Arc;

/// Largest number of blocks of the ledger that are summed again per block, where something stopped early: a bound on the work.
/// With twice this value, room that was given up is free again in half the time.
const REFILLS: u64 = 4;

/// The drives that repeat and those that are being played, and the ledger of what has been started.
pub(crate) struct Events {
    shelf: Shelf<PreparedDrive>,
    repeating: Vec<Repeating>,
    sounding: Vec<Sounding>,
    /// How many of them sounded before this block.
    older: usize,
    put_off: VecDeque<PutOff>,
    /// Sums of what has been started, and what it takes of the limits.
    pub(crate) ledger: Ledger,
    /// Blocks of the ledger that hold more than what still sounds.
    stale: Option<(u64, u64)>,
    /// Samples that may still be compared with the limits in this block.
    left: usize,
    options: Options,
    arch: Arch,
}

struct Repeating {
    whose: Whose,
    drive: usize,
    gain: f32,
    base: u64,
    period: f64,
    begun: u64,
}

impl Repeating {
    fn next(&self) -> u64 {
        self.base.saturating_add((self.begun as f64 * self.period).round() as u64)
    }
}

struct PutOff {
    whose: Whose,
    drive: usize,
    gain: f32,
    since: u64,
}

impl Events {
    /// No drives yet, with memory for as many as the options allow.
    pub(crate) fn new(options: &Options) -> Self {
        Self {
            shelf: Shelf::new(Self::places(options)),
            repeating: Vec::with_capacity(options.voices),
            sounding: Vec::with_capacity(options.copies),
            older: 0,
            put_off: VecDeque::with_capacity(options.copies),
            ledger: Ledger::new(options),
            stale: None,
            left: options.work,
            options: options.clone(),
            arch: Arch::new(),
        }
    }

    /// Number of drives that may be held at once.
    pub(crate) fn places(options: &Options) -> usize {
        options.voices + 2 * options.copies + 2
    }

    /// Begins, at sample `clock`, the copies that were postponed because the block before had no time for
    /// them.
    pub(crate) fn resume(&mut self, clock: u64, outlet: &mut Outlet) {
        self.left = self.options.work;
        for _ in 0..self.put_off.len() {
            let Some(PutOff { whose, drive, gain, since }) = self.put_off.pop_front() else { return };
            let samples = self.cost(drive);
            if samples > self.left && self.left < self.options.work {
                self.put_off.push_front(PutOff { whose, drive, gain, since });
                return;
            }
            if clock - since > self.samples(drive) {
                // What would end more than twice its length after it was asked for.
                self.release(drive, outlet);
                outlet.refuse(Some(whose.voice), Why::Stale);
                continue;
            }
            outlet.report(Report::Late { voice: Some(whose.voice), by: clock - since });
            self.begin(whose, drive, clock, gain, outlet);
        }
    }

    /// Starts a drive at a sample of the clock; returns whether a copy or repetition of it has been
    /// accepted.
    pub(crate) fn start(
        &mut self,
        (whose, drive): (Whose, Arc<PreparedDrive>),
        sample: u64,
        (gain, period): (f32, Option<f64>),
        outlet: &mut Outlet,
    ) -> bool {
        let voice = whose.voice;
        let period = period.or(drive.every().map(|every| every as f64));
        let refused = match period {
            _ if !gain.is_finite() => Some(Why::Gain),
            Some(period) if !(period >= self.options.block as f64 && period.is_finite()) => Some(Why::Period),
            _ => self.unfit(&drive),
        };
        if let Some(why) = refused {
            return self.refuse(voice, drive, why, outlet);
        }
        if period.is_some() {
            if let Some(at) = self.repeating.iter().position(|held| held.whose.voice == voice) {
                self.end(at, outlet);
            }
            if self.repeating.len() >= self.options.voices {
                return self.refuse(voice, drive, Why::Voices, outlet);
            }
        }
        let drive = match self.shelf.put(drive) {
            Ok(place) => place,
            Err(drive) => return self.refuse(voice, drive, Why::Copies, outlet),
        };
        match period {
            Some(period) => {
                self.repeating.push(Repeating { whose, drive, gain, base: sample, period, begun: 0 });
                true
            }
            None => self.ask(whose, drive, sample, gain, outlet),
        }
    }

    /// Gives a repetition another drive.
    pub(crate) fn swap(&mut self, voice: Voice, drive: Arc<PreparedDrive>, outlet: &mut Outlet) {
        if let Some(why) = self.unfit(&drive) {
            self.refuse(voice, drive, why, outlet);
            return;
        }
        let Some(at) = self.repeating.iter().position(|held| held.whose.voice == voice) else {
            self.refuse(voice, drive, Why::Unknown, outlet);
            return;
        };
        let every = drive.every().filter(|&every| every >= self.options.block);
        let place = match self.shelf.put(drive) {
            Ok(place) => place,
            Err(drive) => {
                self.refuse(voice, drive, Why::Copies, outlet);
                return;
            }
        };
        let held = &mut self.repeating[at];
        let old = std::mem::replace(&mut held.drive, place);
        if let Some(every) = every {
            (held.base, held.begun, held.period) = (held.next(), 0, every as f64);
        }
        self.release(old, outlet);
    }

    /// Gives the copies of a repetition to come another gain, a factor.
    pub(crate) fn gain(&mut self, voice: Voice, gain: f32, outlet: &mut Outlet) {
        match self.repeating.iter_mut().find(|held| held.whose.voice == voice) {
            _ if !gain.is_finite() => outlet.refuse(Some(voice), Why::Gain),
            Some(held) => held.gain = gain,
            None => outlet.refuse(Some(voice), Why::Unknown),
        }
    }

    /// Ends what the command of number `id` began, from a sample on; what fades already does so from the
    /// start of the block.
    pub(crate) fn stop(&mut self, id: u64, sample: u64, fade: Option<u32>, outlet: &mut Outlet) {
        if let Some(at) = self.repeating.iter().position(|held| held.whose.id == id) {
            let voice = self.end(at, outlet);
            if !self.is_on(voice) {
                outlet.report(Report::Ended { voice, sample });
            }
        }
        for _ in 0..self.put_off.len() {
            match self.put_off.pop_front() {
                Some(waits) if waits.whose.id == id => self.release(waits.drive, outlet),
                Some(waits) => self.put_off.push_back(waits),
                None => {}
            }
        }
        let Some(fade) = fade.map(|fade| fade.max(self.options.block as u32)) else { return };
        let block = self.options.block as u64;
        for held in self.sounding.iter_mut().filter(|held| held.whose.id == id) {
            let old = held.end();
            let from = if held.fade.is_some() { sample - sample % block } else { sample };
            held.fade = Some(Fade::after(held.fade, from, fade));
            if held.end() < old {
                let (from, to) = (held.end() / block, (old - 1) / block);
                let (low, high) = self.stale.unwrap_or((from, to));
                self.stale = Some((low.min(from), high.max(to)));
            }
        }
    }

    /// First sample of the repetition that comes next, and whose it is.
    pub(crate) fn next(&self) -> Option<(u64, usize)> {
        self.repeating.iter().enumerate().map(|(at, held)| (held.next(), at)).min()
    }

    /// Begins the next copy of the repetition of index `at`.
    pub(crate) fn repeat(&mut self, at: usize, outlet: &mut Outlet) {
        let held = &mut self.repeating[at];
        let sample = held.next();
        held.begun += 1;
        let (whose, drive, gain) = (held.whose, held.drive, held.gain);
        self.shelf.hold(drive);
        self.ask(whose, drive, sample, gain, outlet);
    }

    /// Adds the block that begins at sample `clock` to `out` (outputs x samples), which is silent. What
    /// sounded before comes first, then what `kept` adds, then what begins in this block: the order in which
    /// the ledger was told of them.
    pub(crate) fn mix(&mut self, clock: u64, out: &mut [f32], kept: impl FnOnce(&mut [f32])) {
        self.refill(clock);
        let (older, newer) = self.sounding.split_at(self.older);
        self.mix_some(older, clock, out);
        kept(out);
        self.mix_some(newer, clock, out);
    }

    fn mix_some(&self, some: &[Sounding], clock: u64, out: &mut [f32]) {
        let (shelf, block) = (&self.shelf, self.options.block);
        self.arch.dispatch(Wide(
            #[inline(always)]
            || some.iter().for_each(|held| held.mix(shelf, clock, block, out)),
        ));
    }

    /// Ends the block that begins at sample `clock`, of which this was emitted (outputs x samples).
    pub(crate) fn settle(&mut self, clock: u64, emitted: &[f32], outlet: &mut Outlet) {
        let ledger = &mut self.ledger;
        self.arch.dispatch(Wide(
            #[inline(always)]
            || ledger.settle(emitted),
        ));
        let end = clock + self.options.block as u64;
        let mut at = 0;
        while at < self.sounding.len() {
            if self.sounding[at].end() > end {
                at += 1;
                continue;
            }
            let held = self.sounding.remove(at);
            self.release(held.drive, outlet);
            if !self.is_on(held.whose.voice) {
                outlet.report(Report::Ended { voice: held.whose.voice, sample: held.end() });
            }
        }
        self.older = self.sounding.len();
    }

    /// Whether nothing sounds, repeats or waits.
    pub(crate) fn is_idle(&self) -> bool {
        self.sounding.is_empty() && self.repeating.is_empty() && self.put_off.is_empty()
    }

    /// Whether anything of what the command of number `id` began sounds, repeats or waits.
    pub(crate) fn holds(&self, id: u64) -> bool {
        self.any(|whose| whose.id == id)
    }

    fn is_on(&self, voice: Voice) -> bool {
        self.any(|whose| whose.voice == voice)
    }

    fn any(&self, is: impl Fn(Whose) -> bool) -> bool {
        self.sounding.iter().any(|held| is(held.whose))
            || self.repeating.iter().any(|held| is(held.whose))
            || self.put_off.iter().any(|held| is(held.whose))
    }

    fn unfit(&self, drive: &PreparedDrive) -> Option<Why> {
        if drive.outputs() != self.options.outputs {
            return Some(Why::Outputs);
        }
        (drive.samples() > self.options.longest).then_some(Why::Samples)
    }

    fn cost(&self, drive: usize) -> usize {
        self.options.outputs * self.samples(drive) as usize
    }

    fn samples(&self, drive: usize) -> u64 {
        self.shelf.get(drive).map_or(0, |drive| drive.samples() as u64)
    }

    /// Begins a copy whose use of its drive is counted already, now or, for want of time, in the next block; whether it could.
    fn ask(&mut self, whose: Whose, drive: usize, sample: u64, gain: f32, outlet: &mut Outlet) -> bool {
        if self.sounding.len() + self.put_off.len() >= self.options.copies {
            self.release(drive, outlet);
            outlet.refuse(Some(whose.voice), Why::Copies);
            return false;
        }
        let full = self.cost(drive) > self.left && self.left < self.options.work;
        if full || !self.put_off.is_empty() {
            outlet.meters.add(Count::PutOff);
            self.put_off.push_back(PutOff { whose, drive, gain, since: sample });
        } else {
            self.begin(whose, drive, sample, gain, outlet);
        }
        true
    }

    /// Judges a copy, enters it into the ledger, and lets it sound with the gain that is left.
    fn begin(&mut self, whose: Whose, place: usize, sample: u64, asked: f32, outlet: &mut Outlet) {
        let Some(drive) = self.shelf.get(place) else { return };
        let (ledger, samples) = (&mut self.ledger, drive.samples());
        self.left = self.left.saturating_sub(drive.outputs() * samples);
        let verdict = self.arch.dispatch(Wide(
            #[inline(always)]
            || {
                let verdict = ledger.judge(drive, sample, asked);
                ledger.enter(drive, sample, verdict.gain);
                verdict
            },
        ));
        let gain = verdict.gain;
        outlet.started(whose.voice, sample, [asked, gain], verdict.by);
        self.sounding.push(Sounding {
            whose,
            drive: place,
            start: sample,
            samples: samples as u64,
            gain,
            fade: None,
        });
    }

    /// Makes a few blocks of the ledger anew, of what still sounds.
    fn refill(&mut self, clock: u64) {
        let Some((from, to)) = self.stale else { return };
        let from = from.max(clock / self.options.block as u64 + 1);
        let (shelf, sounding, ledger) = (&self.shelf, &self.sounding, &mut self.ledger);
        self.arch.dispatch(Wide(
            #[inline(always)]
            || {
                for block in from..(from + REFILLS).min(to + 1) {
                    ledger.clear(block);
                    for held in sounding {
                        if let Some(drive) = shelf.get(held.drive) {
                            ledger.refill(block, drive, held.start, held.end(), held.gain);
                        }
                    }
                    ledger.weigh_block(block);
                }
            },
        ));
        self.stale = (from + REFILLS <= to).then_some((from + REFILLS, to));
    }

    /// Lets one repeat no more; its name.
    fn end(&mut self, at: usize, outlet: &mut Outlet) -> Voice {
        let held = self.repeating.remove(at);
        self.release(held.drive, outlet);
        held.whose.voice
    }

    fn release(&mut self, drive: usize, outlet: &mut Outlet) {
        if let Some(drive) = self.shelf.release(drive) {
            outlet.discard(Garbage::Drive(drive));
        }
    }

    fn refuse(&mut self, voice: Voice, drive: Arc<PreparedDrive>, why: Why, outlet: &mut Outlet) -> bool {
        outlet.discard(Garbage::Drive(drive));
        outlet.refuse(Some(voice), why);
        false
    }
}
