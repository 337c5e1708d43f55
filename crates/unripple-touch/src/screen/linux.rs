//! Multi-touch screens of Linux: evdev devices.

use super::axis::Axis;
use super::contacts::Contacts;
use super::slots::Event;
use crate::TouchError;
use evdev::raw_stream::RawDevice;
use evdev::{AbsoluteAxisCode, Device};
use std::fs::File;
use std::io::{self, ErrorKind};
use std::os::fd::{AsFd, BorrowedFd};
use std::path::{Path, PathBuf};

/// A touch screen that is connected: its name, its device file, and the ranges of its coordinates and pressure.
pub(super) struct Found {
    pub(super) name: String,
    pub(super) kernel: Kernel,
    pub(super) axes: (Axis, Axis),
    pub(super) pressure: Option<Axis>,
}

/// An open device file of the kernel.
pub(super) struct Kernel {
    path: PathBuf,
    device: RawDevice,
}

fn device(path: &Path) -> io::Result<RawDevice> {
    let file = File::open(path)?;
    // Not blocking is a property of the open file, which both descriptors share.
    Device::from_fd(file.try_clone()?.into())?.set_nonblocking(true)?;
    RawDevice::from_fd(file.into())
}

impl Kernel {
    pub(super) fn open(path: &Path) -> Result<Found, TouchError> {
        let fix = "the user must be allowed to read it: usermod -aG input USER, then log in again";
        let error = |error| TouchError::io(format!("opening {}", path.display()), error, fix);
        let device = device(path).map_err(error)?;
        let ranges: Vec<_> = device.get_absinfo().map_err(error)?.collect();
        let axis = |code: AbsoluteAxisCode| {
            let found = ranges.iter().find(|(other, _)| *other == code);
            found.map(|(_, info)| Axis { minimum: info.minimum(), maximum: info.maximum() })
        };
        let needed = |code, what: &str| {
            let device = path.display().to_string();
            axis(code).ok_or_else(|| TouchError::Screen { device, what: format!("no {what}") })
        };
        needed(AbsoluteAxisCode::ABS_MT_SLOT, "ABS_MT_SLOT")?;
        let axes = (
            needed(AbsoluteAxisCode::ABS_MT_POSITION_X, "ABS_MT_POSITION_X")?,
            needed(AbsoluteAxisCode::ABS_MT_POSITION_Y, "ABS_MT_POSITION_Y")?,
        );
        let pressure = axis(AbsoluteAxisCode::ABS_MT_PRESSURE);
        let name = format!("screen {} ({})", device.name().unwrap_or("without a name"), path.display());
        Ok(Found { name, kernel: Self { path: path.to_owned(), device }, axes, pressure })
    }
}

impl Contacts for Kernel {
    fn read(&mut self, events: &mut Vec<Event>) -> io::Result<()> {
        match self.device.fetch_events() {
            Ok(fetched) => {
                let plain =
                    |e: evdev::InputEvent| Event { kind: e.event_type().0, code: e.code(), value: e.value() };
                events.extend(fetched.map(plain));
                Ok(())
            }
            Err(error) if error.kind() == ErrorKind::WouldBlock => Ok(()),
            Err(error) => Err(error),
        }
    }

    fn slot(&mut self) -> io::Result<usize> {
        let states = self.device.get_abs_state()?;
        let slot = states[usize::from(AbsoluteAxisCode::ABS_MT_SLOT.0)].value;
        Ok(usize::try_from(slot).unwrap_or(0))
    }

    fn file(&self) -> Option<BorrowedFd<'_>> {
        Some(self.device.as_fd())
    }

    fn reopen(&mut self) -> io::Result<()> {
        self.device = device(&self.path)?;
        Ok(())
    }
}

pub(super) fn list() -> Vec<(PathBuf, String)> {
    let screen = |(path, device): (PathBuf, Device)| {
        let slots =
            |axes: &evdev::AttributeSetRef<AbsoluteAxisCode>| axes.contains(AbsoluteAxisCode::ABS_MT_SLOT);
        let multi = device.supported_absolute_axes().is_some_and(slots);
        multi.then(|| (path, device.name().unwrap_or("without a name").to_owned()))
    };
    evdev::enumerate().filter_map(screen).collect()
}
