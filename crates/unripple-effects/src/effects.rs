//! Running a set of effects: touches and time in, cues out.

use crate::error::within;
use crate::fingers::{Finger, Under, holds};
use crate::play::{Budget, Maker, Moment, Out, Play};
use crate::{Cue, EffectSet, EffectsError, Kind, Level, Region, Start, limits};
use std::collections::BTreeMap;
use unripple_core::{Outline, Phase, Point, Touch};

/// Largest time accepted, in s: there the rounding of f64 is a tenth of a millisecond. With twice this time, it is two tenths.
const LARGEST_TIME: f64 = 1e12;
/// Number of bits of a voice's number that hold the effect, and of the bits below them that hold the
/// effect's part; the bits above hold the contact. This allows 256 effects in a set, of which
/// [`limits::MOST_EFFECTS`] permits 64.
const EFFECT_BITS: u32 = 8;

/// A running set of effects: takes touches and the time, gives cues.
///
/// Work and memory are bounded for any input: fingers beyond [`limits::MOST_FINGERS`] and cues of one call beyond
/// [`limits::MOST_CUES`] are dropped and counted. Touches whose place or time is not finite or out of range are refused and
/// counted, except that a finger is always lifted. A finger that is put down again without a lift counts as lifted before.
pub struct Effects {
    effects: Vec<Ready>,
    outline: Outline,
    fingers: BTreeMap<u64, Finger>,
    running: Vec<Running>,
    contacts: u64,
    /// Time of the latest touch.
    now: Option<f64>,
    has_begun: bool,
    dropped: u64,
    refused: u64,
}

/// An effect of a checked set, prepared for playing.
struct Ready {
    name: String,
    region: Region,
    level: Level,
    start: Start,
    maker: Maker,
}

/// A score that runs without a finger.
struct Running {
    contact: u64,
    effect: usize,
    play: Box<dyn Play>,
}

impl Effects {
    /// Prepares the effects of a set for a sheet of the given outline, with waveforms at `rate` samples per second.
    ///
    /// # Errors
    /// As [`EffectSet::check`]; [`EffectsError::Range`] if the rate is not within [`limits::SAMPLE_RATE`].
    pub fn new(set: &EffectSet, outline: Outline, rate: f64) -> Result<Self, EffectsError> {
        set.check()?;
        within("sample rate", rate, limits::SAMPLE_RATE)?;
        let ready = |effect: &crate::Effect| {
            let start = match &effect.kind {
                Kind::Score(score) => score.start,
                _ => Start::Touch,
            };
            let maker = effect.kind.maker(&effect.region, rate)?;
            Ok(Ready {
                name: effect.name.clone(),
                region: effect.region.clone(),
                level: effect.level,
                start,
                maker,
            })
        };
        Ok(Self {
            effects: set.effects.iter().map(ready).collect::<Result<_, EffectsError>>()?,
            outline,
            fingers: BTreeMap::new(),
            running: Vec::new(),
            contacts: 0,
            now: None,
            has_begun: false,
            dropped: 0,
            refused: 0,
        })
    }

    /// Processes a touch event and appends its cues to `cues`, after all timed cues that are due by the time
    /// of the touch.
    pub fn touch(&mut self, touch: &Touch, cues: &mut Vec<Cue>) {
        let lifts = touch.phase == Phase::Up;
        let is_time = touch.time.is_finite() && touch.time.abs() <= LARGEST_TIME;
        let [least, greatest] = limits::PLACE;
        let is_place = [touch.at.x, touch.at.y].iter().all(|v| (least..=greatest).contains(v));
        if !(is_time && is_place) {
            self.refused += 1;
            if !lifts {
                return;
            }
        }
        let now = self.now.unwrap_or(touch.time);
        let time = if is_time { touch.time.max(now) } else { self.now.unwrap_or(0.0) };
        self.now = Some(time);
        let mut budget = Budget { left: limits::MOST_CUES, dropped: 0 };
        self.begin(time);
        self.due(time, cues, &mut budget);
        let force = touch.force.filter(|force| force.is_finite());
        match touch.phase {
            Phase::Down => {
                self.lift(touch.finger, time, cues, &mut budget);
                self.land(touch.finger, time, touch.at, force, cues, &mut budget);
            }
            Phase::Move => self.slide(touch.finger, time, touch.at, force, cues, &mut budget),
            Phase::Up => self.lift(touch.finger, time, cues, &mut budget),
        }
        // What a touch started may be due at once.
        self.due(time, cues, &mut budget);
        self.dropped += budget.dropped;
    }

