//! The viewer: a server that listens for pages until it is told to stop.

use crate::door::listen;
use crate::framing::policy;
use crate::guard::Guard;
use crate::host::SessionHost;
use crate::server::{Desk, router};
use crate::{View, ViewError};
use std::future::Future;
use tokio::net::TcpListener;
use tokio::runtime::Runtime;

/// Threads that serve pages: one, so that serving never takes a core from the simulation.
const THREADS: usize = 1;

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
        let desk = Desk { host, guard, policy: policy(&self.framed_by) };
        Ok(Viewer { listener, desk, runtime })
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
