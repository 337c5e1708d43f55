//! The program, started as people start it, reached as others reach it, and looked at from outside.

use crate::common::{self, SMALL_FILM, Scratch};
use crate::link::{ANSWER, Link};
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use unripple_store::read_wav;

/// Pulses while a finger rests, as the viewer plays them by itself, but at shorter intervals.
const EFFECT: &str = "format = 1\n[[effect]]\nkind = \"pulse-train\"\nrate_hz = 20\n";

/// Files with what the program prints, and with the touches that it records.
const PRINTED: &str = "printed.txt";
const ERRORS: &str = "errors.txt";
const TAPS: &str = "taps.jsonl";

/// Lines of what it said last that tell what went wrong: more are hardly read.
const LAST: usize = 20;

/// How long it may take to start: it computes modes, and others may be at work.
const STARTS: Duration = Duration::from_secs(60);

/// How long it may take to end once it is told to. It takes a tenth of a second or two; others may be at work.
const ENDS: Duration = Duration::from_secs(10);

/// How often it is looked whether something has happened.
pub const LOOK: Duration = Duration::from_millis(10);

/// The command that is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    Play,
    View,
}

impl Task {
    /// Path at which links are opened.
    pub fn path(self) -> &'static str {
        match self {
            Self::Play => "/",
            Self::View => "/link",
        }
    }

    /// The message that says what a finger does.
    pub fn touch(self, finger: u32, phase: &str, at_mm: [f64; 2]) -> Value {
        match self {
            Self::Play => {
                json!({ "v": 1, "type": "touch", "finger": finger, "phase": phase, "at_mm": at_mm })
            }
            Self::View => json!({ "do": "touch", "finger": finger, "phase": phase, "at_mm": at_mm }),
        }
    }
}

/// What the program holds: resident memory, open files, threads.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    pub memory_kb: u64,
    pub files: usize,
    pub threads: usize,
}

/// The program, which is ended with this.
pub struct Program {
    pub task: Task,
    /// Where links are opened.
    pub links: SocketAddr,
    /// Where datagrams are received, by `play` alone.
    pub datagrams: Option<SocketAddr>,
    child: Child,
    scratch: Scratch,
    /// Measurements asked for so far.
    asked: u64,
}

impl Program {
    /// Starts the program on a server, and waits until it plays.
    pub fn start(task: Task, server: &str) -> Self {
        let scratch = Scratch::new("sitting");
        let (film, effect) = (scratch.file("film.toml", SMALL_FILM), scratch.file("pulses.toml", EFFECT));
        let (taps, folder) = (scratch.join(TAPS), scratch.path().display().to_string());
        let own = match task {
            Task::Play => vec!["play", &film, "--effect", &effect, "--record", &taps, "--json"],
            Task::View => vec!["view", &film, "--port", "0", "--no-browser", "--folder", &folder],
        };
        let ports: &[&str] = if task == Task::Play { &["--tuio", "0", "--websocket", "0"] } else { &[] };
        let to = |name: &str| File::create(scratch.join(name)).unwrap();
        let child = common::program()
            .args(own)
            .args(ports)
            .args(["--device", "jack", "--jack-server", server])
            // As many threads on every machine, so that their number tells of leaks alone.
            .env("RAYON_NUM_THREADS", "2")
            .stdin(Stdio::null())
            .stdout(to(PRINTED))
            .stderr(to(ERRORS))
            .spawn()
            .unwrap();
        let unknown = SocketAddr::from(([127, 0, 0, 1], 0));
        let mut program = Self { task, links: unknown, datagrams: None, child, scratch, asked: 0 };
        match task {
            Task::Play => {
                program.datagrams = Some(program.told(ERRORS, "touches from UDP "));
                program.links = program.told(ERRORS, "touches from WebSocket ");
            }
            Task::View => program.links = program.told(PRINTED, "http://"),
        }
        program
    }

