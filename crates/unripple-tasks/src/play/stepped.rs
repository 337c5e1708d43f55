//! A session of `play` that its caller advances block by block, in virtual time.

use super::report::Report;
use super::run::{TELL, join, prepare};
use super::{Ask, TouchAsk};
use crate::{Progress, TaskError};
use unripple::core::Layout;
use unripple_devices::Feeling;
use unripple_live::Engine;
use unripple_touch::{Source, Sources};

/// A session of [`run`](super::run()) on a virtual surface that its caller advances block by block and
/// supplies with touches, for programs that act between the blocks. Time passes only in [`Stepped::step`]:
/// the same touches at the same times give the same drive.
///
/// ```
/// use unripple::core::{Phase, Point, Touch};
/// use unripple_tasks::{Silent, SurfaceAsk, play};
///
/// let set = [("drive.band_hz".to_owned(), "[0, 1500]".to_owned())].into();
/// let surface = SurfaceAsk::Set { name: "hudin-2012".into(), set };
/// let (pusher, source) = unripple_touch::pushed(&surface.load()?.outline);
/// let ask = play::Ask { surface, window_s: Some(0.01), ..play::Ask::default() };
/// let mut session = play::Stepped::open(&ask, Box::new(source), &mut Silent)?;
///
/// session.step()?;
/// assert!(session.drive().iter().all(|sample| *sample == 0.0));
/// let (at, time) = (Point::from_mm(62.0, 90.0), session.time());
/// pusher.push(Touch { finger: 1, phase: Phase::Down, at, time, force: None })?;
/// session.step()?;
/// assert!(session.drive().iter().any(|sample| *sample != 0.0));
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
pub struct Stepped {
    engine: Engine,
    report: Report,
    window: f64,
    /// Time at which what fingers feel was last sampled, in s.
    told: f64,
}

impl Stepped {
    /// Opens a session: the surface and effects of a request, with a virtual surface as device and `source`
    /// as the source of touches, which is polled at the beginning of each block. The fields `touch`,
    /// `seconds` and `keep_drive` of the request are ignored.
    ///
    /// # Errors
    /// Those of [`run`](super::run()) before it plays; [`TaskError::Input`] for anything that runs in real time.
    pub fn open(ask: &Ask, source: Box<dyn Source>, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let ask = Ask { touch: TouchAsk::default(), keep_drive: None, ..ask.clone() };
        if let Some(clock) = ask.clock() {
            let text = format!("play in steps: expected what needs no clock, found {clock}");
            return Err(TaskError::Input(text));
        }
        let prepared = prepare(&ask, progress)?;
        let mut sources = Sources::new(&prepared.surface.outline);
        sources.push(source);
        let window = prepared.window.seconds;
        let (engine, report) = join(&ask, prepared, sources, progress)?;
        Ok(Self { engine, report, window, told: 0.0 })
    }

    /// Plays one block.
    ///
    /// # Errors
    /// [`TaskError::Work`] if the device is lost or the thread that computes drives is gone.
    pub fn step(&mut self) -> Result<(), TaskError> {
        self.engine.step()?;
        let stage = self.engine.stage();
        if stage.time() - self.told >= TELL {
            self.told = stage.time();
            self.report.look(stage, None);
        }
        Ok(())
    }

    /// Channels, sample rate and block length of the device: an output for each actuator, and an input for
    /// each actuator's sensor and for the probe.
    pub fn layout(&self) -> &Layout {
        self.engine.heart().device().layout()
    }

    /// Drive of the last block in the actuators' units, one output after the other.
    pub fn drive(&self) -> &[f32] {
        self.engine.heart().drive()
    }

    /// Recording of the last block, one input after the other: the sensors in their units, and the probe in m/s.
    pub fn heard(&self) -> &[f32] {
        self.engine.heart().heard()
    }

    /// Time played, in s.
    pub fn time(&mut self) -> f64 {
        self.engine.stage().time()
    }

    /// Window T, which is the delay from a touch to its focus, in s.
    pub fn window(&self) -> f64 {
        self.window
    }

    /// What each finger felt (level and contrast) when last sampled; samples are taken every 0.2 s of
    /// played time.
    pub fn feelings(&self) -> &[Feeling] {
        &self.report.feelings
    }

    /// Time at which [`Stepped::feelings`] was last sampled, in s; 0 before the first sample. A sample
    /// covers the 0.2 s before it, or the time since the sample before it.
    pub fn felt_at(&self) -> f64 {
        self.told
    }

    /// Report on what was played and felt so far.
    pub fn report(&mut self) -> Report {
        self.report.clone().finish(&mut self.engine)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DeviceAsk, DeviceKind, Silent, SurfaceAsk};
    use unripple_touch::{Synthetic, SyntheticOptions};

    /// A second of the paper's film in a narrow band, with fingers from a seed.
    fn second() -> Ask {
        let set = [("drive.band_hz".to_owned(), "[0, 1500]".to_owned())].into();
        let surface = SurfaceAsk::Set { name: "hudin-2012".into(), set };
        let touch = TouchAsk { fingers: Some(3), seed: 5, ..TouchAsk::default() };
        Ask { surface, touch, window_s: Some(0.01), seconds: Some(1.0), ..Ask::default() }
    }

    #[test]
    fn steps_play_what_a_run_plays() {
        let file = std::env::temp_dir().join(format!("unripple-stepped-{}.wav", std::process::id()));
        let ask = Ask { keep_drive: Some(file.clone()), ..second() };
        crate::play::run(&ask, &mut Silent).unwrap();
        let kept = unripple_store::read_wav(&file).unwrap().channels;
        std::fs::remove_file(&file).unwrap();

        let options = SyntheticOptions { fingers: 3, seed: 5, ..SyntheticOptions::default() };
        let fingers = Synthetic::new(&ask.surface.load().unwrap().outline, options).unwrap();
        let mut session = Stepped::open(&ask, Box::new(fingers), &mut Silent).unwrap();
        let (block, actuators) = (session.layout().block, session.layout().outputs.len());
        let mut played = vec![Vec::new(); actuators];
        while session.time() < 1.0 {
            session.step().unwrap();
            for (line, plane) in played.iter_mut().zip(session.drive().chunks_exact(block)) {
                line.extend(plane.iter().map(|sample| f64::from(*sample)));
            }
            assert_eq!(session.heard().len(), (actuators + 1) * block);
        }
        assert!(played.iter().flatten().any(|sample| *sample != 0.0));
        assert!(played == kept, "a drive in steps differs from that of a run");
        let report = serde_json::to_value(session.report()).unwrap();
        assert_eq!((report["seconds"].as_f64(), report["window_s"].as_f64()), (Some(1.0), Some(0.01)));
        assert!(report["touches"].as_u64() > Some(0) && report["started"].as_u64() > Some(0));
    }

    #[test]
    fn what_runs_in_real_time_is_refused() {
        let device = DeviceAsk { device: DeviceKind::Jack, ..DeviceAsk::default() };
        for ask in [Ask { device, ..second() }, Ask { real_time: true, ..second() }] {
            let source = unripple_touch::pushed(&ask.surface.load().unwrap().outline).1;
            let error = Stepped::open(&ask, Box::new(source), &mut Silent).err().unwrap().to_string();
            assert!(error.starts_with("play in steps: expected what needs no clock, found `"), "{error}");
        }
    }
}
