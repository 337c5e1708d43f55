//! A JACK server for this example, the program that plays through it, and the processor time of both.

use serde_json::Value;
use std::error::Error;
use std::io::Read;
use std::net::UdpSocket;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How long to wait for anything.
const PATIENCE: Duration = Duration::from_secs(20);

/// A process that is asked to end when this is dropped.
pub struct Process(pub Child);

impl Process {
    /// Sends a signal by its name.
    pub fn signal(&self, name: &str) {
        let _ = Command::new("kill").args([name, &self.0.id().to_string()]).status();
    }

    /// Ends the program as a user would, and reads its summary.
    pub fn finish(&mut self) -> Result<Value, Box<dyn Error>> {
        self.signal("-INT");
        let mut text = String::new();
        if let Some(mut out) = self.0.stdout.take() {
            out.read_to_string(&mut text)?;
        }
        Ok(serde_json::from_str(&text)?)
    }
}

/// Tries until there is a result, 20 s at most.
pub fn patiently<T>(mut try_it: impl FnMut() -> Option<T>) -> Result<T, Box<dyn Error>> {
    let start = Instant::now();
    loop {
        match try_it() {
            Some(found) => return Ok(found),
            None if start.elapsed() > PATIENCE => return Err("it does not come".into()),
            None => std::thread::sleep(Duration::from_millis(20)),
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        if let Ok(None) = self.0.try_wait() {
            self.signal("-TERM");
            let _ = self.0.wait();
        }
    }
}

/// A server with its dummy driver.
pub fn server(name: &str, period: usize, real_time: bool) -> Option<Process> {
    let scheduling = if real_time { "--realtime" } else { "--no-realtime" };
    let child = Command::new("jackd")
        .args([scheduling, "--no-mlock", "--name", name, "-d", "dummy", "-r", "48000"])
        .args(["-p", &period.to_string(), "-C", "2", "-P", "8"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    Some(Process(child))
}

/// Starts the program, which plays through a server and receives touches at a port.
pub fn program(path: &str, server: &str, port: u16, more: &[&str]) -> std::io::Result<Process> {
    let child = Command::new(path)
        .args(["play", "hudin-2012", "--json", "--device", "jack", "--jack-server", server])
        .args(["--tuio", &port.to_string()])
        .args(more)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    Ok(Process(child))
}

/// A network port that is free.
pub fn free_port() -> std::io::Result<u16> {
    Ok(UdpSocket::bind("127.0.0.1:0")?.local_addr()?.port())
}

/// Processor time of all threads of a process so far, or of one of them, in s.
pub fn processor(pid: u32, thread: Option<u64>) -> f64 {
    let tasks = std::fs::read_dir(format!("/proc/{pid}/task")).into_iter().flatten().flatten();
    let wanted = tasks.filter(|task| thread.is_none_or(|id| task.file_name() == *id.to_string()));
    let spent = wanted.filter_map(|task| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    });
    1e-9 * spent.sum::<f64>()
}

/// A source of touches: packets to a port of this machine.
pub struct Finger {
    socket: UdpSocket,
    random: u64,
}

impl Finger {
    pub fn new(port: u16) -> std::io::Result<Self> {
        let socket = UdpSocket::bind("127.0.0.1:0")?;
        socket.connect(("127.0.0.1", port))?;
        Ok(Self { socket, random: 0x9e37_79b9_7f4a_7c15 })
    }

    /// A pseudorandom number from 0 to 1.
    pub fn chance(&mut self) -> f64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn touch(&self, finger: i32, (x, y): (f32, f32)) {
        let parts: [&[u8]; 4] =
            [b"/unripple/touch\0,iff\0\0\0\0", &finger.to_be_bytes(), &x.to_be_bytes(), &y.to_be_bytes()];
        let _ = self.socket.send(&parts.concat());
    }

    pub fn lift(&self, finger: i32) {
        let parts: [&[u8]; 2] = [b"/unripple/lift\0\0,i\0\0", &finger.to_be_bytes()];
        let _ = self.socket.send(&parts.concat());
    }

    /// Sends ten fingers that circle, a hundred times a second, for some seconds.
    pub fn ten(&self, seconds: f64) {
        for step in 0..(100.0 * seconds) as usize {
            for finger in 0..10i32 {
                let angle = 0.06 * step as f32 + 0.6 * finger as f32;
                let place = (75.0 + 50.0 * angle.sin(), 25.0 + 11.0 * finger as f32);
                self.touch(finger, place);
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        (0..10).for_each(|finger| self.lift(finger));
    }
}
