//! Checks of the sources of touches.

use super::ask::Ask;
use super::check::Check;
use std::net::{SocketAddr, UdpSocket};
use unripple_touch::Screen;

/// Checks the TUIO port and the multi-touch screens.
pub fn checks(ask: &Ask) -> [Check; 2] {
    [port(ask), screens()]
}

fn port(ask: &Ask) -> Check {
    let address = SocketAddr::new(ask.listen, ask.tuio);
    match UdpSocket::bind(address) {
        Ok(_) => Check::good("TUIO", format!("UDP {address} is free for `play --tuio`")),
        Err(error) => Check::doubtful(
            "TUIO",
            format!("UDP {address} cannot be opened: {error}"),
            "another program listens there: stop it, or choose another port on both sides",
        ),
    }
}

fn screens() -> Check {
    let found = Screen::list();
    if found.is_empty() {
        return Check::skipped(
            "screens",
            "no readable multi-touch screen: touches come over TUIO, OSC or WebSocket, or from synthetic fingers",
        );
    }
    let names: Vec<String> =
        found.iter().map(|(path, name)| format!("{} ({name})", path.display())).collect();
    Check::good("screens", names.join(", "))
}