    /// Appends all timed cues that are due up to and including the time `until` (s) to `cues`.
    ///
    /// `until` may lie in the future, so that cues are given before they are due; if the finger is then lifted, a stop cancels
    /// the cues given ahead. Cues that are overdue by more than [`limits::LATEST`] are skipped.
    pub fn tick(&mut self, until: f64, cues: &mut Vec<Cue>) {
        if !(until.is_finite() && until.abs() <= LARGEST_TIME) {
            self.refused += 1;
            return;
        }
        let mut budget = Budget { left: limits::MOST_CUES, dropped: 0 };
        self.begin(until);
        self.due(until, cues, &mut budget);
        self.dropped += budget.dropped;
    }

    /// Starts a score ([`Start::Name`]) by the name of its effect, at a time (s) and a place (m); without a place, in the
    /// middle of the sheet.
    ///
    /// # Errors
    /// [`EffectsError::NoScore`] if no effect of that name is a score that is started by name, [`EffectsError::Range`] if the time
    /// or the place is not finite or out of range, [`EffectsError::Size`] if [`limits::MOST_SCORES`] run already.
    pub fn start(&mut self, name: &str, at: f64, place: Option<Point>) -> Result<(), EffectsError> {
        let effect = self.named(name)?;
        within("time of a start", at, [-LARGEST_TIME, LARGEST_TIME])?;
        place.map_or(Ok(()), |place| crate::error::place("place of a start", place))?;
        if self.running.len() >= limits::MOST_SCORES {
            let expected = format!("at most {} scores at once", limits::MOST_SCORES);
            return Err(EffectsError::Size { what: "scores", expected, found: self.running.len() + 1 });
        }
        self.run(effect, at, place);
        Ok(())
    }

    /// Stops all running instances of a score that is started by name, at a time (s); appends the stops to `cues`.
    ///
    /// # Errors
    /// [`EffectsError::NoScore`] if no effect of that name is a score that is started by name, [`EffectsError::Range`] if the time
    /// is not finite or out of range.
    pub fn stop(&mut self, name: &str, at: f64, cues: &mut Vec<Cue>) -> Result<(), EffectsError> {
        let effect = self.named(name)?;
        within("time of a stop", at, [-LARGEST_TIME, LARGEST_TIME])?;
        let mut budget = Budget { left: limits::MOST_CUES, dropped: 0 };
        let now = Moment { time: at, at: Point::default(), force: None, velocity: Point::default() };
        let (ready, outline) = (&self.effects[effect], &self.outline);
        self.running.retain_mut(|run| {
            if run.effect == effect {
                run.play.leave(&now, &mut ready.out(voice(run.contact, effect), outline, cues, &mut budget));
            }
            run.effect != effect
        });
        Ok(())
    }

    /// Whether no cues will come before the next touch or [`Effects::start`]: no finger is down and no score runs. False before
    /// the first touch or tick, which may start scores.
    pub fn rests(&self) -> bool {
        self.has_begun && self.fingers.is_empty() && self.running.is_empty()
    }

    /// Number of fingers that are now on the surface.
    pub fn fingers(&self) -> usize {
        self.fingers.len()
    }

    /// Number of cues dropped so far because one call would have given more than [`limits::MOST_CUES`].
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Number of touches and ticks refused so far: with a place or time out of range, of one finger too many, or of a finger that
    /// moved without having been put down.
    pub fn refused(&self) -> u64 {
        self.refused
    }

    /// Index of the effect of this name that is a score started by name.
    fn named(&self, name: &str) -> Result<usize, EffectsError> {
        let scores = || self.effects.iter().enumerate().filter(|(_, ready)| ready.start == Start::Name);
        let found = scores().find(|(_, ready)| ready.name == name).map(|(effect, _)| effect);
        found.ok_or_else(|| EffectsError::NoScore {
            expected: scores().map(|(_, ready)| ready.name.as_str()).collect::<Vec<_>>().join(", "),
            found: name.to_owned(),
        })
    }

    /// At the first touch or tick, starts the scores of [`Start::Zero`].
    fn begin(&mut self, time: f64) {
        if std::mem::replace(&mut self.has_begun, true) {
            return;
        }
        for effect in 0..self.effects.len() {
            if self.effects[effect].start == Start::Zero {
                self.run(effect, time, None);
            }
        }
    }

