//! `unripple view`: a surface in the browser.

use crate::args::{DeviceName, ViewOptions};
use crate::error::CliError;
use crate::progress::Terminal;
use crate::targets::positive;
use crate::{interrupt, output};
use serde_json::json;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use unripple_calibrate::Interpolation;
use unripple_tasks::play::{follower, late, opener};
use unripple_tasks::{SurfaceAsk, TaskError, judge, source};
use unripple_viewer::{Follow, Opener, Responder, View, ViewError};

/// Bytes of a token that is made here, before they are letters.
const TOKEN: usize = 16;

/// Lengths of a token that is given.
const LENGTHS: std::ops::RangeInclusive<usize> = 8..=64;

impl From<ViewError> for CliError {
    fn from(error: ViewError) -> Self {
        match error {
            ViewError::Store(error) => TaskError::from(error).into(),
            ViewError::Live(error) => TaskError::from(error).into(),
            error @ (ViewError::Address { .. } | ViewError::Gone { .. } | ViewError::Device { .. }) => {
                Self::work(error)
            }
            error => Self::input(error),
        }
    }
}

pub fn run(options: &ViewOptions, as_json: bool) -> Result<(), CliError> {
    let seconds = options.seconds.map(|s| positive(s, "--seconds", "s")).transpose()?;
    let source = source::open(&(&options.surface).into(), &mut Terminal::default())?;
    let respond = respond(&options.surface, &source);
    let ip = options.listen.unwrap_or(IpAddr::V4(Ipv4Addr::LOCALHOST));
    let without_scale = source.without_scale();
    let view = View {
        surface: source.surface,
        without_scale,
        stored: source.stored.map(|stored| Arc::new(stored.responses)),
        respond,
        source: options.surface.clone(),
        method: options.method.method(),
        device: device(options),
        follow: follow(options)?,
        device_name: options.device.device.name().into(),
        address: SocketAddr::new(ip, options.port),
        token: token(options, ip)?,
        folder: options.folder.clone(),
        quiet: false,
    };
    let viewer = view.open()?;
    let url = viewer.url();
    let elsewhere = viewer.elsewhere();
    let text = elsewhere
        .as_ref()
        .map_or(String::new(), |there| format!("{there}  from elsewhere on this network\n"));
    output::answer(as_json, &json!({ "url": url, "elsewhere": elsewhere }), &format!("{url}\n{text}"))?;
    eprintln!("open the address in a browser; Ctrl+C ends");
    if !options.no_browser {
        browse(&url);
    }
    let stop = interrupt::wished();
    Ok(viewer.serve(until(stop, seconds))?)
}

/// Responses of a library at places that pages ask for, as `focus` has them.
fn respond(name: &str, source: &unripple_tasks::Source) -> Option<Responder> {
    source.stored.as_ref()?;
    let name = SurfaceAsk::from(name);
    Some(Arc::new(move |places| {
        let answered =
            source::open_again(&name).and_then(|source| source.respond(places, Interpolation::default()));
        answered.map(|(_, responses, _)| responses).map_err(|error| error.to_string())
    }))
}

/// The device that was asked for, where the surface is not merely simulated.
fn device(options: &ViewOptions) -> Option<Opener> {
    let device = &options.device;
    let simulated = device.device == DeviceName::Virtual && device.unknowns.is_none();
    (!simulated).then(|| opener(&device.ask(), options.follow_tension))
}

/// What follows the tension of the surface out there, if it is to be followed.
fn follow(options: &ViewOptions) -> Result<Option<Follow>, CliError> {
    if !options.follow_tension {
        return Ok(None);
    }
    if device(options).is_none() {
        let text = "--follow-tension: expected a real device, or --unknowns, found a surface that is known and never drifts";
        return Err(CliError::Input(text.into()));
    }
    let device = options.device.ask();
    Ok(Some(Arc::new(move |surface, settings, block| {
        let followed = judge::model(surface, None, &[])
            .and_then(|model| follower(surface, &model, settings, late(&device, block)));
        followed.map_err(|error| error.to_string())
    })))
}

/// Who does not know it is not let in, where others than this machine can come.
fn token(options: &ViewOptions, ip: IpAddr) -> Result<Option<String>, CliError> {
    if let Some(token) = &options.token {
        let legal = LENGTHS.contains(&token.len()) && token.chars().all(|c| c.is_ascii_alphanumeric());
        let text = format!(
            "--token: expected {} to {} letters and digits, found others",
            LENGTHS.start(),
            LENGTHS.end()
        );
        return if legal { Ok(Some(token.clone())) } else { Err(CliError::Input(text)) };
    }
    if ip.is_loopback() {
        return Ok(None);
    }
    let mut bytes = [0; TOKEN];
    getrandom::fill(&mut bytes).map_err(CliError::work)?;
    Ok(Some(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
}

/// Opens an address in the browser of whoever sits here; that there is none is no fault.
fn browse(url: &str) {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let _ = Command::new(opener).arg(url).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
}

/// Is over when somebody wants to stop, or after so many seconds.
async fn until(stop: Arc<AtomicBool>, seconds: Option<f64>) {
    let began = Instant::now();
    while !stop.load(Ordering::Relaxed) && seconds.is_none_or(|s| began.elapsed().as_secs_f64() < s) {
        unripple_viewer::pause(Duration::from_millis(100)).await;
    }
}
