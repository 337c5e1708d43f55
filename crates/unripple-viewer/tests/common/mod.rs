//! A viewer that is served, and what a page says to it.
#![allow(dead_code, missing_docs)]

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};
use unripple::focus::Method;
use unripple::physics::design::papers_surface;
use unripple_viewer::{View, ViewError, pause};

/// A viewer of a small surface on a thread of its own.
pub struct Served {
    pub address: SocketAddr,
    done: Sender<()>,
    thread: Option<JoinHandle<Result<(), ViewError>>>,
}

impl Served {
    pub fn new(token: Option<&str>) -> Self {
        Self::with(token, |_| ())
    }

    /// The same, with something otherwise.
    pub fn with(token: Option<&str>, change: impl FnOnce(&mut View)) -> Self {
        let mut surface = papers_surface();
        surface.emission.band[1] = 700.0;
        let mut view = View {
            surface,
            stored: None,
            without_scale: None,
            respond: None,
            source: "small".into(),
            method: Method::TimeReversal,
            device: None,
            follow: None,
            device_name: "virtual".into(),
            address: ([127, 0, 0, 1], 0).into(),
            token: token.map(str::to_owned),
            framed_by: Vec::new(),
            folder: std::env::temp_dir(),
            quiet: true,
        };
        change(&mut view);
        let (told, url) = channel();
        let (done, over) = channel();
        let thread = std::thread::spawn(move || {
            let viewer = view.open()?;
            told.send(viewer.url()).unwrap();
            viewer.serve(async move {
                while over.try_recv() == Err(std::sync::mpsc::TryRecvError::Empty) {
                    pause(Duration::from_millis(20)).await;
                }
            })
        });
        let url: String = url.recv().unwrap();
        let address = url.trim_start_matches("http://").split('/').next().unwrap().parse().unwrap();
        Self { address, done, thread: Some(thread) }
    }

    /// What is answered to a request, word for word.
    pub fn ask(&self, request: &str) -> String {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// What is answered when something is fetched.
    pub fn get(&self, path: &str, more: &str) -> String {
        self.ask(&format!("GET {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n{more}\r\n", self.address))
    }

    /// What is answered to a surface that is sent.
    pub fn post(&self, body: &str) -> String {
        let head = format!("POST /surface HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n", self.address);
        self.ask(&format!("{head}Content-Length: {}\r\n\r\n{body}", body.len()))
    }

    /// A link for a page from somewhere, or the code of the answer that refuses it.
    pub fn join(&self, origin: &str) -> Result<WebSocket<TcpStream>, u16> {
        let mut request = format!("ws://{}/link", self.address).into_client_request().unwrap();
        request.headers_mut().insert("Origin", origin.parse().unwrap());
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
        match tungstenite::client(request, stream) {
            Ok((socket, _)) => Ok(socket),
            Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(answer))) => {
                Err(answer.status().as_u16())
            }
            Err(error) => panic!("{error}"),
        }
    }

    /// A link for a page of the viewer.
    pub fn page(&self) -> WebSocket<TcpStream> {
        self.join(&format!("http://{}", self.address)).unwrap()
    }
}

impl Served {
    /// Stops it, and waits until it has.
    pub fn stop(&mut self) {
        // It may have ended already.
        let _ = self.done.send(());
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap().unwrap();
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.stop();
    }
}

/// The code of an answer.
pub fn status(answer: &str) -> u16 {
    answer.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or(0)
}

/// Reads until a JSON message of a kind comes; what it says.
pub fn until(socket: &mut WebSocket<TcpStream>, kind: &str) -> serde_json::Value {
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(60) {
        if let Message::Text(text) = socket.read().unwrap() {
            let value: serde_json::Value = serde_json::from_str(&text).unwrap();
            if value["is"] == kind {
                return value;
            }
        }
    }
    panic!("no {kind} came");
}
