//! Options of the task `view`.

use serde::{Deserialize, Serialize};
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use unripple::focus::Method;
use unripple_tasks::record::Request;
use unripple_tasks::{DeviceAsk, DeviceKind, SurfaceAsk, method};

/// The surface that is shown in a browser, the device that plays it, and who may connect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// The device that plays and records.
    pub device: DeviceAsk,
    /// Focusing method to begin with; the page can change it.
    #[serde(with = "method")]
    pub method: Method,
    /// Whether to follow the tension of the sheet, from the signals of the actuators' sensors; possible on a
    /// real device, or with `unknowns`.
    pub follow_tension: bool,
    /// Address to listen at; by default only this machine can connect. For other machines the URL holds a token.
    pub listen: IpAddr,
    /// TCP port; 0 for any free one.
    pub port: u16,
    /// The token, 8 to 64 letters and digits; by default a new random one at each start.
    pub token: Option<String>,
    /// Origins, `scheme://host[:port]`, whose pages may show this page in a frame; without them none may.
    pub framed_by: Vec<String>,
    /// Folder for libraries that are calibrated from the page.
    pub folder: PathBuf,
    /// Time for which pages are served, in s; `None` to serve until the task is cancelled.
    pub seconds: Option<f64>,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            device: DeviceAsk::default(),
            method: Method::default(),
            follow_tension: false,
            listen: IpAddr::V4(Ipv4Addr::LOCALHOST),
            // Beside those that people's other servers take: 8000, 8080, 8888.
            port: 8417,
            token: None,
            framed_by: Vec::new(),
            folder: ".".into(),
            seconds: None,
        }
    }
}

impl Ask {
    /// Whether the surface is simulated exactly as its file describes it.
    pub(super) fn simulated(&self) -> bool {
        self.device.device == DeviceKind::Virtual && self.device.unknowns.is_none()
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "view";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        if let Some(folder) = output {
            self.folder = folder;
        }
    }
}
