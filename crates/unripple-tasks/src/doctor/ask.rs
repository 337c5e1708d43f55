//! Options of the task `doctor`.

use crate::record::Request;
use crate::{DeviceAsk, SurfaceAsk};
use serde::{Deserialize, Serialize};
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;

/// Which surface, which device and which network port for touches to check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// The device that is checked.
    pub device: DeviceAsk,
    /// UDP port on which touches (TUIO messages) would be received.
    pub tuio: u16,
    /// Network address on which touches would be received.
    pub listen: IpAddr,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            surface: SurfaceAsk::default(),
            device: DeviceAsk::default(),
            tuio: 3333,
            listen: IpAddr::V4(Ipv4Addr::LOCALHOST),
        }
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "doctor";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}
