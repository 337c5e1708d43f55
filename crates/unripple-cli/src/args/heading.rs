//! Headings under which the help lists options.

/// Options that every command has.
pub const EVERY: &str = "For every command";
/// Of which surfaces something is asked.
pub const SURFACES: &str = "Surfaces";
/// What is to be in focus, or looked at.
pub const TARGETS: &str = "Targets";
/// How strong a drive is.
pub const LEVEL: &str = "Level";
/// How a drive is computed.
pub const METHOD: &str = "Method";
/// How long a drive or a session lasts.
pub const TIME: &str = "Time";
/// On what a drive is simulated.
pub const SIMULATION: &str = "Simulation";
/// What is written, and where.
pub const RESULTS: &str = "Results";
/// The device that plays and records.
pub const DEVICE: &str = "Device";
/// A sound server as the device.
pub const JACK: &str = "Device: JACK server";
/// A sound card as the device.
pub const CARD: &str = "Device: sound card";
/// Recordings made elsewhere as the device.
pub const TAPE: &str = "Device: tape (recordings made elsewhere)";
/// A simulated surface as the device.
pub const VIRTUAL: &str = "Device: virtual surface";
/// What a calibration measures.
pub const POINTS: &str = "Points to measure";
/// What a calibration plays.
pub const SWEEPS: &str = "Sweeps";
/// Which channel each actuator, sensor and the probe is connected to, and which physical value full scale stands for.
pub const WIRING: &str = "Wiring and scales";
/// What the surface is compared with.
pub const MODEL: &str = "Model";
/// What a SOFA file says of itself.
pub const SOFA: &str = "SOFA";
/// Where touches come from.
pub const TOUCHES: &str = "Touches";
/// How pages reach the program.
pub const NETWORK: &str = "Network";
