//! A device that is reopened when it is lost.

use std::time::Duration;
use unripple_core::clock::Instant;
use unripple_core::{Cycle, Device, DeviceError, Layout, Server, State, Status, Work};

/// Function that opens the device, at first and after each loss; the error says in words why it cannot.
pub type Opener = Box<dyn FnMut() -> Result<Box<dyn Device>, String> + Send>;

/// Waits between two tries: from the first, doubled until the longest.
const FIRST_WAIT: Duration = Duration::from_millis(250);
const LONGEST_WAIT: Duration = Duration::from_secs(4);

/// A device that is reopened when it is lost. Meanwhile its drive is discarded, its inputs are silent, and time goes
/// on.
///
/// After a loss, reopening is tried after 0.25 s, then after twice as long each time, up to 4 s, as often as
/// the number of tries allows; then the device stays lost. Meanwhile each block takes its normal duration,
/// so that the caller needs no special case. A device that returns with other channels or another rate is
/// refused. So is one with another block length, unless it [calls](Device::install_work) its work by itself;
/// meanwhile that work is called here, at the normal pace. A sound server may return with another period, so
/// its opener asks for the first device's block length each time after
/// ([`JackOptions::block`](unripple_devices::JackOptions::block)).
///
/// ```
/// use unripple_core::*;
/// use unripple_live::Recovering;
///
/// # #[derive(Clone)]
/// # struct Loop(Layout);
/// # impl Device for Loop {
/// #     fn layout(&self) -> &Layout { &self.0 }
/// #     fn status(&self) -> Status { Status::default() }
/// #     fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
/// #         heard.copy_from_slice(drive);
/// #         Ok(())
/// #     }
/// # }
/// # let one = || vec!["a1".to_owned()];
/// # let wire = Loop(Layout { device: "wire".into(), rate: 48e3, block: 64, outputs: one(), inputs: one(), full_scale: 1.0 });
/// let mut device = Recovering::open(Box::new(move || Ok(Box::new(wire.clone()))), 10)?;
/// device.exchange(&[0.5; 64], &mut [0.0; 64])?;
/// assert_eq!(device.status().state, State::Running);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Recovering {
    open: Opener,
    device: Option<Box<dyn Device>>,
    layout: Layout,
    /// Tries in a row, those made, and when the next is due.
    tries: u32,
    tried: u32,
    due: Instant,
    away: Away,
    status: Status,
    /// Counts of the devices that were lost.
    before: Status,
    /// Times that a device came back.
    returns: u64,
    /// Work that a lost device was calling, and whether a device has it now.
    work: Option<Box<dyn Work>>,
    lent: bool,
    /// Last state of the last server, and counts of the lost ones: cycles late, our own late, samples left out.
    server: Option<Server>,
    counted: [u64; 3],
}

/// The absence of a device: why, since when, blocks lost.
struct Away {
    why: String,
    since: Instant,
    blocks: u64,
}

impl Recovering {
    /// Opens the device for the first time. `tries` is the number of attempts to reopen it after each loss.
    ///
    /// # Errors
    /// Why it cannot be opened, in the opener's words.
    pub fn open(mut open: Opener, tries: u32) -> Result<Self, DeviceError> {
        let device = open().map_err(|why| DeviceError::Lost { device: "the device".into(), why })?;
        let layout = device.layout().clone();
        let now = Instant::now();
        let away = Away { why: String::new(), since: now, blocks: 0 };
        let (status, before) = (Status::default(), Status::default());
        Ok(Self {
            open,
            device: Some(device),
            layout,
            tries,
            tried: 0,
            due: now,
            away,
            status,
            before,
            returns: 0,
            work: None,
            lent: false,
            server: None,
            counted: [0; 3],
        })
    }

    /// Number of times that the device was reopened after a loss.
    pub fn returns(&self) -> u64 {
        self.returns
    }

    /// Lets go of a device that failed.
    fn lose(&mut self, why: String) {
        if let Some(mut device) = self.device.take() {
            if std::mem::take(&mut self.lent) {
                self.work = device.remove_work();
            }
            let last = device.status();
            if let Some(mut server) = last.server {
                let counts = [&mut server.late, &mut server.own_late, &mut server.skipped];
                let more = counts.map(std::mem::take);
                self.counted.iter_mut().zip(more).for_each(|(to, more)| *to += more);
                self.server = Some(server);
            }
            self.before.blocks += last.blocks;
            self.before.lost += last.lost;
        }
        let now = Instant::now();
        self.tried = 0;
        self.due = now + FIRST_WAIT;
        self.away = Away { why, since: now, blocks: 0 };
    }

