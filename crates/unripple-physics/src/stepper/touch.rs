//! A finger on the running surface: coming, moving, going.

use super::bank::Burden;
use unripple_core::Finger;

/// A finger that is coming, there, or going.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// Name that whoever put it down gave it.
    pub(super) id: u64,
    /// Its mass, damping, stiffness and contact radius.
    pub(super) finger: Finger,
    /// Which of the rows kept for fingers are its own.
    pub(super) slot: usize,
    /// Progress of coming, 0 to 1.
    pub(super) coming: f64,
    /// Progress of moving to its newest place, 0 to 1.
    pub(super) moving: f64,
    /// Whether it has been lifted.
    pub(super) lifted: bool,
}

impl Touch {
    /// A finger that is not felt yet; `slot` is the index of its two rows of weights.
    pub(super) fn new(id: u64, finger: Finger, slot: usize) -> Self {
        Self { id, finger, slot, coming: 0.0, moving: 1.0, lifted: false }
    }

    /// Whether it will not be as it is.
    #[inline(always)]
    pub(super) fn changes(&self) -> bool {
        self.lifted || self.coming < 1.0 || self.moving < 1.0
    }

    /// Goes on by these shares of its fade and its glide, 0 to 1 each.
    #[inline(always)]
    pub(super) fn go_on(&mut self, fade: f64, glide: f64) {
        let fade = if self.lifted { -fade } else { fade };
        self.coming = (self.coming + fade).clamp(0.0, 1.0);
        self.moving = (self.moving + glide).min(1.0);
    }

    /// Whether nothing is left of it.
    #[inline(always)]
    pub(super) fn gone(&self) -> bool {
        self.lifted && self.coming <= 0.0
    }

    /// How much of it is felt, 0 to 1: its progress with two smooth derivatives.
    #[inline(always)]
    pub(super) fn grip(&self) -> f64 {
        let x = self.coming;
        // 6x⁵ - 15x⁴ + 10x³: its first two derivatives vanish at both ends.
        x * x * x * (10.0 + x * (6.0 * x - 15.0))
    }

    /// Shares, 0 to 1, of the place it leaves and the place it goes to.
    #[inline(always)]
    pub(super) fn shares(&self) -> [f64; 2] {
        let grip = self.grip();
        [grip * (1.0 - self.moving), grip * self.moving]
    }

    /// The finger as a load.
    pub(super) fn burden(&self) -> Burden {
        let Finger { mass, damping, stiffness, .. } = self.finger;
        Burden { mass, damping, stiffness, circuit: None }
    }
}
