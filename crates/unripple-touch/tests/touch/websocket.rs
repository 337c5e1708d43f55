//! The WebSocket, by a client written out by hand.

use crate::{Promise, options, sheet, told};
use serde_json::{Value, json};
use std::io::{ErrorKind, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::time::Duration;
use unripple_core::Phase::{Down, Move, Up};
use unripple_core::Touch;
use unripple_touch::{Counts, Heard, Options, Source, WebSocketOptions, WebSocketPort, Wish};

/// A client that masks with zeros, which leaves its text readable.
pub struct Client {
    stream: TcpStream,
    bytes: Vec<u8>,
}

impl Client {
    pub fn new(port: &WebSocketPort) -> Self {
        let stream = TcpStream::connect(port.address()).unwrap();
        stream.set_nonblocking(true).unwrap();
        stream.set_nodelay(true).unwrap();
        Self { stream, bytes: Vec::new() }
    }

    pub fn request(&mut self, origins: &[&str]) {
        let origins: String = origins.iter().map(|origin| format!("Origin: {origin}\r\n")).collect();
        let text = format!(
            "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n{origins}\
             Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        );
        self.raw(text.as_bytes());
    }

    /// Writes what the system takes; the other end may be gone.
    pub fn raw(&mut self, bytes: &[u8]) -> bool {
        self.stream.write_all(bytes).is_ok()
    }

    pub fn frame(&mut self, head: u8, payload: &[u8]) -> bool {
        let mut bytes = vec![head];
        match payload.len() {
            n if n < 126 => bytes.push(0x80 | n as u8),
            n if n < 65536 => bytes.extend([0x80 | 126, (n >> 8) as u8, n as u8]),
            n => bytes.extend([&[0x80 | 127][..], &(n as u64).to_be_bytes()].concat()),
        }
        bytes.extend([0; 4]);
        bytes.extend(payload);
        self.raw(&bytes)
    }

    pub fn say(&mut self, message: &Value) -> bool {
        self.frame(0x81, message.to_string().as_bytes())
    }

    /// Whether the connection is still there; takes in what came.
    fn take(&mut self) -> bool {
        let mut buffer = [0; 4096];
        loop {
            match self.stream.read(&mut buffer) {
                Ok(0) => return false,
                Ok(n) => self.bytes.extend(&buffer[..n]),
                Err(error) => return error.kind() == ErrorKind::WouldBlock,
            }
        }
    }

    /// The next text, pings being answered if they are to be.
    fn hear(&mut self, answering: bool) -> Option<Value> {
        self.take();
        if let Some(end) =
            self.bytes.windows(4).position(|w| w == b"\r\n\r\n").filter(|_| self.bytes.starts_with(b"HTTP"))
        {
            self.bytes.drain(..end + 4);
        }
        while self.bytes.len() >= 2 {
            let (head, short) = (self.bytes[0], usize::from(self.bytes[1]));
            let (start, length) = match short {
                126 if self.bytes.len() >= 4 => {
                    (4, usize::from(u16::from_be_bytes([self.bytes[2], self.bytes[3]])))
                }
                126 => return None,
                _ => (2, short),
            };
            if self.bytes.len() < start + length {
                return None;
            }
            let payload: Vec<u8> = self.bytes.drain(..start + length).skip(start).collect();
            match head {
                0x81 => return serde_json::from_slice(&payload).ok(),
                0x89 if answering => {
                    self.frame(0x8a, &payload);
                }
                _ => {}
            }
        }
        None
    }
}

/// A port that is polled every millisecond of its own clock.
struct Web {
    port: WebSocketPort,
    now: f64,
    promise: Promise,
    heard: Heard,
}

impl Web {
    fn with(options: Options, sockets: WebSocketOptions) -> Self {
        let port = WebSocketPort::local(0, options, sockets).unwrap();
        Self { port, now: 0.0, promise: Promise::default(), heard: Heard::default() }
    }

    fn new() -> Self {
        Self::with(options(), WebSocketOptions::default())
    }

    fn client(&mut self) -> Client {
        let mut client = Client::new(&self.port);
        client.request(&[]);
        self.until(|_| {
            client.hear(true).is_some() || {
                client.say(&json!({"v":1,"type":"hello"})) && client.hear(true).is_some()
            }
        });
        client
    }

    fn poll(&mut self) {
        std::thread::sleep(Duration::from_micros(200));
        self.now += 1e-3;
        let before = self.heard.touches.len();
        self.port.poll(self.now, &mut self.heard);
        self.promise.hold(&self.heard.touches[before..], &sheet());
    }

    /// Polls until something holds; fails if it never does.
    fn until(&mut self, mut holds: impl FnMut(&Self) -> bool) {
        for _ in 0..50_000 {
            self.poll();
            if holds(self) {
                return;
            }
        }
        panic!("never happened: {:?}", self.port.counts());
    }

    fn touches(&mut self, count: usize) -> Vec<Touch> {
        self.until(|web| web.heard.touches.len() >= count);
        std::mem::take(&mut self.heard.touches)
    }

    fn answer(&mut self, client: &mut Client) -> Value {
        let mut answer = None;
        self.until(|_| {
            answer = client.hear(true);
            answer.is_some()
        });
        answer.unwrap()
    }

    fn counts(&self) -> Counts {
        self.port.counts()
    }
}

fn touch(finger: u32, phase: &str, x: f64, y: f64) -> Value {
    json!({"v": 1, "type": "touch", "finger": finger, "phase": phase, "at_mm": [x, y]})
}

#[test]
fn says_hello_and_takes_touches_and_wishes() {
    let mut web = Web::new();
    let mut client = web.client();
    client.say(&json!({"v": 1, "type": "hello"}));
    let hello = web.answer(&mut client);
    assert_eq!(
        (&hello["v"], &hello["type"], &hello["server"]),
        (&json!(1), &json!("hello"), &json!("unripple"))
    );
    assert_eq!(hello["size_mm"], json!([150.0, 100.0]));
    client.say(&json!({"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[62,90],"force_n":0.3}));
    client.say(&touch(2, "down", 20.0, 20.0));
    let down = web.touches(2);
    assert_eq!(told(&down), [(1, Down, 62.0, 90.0), (2, Down, 20.0, 20.0)]);
    assert_eq!(down[0].force, Some(0.3));
    client.say(&touch(1, "move", 63.0, 90.0));
    client.say(&json!({"v": 1, "type": "touch", "finger": 2, "phase": "up"}));
    assert_eq!(told(&web.touches(2)), [(1, Move, 63.0, 90.0), (2, Up, 20.0, 20.0)]);
    // A finger that comes twice is two.
    client.say(&touch(1, "down", 64.0, 90.0));
    assert_eq!(told(&web.touches(2)), [(1, Up, 63.0, 90.0), (3, Down, 64.0, 90.0)]);
    client.say(&json!({"v": 1, "type": "clear"}));
    assert_eq!(told(&web.touches(1)), [(3, Up, 64.0, 90.0)]);
    client.say(&json!({"v": 1, "type": "effect", "name": "click"}));
    client.say(&json!({"v": 1, "type": "gain", "db": -6}));
    web.until(|web| web.heard.wishes.len() == 2);
    assert_eq!(web.heard.wishes, [Wish::Effect("click".into()), Wish::Gain(-6.0)]);
    assert_eq!(web.counts().errors(), 0);
}

#[test]
fn mistakes_are_answered() {
    let mut web = Web::new();
    let mut client = web.client();
    let mut wrong = |message: &[u8], expected: &str| {
        client.frame(0x81, message);
        let answer = web.answer(&mut client);
        assert_eq!((&answer["v"], &answer["type"]), (&json!(1), &json!("error")));
        assert!(answer["what"].as_str().unwrap().contains(expected), "{answer} has no {expected}");
    };
    wrong(b"{", "EOF");
    wrong(b"[1]", "expected an object");
    wrong(br#"{"type":"hello"}"#, "missing field `v`");
    wrong(br#"{"v":2,"type":"hello"}"#, "expected version 1, found 2");
    wrong(br#"{"v":1,"type":"dance"}"#, "unknown variant `dance`");
    wrong(br#"{"v":1,"type":"touch","finger":1,"phase":"down"}"#, "expected at_mm");
    wrong(br#"{"v":1,"type":"touch","finger":-1,"phase":"up"}"#, "invalid value");
    wrong(br#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[62,90],"colour":"red"}"#, "colour");
    wrong(br#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[1e999,90]}"#, "number out of range");
    wrong(br#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[162,90]}"#, "on the surface");
    wrong(br#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[62,90],"force_n":-1}"#, "force");
    wrong(br#"{"v":1,"type":"touch","finger":1,"phase":"move","at_mm":[62,90]}"#, "finger that is down");
    wrong(br#"{"v":1,"type":"effect","name":""}"#, "name");
    wrong(br#"{"v":1,"type":"gain","db":1000}"#, "db");
    client.frame(0x82, b"bytes");
    assert_eq!(web.answer(&mut client)["what"], "expected text, found bytes");
    assert!(web.heard.touches.is_empty() && web.heard.wishes.is_empty());
    assert_eq!(web.counts().errors(), 15);
}

#[test]
fn a_foreign_origin_is_refused() {
    let listed = WebSocketOptions { origins: vec!["https://lab.example".into()], ..Default::default() };
    let mut web = Web::with(options(), listed);
    for (origins, status) in [
        (&["http://evil.example"][..], "403"),
        (&["null"], "403"),
        (&["http://localhost.evil.example"], "403"),
        (&["http://localhost", "http://evil.example"], "403"),
        (&["http://localhost:8080"], "101"),
        (&["https://lab.example"], "101"),
        (&[], "101"),
    ] {
        let mut client = Client::new(&web.port);
        client.request(origins);
        web.until(|_| {
            client.take();
            client.bytes.len() > 12
        });
        let text = String::from_utf8_lossy(&client.bytes).into_owned();
        assert!(text.starts_with(&format!("HTTP/1.1 {status}")), "{origins:?}: {text}");
        web.until(|_| client.take() == (status == "101"));
    }
    assert_eq!((web.counts().foreign, web.counts().errors()), (4, 4));
}

#[test]
fn fingers_leave_with_their_connection_and_come_back_with_another() {
    let mut web = Web::new();
    let mut first = web.client();
    let mut second = web.client();
    first.say(&touch(1, "down", 62.0, 90.0));
    assert_eq!(told(&web.touches(1)), [(1, Down, 62.0, 90.0)]);
    second.say(&touch(1, "down", 20.0, 20.0));
    assert_eq!(told(&web.touches(1)), [(2, Down, 20.0, 20.0)]);
    first.stream.shutdown(Shutdown::Both).unwrap();
    assert_eq!(told(&web.touches(1)), [(1, Up, 62.0, 90.0)]);
    let mut again = web.client();
    again.say(&touch(1, "down", 62.0, 90.0));
    assert_eq!(told(&web.touches(1)), [(3, Down, 62.0, 90.0)]);
    // A closing frame does the same.
    again.frame(0x88, &[]);
    assert_eq!(told(&web.touches(1)), [(3, Up, 62.0, 90.0)]);
    assert_eq!(web.counts().errors(), 0);
}

#[test]
fn a_client_that_answers_pings_may_rest_its_finger() {
    let mut web = Web::new();
    let mut client = web.client();
    client.say(&touch(1, "down", 62.0, 90.0));
    web.touches(1);
    // Ten seconds of its clock.
    for _ in 0..100 {
        for _ in 0..20 {
            web.now += 4e-3;
            web.poll();
        }
        client.hear(true);
        web.poll();
    }
    assert!(web.heard.touches.is_empty(), "{:?}", web.heard.touches);
    // One that does not is taken for dead, first its finger, then itself.
    web.until(|web| web.counts().silent == 1);
    assert_eq!(told(&web.touches(1)), [(1, Up, 62.0, 90.0)]);
    assert_eq!((web.counts().expired, web.port.tracked()), (1, 0));
}

#[test]
fn slow_handshakes_and_crowds_are_dropped() {
    let mut web = Web::with(options(), WebSocketOptions { most: 3, ..Default::default() });
    let mut slow = Client::new(&web.port);
    slow.raw(b"GET / HTTP/1.1\r\n");
    let crowd: Vec<Client> = (0..10).map(|_| Client::new(&web.port)).collect();
    web.until(|web| web.counts().crowded == 8);
    assert_eq!(web.port.tracked(), 3);
    web.until(|web| web.counts().silent == 3);
    assert_eq!(web.port.tracked(), 0);
    drop(crowd);
    web.client();
}

#[test]
fn a_crowd_that_says_nothing_keeps_no_client_out() {
    let mut web = Web::with(options(), WebSocketOptions { most: 3, ..Default::default() });
    let mut good = web.client();
    let crowd: Vec<Client> = (0..20).map(|_| Client::new(&web.port)).collect();
    web.until(|web| web.counts().crowded == 18);
    let mut another = web.client();
    assert_eq!((web.counts().silent, web.port.tracked()), (0, 3));
    good.say(&touch(1, "down", 62.0, 90.0));
    assert_eq!(told(&web.touches(1)), [(1, Down, 62.0, 90.0)]);
    another.say(&touch(1, "down", 20.0, 20.0));
    assert_eq!(told(&web.touches(1)), [(2, Down, 20.0, 20.0)]);
    drop(crowd);
}

#[test]
fn hostile_bytes_end_their_own_connection_alone() {
    let mut web = Web::new();
    let mut good = web.client();
    good.say(&touch(1, "down", 62.0, 90.0));
    web.touches(1);
    let long = vec![b'x'; 5000];
    let mut expected = 0;
    for attack in 0..6 {
        let mut bad = web.client();
        match attack {
            0 => bad.frame(0x81, &long),
            1 => bad.raw(&[0x81, 0x05, b'h', b'e', b'l', b'l', b'o']),
            2 => bad.raw(&[0x81, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0]),
            3 => bad.frame(0x81, &[0xff, 0xfe]),
            4 => bad.frame(0xf1, b"reserved bits"),
            _ => (0..100).all(|_| bad.frame(0x00, &long[..100])),
        };
        expected += 1;
        web.until(|web| web.counts().malformed == expected);
    }
    let mut junk = Client::new(&web.port);
    junk.raw(b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 not HTTP at all\r\n\r\n");
    web.until(|web| web.counts().malformed == expected + 1);
    good.say(&touch(1, "move", 63.0, 90.0));
    assert_eq!(told(&web.touches(1)), [(1, Move, 63.0, 90.0)]);
    assert_eq!(web.port.tracked(), 2);
}

#[test]
fn a_client_that_takes_no_answers_is_dropped() {
    let mut web = Web::new();
    let mut deaf = web.client();
    // It asks until the system's buffers are full of answers that it does not read.
    let question = br#"{"v":1,"type":"touch","finger":1,"phase":"down","at_mm":[-1,0],"force_n":1}"#;
    let frame = [&[0x81, 0x80 | question.len() as u8, 0, 0, 0, 0], &question[..]].concat();
    let many = frame.repeat(64);
    let mut sent = 0;
    for _ in 0..100_000 {
        sent += deaf.stream.write(&many[sent % many.len()..]).unwrap_or(0);
        web.poll();
        if web.counts().silent == 1 {
            break;
        }
    }
    let counts = web.counts();
    assert_eq!((counts.silent, counts.malformed, web.port.tracked()), (1, 0, 0), "{counts:?} after {sent}");
}
