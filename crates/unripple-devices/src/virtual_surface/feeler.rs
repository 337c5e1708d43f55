//! What fingers on a virtual surface feel.

use super::Handle;
use crate::DevicesError;
use unripple_core::{Contact, FOCAL_RADIUS, Finger, Outline, Phase, Point, Surface, Touch};
use unripple_dsp::{Threshold, Weighting};
use unripple_physics::Medium;

/// Distance, in samples, between the instants at which the displacement is recorded: at 48 kHz 83 µs, twelve
/// times a period of 1 kHz. Twice the distance costs half as much and may miss the largest displacement by
/// more.
const STRIDE: usize = 4;

/// Number of places, besides the fingers', at which displacement is recorded, along each side of the
/// outline's bounding box: 36 in all, whose mean square represents that of the whole sheet. Twice as many
/// cost four times as much.
const ACROSS: usize = 6;

/// What one finger on a virtual surface felt since the last call of [`Feeler::look`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feeling {
    /// Number of the finger, as in its [`Touch`].
    pub finger: u64,
    /// Place of the finger, in m.
    pub at: Point,
    /// Largest displacement since the last call of [`Feeler::look`], weighted by the threshold of touch, in
    /// dB above it; `None` without motion.
    pub level_db: Option<f64>,
    /// Contrast: largest velocity since the last call of [`Feeler::look`], relative to the rms velocity, at
    /// the same instant, of the places outside all fingers' focal discs; `None` if nothing is felt.
    pub contrast: Option<f64>,
}

/// Puts fingers on a virtual surface and computes what they feel.
///
/// The displacement is recorded at each finger's place and, for the contrast, at a grid of other places. The
/// fingers load the sheet, and what they feel is its motion under the load of all of them.
#[derive(Debug)]
pub struct Feeler {
    handle: Handle,
    /// The load of each finger on the surface; `None` if fingers do not load it.
    finger: Option<Finger>,
    outline: Outline,
    /// The finger in each slot, whether it presses on the surface yet, whether it has lifted since the last
    /// call of `look`, and its place.
    slots: Vec<Option<u64>>,
    pressing: Vec<bool>,
    left: Vec<bool>,
    places: Vec<Point>,
    rate: f64,
    disc: f64,
    moved: bool,
}

impl Feeler {
    /// Prepares recording of what at most `most` fingers feel on a virtual surface.
    ///
    /// # Errors
    /// [`DevicesError`] if the surface cannot be watched.
    pub fn new(handle: Handle, surface: &Surface, most: usize) -> Result<Self, DevicesError> {
        let outline = surface.outline.clone();
        let (width, height) = outline.extent();
        let middle = outline.nearest(Point::new(width / 2.0, height / 2.0));
        let cell = |n: usize, side: f64| (n as f64 + 0.5) * side / ACROSS as f64;
        let grid =
            (0..ACROSS * ACROSS).map(|n| Point::new(cell(n % ACROSS, width), cell(n / ACROSS, height)));
        let mut places = vec![middle; most];
        places.extend(grid.filter(|place| outline.contains(*place)));
        handle.watch(&places, STRIDE)?;
        Ok(Self {
            handle,
            finger: Some(surface.finger),
            outline,
            slots: vec![None; most],
            pressing: vec![false; most],
            left: vec![false; most],
            places,
            rate: surface.emission.rate / STRIDE as f64,
            disc: FOCAL_RADIUS * Medium::of(&surface.sheet).lambda_min(surface.emission.band[1]),
            moved: false,
        })
    }

    /// This feeler with fingers that do not load the surface: it computes the motion of the free surface where they are.
    pub fn weightless(self) -> Self {
        Self { finger: None, ..self }
    }

