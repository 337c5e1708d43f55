//! Answers to HTTP requests.

use crate::assets;
use crate::guard::{Credentials, Guard, Refusal};
use crate::host::SessionHost;
use crate::link;
use crate::lobby::Seat;
use axum::Router;
use axum::body::Bytes;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{DefaultBodyLimit, Extension, FromRequest, Path, Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use std::sync::Arc;
use std::time::Duration;
use tokio::time::timeout;

/// Bytes of the largest surface file that is taken. A surface file has a few kilobytes.
const LARGEST: usize = 256 << 10;

/// How long an upload may take: as long as a poor network takes for the largest file.
const SENT: Duration = Duration::from_secs(20);

/// Largest number of open pages, a classroom's and more; one too many is refused with the reason.
const MOST_PAGES: usize = 64;

/// State that the handlers of all requests share.
#[derive(Clone)]
pub struct Desk {
    /// The session that all pages share.
    pub host: Arc<SessionHost>,
    /// The rules of access.
    pub guard: Guard,
    /// The header that says what a page may load, and who may show it in a frame.
    pub policy: HeaderValue,
}

/// Router of all requests, behind the checks of access.
pub fn router(desk: Desk) -> Router {
    Router::new()
        .route("/", get(|headers: HeaderMap| async move { file("index.html", &headers) }))
        .route(
            "/assets/{name}",
            get(|Path(name): Path<String>, headers: HeaderMap| async move { file(&name, &headers) }),
        )
        .route("/link", get(open))
        .route("/surface.toml", get(surface))
        .route("/surface", axum::routing::post(load))
        .route("/{name}", get(measured))
        .layer(DefaultBodyLimit::max(LARGEST))
        .layer(from_fn_with_state(desk.clone(), guard))
        .with_state(desk)
}

/// Refuses requests that are not allowed, and adds security headers to answers.
async fn guard(State(desk): State<Desk>, request: Request, next: Next) -> Response {
    let path = request.uri().path();
    // The page's own files are no secret, and its modules cannot name a token to one another.
    let needs = if path.starts_with("/assets/") {
        Credentials::Nothing
    } else if path == "/link" {
        Credentials::Origin
    } else {
        Credentials::Token
    };
    if let Err(refusal) = desk.guard.check(request.uri(), request.headers(), needs) {
        desk.host.log(&format!(
            "refused: {} {}: {refusal:?}",
            request.method(),
            request.uri().path().escape_debug()
        ));
        return (StatusCode::FORBIDDEN, why(refusal)).into_response();
    }
    if let Some(seat) = request.extensions().get::<Arc<Seat>>().filter(|_| needs != Credentials::Nothing) {
        seat.admit();
    }
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_SECURITY_POLICY, desk.policy);
    for (name, value) in [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-cache"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

fn why(refusal: Refusal) -> &'static str {
    match refusal {
        Refusal::Host => "this name is not the viewer's: open the address that it printed\n",
        Refusal::Origin => "a page from elsewhere may not use the viewer\n",
        Refusal::Token => {
            "the address lacks the viewer's token, or it has another by now: open the address that it printed\n"
        }
    }
}

fn file(name: &str, headers: &HeaderMap) -> Response {
    let Some((bytes, kind, print)) = assets::file(name) else {
        return (StatusCode::NOT_FOUND, "no such file\n").into_response();
    };
    if headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == print.as_bytes()) {
        return StatusCode::NOT_MODIFIED.into_response();
    }
    ([(header::CONTENT_TYPE, kind.to_owned()), (header::ETAG, print)], bytes).into_response()
}

async fn open(
    State(desk): State<Desk>,
    seat: Option<Extension<Arc<Seat>>>,
    upgrade: WebSocketUpgrade,
) -> Response {
    // Taken before the answer, so that no two pages take the last place.
    let Some(viewing) = desk.host.notices.enter(MOST_PAGES) else {
        return (StatusCode::SERVICE_UNAVAILABLE, "too many pages are open\n").into_response();
    };
    let upgrade = upgrade.max_message_size(link::TAKEN).max_frame_size(link::TAKEN);
    upgrade.on_upgrade(async move |socket| {
        if let Some(Extension(seat)) = &seat {
            seat.settle();
        }
        link::serve(socket, desk.host).await;
        drop((viewing, seat));
    })
}

async fn surface(State(desk): State<Desk>) -> Response {
    download(desk.host.toml().into_bytes(), "application/toml", "surface.toml")
}

async fn load(State(desk): State<Desk>, request: Request) -> Response {
    let body = match timeout(SENT, Bytes::from_request(request, &desk)).await {
        Ok(Ok(body)) => body,
        Ok(Err(refused)) => return refused.into_response(),
        Err(_) => return (StatusCode::REQUEST_TIMEOUT, "the upload took too long\n").into_response(),
    };
    let refused = |why: String| {
        desk.host.log(&format!("refused: an uploaded surface: {}", why.lines().next().unwrap_or_default()));
        let text = serde_json::json!({ "text": why }).to_string();
        (StatusCode::BAD_REQUEST, [(header::CONTENT_TYPE, "application/json")], text).into_response()
    };
    let Ok(text) = String::from_utf8(body.to_vec()) else {
        return refused("expected a text, found bytes that are none".into());
    };
    match desk.host.load(text).await {
        Ok(()) => ([(header::CONTENT_TYPE, "application/json")], "{}").into_response(),
        Err(why) => refused(why),
    }
}

/// Files of a measurement: that with the number in the request, if it is the newest of its page, or the newest of all.
async fn measured(State(desk): State<Desk>, Path(name): Path<String>, uri: Uri) -> Response {
    let wanted = uri.query().unwrap_or_default().split('&').find_map(|pair| pair.strip_prefix("id="));
    let Some(measured) = desk.host.measured(wanted) else {
        let why = match desk.host.measured(None) {
            None => "nothing has been measured yet\n",
            Some(_) => "something else has been measured since: measure again\n",
        };
        return (StatusCode::NOT_FOUND, why).into_response();
    };
    match name.as_str() {
        "drive.wav" => download(measured.drive, "audio/wav", "drive.wav"),
        "report.json" => download(measured.json.into_bytes(), "application/json", "report.json"),
        "report.md" => download(measured.markdown.into_bytes(), "text/markdown; charset=utf-8", "report.md"),
        _ => (StatusCode::NOT_FOUND, "no such file\n").into_response(),
    }
}

fn download(bytes: Vec<u8>, kind: &'static str, name: &str) -> Response {
    let named = format!("attachment; filename=\"{name}\"");
    ([(header::CONTENT_TYPE, kind.to_owned()), (header::CONTENT_DISPOSITION, named)], bytes).into_response()
}
