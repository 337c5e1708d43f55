//! Options of the viewer, and the server that runs it.

use crate::ViewError;
use crate::compute::Responder;
use crate::door::listen;
use crate::guard::Guard;
use crate::host::SessionHost;
use crate::server::{Desk, router};
use crate::simulation::{Follow, PULSES, Spec};
use std::future::Future;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::Arc;
use tokio::net::TcpListener;
use tokio::runtime::Runtime;
use unripple::core::{SampledResponses, Surface};
use unripple::focus::Method;
use unripple_tasks::play::Opener;

/// Pulses a second under a resting finger, at first. Apart enough to be felt one by one, and often enough to be found
/// at once.
const RATE: f64 = 10.0;

/// Threads that serve pages: one, so that serving never takes a core from the simulation.
const THREADS: usize = 1;

/// Options of the viewer: the surface to show, how it is played, and who may connect.
pub struct View {
    /// The surface that is shown.
    pub surface: Surface,
    /// Measured responses of the surface; computed ones are used where `None`.
    pub stored: Option<Arc<SampledResponses>>,
    /// Reason for which the scale of the responses is not known, if it is not.
    pub without_scale: Option<String>,
    /// Function that gives responses of the surface's library at any places, as the command line has them.
    pub respond: Option<Responder>,
    /// Name of the surface on the command line.
    pub source: String,
    /// Focusing method to begin with; pages can change it.
    pub method: Method,
    /// Function that opens a real device; the surface is simulated where `None`.
    pub device: Option<Opener>,
    /// Function that makes the follower of the sheet's tension, if it is to be followed.
    pub follow: Option<Follow>,
    /// Name of the device, for people.
    pub device_name: String,
    /// Address to listen at; port 0 takes any that is free.
    pub address: SocketAddr,
    /// Token that the page's URL must hold; `None` where only this machine can connect.
    pub token: Option<String>,
    /// Folder for libraries that are calibrated from the page.
    pub folder: PathBuf,
    /// Whether to print nothing about requests that are refused.
    pub quiet: bool,
}

/// A viewer that listens for connections.
pub struct Viewer {
    listener: TcpListener,
    desk: Desk,
    runtime: Runtime,
}

impl View {
    /// Builds the instrument of the surface, and listens for connections.
    ///
    /// # Errors
    /// [`ViewError::Address`] if the server cannot listen at the address; those of the surface and the device.
    pub fn open(self) -> Result<Viewer, ViewError> {
        let refused = |why: &dyn std::fmt::Display| ViewError::Address {
            address: self.address.to_string(),
            why: why.to_string(),
        };
        let runtime =
            tokio::runtime::Builder::new_multi_thread().worker_threads(THREADS).enable_all().build();
        let runtime = runtime.map_err(|error| ViewError::Gone { why: error.to_string() })?;
        let listener = runtime.block_on(TcpListener::bind(self.address)).map_err(|error| refused(&error))?;
        let address = listener.local_addr().map_err(|error| refused(&error))?;
        let guard = Guard::new(address, self.token.clone());
        let host = SessionHost::open(&self, guard.elsewhere())?;
        Ok(Viewer { listener, desk: Desk { host, guard }, runtime })
    }

    /// Specification of the instrument to begin with.
    pub(crate) fn spec(&self) -> Spec {
        Spec {
            surface: self.surface.clone(),
            stored: self.stored.clone(),
            without_scale: self.without_scale.is_some(),
            method: self.method,
            effect: PULSES.into(),
            window: None,
            rate: RATE,
            load: false,
            device: self.device.clone(),
            follow: self.follow.clone(),
        }
    }
}

impl Viewer {
    /// URL to open in a browser on this machine, including the token.
    pub fn url(&self) -> String {
        self.desk.guard.url()
    }

    /// URL to open on another machine of the network; `None` if only this machine can connect.
    pub fn elsewhere(&self) -> Option<String> {
        self.desk.guard.elsewhere()
    }

    /// Serves pages until the future `stop` is ready. Then connections are cut, jobs stopped, and the device is closed.
    ///
    /// # Errors
    /// [`ViewError::Gone`] if the thread that plays the surface failed before.
    pub fn serve(self, stop: impl Future<Output = ()>) -> Result<(), ViewError> {
        let Self { listener, desk, runtime } = self;
        let host = desk.host.clone();
        runtime.block_on(async move {
            // Links last as long as pages do: what is open when it ends is cut.
            tokio::select! {
                () = listen(listener, router(desk)) => {}
                () = stop => {}
            }
        });
        runtime.shutdown_background();
        host.close()
    }
}
