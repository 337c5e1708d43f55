//! What pages cost the server: the paper's surface in real time under five fingers, a picture of 128 x 128 cells, one page, ten pages, and
//! ten of which one takes nothing.
//!
//! `cargo run --release -p unripple-viewer --example thirty_frames [-- SECONDS]`
//!
//! Pages are processes of their own that read what is sent and say that they have drawn it; so the processor time told is the server's
//! alone: the surface, the player, the pictures and the sending. The limit is one core.

use std::error::Error;
use std::io::Read;
use std::net::{SocketAddr, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};
use unripple::focus::Method;
use unripple::physics::design::papers_surface;
use unripple_viewer::{View, pause};

type Fault = Box<dyn Error + Send + Sync>;

/// How long each is measured unless told otherwise, in s.
const SECONDS: f64 = 10.0;

/// Time that a page takes to come and to go, in s.
const SETTLING: f64 = 2.0;

fn main() -> Result<(), Fault> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [word, address, seconds] = &arguments[..] {
        return match word.as_str() {
            "page" => page(address.parse()?, seconds.parse()?),
            "mute" => mute(address.parse()?, seconds.parse()?),
            _ => Err("expected page or mute".into()),
        };
    }
    let seconds = arguments.first().map_or(Ok(SECONDS), |text| text.parse())?;
    let (told, address) = channel();
    let (done, over) = channel::<()>();
    let server = std::thread::spawn(move || -> Result<(), Fault> {
        let viewer = view().open()?;
        told.send(viewer.url())?;
        let waits = async move {
            while over.try_recv() == Err(std::sync::mpsc::TryRecvError::Empty) {
                pause(Duration::from_millis(50)).await;
            }
        };
        Ok(viewer.serve(waits)?)
    });
    let url = address.recv()?;
    let address: SocketAddr = url.trim_start_matches("http://").trim_end_matches('/').parse()?;
    let [least, median, bytes, core, pace] =
        ["frames/s least", "frames/s median", "kB/s for a page", "of one core", "of real time"];
    println!("{:<34}{least:>14}{median:>16}{bytes:>16}{core:>14}{pace:>14}", "");
    for (name, pages, mutes) in
        [("one page", 1, 0), ("ten pages", 10, 0), ("nine pages and one that is mute", 9, 1)]
    {
        let fingers = press(address)?;
        measure(name, address, seconds, [pages, mutes])?;
        drop(fingers);
    }
    done.send(())?;
    server.join().map_err(|_| "the server panicked")?
}

fn view() -> View {
    View {
        surface: papers_surface(),
        stored: None,
        without_scale: None,
        respond: None,
        source: "hudin-2012".into(),
        method: Method::TimeReversal,
        device: None,
        follow: None,
        device_name: "virtual".into(),
        address: ([127, 0, 0, 1], 0).into(),
        token: None,
        framed_by: Vec::new(),
        folder: ".".into(),
        quiet: false,
    }
}

