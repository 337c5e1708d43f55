//! Options of the task `play`.

use crate::{DeviceAsk, SurfaceAsk, names, source};
use serde::{Deserialize, Serialize};
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use unripple::focus::Method;
use unripple_store::effect_files;

/// Where touches come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TouchAsk {
    /// Fingers that are not there, tapping and sliding; 2 where nothing else touches.
    pub fingers: Option<usize>,
    /// Another seed, other fingers.
    pub seed: u64,
    /// Hear TUIO 1.1, TUIO 2.0 and OSC at this UDP port; 3333 is theirs.
    pub tuio: Option<u16>,
    /// Hear WebSocket clients at this port.
    pub websocket: Option<u16>,
    /// Address to listen at; by default this machine alone.
    pub listen: IpAddr,
    /// Multi-touch screens, such as /dev/input/event5.
    pub screen: Vec<PathBuf>,
    /// A recorded session, played again.
    pub session: Option<PathBuf>,
    /// Record all touches to a new file, for a session.
    pub record: Option<PathBuf>,
}

impl Default for TouchAsk {
    fn default() -> Self {
        Self {
            fingers: None,
            seed: 1,
            tuio: None,
            websocket: None,
            listen: IpAddr::V4(Ipv4Addr::LOCALHOST),
            screen: Vec::new(),
            session: None,
            record: None,
        }
    }
}

impl TouchAsk {
    /// A field by which somebody out there may touch.
    pub fn live(&self) -> Option<&'static str> {
        let fields = [
            (self.tuio.is_some(), "`tuio`"),
            (self.websocket.is_some(), "`websocket`"),
            (!self.screen.is_empty(), "`screen`"),
        ];
        fields.into_iter().find_map(|(given, name)| given.then_some(name))
    }
}

/// Which surface is played through what, what touches it, and what that sets off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// What plays and listens.
    pub device: DeviceAsk,
    /// What touches set off: the name of built-in effects, a TOML file, or a .haptic, .ahap or .hjif file.
    pub effect: String,
    /// Where touches come from.
    pub touch: TouchAsk,
    /// How drives are made.
    #[serde(with = "names::method")]
    pub method: Method,
    /// Window T in s, which is the delay of every focus; by default the shortest with three quarters of the largest contrast.
    pub window_s: Option<f64>,
    /// Samples of a block.
    pub block: usize,
    /// Seconds to play; without it until cancelled, or until a recorded session is over.
    pub seconds: Option<f64>,
    /// Let a gain of 1 be the surface's own drive limit, however far that moves the sheet; by default it is felt as much as a pulse that
    /// moves the sheet by half its thickness.
    pub full_limit: bool,
    /// Follow the tension of the sheet while playing, by what the actuators hear.
    pub follow_tension: bool,
    /// Play by the clock on the wall even where nothing needs it.
    pub real_time: bool,
    /// Virtual: the tension drifts by this share, up and down within a minute.
    pub drift: Option<f64>,
    /// Keep all that was driven, as a WAV file in the actuators' unit; at most a minute. One that was kept earlier is replaced.
    pub keep_drive: Option<PathBuf>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            device: DeviceAsk::default(),
            effect: "click-button".into(),
            touch: TouchAsk::default(),
            method: Method::default(),
            window_s: None,
            block: 64,
            seconds: None,
            full_limit: false,
            follow_tension: false,
            real_time: false,
            drift: None,
            keep_drive: None,
        }
    }
}

impl Ask {
    /// Files and folders that are read, which no output may take the place of.
    pub fn reads(&self) -> Vec<PathBuf> {
        let sessions = self.touch.session.iter().chain(&self.touch.screen).cloned();
        source::reads(&self.surface).into_iter().chain(effect_files(&self.effect)).chain(sessions).collect()
    }

    /// What makes a sitting go by the clock on the wall; nothing where it goes as fast as it can.
    pub fn clock(&self) -> Option<String> {
        let device = || format!("`device` {}", self.device.device.name());
        let real = self.device.is_real().then(device);
        real.or_else(|| self.real_time.then(|| "`real_time`".into()))
            .or_else(|| self.touch.live().map(Into::into))
    }
}
