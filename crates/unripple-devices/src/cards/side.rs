//! The two sides of a card: one plays, one records.

use cpal::traits::DeviceTrait;

/// The direction of a stream: playing or recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Playback,
    Capture,
}

impl Side {
    /// The opposite direction.
    pub(super) fn other(self) -> Self {
        match self {
            Self::Playback => Self::Capture,
            Self::Capture => Self::Playback,
        }
    }

    /// The verb for messages: played or recorded.
    pub(super) fn did(self) -> &'static str {
        match self {
            Self::Playback => "played",
            Self::Capture => "recorded",
        }
    }

    /// The noun for messages: output or input channels.
    pub(super) fn channels(self) -> &'static str {
        match self {
            Self::Playback => "output channels",
            Self::Capture => "input channels",
        }
    }

    /// The stream formats that a device offers in this direction.
    pub(super) fn offers(self, device: &cpal::Device) -> Vec<cpal::SupportedStreamConfigRange> {
        match self {
            Self::Playback => device.supported_output_configs().map(Iterator::collect),
            Self::Capture => device.supported_input_configs().map(Iterator::collect),
        }
        .unwrap_or_default()
    }
}
