//! Options of `unripple play`.

use super::{DeviceOptions, MethodName, examples, heading};
use crate::common::Common;
use clap::Args;
use std::net::IpAddr;
use std::path::PathBuf;
use unripple_tasks::doctor;
use unripple_tasks::play::TouchAsk;

/// Options of `play`.
#[derive(Debug, Args)]
#[command(after_help = examples::PLAY)]
pub struct PlayOptions {
    /// A surface file, the name of a built-in surface, or a library of responses.
    #[arg(value_name = "SURFACE|LIBRARY")]
    pub surface: String,
    /// The device that plays and records.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// Effect that a touch triggers: the name of a built-in one, a TOML file, or a .haptic, .ahap or .hjif file.
    #[arg(long, value_name = "NAME|FILE", default_value = "click-button")]
    pub effect: String,
    /// Where touches come from.
    #[command(flatten)]
    pub touch: TouchOptions,
    /// Method of focusing.
    #[arg(long, value_enum, default_value = "time-reversal", help_heading = heading::METHOD)]
    pub method: MethodName,
    /// Window T in ms, at most 10 000, which is the delay from a touch to its focus; by default the shortest window that reaches
    /// three quarters of the largest contrast.
    #[arg(long, value_name = "MS", allow_negative_numbers = true, help_heading = heading::METHOD)]
    pub window_ms: Option<f64>,
    /// Samples per block.
    #[arg(long, value_name = "N", default_value_t = 64, help_heading = heading::TIME)]
    pub block: usize,
    /// Seconds to play; by default until interrupted, or until the recorded session ends.
    #[arg(long, value_name = "S", allow_negative_numbers = true, help_heading = heading::TIME)]
    pub seconds: Option<f64>,
    /// Let a gain of 1 in an effect be the surface's drive limit, however far that moves the sheet. By default a gain of 1 stands
    /// for the level felt of a pulse that moves the sheet by about half its thickness.
    #[arg(long, help_heading = heading::LEVEL)]
    pub full_limit: bool,
    /// Estimate the tension of the sheet while playing, from the sensor signals of the actuators, and compute drives for it.
    #[arg(long, help_heading = heading::METHOD)]
    pub follow_tension: bool,
    /// Play in real time even if a simulated surface and simulated or recorded touches allow to play faster.
    #[arg(long, help_heading = heading::TIME)]
    pub real_time: bool,
    /// Virtual: let the tension drift by this many per cent, up and down within a minute.
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, help_heading = heading::VIRTUAL)]
    pub drift_percent: Option<f64>,
    /// Store the drive that was played as a WAV file in the actuators' unit; only the first minute is stored. The file of an
    /// earlier run is replaced.
    #[arg(long, value_name = "WAV", help_heading = heading::RESULTS)]
    pub keep_drive: Option<PathBuf>,
}

/// Where touches come from.
#[derive(Debug, Args)]
pub struct TouchOptions {
    /// Number of simulated fingers that tap and slide; 2 if there is no other source of touches.
    #[arg(long, value_name = "N", help_heading = heading::TOUCHES)]
    pub fingers: Option<usize>,
    /// Seed of the simulated fingers.
    #[arg(long, value_name = "SEED", default_value_t = 1, help_heading = heading::TOUCHES)]
    pub seed: u64,
    /// Receive TUIO 1.1, TUIO 2.0 and OSC at this UDP port, 3333 if the option has no value.
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "3333", help_heading = heading::TOUCHES)]
    pub tuio: Option<u16>,
    /// Accept WebSocket clients at this TCP port, 8765 if the option has no value.
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "8765", help_heading = heading::TOUCHES)]
    pub websocket: Option<u16>,
    /// Network address at which touches are received; by default only this machine can connect.
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1", help_heading = heading::TOUCHES)]
    pub listen: IpAddr,
    /// A multi-touch screen, such as /dev/input/event5. Repeatable.
    #[arg(long, value_name = "DEVICE", help_heading = heading::TOUCHES)]
    pub screen: Vec<PathBuf>,
    /// Replay the touches of a recorded session.
    #[arg(long, value_name = "FILE", help_heading = heading::TOUCHES)]
    pub session: Option<PathBuf>,
    /// Record all touches to a new file, for --session.
    #[arg(long, value_name = "FILE", help_heading = heading::TOUCHES)]
    pub record: Option<PathBuf>,
}

impl TouchOptions {
    /// Converts the options to a [`TouchAsk`].
    pub fn ask(&self) -> TouchAsk {
        TouchAsk {
            fingers: self.fingers,
            seed: self.seed,
            tuio: self.tuio,
            websocket: self.websocket,
            listen: self.listen,
            screen: self.screen.clone(),
            session: self.session.clone(),
            record: self.record.clone(),
        }
    }
}

/// Options of `doctor`.
#[derive(Debug, Args)]
#[command(after_help = examples::DOCTOR)]
pub struct DoctorOptions {
    /// A surface file, or the name of a built-in surface.
    #[arg(default_value = "hudin-2012")]
    pub surface: String,
    /// The device to check.
    #[command(flatten)]
    pub device: DeviceOptions,
    /// UDP port to check, at which `play` would receive touches.
    #[arg(long, value_name = "PORT", default_value_t = 3333)]
    pub tuio: u16,
    /// Network address at which `play` would open that port.
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub listen: IpAddr,
}

impl DoctorOptions {
    /// Converts the options to a request.
    pub fn ask(&self, common: &Common) -> doctor::Ask {
        doctor::Ask {
            surface: common.surface(&self.surface),
            device: self.device.ask(),
            tuio: self.tuio,
            listen: self.listen,
        }
    }
}
