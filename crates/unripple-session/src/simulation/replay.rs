//! Two simulations, each of a drive on a surface that nobody touches, shown side by side.

use super::lens::{Lens, weights};
use super::past::{Past, room, stride};
use super::transport::Transport;
use crate::ViewError;
use crate::stop::wanted;
use crate::wire::{Frame, Head, Strip};
use std::sync::Arc;
use unripple::core::{Drive, Point, Surface};
use unripple::physics::Modes;
use unripple::physics::stepper::{History, Plant, StepperOptions, VirtualSurface};
use unripple_tasks::Progress;

/// Cells along the longer side of each picture: two of these are no more than one of the live surface's.
const CELLS: usize = 88;

/// Speed at which a replay is shown at first, in s of the surface per second of the page. A focus of a millisecond then takes
/// a fifth of a second.
const SPEED: f64 = 0.005;

/// How much of the past a trace shows, in s. Half of the live trace's, since only the focus is looked at.
const SPAN: f64 = 0.02;

/// Time for which a replay goes on after the focus, in s, so that the waves are seen to part again.
const AFTER: f64 = 6e-3;

/// Samples that are simulated between two looks whether the replay is still wanted. With 10 000 modes they take some tens of
/// milliseconds.
const LOOKED: usize = 512;

/// One simulation: the motion caused by a drive on a surface that nobody touches.
pub struct Pane {
    history: History,
    /// Drive of each actuator over its limit.
    drive: Vec<Vec<f32>>,
}

/// Simulations shown side by side, in step, again and again.
pub struct Replay {
    panes: Vec<Pane>,
    lens: Lens,
    rate: f64,
    /// The focal instant, in s.
    focus: f64,
    targets: Vec<(Point, Vec<f32>)>,
}