    /// Processes a touch event: a finger came down, moved or lifted. Fingers beyond the largest number are
    /// ignored. If the surface has no room for a finger while others are still being lifted, it presses as
    /// soon as there is room.
    ///
    /// # Errors
    /// [`DevicesError`] for a finger that the surface does not know.
    pub fn touch(&mut self, touch: &Touch) -> Result<(), DevicesError> {
        let at = self.outline.nearest(touch.at);
        let mut here = self.slots.iter().zip(&self.left);
        let slot = here.position(|(slot, left)| *slot == Some(touch.finger) && !left);
        match (touch.phase, slot) {
            (Phase::Up, Some(slot)) => {
                self.left[slot] = true;
                if std::mem::take(&mut self.pressing[slot]) {
                    self.handle.lift(touch.finger)?;
                }
            }
            (Phase::Down | Phase::Move, Some(slot)) => {
                self.places[slot] = at;
                self.moved = true;
                if self.pressing[slot] {
                    self.handle.move_finger(touch.finger, at)?;
                }
            }
            (Phase::Down, None) => {
                let free = self.slots.iter().position(Option::is_none);
                let Some(slot) = free.or_else(|| self.left.iter().position(|left| *left)) else {
                    return Ok(());
                };
                self.slots[slot] = Some(touch.finger);
                self.left[slot] = false;
                self.places[slot] = at;
                self.moved = true;
            }
            (Phase::Move | Phase::Up, None) => {}
        }
        Ok(())
    }

    /// Updates the recorded places and the loads to the fingers' places; to be called once per block.
    ///
    /// # Errors
    /// [`DevicesError`] if the surface cannot be watched there.
    pub fn follow(&mut self) -> Result<(), DevicesError> {
        if std::mem::take(&mut self.moved) {
            self.handle.move_watched(&self.places)?;
        }
        let Some(finger) = self.finger else { return Ok(()) };
        let here = self.slots.iter().zip(&self.left).map(|(slot, left)| slot.filter(|_| !left));
        let slots = here.zip(&self.places).zip(&mut self.pressing);
        for ((id, at), pressing) in slots.filter(|(_, pressing)| !**pressing) {
            let contact = Contact { at: *at, finger };
            *pressing = id.is_some_and(|id| self.handle.touch(id, &contact).is_ok());
        }
        Ok(())
    }

    /// Returns what every finger felt since the last call, including fingers that have lifted since then.
    pub fn look(&mut self) -> Vec<Feeling> {
        let feelings = self.feelings();
        for (slot, left) in self.slots.iter_mut().zip(&mut self.left) {
            if std::mem::take(left) {
                *slot = None;
            }
        }
        feelings
    }

    fn feelings(&self) -> Vec<Feeling> {
        let traces = self.handle.watched();
        let samples = traces.iter().map(Vec::len).min().unwrap_or(0);
        let down: Vec<usize> = (0..self.slots.len()).filter(|slot| self.slots[*slot].is_some()).collect();
        if samples < 3 {
            return Vec::new();
        }
        let outside: Vec<usize> = (self.slots.len()..self.places.len())
            .filter(|place| {
                down.iter().all(|slot| self.places[*slot].distance(self.places[*place]) > self.disc)
            })
            .collect();
        let weighting = Weighting::padded(&Threshold::default(), self.rate, samples, samples / 4);
        let velocity = |place: usize, i: usize| f64::from(traces[place][i + 1] - traces[place][i - 1]);
        let feel = |slot: usize| {
            let trace: Vec<f64> = traces[slot][..samples].iter().map(|u| f64::from(*u)).collect();
            let felt = weighting.weigh(&trace).iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let speed = |i: &usize| velocity(slot, *i).abs();
            let peak = (1..samples - 1).max_by(|a, b| speed(a).total_cmp(&speed(b))).unwrap_or(1);
            let square = outside.iter().map(|place| velocity(*place, peak).powi(2)).sum::<f64>();
            let rms = (square / outside.len().max(1) as f64).sqrt();
            Feeling {
                finger: self.slots[slot].unwrap_or_default(),
                at: self.places[slot],
                level_db: (felt > 0.0).then(|| 20.0 * felt.log10()),
                contrast: (felt > 1.0 && rms > 0.0).then(|| speed(&peak) / rms),
            }
        };
        down.into_iter().map(feel).collect()
    }
}