    /// Tries to have it back, when it is time.
    fn retry(&mut self) {
        if self.tried >= self.tries || Instant::now() < self.due {
            return;
        }
        self.tried += 1;
        match (self.open)() {
            Ok(mut device) if self.is_same(device.layout()) => {
                if let Some(work) = self.work.take() {
                    self.work = device.install_work(work).err();
                    self.lent = self.work.is_none();
                }
                self.device = Some(device);
                self.returns += 1;
            }
            Ok(device) => {
                let found = device.layout();
                self.away.why = format!(
                    "it came back with other properties: expected {} outputs and {} inputs, {} Hz, blocks of {}, found {}, {}, \
                     {} Hz, {}",
                    self.layout.outputs.len(),
                    self.layout.inputs.len(),
                    self.layout.rate,
                    self.layout.block,
                    found.outputs.len(),
                    found.inputs.len(),
                    found.rate,
                    found.block
                );
            }
            Err(why) => self.away.why = why,
        }
        let wait = FIRST_WAIT * 2u32.saturating_pow(self.tried.min(16));
        self.due = Instant::now() + wait.min(LONGEST_WAIT);
    }

    /// Whether a device is the one that was lost; one that calls may do so at any pace.
    fn is_same(&self, other: &Layout) -> bool {
        match self.work {
            Some(_) => Layout { block: self.layout.block, ..other.clone() } == self.layout,
            None => *other == self.layout,
        }
    }

    /// Time until the blocks that were counted while the device is away would be over.
    fn left(&self) -> Duration {
        let over = self.away.blocks as f64 * self.layout.block as f64 / self.layout.rate;
        Duration::from_secs_f64(over).saturating_sub(self.away.since.elapsed())
    }

    /// Calls the work for one block that is discarded, if the last one is over.
    fn play_alone(&mut self) {
        let over = self.left().is_zero();
        let Some(work) = self.work.as_mut().filter(|_| over) else { return };
        let (frames, outputs) = (self.layout.block, self.layout.outputs.len());
        let mut nowhere = Nowhere { drive: vec![0.0; frames * outputs], heard: vec![0.0; frames], frames };
        work.cycle(&mut nowhere);
        self.away.blocks += 1;
        self.status.lost += 1;
    }
}

impl Device for Recovering {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        let mut status = self.before.clone();
        match &self.device {
            Some(device) => {
                let own = device.status();
                (status.state, status.server) = (own.state, own.server);
                status.waiting = own.waiting;
                status.blocks += own.blocks;
                status.lost += own.lost;
            }
            None => {
                status.server = self.server.clone();
                let why = format!("{} ({} tries of {})", self.away.why, self.tried, self.tries);
                status.state = match self.tried < self.tries {
                    true => State::Stalled(why),
                    false => State::Lost(why),
                };
            }
        }
        status.lost += self.status.lost;
        if let Some(server) = &mut status.server {
            let [late, own_late, skipped] = self.counted;
            (server.late, server.own_late) = (server.late + late, server.own_late + own_late);
            server.skipped += skipped;
        }
        status
    }

    /// As [`Device::exchange`]; but while the device is away its inputs are silent, and the block is counted as lost.
    ///
    /// # Errors
    /// [`DeviceError::Size`]; [`DeviceError::Lost`] once all tries have failed.
    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        if let Some(device) = &mut self.device {
            match device.exchange(drive, heard) {
                Ok(()) => return Ok(()),
                Err(error @ DeviceError::Size { .. }) => return Err(error),
                Err(error) => self.lose(error.to_string()),
            }
        } else {
            self.retry();
        }
        heard.fill(0.0);
        self.status.lost += 1;
        if self.device.is_none() && self.tried >= self.tries {
            return Err(DeviceError::Lost { device: self.layout.device.clone(), why: self.away.why.clone() });
        }
        self.away.blocks += 1;
        std::thread::sleep(self.left());
        Ok(())
    }

    fn install_work(&mut self, work: Box<dyn Work>) -> Result<(), Box<dyn Work>> {
        let Some(device) = &mut self.device else { return Err(work) };
        device.install_work(work)?;
        self.lent = true;
        Ok(())
    }

    fn remove_work(&mut self) -> Option<Box<dyn Work>> {
        match &mut self.device {
            Some(device) if std::mem::take(&mut self.lent) => device.remove_work(),
            _ => self.work.take(),
        }
    }

    /// As [`Device::check`]; while the device is lost, its work is called at the normal pace, and its drive discarded.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] once all tries have failed.
    fn check(&mut self) -> Result<Duration, DeviceError> {
        match &mut self.device {
            Some(device) => match device.check() {
                Ok(wait) => return Ok(wait),
                Err(error) => self.lose(error.to_string()),
            },
            None => self.retry(),
        }
        if self.device.is_none() && self.tried >= self.tries {
            return Err(DeviceError::Lost { device: self.layout.device.clone(), why: self.away.why.clone() });
        }
        self.play_alone();
        Ok(self.left())
    }
}