/// Presses five places, for as long as a page is thought to be there that says nothing more.
fn press(address: SocketAddr) -> Result<WebSocket<TcpStream>, Fault> {
    let mut page = join(address)?;
    page.send(Message::text(r#"{"do":"transport","speed":1}"#))?;
    for i in 0..5 {
        let place = [30.0 + 20.0 * f64::from(i), 40.0 + 13.0 * f64::from(i)];
        let text =
            format!(r#"{{"do":"touch","finger":{i},"phase":"down","at_mm":[{},{}]}}"#, place[0], place[1]);
        page.send(Message::text(text))?;
    }
    Ok(page)
}

/// Runs so many pages, and prints what they got and what that cost.
fn measure(name: &str, address: SocketAddr, seconds: f64, [pages, mutes]: [usize; 2]) -> Result<(), Fault> {
    let start = |word: &str| -> Result<Child, Fault> {
        let mut command = Command::new(std::env::current_exe()?);
        command.args([word, &address.to_string(), &seconds.to_string()]).stdout(Stdio::piped());
        Ok(command.spawn()?)
    };
    let mutes: Vec<Child> = (0..mutes).map(|_| start("mute")).collect::<Result<_, _>>()?;
    let pages: Vec<Child> = (0..pages).map(|_| start("page")).collect::<Result<_, _>>()?;
    std::thread::sleep(Duration::from_secs_f64(SETTLING));
    let (began, before) = (Instant::now(), processor_time());
    std::thread::sleep(Duration::from_secs_f64((seconds - SETTLING).max(1.0)));
    let share = (processor_time() - before) / began.elapsed().as_secs_f64();
    let mut got = Vec::new();
    for mut page in pages {
        let mut text = String::new();
        page.stdout.take().ok_or("no output")?.read_to_string(&mut text)?;
        page.wait()?;
        let mut numbers = text.split_whitespace().map(str::parse::<f64>);
        let mut next = || -> Result<f64, Fault> { Ok(numbers.next().ok_or("a page said too little")??) };
        got.push((next()?, next()?, next()?));
    }
    for mut mute in mutes {
        mute.wait()?;
    }
    got.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (least, median) = (got[0].0, got[got.len() / 2].0);
    let most = got.iter().map(|(_, bytes, _)| *bytes).fold(0.0, f64::max) / 1e3;
    let pace = got[0].2;
    println!("{name:<34}{least:>14.1}{median:>16.1}{most:>16.0}{share:>14.2}{pace:>14.2}");
    Ok(())
}

/// A page that draws at once: prints frames and bytes a second, and how fast the surface runs.
fn page(address: SocketAddr, seconds: f64) -> Result<(), Fault> {
    let mut socket = join(address)?;
    let (mut frames, mut bytes, mut began, mut pace) = (0u32, 0usize, None, 0.0);
    let start = Instant::now();
    while start.elapsed().as_secs_f64() < SETTLING / 2.0 + seconds {
        let message = socket.read()?;
        // What a page gets when it opens is not what it gets from then on.
        if start.elapsed().as_secs_f64() < SETTLING / 2.0 {
            began = Some(Instant::now());
            (frames, bytes) = (0, 0);
        }
        bytes += message.len();
        match message {
            Message::Binary(frame) => {
                frames += 1;
                let number = number(&frame)?;
                socket.send(Message::text(format!(r#"{{"do":"seen","frame":{number}}}"#)))?;
            }
            Message::Text(text) => {
                let told: serde_json::Value = serde_json::from_str(&text)?;
                pace = told["speed_real"].as_f64().unwrap_or(pace);
            }
            _ => {}
        }
    }
    let seconds = began.ok_or("nothing was sent")?.elapsed().as_secs_f64();
    println!("{} {} {pace}", f64::from(frames) / seconds, bytes as f64 / seconds);
    Ok(())
}

/// The number of a frame, from its head.
fn number(frame: &[u8]) -> Result<u64, Fault> {
    let length = frame.first_chunk::<4>().map_or(0, |length| u32::from_le_bytes(*length)) as usize;
    let head: serde_json::Value = serde_json::from_slice(frame.get(4..4 + length).ok_or("no head")?)?;
    head["frame"].as_u64().ok_or_else(|| "no number".into())
}

/// A page that opens and then takes nothing.
fn mute(address: SocketAddr, seconds: f64) -> Result<(), Fault> {
    let socket = join(address)?;
    std::thread::sleep(Duration::from_secs_f64(seconds + SETTLING));
    drop(socket);
    Ok(())
}

fn join(address: SocketAddr) -> Result<WebSocket<TcpStream>, Fault> {
    let mut request = format!("ws://{address}/link").into_client_request()?;
    request.headers_mut().insert("Origin", format!("http://{address}").parse()?);
    let (socket, _) =
        tungstenite::client(request, TcpStream::connect(address)?).map_err(|error| error.to_string())?;
    Ok(socket)
}

/// Processor time of this process, in s.
fn processor_time() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
