//! Options of the task `view`.

use serde::{Deserialize, Serialize};
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use unripple::focus::Method;
use unripple_tasks::{DeviceAsk, DeviceKind, SurfaceAsk, method};

/// Which surface is shown in a browser, through what it is played, and who may come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// What plays and listens.
    pub device: DeviceAsk,
    /// How drives are made at first.
    #[serde(with = "method")]
    pub method: Method,
    /// Follow the tension of the sheet, by what the actuators hear: of a real device, or with unknowns.
    pub follow_tension: bool,
    /// The address to listen at; by default this machine alone. Where others can come, their address holds a token.
    pub listen: IpAddr,
    /// TCP port; 0 takes any that is free.
    pub port: u16,
    /// The token, where it is to be the same each time: 8 to 64 letters and digits. A new one each time otherwise.
    pub token: Option<String>,
    /// Folder for libraries that are calibrated from the page.
    pub folder: PathBuf,
    /// Seconds to serve; without it until cancelled.
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
            folder: ".".into(),
            seconds: None,
        }
    }
}

impl Ask {
    /// Whether the surface is merely computed, and exactly the one that the file describes.
    pub(super) fn simulated(&self) -> bool {
        self.device.device == DeviceKind::Virtual && self.device.unknowns.is_none()
    }
}
