//! Why a surface cannot be played live.

use unripple_core::DeviceError;
use unripple_devices::DevicesError;
use unripple_field::FieldError;
use unripple_focus::FocusError;

/// Errors that keep a surface from being played.
#[derive(Debug, thiserror::Error)]
pub enum LiveError {
    /// A value is out of its range.
    #[error("{what}: expected {expected}, found {found}")]
    Range {
        /// Name of the value, and its unit.
        what: &'static str,
        /// The range that is allowed.
        expected: String,
        /// The value that was given.
        found: String,
    },
    /// The device has other channels or another rate than the surface.
    #[error("device `{device}`: expected {expected}, found {found}")]
    Unlike {
        /// Name of the device.
        device: String,
        /// Channels or sample rate of the surface, in words.
        expected: String,
        /// Channels or sample rate of the device, in words.
        found: String,
    },
    /// A thread that live play needs has ended: the one that computes drives, or another.
    #[error("a thread that play needs is gone: {why}")]
    Gone {
        /// Reason why the thread ended, as far as it is known.
        why: String,
    },
    /// A drive cannot be computed.
    #[error(transparent)]
    Focus(#[from] FocusError),
    /// The field that a drive causes on the surface cannot be computed.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A device, or a simulated finger on a virtual surface, cannot be set up or used.
    #[error(transparent)]
    Devices(#[from] DevicesError),
    /// A device did not exchange a block.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// Measured responses cannot be interpolated, or tension cannot be followed.
    #[error(transparent)]
    Calibrate(#[from] unripple_calibrate::CalibrateError),
    /// The effects are invalid, or do not suit the surface.
    #[error(transparent)]
    Effects(#[from] unripple_effects::EffectsError),
    /// The player refuses its options or a drive.
    #[error(transparent)]
    Player(#[from] unripple_player::PlayerError),
}
