//! Opens a surface with its device, and shows it until the task is cancelled.

use super::{Ask, Report};
use crate::{Origin, View, ViewError, Viewer, pause};
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};
use unripple_calibrate::Interpolation;
use unripple_session::{Follow, Responder};
use unripple_tasks::play::{Opener, follower, latency, opener};
use unripple_tasks::{Progress, Source, SurfaceAsk, TaskError, apart, go_on, judge, source};

/// Bytes of a token that is made here, before they are letters. 128 bits cannot be guessed.
const TOKEN: usize = 16;

/// Lengths of a token that is given: not guessed in a lifetime, and still typed on a phone.
const LENGTHS: std::ops::RangeInclusive<usize> = 8..=64;

/// Interval at which it is checked whether the task has been cancelled: too short to be noticed.
const LOOKED: Duration = Duration::from_millis(100);

/// Shows a surface until the task is cancelled or the requested time is over. `opened` is called with the
/// page's addresses as soon as a page can be opened. A task that is cancelled before that returns within 0.2
/// s.
///
/// ```
/// use unripple_tasks::Silent;
/// use unripple_viewer::task::{Ask, run};
///
/// let ask = Ask { port: 0, seconds: Some(0.1), ..Ask::default() };
/// let mut heard = String::new();
/// let report = run(&ask, &mut Silent, &mut |report| {
///     heard.clone_from(&report.url);
///     Ok(())
/// })?;
/// assert!(heard.starts_with("http://127.0.0.1:"));
/// assert_eq!(report.elsewhere, None);
///
/// // Who may frame the page is an origin, and nothing more.
/// let ask = Ask { framed_by: vec!["http://localhost:8888/lab".into()], ..ask };
/// let refused = run(&ask, &mut Silent, &mut |_| Ok(())).unwrap_err().to_string();
/// assert!(refused.contains("framed_by") && refused.contains("expected scheme://host[:port]"), "{refused}");
/// # Ok::<(), unripple_tasks::TaskError>(())
/// ```
///
/// # Errors
/// Those of [`View::open`], [`Viewer::serve`] and `opened`; [`TaskError::Ask`] that names the field; [`TaskError::Cancelled`] before the
/// first page can be opened.
pub fn run(
    ask: &Ask,
    progress: &mut dyn Progress,
    opened: &mut dyn FnMut(&Report) -> Result<(), TaskError>,
) -> Result<Report, TaskError> {
    if let Some(seconds) = ask.seconds.filter(|s| !s.is_finite() || *s <= 0.0) {
        return Err(TaskError::ask("seconds", "a number above 0 s", seconds));
    }
    // The modes of a surface that needs a mesh take seconds, in which nothing asks whether to go on.
    let viewer = apart(ask.clone(), open, progress)?;
    go_on(progress)?;
    progress.over();
    let (url, elsewhere) = (viewer.url(), viewer.elsewhere());
    let report = Report { url, elsewhere, framed_by: ask.framed_by.clone() };
    opened(&report)?;
    viewer.serve(until(progress, ask.seconds))?;
    Ok(report)
}

/// Makes the surface ready, and listens.
fn open(ask: &Ask, progress: &mut dyn Progress) -> Result<Viewer, TaskError> {
    let (token, framed_by) = (token(ask)?, origins(ask)?);
    let follow = follow(ask)?;
    let source = source::open(&ask.surface, progress)?;
    let view = View {
        without_scale: source.without_scale(),
        respond: respond(&ask.surface, &source),
        surface: source.surface,
        stored: source.stored.map(|stored| Arc::new(stored.responses)),
        source: ask.surface.to_string(),
        method: ask.method,
        device: device(ask),
        follow,
        device_name: ask.device.device.name().into(),
        address: SocketAddr::new(ask.listen, ask.port),
        token,
        framed_by,
        folder: ask.folder.clone(),
        quiet: false,
    };
    progress.stage("modes");
    Ok(view.open()?)
}

/// Function that gives a library's responses at places that pages ask for, as `focus` computes them.
fn respond(ask: &SurfaceAsk, source: &Source) -> Option<Responder> {
    source.stored.as_ref()?;
    let ask = ask.clone();
    Some(Arc::new(move |places| {
        let answered =
            source::open_again(&ask).and_then(|source| source.respond(places, Interpolation::default()));
        answered.map(|(_, responses, _)| responses).map_err(|error| error.to_string())
    }))
}

/// The device that was asked for, where the surface is not merely simulated.
fn device(ask: &Ask) -> Option<Opener> {
    (!ask.simulated()).then(|| opener(&ask.device, ask.follow_tension))
}

/// Function that makes the follower of the real surface's tension, if it is to be followed.
fn follow(ask: &Ask) -> Result<Option<Follow>, TaskError> {
    if !ask.follow_tension {
        return Ok(None);
    }
    if ask.simulated() {
        let expected = "a real device, or `unknowns`";
        let found = "a surface that is known and never drifts";
        return Err(TaskError::ask("follow_tension", expected, found));
    }
    let device = ask.device.clone();
    Ok(Some(Arc::new(move |surface, settings, block| {
        let followed = judge::model(surface, None, &[])
            .and_then(|model| follower(surface, &model, settings, latency(&device, block)));
        followed.map_err(|error| error.to_string())
    })))
}

/// The token that pages need where other machines can connect: the given one, or a random one.
fn token(ask: &Ask) -> Result<Option<String>, TaskError> {
    if let Some(token) = &ask.token {
        let legal = LENGTHS.contains(&token.len()) && token.chars().all(|c| c.is_ascii_alphanumeric());
        let expected = format!("{} to {} letters and digits", LENGTHS.start(), LENGTHS.end());
        return if legal {
            Ok(Some(token.clone()))
        } else {
            Err(TaskError::ask("token", expected, "others"))
        };
    }
    if ask.listen.is_loopback() {
        return Ok(None);
    }
    let mut bytes = [0; TOKEN];
    getrandom::fill(&mut bytes).map_err(TaskError::work)?;
    Ok(Some(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
}

/// The origins that may frame the page.
fn origins(ask: &Ask) -> Result<Vec<Origin>, TaskError> {
    let read = |text: &String| {
        text.parse().map_err(|error| match error {
            ViewError::Range { what, expected, found } => TaskError::ask(what, expected, found),
            error => error.into(),
        })
    };
    ask.framed_by.iter().map(read).collect()
}

/// Ends when the task is cancelled, or after `seconds` seconds if they are given.
async fn until(progress: &dyn Progress, seconds: Option<f64>) {
    let began = Instant::now();
    while !progress.cancelled() && seconds.is_none_or(|s| began.elapsed().as_secs_f64() < s) {
        pause(LOOKED).await;
    }
}
