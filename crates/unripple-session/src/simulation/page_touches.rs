//! Fingers on pages, as a source of touches of the surface.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use unripple::core::{Outline, Point};
use unripple_touch::{Counts, Fingers, Heard, Key, Options, Source, TouchError, Wish};

/// Changes taken in one poll, so that a poll does bounded work; the rest is taken by the next.
const TAKEN: usize = 256;

/// Fingers at once over all pages: all that a crowd of pages can put down and a surface can tell apart.
const MOST: usize = 128;

/// Places (m) of the fingers of pages that are down, by the number of the page and the page's number for the
/// finger.
pub type Pressed = BTreeMap<(u64, u32), Point>;

/// What pages tell a source of touches.
pub enum News {
    /// All fingers that are down.
    Pressed(Pressed),
    /// Level of all effects, in dB relative to their own.
    Gain(f64),
}

/// Source of touches that receives the fingers on pages.
pub struct PageTouches {
    outline: Outline,
    news: Receiver<News>,
    fingers: Fingers,
    counts: Counts,
}

impl PageTouches {
    /// A source of touches on a surface with this outline, and the channel through which it is told of the fingers
    /// that are down.
    ///
    /// # Errors
    /// [`TouchError`] for an outline on which touches cannot be received.
    pub fn new(outline: &Outline) -> Result<(Sender<News>, Self), TouchError> {
        let (tell, news) = channel();
        // A page is one sender among others, and its link says when it is gone: nothing is lifted for want of news.
        let fingers = Fingers::new(Options { most: MOST, most_per_sender: MOST, ..Options::new(outline) })?;
        Ok((tell, Self { outline: outline.clone(), news, fingers, counts: Counts::default() }))
    }

    fn hear(&mut self, pressed: &Pressed, heard: &mut Heard) {
        self.fingers.lift_where(|key| !pressed.keys().any(|finger| *key == named(*finger)), heard);
        for (finger, at) in pressed {
            let key = named(*finger);
            // One that comes must come on the surface; one that slides off stays at its rim.
            let at = if self.fingers.has(key) { self.outline.nearest(*at) } else { *at };
            // What is refused is counted.
            let _ = self.fingers.put(key, at, None, heard);
        }
    }
}

/// A page's finger among those of all.
fn named((page, finger): (u64, u32)) -> Key {
    // Pages are counted from 1, and there will not be more of them than a u32 can tell apart.
    Key { peer: page as u32, stream: 0, session: i64::from(finger) }
}

impl Source for PageTouches {
    fn name(&self) -> &str {
        "pages"
    }

    fn poll(&mut self, now: f64, heard: &mut Heard) {
        self.fingers.begin(now);
        for _ in 0..TAKEN {
            let Ok(news) = self.news.try_recv() else { return };
            self.counts.packets += 1;
            match news {
                News::Pressed(pressed) => self.hear(&pressed, heard),
                News::Gain(db) => heard.wishes.push(Wish::Gain(db)),
            }
        }
    }

    fn counts(&self) -> Counts {
        self.fingers.counts() + self.counts
    }
}
