//! Options of the task `doctor`.

use crate::{DeviceAsk, SurfaceAsk};
use serde::{Deserialize, Serialize};
use std::net::{IpAddr, Ipv4Addr};

/// Which surface, device and port are looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
    /// The device to be looked at.
    pub device: DeviceAsk,
    /// UDP port that touches would come to.
    pub tuio: u16,
    /// Address that would be listened at.
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
