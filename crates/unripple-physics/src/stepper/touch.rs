//! A finger on the simulated surface: being put down, moved and lifted.

use super::bank::Burden;
use unripple_core::Finger;

/// A finger that is being put down, in contact, or being lifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// Number by which the caller identifies the finger.
    pub(super) id: u64,
    /// Mass, damping, stiffness and contact radius of the finger.
    pub(super) finger: Finger,
    /// Index of the finger's pair of rows of weights.
    pub(super) slot: usize,
    /// Progress of the fade-in, 0 to 1; it decreases when the finger is lifted.
    pub(super) coming: f64,
    /// Progress of the movement to the newest place, 0 to 1.
    pub(super) moving: f64,
    /// Whether the finger has been lifted.
    pub(super) lifted: bool,
}

impl Touch {
    /// A finger at the start of its fade-in; `slot` is the index of the finger's pair of rows of weights.
    pub(super) fn new(id: u64, finger: Finger, slot: usize) -> Self {
        Self { id, finger, slot, coming: 0.0, moving: 1.0, lifted: false }
    }

    /// Whether the finger is being put down, moved or lifted.
    #[inline(always)]
    pub(super) fn changes(&self) -> bool {
        self.lifted || self.coming < 1.0 || self.moving < 1.0
    }

    /// Advances the finger's fade and movement by the given shares of the whole, 0 to 1 each.
    #[inline(always)]
    pub(super) fn go_on(&mut self, fade: f64, glide: f64) {
        let fade = if self.lifted { -fade } else { fade };
        self.coming = (self.coming + fade).clamp(0.0, 1.0);
        self.moving = (self.moving + glide).min(1.0);
    }

    /// Whether the finger has been lifted and its fade-out is over.
    #[inline(always)]
    pub(super) fn gone(&self) -> bool {
        self.lifted && self.coming <= 0.0
    }

    /// Factor of the finger's coupling to the sheet, 0 to 1: a function of the fade's progress with two continuous derivatives.
    #[inline(always)]
    pub(super) fn grip(&self) -> f64 {
        let x = self.coming;
        // 6x⁵ - 15x⁴ + 10x³: its first two derivatives vanish at both ends.
        x * x * x * (10.0 + x * (6.0 * x - 15.0))
    }

    /// Weights, 0 to 1, of the place that the finger moves from and the place that it moves to.
    #[inline(always)]
    pub(super) fn shares(&self) -> [f64; 2] {
        let grip = self.grip();
        [grip * (1.0 - self.moving), grip * self.moving]
    }

    /// The finger's mass, damping and stiffness as a load.
    pub(super) fn burden(&self) -> Burden {
        let Finger { mass, damping, stiffness, .. } = self.finger;
        Burden { mass, damping, stiffness, circuit: None, twin: false }
    }
}
