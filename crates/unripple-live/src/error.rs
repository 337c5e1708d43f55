//! Why a surface cannot be played live.

use unripple_core::DeviceError;
use unripple_devices::DevicesError;
use unripple_field::FieldError;
use unripple_focus::FocusError;

/// Errors that keep a surface from being played.
#[derive(Debug, thiserror::Error)]
pub enum LiveError {
    /// A value that cannot be.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// What it is.
        what: &'static str,
        /// What would do.
        expected: String,
        /// What there is.
        found: String,
    },
    /// The device has other channels or another rate than the surface.
    #[error("device `{device}`: expected {expected}, found {found}")]
    Unlike {
        /// Name of the device.
        device: String,
        /// What the surface has.
        expected: String,
        /// What the device has.
        found: String,
    },
    /// A thread is gone: the one that makes drives, or another that play needs.
    #[error("a thread that play needs is gone: {why}")]
    Gone {
        /// Why, as far as is known.
        why: String,
    },
    /// No drive can be made.
    #[error(transparent)]
    Focus(#[from] FocusError),
    /// What a drive does to the surface cannot be computed.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A device cannot be had.
    #[error(transparent)]
    Devices(#[from] DevicesError),
    /// A device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// What was measured does not fit.
    #[error(transparent)]
    Calibrate(#[from] unripple_calibrate::CalibrateError),
    /// Effects that cannot be.
    #[error(transparent)]
    Effects(#[from] unripple_effects::EffectsError),
    /// The player refuses its options.
    #[error(transparent)]
    Player(#[from] unripple_player::PlayerError),
}
