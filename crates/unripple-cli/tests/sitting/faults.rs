//! What may happen in a sitting: to the server, and by those who reach the program.

use crate::datagrams::{cursors, garbage, touch};
use crate::hand::socket;
use crate::link::{ANSWER, Link};
use crate::program::{LOOK, Task};
use crate::server::Server;
use crate::sitting::{PERIOD, Sitting};
use serde_json::json;
use std::io::Write;
use std::net::{SocketAddr, TcpStream, UdpSocket};
use std::process::Command;
use std::time::Duration;
use tungstenite::Message;

/// How long a finger strokes before something happens, in s: some pulses.
const STROKED: f64 = 0.3;

/// Range of how long a server stands still, in s. At its end a program may have given the server up.
const STANDS: [f64; 2] = [0.1, 3.0];

/// Longest time that a server is away, in s, so that it comes back between the first and the fourth time that it is looked for.
const AWAY: f64 = 2.0;

/// Periods that the server changes to, or comes back with, in samples; from them it goes back to that of the first.
const PERIODS: [usize; 2] = [64, 1024];

/// Of so many servers that come back, one has the period of the first: both have to be found again, and another one is harder.
const SAME: usize = 3;

/// Sockets and datagrams of a flood, many times what the system keeps for the program.
const SOCKETS: usize = 8;
const FLOOD: usize = 3000;

/// Datagrams of no use.
const GARBAGE: usize = 3000;

/// Connections that never say all that they have to: more than `play` has places, and fewer than the viewer has for one address.
const SILENT: usize = 24;

/// What they say.
const BEGUN: [&[u8]; 3] = [b"", b"GET / HTTP/1.1\r\nHost: x\r\nX-A: ", b"\x16\x03\x01\x02\x00"];

/// Messages of nonsense, more than the viewer bears, and questions of who never listens, fewer than it hears in a second.
const NONSENSE: usize = 100;
const QUESTIONS: usize = 500;

/// Steps of guests before they go, and the one at which pages ask for something.
const STEPS: usize = 20;
const ASKS: usize = 10;

/// Numbers of what guests ask for, beyond those of whoever looks whether all is well.
const GUESTS_ASK: u64 = 1_000_000_000;

/// A fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// The server stands still, and a finger is lifted meanwhile.
    Frozen,
    /// The server ends, and comes back, with another period or the same; a finger is lifted meanwhile.
    Killed,
    /// The server changes its period, and changes it back.
    Period,
    /// Fingers come by datagrams faster than anybody can follow, and are never lifted.
    Flood,
    /// Datagrams mean nothing, or nearly what touches do.
    Garbage,
    /// Who has a link says nonsense, or asks and never listens.
    Rubbish,
    /// Connections are opened, and what should come on them does not.
    Silent,
    /// Somebody comes, touches, asks for something, and goes in the middle of it.
    Guests,
}

impl Fault {
    /// All that may happen to a command; in a short sitting each once in one of the two.
    pub fn of(task: Task, short: bool) -> Vec<Self> {
        let server = [Self::Frozen, Self::Killed, Self::Period];
        let links = [Self::Rubbish, Self::Silent, Self::Guests];
        match (task, short) {
            (Task::Play, true) => vec![Self::Frozen, Self::Flood, Self::Garbage],
            (Task::View, true) => [&server[1..], &links].concat(),
            (Task::Play, false) => [&server[..], &[Self::Flood, Self::Garbage], &links].concat(),
            (Task::View, false) => [server, links].concat(),
        }
    }

    /// Where the program's counts may tell of it.
    pub fn counted(self, task: Task) -> &'static [&'static str] {
        match (task, self) {
            (Task::View, Self::Frozen | Self::Killed | Self::Period) => &["/tally/lost"],
            (Task::View, _) => &["/tally/started"],
            (Task::Play, Self::Frozen) => &["/server/late_cycles", "/server/skipped_s"],
            (Task::Play, Self::Killed | Self::Period) => &["/lost_blocks"],
            (Task::Play, _) => &["/touches", "/refused_touches"],
        }
    }
}

impl Sitting {
    /// Lets a fault happen; connections that stay open beyond it.
    pub fn suffer(&mut self, fault: Fault) -> Vec<TcpStream> {
        match fault {
            Fault::Frozen => self.freeze(),
            Fault::Killed => self.kill(),
            Fault::Period => self.change_period(),
            Fault::Flood => self.flood(),
            Fault::Garbage => self.garble(),
            Fault::Rubbish => return self.talk_rubbish(),
            Fault::Silent => return self.begin_and_wait(),
            Fault::Guests => self.come_and_go(),
        }
        Vec::new()
    }

    fn freeze(&mut self) {
        let half = self.random.between(STANDS[0], STANDS[1]) / 2.0;
        let link = self.link();
        let mut hand = self.hand(link);
        self.stroke(&mut hand, STROKED);
        self.server.stand_still(true);
        self.stroke(&mut hand, half);
        hand.lift();
        std::thread::sleep(Duration::from_secs_f64(half));
        self.server.stand_still(false);
    }

