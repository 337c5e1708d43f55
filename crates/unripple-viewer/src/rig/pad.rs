use crate::wire::Phase;
use std::collections::HashSet;
use std::sync::mpsc::{Receiver, Sender, channel};
use unripple::core::{Outline, Phase as Core, Point, Touch};
use unripple_touch::{Counts, Heard, Source};

/// Touches taken in one poll.
const TAKEN: usize = 256;

/// What a page's finger did: its number over all pages, what, and where.
pub type Pressed = (u64, Phase, Point);

/// Fingers on pages as a source of touches.
pub struct Pad {
    outline: Outline,
    pressed: Receiver<Pressed>,
    down: HashSet<u64>,
    counts: Counts,
}

impl Pad {
    /// A source for a surface, and the end that is told.
    pub fn new(outline: &Outline) -> (Sender<Pressed>, Self) {
        let (tell, pressed) = channel();
        let counts = Counts::default();
        (tell, Self { outline: outline.clone(), pressed, down: HashSet::new(), counts })
    }

    fn hear(&mut self, (finger, phase, at): Pressed, now: f64, heard: &mut Heard) {
        let known = self.down.contains(&finger);
        let phase = match phase {
            Phase::Down if !self.outline.contains(at) => {
                self.counts.outside += 1;
                return;
            }
            Phase::Down if !known => Core::Down,
            Phase::Down | Phase::Move if known => Core::Move,
            Phase::Up if known => Core::Up,
            _ => return,
        };
        match phase {
            Core::Down => drop(self.down.insert(finger)),
            Core::Up => drop(self.down.remove(&finger)),
            Core::Move => {}
        }
        let at = self.outline.nearest(at);
        self.counts.touches += 1;
        heard.touches.push(Touch { finger, phase, at, time: now, force: None });
    }
}

impl Source for Pad {
    fn name(&self) -> &str {
        "pages"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        for _ in 0..TAKEN {
            let Ok(pressed) = self.pressed.try_recv() else { return };
            self.counts.packets += 1;
            self.hear(pressed, now, heard);
        }
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
