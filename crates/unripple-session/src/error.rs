//! Errors of the viewer.

use unripple_store::StoreError;
use unripple_tasks::TaskError;

/// Errors that keep a surface from being shown.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The server cannot listen at an address.
    #[error("listening at {address}: {why} (another program may use it: choose another port)")]
    Address {
        /// The address that was requested.
        address: String,
        /// Reason that the operating system gave.
        why: String,
    },
    /// A thread cannot be started, or ended early.
    #[error("a thread of the viewer is gone: {why}")]
    Gone {
        /// Reason, as far as it is known.
        why: String,
    },
    /// Work that was cancelled before it was complete.
    #[error("stopped")]
    Stopped,
    /// A value is not accepted.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// Name of the value.
        what: &'static str,
        /// Description of the values that are accepted.
        expected: String,
        /// The value that was found.
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
    /// A surface without responses, such as one that has no mode in its band.
    #[error(transparent)]
    Act(#[from] unripple::act::ActError),
    /// A virtual surface that cannot be simulated.
    #[error(transparent)]
    Devices(#[from] unripple_devices::DevicesError),
    /// A surface on which touches cannot be received.
    #[error(transparent)]
    Touch(#[from] unripple_touch::TouchError),
    /// A device that cannot be opened.
    #[error("device: {why}")]
    Device {
        /// Reason that the device gave.
        why: String,
    },
}

impl From<ViewError> for TaskError {
    fn from(error: ViewError) -> Self {
        match error {
            ViewError::Store(error) => error.into(),
            ViewError::Live(error) => error.into(),
            ViewError::Stopped => Self::Cancelled,
            error @ (ViewError::Address { .. } | ViewError::Gone { .. } | ViewError::Device { .. }) => {
                Self::work(error)
            }
            error => Self::input(error),
        }
    }
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