    /// The address that it tells after some words, as soon as it does.
    fn told(&mut self, file: &str, before: &str) -> SocketAddr {
        let began = Instant::now();
        loop {
            let text = self.read(file);
            let whole = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
            if let Some((_, address)) = whole.lines().find_map(|line| line.split_once(before)) {
                return address.trim_end_matches('/').parse().unwrap();
            }
            self.goes_on();
            assert!(began.elapsed() < STARTS, "it does not start: {}", self.last_words());
            std::thread::sleep(LOOK);
        }
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.scratch.join(file)).unwrap_or_default()
    }

    /// What it said last.
    pub fn last_words(&self) -> String {
        let text = self.read(ERRORS);
        let lines: Vec<&str> = text.lines().collect();
        lines[lines.len().saturating_sub(LAST)..].join("\n")
    }

    /// Fails if it has ended.
    pub fn goes_on(&mut self) {
        let ended = self.child.try_wait().unwrap();
        assert!(ended.is_none(), "it has ended: {ended:?}; it said:\n{}", self.last_words());
    }

    /// A link that was told of the surface, of somebody who came just now; of a page also what it measured.
    pub fn served(&mut self, deadline: Instant) -> Result<Link, String> {
        loop {
            match self.welcome(deadline) {
                Err(why) if Instant::now() >= deadline => return Err(format!("nobody is served: {why}")),
                Err(_) => std::thread::sleep(LOOK),
                link => return link,
            }
        }
    }

    fn welcome(&mut self, deadline: Instant) -> Result<Link, String> {
        let soon = Instant::now() + ANSWER;
        let mut link = Link::open(self.task, self.links)?;
        match self.task {
            Task::Play => {
                link.say(&json!({ "v": 1, "type": "hello" }));
                let greeted = |told: &Value| told["type"] == "hello" && told["size_mm"].is_array();
                link.until("the surface", soon, greeted)?;
            }
            Task::View => {
                self.fetch()?;
                link.until("the surface", soon, |told| told["is"] == "surface")?;
                // Each measurement has a number of its own, whoever asks for it.
                self.asked += 1;
                let id = self.asked;
                link.say(&json!({ "do": "measure", "id": id, "at": [[62, 90]] }));
                let measured = |told: &Value| told["is"] == "measured" && told["id"] == id;
                link.until("the measurement", deadline, measured)?;
            }
        }
        Ok(link)
    }

    /// Fetches the page.
    fn fetch(&self) -> Result<(), String> {
        let said = |error: std::io::Error| error.to_string();
        let mut stream = TcpStream::connect_timeout(&self.links, ANSWER).map_err(said)?;
        stream.set_read_timeout(Some(ANSWER)).map_err(said)?;
        let request = format!("GET / HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", self.links);
        stream.write_all(request.as_bytes()).map_err(said)?;
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).map_err(said)?;
        let begins = String::from_utf8_lossy(&answer).lines().next().unwrap_or_default().to_owned();
        if begins.starts_with("HTTP/1.1 200 ") { Ok(()) } else { Err(format!("the page: {begins}")) }
    }

    /// What it holds now.
    pub fn held(&self) -> Held {
        let folder = Path::new("/proc").join(self.child.id().to_string());
        let status = fs::read_to_string(folder.join("status")).unwrap();
        let resident = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let memory_kb = resident.and_then(|kb| kb.split_whitespace().next()?.parse().ok()).unwrap();
        let count = |of: &str| fs::read_dir(folder.join(of)).unwrap().count();
        Held { memory_kb, files: count("fd"), threads: count("task") }
    }

    /// Ends it as Ctrl+C does; how long it took, and what it counted in all.
    pub fn end(&mut self) -> (Duration, Value) {
        let last = match self.task {
            Task::Play => None,
            Task::View => {
                let mut page = Link::open(self.task, self.links).unwrap();
                let soon = Instant::now() + ANSWER;
                Some(page.until("its state", soon, |told| told["is"] == "status").unwrap())
            }
        };
        let began = Instant::now();
        let sent = Command::new("kill").args(["-INT", &self.child.id().to_string()]).status();
        assert!(sent.is_ok_and(|status| status.success()), "it cannot be told to end");
        let status = loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                break status;
            }
            assert!(began.elapsed() < ENDS, "it does not end: {}", self.last_words());
            std::thread::sleep(LOOK);
        };
        let took = began.elapsed();
        assert!(status.success(), "{status}: {}", self.last_words());
        (took, last.unwrap_or_else(|| serde_json::from_str(&self.read(PRINTED)).unwrap()))
    }

    /// Plays once more what was recorded, and reads the drive that is kept of that: a run by a device's clock keeps none.
    pub fn replay(&self) {
        let fingers = self.read(TAPS).lines().filter(|line| line.contains("\"down\"")).count();
        assert!(fingers > 0, "no finger was recorded");
        let [film, effect, taps, kept] =
            ["film.toml", "pulses.toml", TAPS, "kept.wav"].map(|name| self.scratch.join(name));
        let play = ["play", &film, "--effect", &effect, "--session", &taps];
        common::json(&[&play[..], &["--seconds", "1", "--keep-drive", &kept]].concat());
        let kept = read_wav(&kept).unwrap();
        assert!(kept.channels.len() == 2 && kept.channels.iter().all(|channel| !channel.is_empty()));
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // One that has ended cannot be ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