/// A cycle of a device that is away.
struct Nowhere {
    drive: Vec<f32>,
    heard: Vec<f32>,
    frames: usize,
}

impl Cycle for Nowhere {
    fn frames(&self) -> usize {
        self.frames
    }

    fn began(&self) -> Instant {
        Instant::now()
    }

    fn drive(&mut self, output: usize) -> &mut [f32] {
        self.drive.chunks_exact_mut(self.frames).nth(output).unwrap_or_default()
    }

    fn heard(&self, _: usize) -> &[f32] {
        &self.heard
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU32, Ordering};

    /// A device that fails after some blocks.
    struct Mortal(Layout, u32);

    /// Counts of its server from one opening to the next.
    fn counts(late: u64) -> Option<Server> {
        Some(Server { late, own_late: 2 * late, skipped: 100 * late, ..Server::default() })
    }

    impl Device for Mortal {
        fn layout(&self) -> &Layout {
            &self.0
        }
        fn status(&self) -> Status {
            Status { waiting: 7, server: counts(3), ..Status::default() }
        }
        fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
            self.1 = self
                .1
                .checked_sub(1)
                .ok_or(DeviceError::Lost { device: "mortal".into(), why: "it was killed".into() })?;
            heard.copy_from_slice(drive);
            Ok(())
        }
    }

    fn layout(block: usize) -> Layout {
        let one = || vec!["a1".to_owned()];
        Layout { device: "mortal".into(), rate: 48e3, block, outputs: one(), inputs: one(), full_scale: 1.0 }
    }

    /// Opens by what a number says: 0 a short life, 1 not at all, 2 another block.
    fn opener(what: &'static [u32]) -> (Opener, Arc<AtomicU32>) {
        let asked = Arc::new(AtomicU32::new(0));
        let own = asked.clone();
        let open = move || match what.get(own.fetch_add(1, Ordering::Relaxed) as usize) {
            Some(0) => Ok(Box::new(Mortal(layout(480), 3)) as Box<dyn Device>),
            Some(2) => Ok(Box::new(Mortal(layout(64), 3)) as Box<dyn Device>),
            _ => Err("nobody is there".to_owned()),
        };
        (Box::new(open), asked)
    }

    #[test]
    fn a_device_comes_back_by_itself() {
        let (open, asked) = opener(&[0, 1, 0]);
        let mut device = Recovering::open(open, 5).unwrap();
        let mut heard = [0.0; 480];
        let mut sounding = Vec::new();
        let start = Instant::now();
        while device.returns() == 0 && start.elapsed() < Duration::from_secs(20) {
            device.exchange(&[0.5; 480], &mut heard).unwrap();
            sounding.push(heard[0] != 0.0);
        }
        device.exchange(&[0.5; 480], &mut heard).unwrap();
        assert_eq!((device.returns(), asked.load(Ordering::Relaxed)), (1, 3));
        assert_eq!(heard[0], 0.5);
        assert!(sounding[..3].iter().all(|s| *s) && sounding[3..].iter().all(|s| !s));
        assert_eq!(device.status().state, State::Running);
        assert_eq!(device.status().lost as usize, sounding.len() - 3);
        // Two lives.
        assert_eq!((device.status().waiting, device.status().server), (7, counts(6)));
        // 0.25 s and 0.5 s of waiting in blocks of 10 ms.
        assert!(sounding.len() > 60, "{}", sounding.len());
    }

    #[test]
    fn tries_end_and_another_device_is_refused() {
        let (open, _) = opener(&[0, 2, 1]);
        let mut device = Recovering::open(open, 2).unwrap();
        let mut heard = [0.0; 480];
        let start = Instant::now();
        let error = loop {
            match device.exchange(&[0.5; 480], &mut heard) {
                Ok(()) if start.elapsed() < Duration::from_secs(20) => {}
                other => break other,
            }
        };
        let error = error.unwrap_err().to_string();
        assert!(error.contains("nobody is there"), "{error}");
        assert!(matches!(device.status().state, State::Lost(_)));
    }
}