    /// Starts a score without a finger.
    fn run(&mut self, effect: usize, time: f64, place: Option<Point>) {
        let (width, height) = self.outline.extent();
        let at = place.unwrap_or_else(|| self.outline.nearest(Point::new(width / 2.0, height / 2.0)));
        let contact = self.next_contact();
        let mut play = (self.effects[effect].maker)(contact);
        let (mut cues, mut budget) = (Vec::new(), Budget { left: 0, dropped: 0 });
        let now = Moment { time, at, force: None, velocity: Point::default() };
        // A score cues nothing before it is due.
        play.enter(&now, true, &mut self.effects[effect].out(0, &self.outline, &mut cues, &mut budget));
        self.running.push(Running { contact, effect, play });
    }

    fn next_contact(&mut self) -> u64 {
        self.contacts += 1;
        self.contacts
    }

    /// A finger is put down.
    fn land(
        &mut self,
        id: u64,
        time: f64,
        at: Point,
        force: Option<f64>,
        cues: &mut Vec<Cue>,
        budget: &mut Budget,
    ) {
        if self.fingers.len() >= limits::MOST_FINGERS {
            self.refused += 1;
            return;
        }
        let contact = self.next_contact();
        let under = |ready: &Ready| {
            let play = (ready.start == Start::Touch).then(|| (ready.maker)(contact))?;
            Some(Under { inside: holds(&self.outline, &ready.region, at), play })
        };
        let mut finger = Finger::new(contact, time, at, force, self.effects.iter().map(under).collect());
        let now = finger.last;
        for (effect, (under, ready)) in finger.plays.iter_mut().zip(&self.effects).enumerate() {
            if let Some(under) = under.as_mut().filter(|under| under.inside) {
                let mut out = ready.out(voice(contact, effect), &self.outline, cues, budget);
                under.play.enter(&now, true, &mut out);
            }
        }
        self.fingers.insert(id, finger);
    }

    /// A finger moves, or its force changes.
    fn slide(
        &mut self,
        id: u64,
        time: f64,
        at: Point,
        force: Option<f64>,
        cues: &mut Vec<Cue>,
        budget: &mut Budget,
    ) {
        let Some(finger) = self.fingers.get_mut(&id) else {
            self.refused += 1;
            return;
        };
        let (from, to) = (finger.last, finger.moved(time, at, force));
        for (effect, (under, ready)) in finger.plays.iter_mut().zip(&self.effects).enumerate() {
            let Some(under) = under else { continue };
            let mut out = ready.out(voice(finger.contact, effect), &self.outline, cues, budget);
            let inside = holds(&self.outline, &ready.region, at);
            match (under.inside, inside) {
                (true, true) => under.play.step(&from, &to, &mut out),
                (false, true) => under.play.enter(&to, false, &mut out),
                (true, false) => under.play.leave(&to, &mut out),
                (false, false) => {}
            }
            under.play.pass(&from, &to, &mut out);
            under.inside = inside;
        }
        finger.last = to;
    }

    /// A finger is lifted, and the effects under it end.
    fn lift(&mut self, id: u64, time: f64, cues: &mut Vec<Cue>, budget: &mut Budget) {
        let Some(mut finger) = self.fingers.remove(&id) else { return };
        let now = Moment { time, ..finger.last };
        for (effect, (under, ready)) in finger.plays.iter_mut().zip(&self.effects).enumerate() {
            if let Some(under) = under.as_mut().filter(|under| under.inside) {
                let mut out = ready.out(voice(finger.contact, effect), &self.outline, cues, budget);
                under.play.leave(&now, &mut out);
            }
        }
    }

    /// Adds the timed cues of all fingers and scores.
    fn due(&mut self, until: f64, cues: &mut Vec<Cue>, budget: &mut Budget) {
        for finger in self.fingers.values_mut() {
            for (effect, (under, ready)) in finger.plays.iter_mut().zip(&self.effects).enumerate() {
                if let Some(under) = under.as_mut().filter(|under| under.inside) {
                    let mut out = ready.out(voice(finger.contact, effect), &self.outline, cues, budget);
                    under.play.due(until, &mut out);
                }
            }
        }
        for run in &mut self.running {
            let voice = voice(run.contact, run.effect);
            run.play.due(until, &mut self.effects[run.effect].out(voice, &self.outline, cues, budget));
        }
        self.running.retain(|run| !run.play.is_done(until));
    }
}

impl Ready {
    /// The output for a running instance of this effect.
    fn out<'o>(
        &self,
        voice: u64,
        outline: &'o Outline,
        cues: &'o mut Vec<Cue>,
        budget: &'o mut Budget,
    ) -> Out<'o> {
        Out { cues, budget, outline, voice, level: self.level }
    }
}

/// The voice of part 0 of an effect under a contact.
fn voice(contact: u64, effect: usize) -> u64 {
    ((contact << EFFECT_BITS) | effect as u64) << EFFECT_BITS
}
