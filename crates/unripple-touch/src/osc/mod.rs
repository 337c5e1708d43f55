//! OSC over UDP: TUIO 1.1, TUIO 2.0 and the addresses under `/unripple/`.

mod frame;
mod own;
mod packet;
mod port;
mod profile;
mod receiver;
mod senders;
mod sequence;
mod tuio;
mod tuio2;

pub use port::OscPort;
pub use receiver::OscReceiver;
