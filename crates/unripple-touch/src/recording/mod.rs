//! Recordings of touch sessions in files.

mod line;
mod playback;
mod recorder;
mod session;

pub use playback::Playback;
pub use recorder::Recorder;
pub use session::Recording;
