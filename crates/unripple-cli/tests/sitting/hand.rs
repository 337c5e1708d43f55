//! A finger on the surface, by datagrams or by a link.

use crate::datagrams;
use crate::link::Link;
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// Interval at which a finger is told of: as often as sensors do, and less often than a page may.
const EVERY: Duration = Duration::from_millis(10);

/// Its number, which no other has.
const FINGER: u32 = 1;

/// How the program hears of a finger.
enum By {
    Datagrams(UdpSocket),
    /// A link, and whether the finger is down there.
    Link(Box<Link>, bool),
}

/// A finger, and where it was last.
pub struct Hand {
    by: By,
    at_mm: [f64; 2],
    next: Instant,
}

/// A socket that sends to an address.
pub fn socket(to: SocketAddr) -> UdpSocket {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    socket.connect(to).unwrap();
    socket
}

impl Hand {
    fn new(by: By) -> Self {
        Self { by, at_mm: [0.0; 2], next: Instant::now() }
    }

    pub fn of_datagrams(to: SocketAddr) -> Self {
        Self::new(By::Datagrams(socket(to)))
    }

    pub fn of_link(link: Link) -> Self {
        Self::new(By::Link(Box::new(link), false))
    }

    /// Puts the finger down, or moves it, unless it was told of just before.
    pub fn touch(&mut self, at_mm: [f64; 2]) {
        if Instant::now() < self.next {
            return;
        }
        (self.at_mm, self.next) = (at_mm, Instant::now() + EVERY);
        match &mut self.by {
            By::Datagrams(socket) => {
                // One that is lost on the way is told of again.
                let _ = socket.send(&datagrams::touch(FINGER as i32, at_mm));
            }
            By::Link(link, down) => {
                // Whose finger was refused has none there.
                *down &= !link.heard().iter().any(|told| told["type"] == "error");
                *down = link.touch(FINGER, if *down { "move" } else { "down" }, at_mm);
                if !*down {
                    link.reopen();
                }
            }
        }
    }

    /// Stays beside the surface.
    pub fn stay(&mut self) {
        if let By::Link(link, _) = &mut self.by {
            link.heard();
        }
    }

    /// Lifts the finger.
    pub fn lift(&mut self) {
        match &mut self.by {
            By::Datagrams(socket) => {
                // A finger that nothing is heard of is lifted as well.
                let _ = socket.send(&datagrams::lift(FINGER as i32));
            }
            By::Link(link, down) => {
                link.touch(FINGER, "up", self.at_mm);
                *down = false;
            }
        }
    }
}
