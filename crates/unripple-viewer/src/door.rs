//! Acceptance of connections: how long they may take, and how many there may be.

use crate::lobby::{Lobby, Seat};
use axum::Router;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};

/// How long a request may take to say what it wants, and how long a connection may stay without one. A phone on a
/// poor network needs a few seconds; longer would let silent connections pile up.
const SAID: Duration = Duration::from_secs(10);

/// Bytes that a request may take to say what it wants. Browsers send two or three kilobytes; what is longer is cut
/// off.
const LONGEST: usize = 16 << 10;

/// How long to wait when the system has no room for a connection: some of those there are end meanwhile.
const FULL: Duration = Duration::from_millis(100);

/// Accepts connections and serves them; never returns.
pub async fn listen(listener: TcpListener, router: Router) {
    let (lobby, service) = (Arc::new(Lobby::default()), TowerToHyperService::new(router));
    loop {
        match listener.accept().await {
            Ok((stream, from)) => {
                let seat = Arc::new(lobby.enter(from.ip()));
                tokio::spawn(attend(stream, service.clone(), seat));
            }
            Err(_) => tokio::time::sleep(FULL).await,
        }
    }
}

/// Serves a connection until it ends, or has to.
async fn attend(stream: TcpStream, service: TowerToHyperService<Router>, seat: Arc<Seat>) {
    let own = seat.clone();
    let answer = service_fn(move |mut request: hyper::Request<Incoming>| {
        request.extensions_mut().insert(own.clone());
        service.call(request)
    });
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(SAID).max_buf_size(LONGEST);
    let connection = http.serve_connection(TokioIo::new(stream), answer).with_upgrades();
    tokio::select! {
        // Whoever is cut off knows by that what went wrong.
        _ = connection => {}
        () = seat.cut() => {}
    }
}