impl Replay {
    /// Simulates the surface under each drive, from rest until shortly after the focal instant `focus` (s); `places`
    /// (m) are the targets. If the states of all that time are too many for the memory that the live surface may take,
    /// only the last of them are kept.
    ///
    /// # Errors
    /// [`ViewError::Physics`] for drives that do not fit the surface; [`ViewError::Stopped`] if `progress` reports a
    /// cancellation.
    pub fn record(
        surface: &Surface,
        modes: Arc<Modes>,
        drives: &[Drive],
        focus: f64,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Self, ViewError> {
        let plant = Plant::of(surface, modes.clone())?;
        let most = room(plant.modes()) / drives.len().max(1);
        Self::within(most, surface, (modes, &plant), (drives, focus), places, progress)
    }

    /// As [`Replay::record`], of a surface whose plant is known, with at most `most` states of each simulation.
    fn within(
        most: usize,
        surface: &Surface,
        (modes, plant): (Arc<Modes>, &Plant),
        (drives, focus): (&[Drive], f64),
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Self, ViewError> {
        let frames = ((focus + AFTER) * surface.emission.rate).ceil() as usize;
        let record = |drive| Pane::record(surface, modes.clone(), drive, [frames, most], progress);
        let panes = drives.iter().map(record).collect::<Result<Vec<Pane>, ViewError>>()?;
        let lens = Lens::new(plant, &surface.outline, CELLS);
        let targets = places.iter().map(|at| (*at, weights(plant, &[*at]))).collect();
        Ok(Self { panes, lens, rate: surface.emission.rate, focus, targets })
    }

    /// The first instant that can be shown, in s.
    pub fn from(&self) -> f64 {
        let oldest = |pane: &Pane| {
            pane.history.newest() as usize - pane.history.stride() * pane.history.len().saturating_sub(1)
        };
        self.panes.first().map_or(0.0, |pane| oldest(pane) as f64 / self.rate)
    }

    /// Duration at the beginning of the simulation, in s, whose states are not stored because they would
    /// take too much memory.
    pub fn dropped(&self) -> f64 {
        let dropped = |pane: &Pane| {
            let states = pane.history.newest() as usize / pane.history.stride();
            states.saturating_sub(pane.history.len()) * pane.history.stride()
        };
        self.panes.first().map_or(0.0, |pane| dropped(pane) as f64 / self.rate)
    }

    /// The last instant that can be shown, in s.
    pub fn to(&self) -> f64 {
        self.panes.first().map_or(0.0, |pane| pane.history.newest() as f64 / self.rate)
    }

    /// The focal instant, in s.
    pub fn focus(&self) -> f64 {
        self.focus
    }

    /// Interval of the stored states, in s.
    pub fn state(&self) -> f64 {
        self.panes.first().map_or(1.0, |pane| pane.history.stride() as f64) / self.rate
    }

    /// Speed at which the replay is shown at first, in s of the surface per second of the page.
    pub fn speed(&self) -> f64 {
        SPEED
    }

    /// A clock set to the first instant.
    pub fn start(&self) -> Transport {
        Transport { now: self.from(), ..Transport::default() }
    }

    /// The instant `now` (s), or the first instant if `now` lies past the last one: the replay then starts over.
    pub fn wrapped(&self, now: f64) -> f64 {
        if now > self.to() { self.from() } else { now }
    }

    /// The pictures at the instant `shown` (s), one for each simulation.
    pub fn frames(&self, shown: f64, velocity: bool) -> Vec<Frame> {
        let frame = |(index, pane): (usize, &Pane)| {
            let history = &pane.history;
            let past = Past { history, rate: self.rate, velocity };
            let at = past.back(shown);
            let (state, span) = (past.state(at)?, past.span(at, SPAN));
            let sample = (history.newest() as usize).saturating_sub(at * history.stride());
            let driven = |channel: &Vec<f32>| channel.get(sample.saturating_sub(1)).copied().unwrap_or(0.0);
            let head = Head {
                pane: index,
                panes: self.panes.len(),
                columns: self.lens.cells.columns,
                rows: self.lens.cells.rows,
                time_s: sample as f64 / self.rate,
                quantity: if velocity { "velocity" } else { "displacement" },
                drive: pane.drive.iter().map(driven).collect(),
                targets: self.targets.iter().map(|(at, _)| mm(*at)).collect(),
                samples: span,
                span_s: (span * history.stride()) as f64 / self.rate,
                traces: (1..).zip(&self.targets).map(strip).collect(),
                ..Head::default()
            };
            let traces = self.targets.iter().map(|(_, weights)| past.trace(weights, at, span)).collect();
            Some(Frame { head, cells: self.lens.look(state), traces })
        };
        self.panes.iter().enumerate().filter_map(frame).collect()
    }
}

fn mm(at: Point) -> [f64; 2] {
    [at.x * 1e3, at.y * 1e3]
}

fn strip((number, (at, _)): (usize, &(Point, Vec<f32>))) -> Strip {
    Strip { name: format!("target {number}"), at_mm: mm(*at), scale: 1.0 }
}

impl Pane {
    /// Simulates the first `frames` samples under a drive, and keeps at most the last `most` states.
    fn record(
        surface: &Surface,
        modes: Arc<Modes>,
        drive: &Drive,
        [frames, most]: [usize; 2],
        progress: &dyn Progress,
    ) -> Result<Self, ViewError> {
        let mut stepped = VirtualSurface::of(surface, modes, &StepperOptions::default())?;
        let channels = drive.channels();
        let stride = stride(surface);
        stepped.remember(stride, (frames / stride).min(most).max(1))?;
        for first in (0..frames).step_by(LOOKED) {
            wanted(progress)?;
            let count = LOOKED.min(frames - first);
            let part = |channel: &Vec<f64>| {
                let silence = std::iter::repeat(0.0);
                channel.iter().copied().skip(first).chain(silence).take(count).collect::<Vec<f64>>()
            };
            let planes: Vec<f64> = channels.iter().flat_map(part).collect();
            stepped.process(count, &planes, &mut [], &mut [])?;
        }
        let history = stepped.history().cloned().ok_or(ViewError::Gone { why: "no history".into() })?;
        let share = |x: &f64| (x / surface.emission.limit) as f32;
        let drive = channels.iter().map(|channel| channel.iter().map(share).collect()).collect();
        Ok(Self { history, drive })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::past::MOST_BYTES;
    use unripple::physics::design::papers_surface;
    use unripple_tasks::Silent;

    /// Two simulations of a small surface with a focus after 50 ms, with at most so many states of each, or as many as there is room for.
    fn recorded(most: Option<usize>) -> Replay {
        let mut film = papers_surface();
        film.emission.band[1] = 700.0;
        let modes = Arc::new(Modes::solve(&film, 700.0, 1e-3).unwrap());
        let mut channels = vec![vec![0.0; 2400]; film.actuators.len()];
        channels[0][0] = 1.0;
        let names = film.actuators.iter().map(|actuator| actuator.name.clone()).collect();
        let drive = Drive::new(film.emission.rate, names, channels).unwrap();
        let (drives, focus, places) = ([drive.clone(), drive], 0.05, [Point::from_mm(62.0, 90.0)]);
        let recorded = match most {
            None => Replay::record(&film, modes, &drives, focus, &places, &Silent),
            Some(most) => {
                let plant = Plant::of(&film, modes.clone()).unwrap();
                Replay::within(most, &film, (modes, &plant), (&drives, focus), &places, &Silent)
            }
        };
        recorded.unwrap()
    }

    #[test]
    fn what_there_is_no_room_for_is_dropped_from_the_beginning() {
        let whole = recorded(None);
        assert_eq!(whole.dropped(), 0.0);
        assert!(whole.from() < 1e-3, "{}", whole.from());
        let cut = recorded(Some(100));
        assert!(cut.panes.iter().all(|pane| pane.history.len() == 100));
        assert!((cut.from() - cut.dropped() - whole.from()).abs() < 1e-9 && cut.dropped() > 0.01);
        assert!(cut.from() < cut.focus() && cut.focus() < cut.to() && cut.to() == whole.to());
        // What is kept is the same.
        let picture = |replay: &Replay| replay.frames(replay.focus(), false).pop().unwrap().cells;
        assert_eq!(picture(&cut), picture(&whole));
    }

    #[test]
    fn states_take_no_more_bytes_than_they_may() {
        for modes in [0, 1, 300, 20_000, 1 << 24] {
            assert!(8 * modes * room(modes) <= MOST_BYTES, "{modes} modes");
        }
        let whole = recorded(None);
        let bytes = |pane: &Pane| 8 * pane.history.len() * pane.history.state(0).unwrap().0.len();
        assert!(whole.panes.iter().map(bytes).sum::<usize>() <= MOST_BYTES);
    }
}
