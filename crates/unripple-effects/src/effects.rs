//! Effects in use: touches and time in, cues out.

use crate::error::within;
use crate::fingers::{Finger, Under, holds};
use crate::play::{Budget, Maker, Moment, Out, Play};
use crate::{Cue, EffectSet, EffectsError, Kind, Level, Region, Start, limits};
use std::collections::BTreeMap;
use unripple_core::{Outline, Phase, Point, Touch};

/// Largest time taken for one, in s: there rounding is a tenth of a millisecond. Doubled, it is two tenths.
const LARGEST_TIME: f64 = 1e12;
/// Bits of a voice below the contact: eight for the effect, eight for its part. So a set may have 256
/// effects, of which [`limits::MOST_EFFECTS`] leaves 64.
const EFFECT_BITS: u32 = 8;

/// A set of effects in use: touches and time in, cues out.
///
/// Work and memory are bounded whatever comes in: so many fingers, so many cues a call, the rest counted. Places and
/// times that are none are refused, and counted; a lift is never refused. A finger that comes again without having
/// left is taken to have left.
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

/// An effect ready to be played.
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
    /// The effects of a set on a sheet, waveforms at `rate` samples per second.
    ///
    /// # Errors
    /// The first value of the set that is not legal.
    pub fn new(set: &EffectSet, outline: Outline, rate: f64) -> Result<Self, EffectsError> {
        set.check()?;
        within("sample rate", rate, limits::SAMPLE_RATE)?;
        let ready = |effect: &crate::Effect| {
            let start = match &effect.kind {
                Kind::Score(score) => score.start,
                _ => Start::Touch,
            };
            let maker = effect.kind.maker(effect, rate)?;
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

    /// Adds the cues that a touch sets off, those due up to its time first.
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

    /// Adds the cues of everything timed that is due up to and with `until` (s).
    ///
    /// `until` may lie ahead of the clock, so that cues come before they are due; a finger that then lifts stops what
    /// was cued ahead. What is overdue by more than [`limits::LATEST`] is skipped.
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

    /// Starts a score by the name of its effect, at a time (s) and a place (m); without a place, in the
    /// middle of the sheet.
    ///
    /// # Errors
    /// [`EffectsError::NoScore`] if no effect of that name is such a score, [`EffectsError::Range`] if the time or the
    /// place is none, [`EffectsError::Size`] if too many run already.
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

    /// Stops every run of a score that was started by name, at a time (s).
    ///
    /// # Errors
    /// As [`Effects::start`].
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

    /// Whether no cue comes before the next touch or start: no finger is there, and no score runs.
    pub fn rests(&self) -> bool {
        self.has_begun && self.fingers.is_empty() && self.running.is_empty()
    }

    /// Number of fingers on the surface now.
    pub fn fingers(&self) -> usize {
        self.fingers.len()
    }

    /// Number of cues left out so far because a call gave too many.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Number of touches and ticks refused so far: at no place or time, or one finger too many.
    pub fn refused(&self) -> u64 {
        self.refused
    }

    /// Index of the score that is started by a name.
    fn named(&self, name: &str) -> Result<usize, EffectsError> {
        let scores = || self.effects.iter().enumerate().filter(|(_, ready)| ready.start == Start::Name);
        let found = scores().find(|(_, ready)| ready.name == name).map(|(effect, _)| effect);
        found.ok_or_else(|| EffectsError::NoScore {
            expected: scores().map(|(_, ready)| ready.name.as_str()).collect::<Vec<_>>().join(", "),
            found: name.to_owned(),
        })
    }

    /// The first time anything is heard of is time zero.
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

    /// A finger comes down.
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

    /// A finger moves, or presses otherwise.
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

    /// A finger leaves, and with it what it set off.
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

    /// Adds what is timed, of all fingers and scores.
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
    /// Where a play of this effect puts its cues.
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

/// Part 0 of an effect under a contact.
fn voice(contact: u64, effect: usize) -> u64 {
    ((contact << EFFECT_BITS) | effect as u64) << EFFECT_BITS
}
