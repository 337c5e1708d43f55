//! The real device, which at most one instrument has at a time: each takes it over from the one before.

use crate::ViewError;
use crate::lock::lock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use unripple::core::{Device, DeviceError, Layout, State, Status, Surface};
use unripple_tasks::play::Opener;

/// The device that instruments play one after the other. It is never open twice: some cards can be opened by one alone.
#[derive(Clone)]
pub struct RealDevice {
    open: Opener,
    held: Arc<Mutex<Held>>,
}

/// The device while it is open.
#[derive(Default)]
struct Held {
    /// The surface that the device was opened for, and the device's samples per block.
    of: Option<(Surface, usize)>,
    /// The device while nobody plays it.
    device: Option<Box<dyn Device>>,
    player: Option<Arc<Player>>,
    closed: bool,
}

impl RealDevice {
    /// A device that is opened when it is first wanted.
    pub fn new(open: Opener) -> Self {
        Self { open, held: Arc::default() }
    }

    /// Samples per block of the device, if it is open for this surface.
    pub fn block(&self, surface: &Surface) -> Option<usize> {
        lock(&self.held).of.as_ref().filter(|(of, _)| of == surface).map(|(_, block)| *block)
    }

    /// Takes the device from the instrument that plays it, if there is one. A device that is open for
    /// another surface, or lost, is closed and opened again.
    ///
    /// # Errors
    /// [`ViewError::Device`] if it cannot be opened; [`ViewError::Stopped`] once it is closed for good.
    pub fn take(&self, surface: &Surface) -> Result<Lent, ViewError> {
        self.rest();
        let mut held = lock(&self.held);
        if held.closed {
            return Err(ViewError::Stopped);
        }
        let fits = held.of.as_ref().is_some_and(|(of, _)| of == surface);
        let here = held.device.take();
        let device = match here.filter(|here| fits && !matches!(here.status().state, State::Lost(_))) {
            Some(here) => here,
            None => {
                held.of = None;
                (self.open)(surface).map_err(|why| ViewError::Device { why })?
            }
        };
        let layout = device.layout().clone();
        held.of = Some((surface.clone(), layout.block));
        Ok(Lent { device: Some(device), layout, held: self.held.clone() })
    }

    /// Records the thread that plays the device now, so that the device can be taken back from it.
    pub fn played_by(&self, player: Arc<Player>) {
        lock(&self.held).player = Some(player);
    }

    /// Closes the device for good.
    pub fn close(&self) {
        self.rest();
        let mut held = lock(&self.held);
        held.closed = true;
        held.device = None;
    }

    /// Ends playing, so that the device is here and at rest.
    fn rest(&self) {
        let player = lock(&self.held).player.take();
        if let Some(player) = player {
            player.end();
        }
    }
}

/// The device while an instrument has it. It is not closed when this is dropped, but kept for the next instrument.
pub struct Lent {
    device: Option<Box<dyn Device>>,
    layout: Layout,
    held: Arc<Mutex<Held>>,
}

impl Device for Lent {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        self.device.as_ref().map_or_else(Status::default, |device| device.status())
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        match &mut self.device {
            Some(device) => device.exchange(drive, heard),
            None => Err(DeviceError::Lost {
                device: self.layout.device.clone(),
                why: "it has been taken back".into(),
            }),
        }
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        let mut held = lock(&self.held);
        if !held.closed {
            held.device = self.device.take();
        }
    }
}

/// The thread that plays a device.
#[derive(Debug)]
pub struct Player {
    stop: Arc<AtomicBool>,
    thread: Mutex<Option<JoinHandle<()>>>,
}

impl Player {
    /// A player that ends when `stop` is set.
    pub fn new(stop: Arc<AtomicBool>, thread: JoinHandle<()>) -> Self {
        Self { stop, thread: Mutex::new(Some(thread)) }
    }

    /// Ends playing, and waits until the device has been given back.
    pub fn end(&self) {
        self.stop.store(true, Ordering::Relaxed);
        let mut thread = lock(&self.thread);
        if let Some(thread) = thread.take() {
            // It has said already what went wrong.
            let _ = thread.join();
        }
    }

    /// Whether playing has been ended.
    pub fn is_ended(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
