//! Options of the viewer, and the instrument that they specify.

use crate::framing::Origin;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use unripple::core::{SampledResponses, Surface};
use unripple::focus::Method;
use unripple_session::{Follow, RealDevice, Responder, Spec};
use unripple_tasks::play::Opener;

/// Options of the viewer: the surface to show, how it is played, and who may connect.
pub struct View {
    /// The surface that is shown.
    pub surface: Surface,
    /// Measured responses of the surface; computed ones are used where `None`.
    pub stored: Option<Arc<SampledResponses>>,
    /// Reason why the scale of the responses is unknown; `None` if it is known.
    pub without_scale: Option<String>,
    /// Function that returns responses of the surface's library at any places, as they are used on the
    /// command line.
    pub respond: Option<Responder>,
    /// Name of the surface on the command line.
    pub source: String,
    /// Focusing method to begin with; pages can change it.
    pub method: Method,
    /// Function that opens a real device, which is never open twice at once; the surface is simulated where `None`.
    pub device: Option<Opener>,
    /// Function that makes the follower of the sheet's tension, if it is to be followed.
    pub follow: Option<Follow>,
    /// Name of the device, for people.
    pub device_name: String,
    /// Address to listen at; with port 0, the system chooses a free port.
    pub address: SocketAddr,
    /// Token that the page's URL must hold; `None` where only this machine can connect.
    pub token: Option<String>,
    /// Origins whose pages may show the viewer's page in a frame; without any it cannot be framed.
    pub framed_by: Vec<Origin>,
    /// Folder for libraries that are calibrated from the page.
    pub folder: PathBuf,
    /// Whether to print nothing about requests that are refused.
    pub quiet: bool,
}

impl View {
    /// Specification of the instrument to begin with.
    pub(crate) fn spec(&self) -> Spec {
        Spec {
            stored: self.stored.clone(),
            without_scale: self.without_scale.is_some(),
            method: self.method,
            device: self.device.clone().map(RealDevice::new),
            follow: self.follow.clone(),
            ..Spec::simulated(self.surface.clone())
        }
    }
}
