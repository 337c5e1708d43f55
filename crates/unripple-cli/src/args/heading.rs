//! Headings under which the help lists options.

/// Options that every command has.
pub const EVERY: &str = "For every command";
/// Surfaces that are compared.
pub const SURFACES: &str = "Surfaces";
/// Actuators that are placed, and those that are kept.
pub const ACTUATORS: &str = "Actuators";
/// Where actuators or sensors may be.
pub const PLACES: &str = "Places";
/// The objective of a search, and its effort.
pub const SEARCH: &str = "Search";
/// Targets of a focus, or places that are evaluated.
pub const TARGETS: &str = "Targets";
/// How strong a drive is.
pub const LEVEL: &str = "Level";
/// How a drive is computed.
pub const METHOD: &str = "Method";
/// How long a drive or a session lasts.
pub const TIME: &str = "Time";
/// Model on which a drive is simulated.
pub const SIMULATION: &str = "Simulation";
/// Files that are written, and where.
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
/// What measured responses are, and their units.
pub const MEASURED: &str = "What was measured";
/// Points that a calibration measures.
pub const POINTS: &str = "Points to measure";
/// Signals that a calibration plays.
pub const SWEEPS: &str = "Sweeps";
/// Which channel each actuator, sensor and the probe is connected to, and which physical value full scale stands for.
pub const WIRING: &str = "Wiring and scales";
/// The model with which a surface is compared, or that is fitted to it.
pub const MODEL: &str = "Model";
/// Natural frequencies that were heard.
pub const FREQUENCIES: &str = "Frequencies";
/// Author and licence that a SOFA file contains.
pub const SOFA: &str = "SOFA";
/// Sources of touches.
pub const TOUCHES: &str = "Touches";
/// How pages reach the program.
pub const NETWORK: &str = "Network";
