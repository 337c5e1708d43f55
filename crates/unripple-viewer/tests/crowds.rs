//! Whoever says nothing keeps nobody else out.

mod common;

use common::{Served, status, until};
use serde_json::json;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;
use tokio::net::TcpSocket;
use tungstenite::Message;

/// Connections that begin to ask for something and never end, from so many addresses of this machine.
fn crowd(served: &Served, count: usize, addresses: usize) -> Vec<TcpStream> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
    let one = |i: usize| {
        let from = SocketAddr::from(([127, 0, 0, 1 + (i % addresses) as u8], 0));
        let stream = runtime.block_on(async {
            let socket = TcpSocket::new_v4().unwrap();
            socket.bind(from).unwrap();
            socket.connect(served.address).await.unwrap()
        });
        let mut stream = stream.into_std().unwrap();
        stream.set_nonblocking(false).unwrap();
        // One that has been cut off already hears so when it reads.
        let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost: x\r\nX-A: ");
        stream
    };
    (0..count).map(one).collect()
}

/// Waits until the other end has closed a connection.
fn closed(mut stream: TcpStream) {
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    let mut bytes = Vec::new();
    match stream.read_to_end(&mut bytes) {
        Ok(_) => {}
        Err(error) => assert_eq!(error.kind(), ErrorKind::ConnectionReset, "{error}"),
    }
}

/// How many of some connections are still open.
fn open(crowd: &mut [TcpStream]) -> usize {
    let open = |stream: &mut TcpStream| {
        stream.set_nonblocking(true).unwrap();
        matches!(stream.read(&mut [0; 64]), Err(error) if error.kind() == ErrorKind::WouldBlock)
    };
    crowd.iter_mut().map(open).filter(|open| *open).count()
}

#[test]
fn a_page_comes_in_beside_a_crowd_and_what_waits() {
    let served = Served::new(None);
    let mut first = served.page();
    until(&mut first, "surface");
    let mut crowd = crowd(&served, 300, 20);
    for id in 0..60 {
        let measure = json!({ "do": "measure", "id": id, "at": [[62, 90]], "method": "felt" });
        first.send(Message::text(measure.to_string())).unwrap();
    }
    first.send(Message::text(r#"{"do":"edit","tension_n_per_m":151}"#)).unwrap();
    while until(&mut first, "surface")["values"]["tension_n_per_m"] != 151.0 {}
    assert_eq!(status(&served.get("/", "")), 200);
    assert_eq!(status(&served.get("/assets/app.js", "")), 200);
    let mut second = served.page();
    let shown = until(&mut second, "surface");
    assert_eq!(shown["values"]["tension_n_per_m"], 151.0);
    while until(&mut second, "design")["edit"] != shown["edit"] {}
    // The page that was there first is still there.
    until(&mut first, "status");
    let left = open(&mut crowd);
    assert!(left <= 128, "{left} of 300 are held");
}

#[test]
fn who_never_ends_asking_is_cut_off() {
    let served = Served::new(Some("abcdef123456"));
    let crowd = crowd(&served, 40, 3);
    // One says all there is to say and sends the rest of its file never; one asks for something and then for nothing more.
    let mut slow = TcpStream::connect(served.address).unwrap();
    let head = format!("POST /surface?token=abcdef123456 HTTP/1.1\r\nHost: {}\r\n", served.address);
    slow.write_all(format!("{head}Content-Length: 1000\r\n\r\nname").as_bytes()).unwrap();
    let mut idle = TcpStream::connect(served.address).unwrap();
    let whole = format!("GET /?token=abcdef123456 HTTP/1.1\r\nHost: {}\r\n\r\n", served.address);
    idle.write_all(whole.as_bytes()).unwrap();
    crowd.into_iter().chain([slow, idle]).for_each(closed);
    assert_eq!(status(&served.get("/?token=abcdef123456", "")), 200);
}

#[test]
fn heads_without_end_are_refused() {
    let served = Served::new(None);
    let mut stream = TcpStream::connect(served.address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    stream.write_all(b"GET / HTTP/1.1\r\n").unwrap();
    let line = format!("X-A: {}\r\n", "x".repeat(1000));
    // Refused at last, so that nothing more is taken.
    let taken = (0..100_000).take_while(|_| stream.write_all(line.as_bytes()).is_ok()).count();
    assert!(taken < 100_000);
    let mut answer = String::new();
    if stream.read_to_string(&mut answer).is_ok() {
        assert_eq!(status(&answer), 431, "{answer}");
    }
}
