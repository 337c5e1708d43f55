//! Errors that tasks return.

use crate::machine;
use unripple::act::{ActError, LevelKind};
use unripple::physics::PhysicsError;
use unripple_calibrate::CalibrateError;
use unripple_devices::DevicesError;
use unripple_live::LiveError;
use unripple_plot::PlotError;
use unripple_store::{FileFaults, StoreError};
use unripple_touch::TouchError;

/// Error that ended a task.
#[derive(Debug, thiserror::Error)]
pub enum TaskError {
    /// A field of the request, or a combination of fields, has a value that is not accepted.
    #[error("{field}: expected {expected}, found {found}")]
    Ask {
        /// The field, or fields separated by commas.
        field: &'static str,
        /// Description of the values that are accepted.
        expected: String,
        /// The value that was found.
        found: String,
    },
    /// An input, such as a file, cannot be used.
    #[error("{0}")]
    Input(String),
    /// The work needs more memory than there is.
    #[error("{0}")]
    Memory(String),
    /// A file has faults, each with its line and column.
    #[error("{0:#}")]
    Faults(Box<FileFaults>),
    /// The work failed, though its input was good.
    #[error("{0}")]
    Work(String),
    /// The caller cancelled the task.
    #[error("cancelled")]
    Cancelled,
}

impl TaskError {
    /// Error of a field of a request, from what was expected and what was found.
    pub fn ask(field: &'static str, expected: impl Into<String>, found: impl std::fmt::Display) -> Self {
        Self::Ask { field, expected: expected.into(), found: found.to_string() }
    }

    /// Error of bad input, from its message.
    pub fn input(error: impl std::fmt::Display) -> Self {
        Self::Input(error.to_string())
    }

    /// Error of a computation or an output that failed, from its message.
    pub fn work(error: impl std::fmt::Display) -> Self {
        Self::Work(error.to_string())
    }

    /// Whether the error lies in the input (the request or a file) rather than in the computation.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Ask { .. } | Self::Input(_) | Self::Memory(_) | Self::Faults(_))
    }
}

impl From<ActError> for TaskError {
    fn from(error: ActError) -> Self {
        match error {
            ActError::Level { what, expected, found } => {
                let field = match what {
                    LevelKind::Peak => "peak_m",
                    LevelKind::Felt => "felt_db",
                };
                Self::ask(field, expected.to_string(), found)
            }
            ActError::Physics(error @ PhysicsError::TooLarge { .. }) => error.into(),
            error if error.is_failed_work() => Self::work(error),
            error => Self::input(error),
        }
    }
}

impl From<StoreError> for TaskError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Surface(faults) => Self::Faults(Box::new(faults)),
            error if error.is_bad_input() => Self::input(error),
            error => Self::work(error),
        }
    }
}

impl From<PhysicsError> for TaskError {
    fn from(error: PhysicsError) -> Self {
        let told = machine::told(&error);
        match error {
            PhysicsError::TooLarge { .. } => Self::Memory(told),
            _ => Self::Input(told),
        }
    }
}

impl From<CalibrateError> for TaskError {
    fn from(error: CalibrateError) -> Self {
        match error {
            CalibrateError::Physics(error) => error.into(),
            CalibrateError::Device(_)
            | CalibrateError::Gap { .. }
            | CalibrateError::Rig { .. }
            | CalibrateError::Sink { .. } => Self::work(error),
            error => Self::input(error),
        }
    }
}

impl From<DevicesError> for TaskError {
    fn from(error: DevicesError) -> Self {
        Self::input(error)
    }
}

impl From<LiveError> for TaskError {
    fn from(error: LiveError) -> Self {
        match error {
            LiveError::Device(_) | LiveError::Gone { .. } => Self::work(error),
            error => Self::input(error),
        }
    }
}

impl From<TouchError> for TaskError {
    fn from(error: TouchError) -> Self {
        Self::input(error)
    }
}

impl From<PlotError> for TaskError {
    fn from(error: PlotError) -> Self {
        Self::work(error)
    }
}