    fn kill(&mut self) {
        let half = self.random.between(0.0, AWAY) / 2.0;
        let link = self.link();
        let mut hand = self.hand(link);
        self.stroke(&mut hand, STROKED);
        // It tells its clients that it ends, and by turns it tells nobody.
        if self.crashes {
            self.server.crash();
        } else {
            self.server.stop();
        }
        self.crashes = !self.crashes;
        self.stroke(&mut hand, half);
        hand.lift();
        std::thread::sleep(Duration::from_secs_f64(half));
        // The first has another, so that each short sitting has one of these.
        let same = self.tally.count(Fault::Killed).is_multiple_of(SAME);
        let period = if same { PERIOD } else { PERIODS[self.one_of(PERIODS.len())] };
        let name = self.server.name.clone();
        self.server = Server::named(&name, period).unwrap();
    }

    fn change_period(&mut self) {
        let period = PERIODS[self.one_of(PERIODS.len())];
        let link = self.link();
        let mut hand = self.hand(link);
        self.stroke(&mut hand, STROKED);
        set_period(&self.server, period);
        self.stroke(&mut hand, STROKED);
        hand.lift();
        drop(hand);
        let took = self.well_again(Vec::new());
        self.tally.lasted(Fault::Period, took);
        set_period(&self.server, PERIOD);
    }

    /// Where datagrams are received.
    fn datagrams(&self) -> SocketAddr {
        self.program.datagrams.unwrap()
    }

    fn flood(&mut self) {
        let to = self.datagrams();
        let sockets: Vec<UdpSocket> = (0..SOCKETS).map(|_| socket(to)).collect();
        for number in 0..FLOOD {
            let datagram = if self.random.uniform() < 0.5 {
                touch(100 + number as i32 % 40, self.place())
            } else {
                let places = [(); 4].map(|()| [self.random.uniform(), self.random.uniform()]);
                cursors(number as i32, &places)
            };
            // What the system has no room for is lost on the way.
            let _ = sockets[number % SOCKETS].send(&datagram);
        }
    }

    fn garble(&mut self) {
        let socket = socket(self.datagrams());
        for _ in 0..GARBAGE {
            let _ = socket.send(&garbage(&mut self.random));
        }
    }

    fn talk_rubbish(&mut self) -> Vec<TcpStream> {
        let [mut nonsense, mut large, mut broken, mut deaf] = [(); 4].map(|()| self.link());
        let letters: Vec<char> =
            r#"{}[]":,do touch type hello at_mm 1e999 -null\u0000 finger"#.chars().collect();
        for _ in 0..NONSENSE {
            let text: String = (0..30).map(|_| letters[self.one_of(letters.len())]).collect();
            nonsense.send(Message::text(text));
        }
        large.send(Message::binary(vec![0; 1000]));
        large.send(Message::text("x".repeat(1 << 17)));
        let bytes: Vec<u8> = (0..200).map(|_| self.one_of(256) as u8).collect();
        // One that has been cut off already hears so when it reads.
        let _ = broken.stream().write_all(&bytes);
        let question = match self.program.task {
            Task::Play => json!({ "v": 1, "type": "hello" }),
            Task::View => json!({ "do": "seen", "frame": 1 }),
        };
        for _ in 0..QUESTIONS {
            deaf.say(&question);
        }
        vec![deaf.into_stream()]
    }

    fn begin_and_wait(&self) -> Vec<TcpStream> {
        let mut open = Vec::new();
        for number in 0..SILENT {
            let mut stream = TcpStream::connect_timeout(&self.program.links, ANSWER).unwrap();
            // One that has been cut off already hears so when it reads.
            let _ = stream.write_all(BEGUN[number % BEGUN.len()]);
            // A few go at once.
            if number % 5 > 0 {
                open.push(stream);
            }
        }
        open
    }

    fn come_and_go(&mut self) {
        let mut guests: [Link; 4] = [(); 4].map(|()| self.link());
        for step in 0..STEPS {
            for (number, guest) in (0u32..).zip(&mut guests) {
                guest.heard();
                guest.touch(number, if step == 0 { "down" } else { "move" }, self.place());
                if step == ASKS && self.program.task == Task::View {
                    let id = GUESTS_ASK + u64::from(number);
                    guest.say(&json!({ "do": "measure", "id": id, "at": [self.place()] }));
                }
            }
            std::thread::sleep(LOOK);
        }
    }
}

fn set_period(server: &Server, period: usize) {
    let changed = Command::new("jack_bufsize")
        .env("JACK_DEFAULT_SERVER", &server.name)
        .arg(period.to_string())
        .output()
        .expect("jack_bufsize");
    assert!(changed.status.success(), "{changed:?}");
}
