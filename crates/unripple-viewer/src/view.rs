//! What is to be shown and to whom, and the server that shows it.

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

/// What is to be shown, and to whom.
pub struct View {
    /// The surface that is shown.
    pub surface: Surface,
    /// Responses of the surface, where they were measured.
    pub stored: Option<Arc<SampledResponses>>,
    /// Reason for which the scale of the responses is not known, if it is not.
    pub without_scale: Option<String>,
    /// Responses of its library at any places, as the command line has them.
    pub respond: Option<Responder>,
    /// Name of the surface on the command line.
    pub source: String,
    /// How drives are made at first.
    pub method: Method,
    /// A real device; the surface is simulated where `None`.
    pub device: Option<Opener>,
    /// How the sheet's tension is followed, if it is.
    pub follow: Option<Follow>,
    /// Name of the device, for people.
    pub device_name: String,
    /// Address to listen at; port 0 takes any that is free.
    pub address: SocketAddr,
    /// Token that pages must know; `None` where only this machine can come.
    pub token: Option<String>,
    /// Folder for libraries.
    pub folder: PathBuf,
    /// Whether to be silent about what is refused.
    pub quiet: bool,
}

/// A viewer that listens.
pub struct Viewer {
    listener: TcpListener,
    desk: Desk,
    runtime: Runtime,
}

impl View {
    /// Makes the surface ready and listens.
    ///
    /// # Errors
    /// [`ViewError::Address`] if nobody can listen there; those of the surface.
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

    /// What is played at first.
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
    /// The address to open in a browser of this machine, the token in it.
    pub fn url(&self) -> String {
        self.desk.guard.url()
    }

    /// The address to open on another machine of the network, where such are listened to.
    pub fn elsewhere(&self) -> Option<String> {
        self.desk.guard.elsewhere()
    }

    /// Serves pages until `stop` is done. Then connections are cut, jobs ended, and the device let go.
    ///
    /// # Errors
    /// [`ViewError::Gone`] if the surface ended before.
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
