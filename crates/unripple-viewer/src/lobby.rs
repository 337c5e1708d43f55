//! The connections, and which are closed when there are too many.

use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv6Addr};
use std::sync::{Arc, Mutex};
use tokio::sync::Notify;
use unripple_session::lock;

/// Largest number of connections that have not been admitted yet, in all and from one address: a browser opens six, and several may sit
/// behind one address.
const STRANGERS: usize = 128;
const STRANGERS_EACH: usize = 32;

/// Largest number of admitted connections that hold no page's link: what browsers keep open for the next file.
const GUESTS: usize = 128;

/// Standing of a connection, by the requests that it has made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    /// No request was allowed so far: anybody may have opened it.
    Stranger,
    /// A request of the connection was allowed.
    Guest,
    /// The connection is the link of a page. How many there may be is counted elsewhere.
    Page,
}

#[derive(Debug)]
struct Seated {
    network: IpAddr,
    standing: Standing,
    cut: Arc<Notify>,
}

/// All connections, the oldest first. A new one is always accepted: if there are too many of a kind, the oldest of that kind is closed, so
/// that silent connections never keep out others. An admitted connection is never closed for one that is not admitted.
#[derive(Debug, Default)]
pub struct Lobby {
    seats: Mutex<(u64, BTreeMap<u64, Seated>)>,
}

/// A connection's entry in the lobby, which is removed when this is dropped.
#[derive(Debug)]
pub struct Seat {
    lobby: Arc<Lobby>,
    number: u64,
    cut: Arc<Notify>,
}

impl Lobby {
    /// Adds a connection from an address. If there are too many that have not been admitted, the oldest of that address or of all is closed.
    pub fn enter(self: &Arc<Self>, address: IpAddr) -> Seat {
        let (network, cut) = (network(address), Arc::new(Notify::new()));
        let mut seats = lock(&self.seats);
        let (given, seats) = &mut *seats;
        *given += 1;
        let standing = Standing::Stranger;
        seats.insert(*given, Seated { network, standing, cut: cut.clone() });
        let goes = stranger_too_many(seats, network);
        dismiss(seats, goes);
        Seat { lobby: self.clone(), number: *given, cut }
    }

    /// Number of connections.
    #[cfg(test)]
    fn count(&self) -> usize {
        lock(&self.seats).1.len()
    }
}

impl Seat {
    /// Records that a request of the connection was allowed.
    pub fn admit(&self) {
        self.rise(Standing::Guest);
        let seats = &mut lock(&self.lobby.seats).1;
        let guest = |(_, seated): &(&u64, &Seated)| seated.standing == Standing::Guest;
        if seats.iter().filter(guest).count() > GUESTS {
            let oldest = seats
                .iter()
                .find(|(number, seated)| seated.standing == Standing::Guest && **number != self.number);
            let oldest = oldest.map(|(number, _)| *number);
            dismiss(seats, oldest);
        }
    }

    /// Records that the connection is a page's link from now on.
    pub fn settle(&self) {
        self.rise(Standing::Page);
    }

    /// Resolves when the connection must be closed.
    pub async fn cut(&self) {
        self.cut.notified().await;
    }

    fn rise(&self, standing: Standing) {
        // One that has been dismissed meanwhile has no place any more.
        if let Some(seated) = lock(&self.lobby.seats).1.get_mut(&self.number)
            && seated.standing != Standing::Page
        {
            seated.standing = standing;
        }
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        lock(&self.lobby.seats).1.remove(&self.number);
    }
}

/// The stranger that has to go, if there are too many of them now that one has come from a network.
fn stranger_too_many(seats: &BTreeMap<u64, Seated>, network: IpAddr) -> Option<u64> {
    let strangers = || seats.iter().filter(|(_, seated)| seated.standing == Standing::Stranger);
    let mut own = strangers().filter(|(_, seated)| seated.network == network);
    if own.clone().count() > STRANGERS_EACH {
        return own.next().map(|(number, _)| *number);
    }
    if strangers().count() <= STRANGERS {
        return None;
    }
    // Beside somebody who may come in there may be more of the same browser.
    let known = |network: IpAddr| {
        seats.values().any(|seated| seated.network == network && seated.standing != Standing::Stranger)
    };
    let unknown = strangers().find(|(_, seated)| !known(seated.network));
    unknown.or_else(|| strangers().next()).map(|(number, _)| *number)
}

fn dismiss(seats: &mut BTreeMap<u64, Seated>, number: Option<u64>) {
    if let Some(seated) = number.and_then(|number| seats.remove(&number)) {
        seated.cut.notify_one();
    }
}

/// What one subscriber can send from: an address, or the 2^64 addresses that share the first half of one.
fn network(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            IpAddr::V6(Ipv6Addr::new(a, b, c, d, 0, 0, 0, 0))
        }
        address => address,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from(last: u8) -> IpAddr {
        IpAddr::from([10, 0, 0, last])
    }

    /// Whether a connection has been told to go.
    fn gone(seat: &Seat) -> bool {
        !lock(&seat.lobby.seats).1.contains_key(&seat.number)
    }

    #[test]
    fn strangers_push_out_strangers_alone() {
        let lobby = Arc::new(Lobby::default());
        let (guest, page, beside) = (lobby.enter(from(1)), lobby.enter(from(2)), lobby.enter(from(2)));
        guest.admit();
        page.admit();
        page.settle();
        let strangers: Vec<Seat> = (0..1000u32).map(|i| lobby.enter(from((i % 250) as u8 + 3))).collect();
        assert!(!gone(&guest) && !gone(&page) && !gone(&beside));
        assert_eq!(lobby.count(), 2 + STRANGERS);
        assert!(strangers.iter().rev().take(STRANGERS - 1).all(|seat| !gone(seat)));
        drop((strangers, guest, page, beside));
        assert_eq!(lobby.count(), 0);
    }

    #[test]
    fn one_address_takes_no_more_than_its_share() {
        let lobby = Arc::new(Lobby::default());
        let other = lobby.enter(from(1));
        let many: Vec<Seat> = (0..300).map(|_| lobby.enter(from(2))).collect();
        assert!(!gone(&other));
        assert_eq!(many.iter().filter(|seat| !gone(seat)).count(), STRANGERS_EACH);
        assert!(!gone(many.last().unwrap()));
        let six = |last: u16| IpAddr::V6(Ipv6Addr::new(0x2001, 0xdb8, 0, 1, 0, 0, 0, last));
        let near: Vec<Seat> = (0..300).map(|last| lobby.enter(six(last))).collect();
        assert_eq!(near.iter().filter(|seat| !gone(seat)).count(), STRANGERS_EACH);
    }

    #[test]
    fn guests_who_stay_for_nothing_make_room_for_guests() {
        let lobby = Arc::new(Lobby::default());
        let page = lobby.enter(from(1));
        page.admit();
        page.settle();
        let guests: Vec<Seat> = (0..200u8)
            .map(|last| {
                let seat = lobby.enter(from(last));
                seat.admit();
                seat
            })
            .collect();
        assert!(!gone(&page));
        assert_eq!(guests.iter().filter(|seat| !gone(seat)).count(), GUESTS);
        assert!(!gone(guests.last().unwrap()));
        // What has been dismissed stays so.
        guests[0].admit();
        assert!(gone(&guests[0]));
    }
}
