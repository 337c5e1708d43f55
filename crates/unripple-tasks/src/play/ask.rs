//! Options of the task `play`.

use crate::record::{Request, Visit};
use crate::{DeviceAsk, SurfaceAsk, TaskError, names, source};
use serde::{Deserialize, Serialize};
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use unripple::focus::Method;
use unripple_store::effect_files;

/// Sources of touches, and a file to which touches are recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TouchAsk {
    /// Number of synthetic fingers that tap and slide; by default 2 if there is no other source of touches, else 0.
    pub fingers: Option<usize>,
    /// Seed of the synthetic fingers' motion.
    pub seed: u64,
    /// UDP port on which touches are received as TUIO 1.1, TUIO 2.0 or OSC; the usual one is 3333.
    pub tuio: Option<u16>,
    /// TCP port on which WebSocket clients that send touches are accepted.
    pub websocket: Option<u16>,
    /// Network address for both ports; by default only this machine can connect.
    pub listen: IpAddr,
    /// Multi-touch screens, such as /dev/input/event5.
    pub screen: Vec<PathBuf>,
    /// File of a recorded session of touches to replay.
    pub session: Option<PathBuf>,
    /// New file to which all touches are recorded, to be replayed as a `session`.
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
    /// Name of the first field that is set and through which live touches come: `tuio`, `websocket` or
    /// `screen`; `None` if none is set.
    pub fn live(&self) -> Option<&'static str> {
        let fields = [
            (self.tuio.is_some(), "`tuio`"),
            (self.websocket.is_some(), "`websocket`"),
            (!self.screen.is_empty(), "`screen`"),
        ];
        fields.into_iter().find_map(|(given, name)| given.then_some(name))
    }
}

/// The surface, the device, the sources of touches, and the effects that touches trigger.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// The device that plays and records.
    pub device: DeviceAsk,
    /// Effects that touches trigger: the name of built-in effects, a TOML file, or a .haptic, .ahap or .hjif file.
    pub effect: String,
    /// Sources of touches, and a file to which touches are recorded.
    pub touch: TouchAsk,
    /// Focusing method by which drives are computed.
    #[serde(with = "names::method")]
    pub method: Method,
    /// Window T in s, at most 10, which is the delay from a touch to its focus; by default the shortest window that reaches three quarters
    /// of the largest contrast.
    pub window_s: Option<f64>,
    /// Number of samples per block of the virtual surface.
    pub block: usize,
    /// Time to play, in s; by default until cancelled, or until a recorded session is over.
    pub seconds: Option<f64>,
    /// Make a gain of 1 in effects stand for the surface's drive limit, however far that moves the sheet.
    /// By default a gain of 1 stands for the felt level of a pulse that moves the sheet by about half its
    /// thickness.
    pub full_limit: bool,
    /// Follow the tension of the sheet while playing, from the signals of the actuators' sensors.
    pub follow_tension: bool,
    /// Play in real time even if neither the device nor a source of touches requires it.
    pub real_time: bool,
    /// For the virtual surface: relative amplitude of a sinusoidal variation of its tension, with a period
    /// of a minute.
    pub drift: Option<f64>,
    /// WAV file to write the played drive to, in the actuators' unit; of a run longer than a minute, the
    /// first minute. The file of an earlier run is replaced.
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
    /// Reason why the session runs in real time, such as its device; `None` if it runs as fast as it can.
    pub fn clock(&self) -> Option<String> {
        let device = || format!("`device` {}", self.device.device.name());
        let real = self.device.is_real().then(device);
        real.or_else(|| self.real_time.then(|| "`real_time`".into()))
            .or_else(|| self.touch.live().map(Into::into))
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "play";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        if !effect_files(&self.effect).is_empty() {
            let mut file = PathBuf::from(&self.effect);
            visit(&mut file)?;
            self.effect = file.to_string_lossy().into_owned();
        }
        self.touch.session.iter_mut().try_for_each(visit)
    }

    fn reads(&self) -> Vec<PathBuf> {
        // A screen is a file too, which no drive may take the place of, and nothing that a record could keep.
        let sessions = self.touch.session.iter().chain(&self.touch.screen).cloned();
        source::reads(&self.surface).into_iter().chain(effect_files(&self.effect)).chain(sessions).collect()
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.keep_drive = output;
        self.touch.record = None;
    }
}
