//! JSON over WebSocket, for pages and programs on this machine.

mod connection;
mod message;
mod metered;
mod origin;
mod port;

pub use message::{Message, SCHEMA};
pub use port::{WebSocketOptions, WebSocketPort};
