//! Why a surface cannot be shown.

use unripple_store::StoreError;

/// Errors that keep a surface from being shown.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// Nobody can listen at an address.
    #[error("listening at {address}: {why} (another program may use it: choose another port)")]
    Address {
        /// The address as it was given.
        address: String,
        /// What the system said.
        why: String,
    },
    /// A thread cannot be started, or ended early.
    #[error("a thread of the viewer is gone: {why}")]
    Gone {
        /// Why, as far as is known.
        why: String,
    },
    /// A value that cannot be.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// Name of the value.
        what: &'static str,
        /// What would do.
        expected: String,
        /// What there is.
        found: String,
    },
    /// A surface or library that cannot be read.
    #[error("{}", told(.0))]
    Store(#[from] StoreError),
    /// A surface that cannot be played.
    #[error(transparent)]
    Live(#[from] unripple_live::LiveError),
    /// A surface that cannot be computed.
    #[error(transparent)]
    Physics(#[from] unripple::physics::PhysicsError),
    /// A virtual surface that cannot be.
    #[error(transparent)]
    Devices(#[from] unripple_devices::DevicesError),
    /// A surface that cannot be touched.
    #[error(transparent)]
    Touch(#[from] unripple_touch::TouchError),
    /// A device that cannot be opened.
    #[error("device: {why}")]
    Device {
        /// What the device said.
        why: String,
    },
}

/// All faults of a file, a line each.
fn told(error: &StoreError) -> String {
    match error {
        StoreError::Surface(faults) => {
            faults.faults().iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
        }
        error => error.to_string(),
    }
}
