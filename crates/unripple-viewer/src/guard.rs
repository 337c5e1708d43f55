//! Access control of the server: host name, origin and token of a request.

use axum::http::{HeaderMap, Uri, header};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};

/// The rules of access to the server.
///
/// A page of another site can make a browser send requests to this server, and a foreign name can resolve to this machine's address. So a
/// request must name this server as its host, and a page that opens a WebSocket link must come from this server. If the server listens to
/// the network, the address also holds a token.
#[derive(Clone, Debug)]
pub struct Guard {
    address: SocketAddr,
    token: Option<String>,
}

/// The credentials that a request needs besides the right host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Credentials {
    /// Nothing but the right host.
    Nothing,
    /// The token, if the server has one.
    Token,
    /// The token, and an `Origin` header that names this server.
    Origin,
}

/// Reason why a request is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The host name in the request is not that of this server.
    Host,
    /// The page that makes the request was not served by this server.
    Origin,
    /// The token is missing or wrong.
    Token,
}

impl Guard {
    /// Rules for a server that listens at `address`, with a `token` if other machines can connect.
    pub fn new(address: SocketAddr, token: Option<String>) -> Self {
        Self { address, token }
    }

    /// URL to open on this machine, including the token.
    pub fn url(&self) -> String {
        let local = if self.address.is_ipv4() {
            IpAddr::V4(Ipv4Addr::LOCALHOST)
        } else {
            IpAddr::V6(Ipv6Addr::LOCALHOST)
        };
        let ip = if self.address.ip().is_unspecified() { local } else { self.address.ip() };
        self.at(ip)
    }

    /// URL to open on another machine; `None` if only this machine can connect.
    pub fn elsewhere(&self) -> Option<String> {
        match self.address.ip() {
            ip if ip.is_loopback() => None,
            ip if ip.is_unspecified() => outward().map(|ip| self.at(ip)),
            ip => Some(self.at(ip)),
        }
    }

    fn at(&self, ip: IpAddr) -> String {
        let token = self.token.as_ref().map_or(String::new(), |token| format!("?token={token}"));
        format!("http://{}/{token}", SocketAddr::new(ip, self.address.port()))
    }

    /// Checks whether a request is allowed; the error is the reason why not.
    pub fn check(&self, uri: &Uri, headers: &HeaderMap, needs: Credentials) -> Result<(), Refusal> {
        let text = |name| headers.get(name).and_then(|value| value.to_str().ok());
        let host = text(header::HOST).filter(|host| self.is_ours(host)).ok_or(Refusal::Host)?;
        let same = |origin: &str| origin.strip_prefix("http://").is_some_and(|from| from == host);
        match text(header::ORIGIN) {
            Some(origin) if !same(origin) => return Err(Refusal::Origin),
            None if needs == Credentials::Origin => return Err(Refusal::Origin),
            _ => {}
        }
        let asked = uri.query().unwrap_or_default().split('&').find_map(|pair| pair.strip_prefix("token="));
        match &self.token {
            Some(token)
                if needs != Credentials::Nothing && !asked.is_some_and(|asked| alike(asked, token)) =>
            {
                Err(Refusal::Token)
            }
            _ => Ok(()),
        }
    }

    /// Whether a host is this server: an address of numbers with its port, which no foreign name can pretend to be, or `localhost`.
    fn is_ours(&self, host: &str) -> bool {
        let port = self.address.port();
        let local = host == format!("localhost:{port}");
        let numbers = host.parse::<SocketAddr>().is_ok_and(|address| {
            let ours = address.ip() == self.address.ip() || self.address.ip().is_unspecified();
            let port = address.port() == port;
            port && (ours || address.ip().is_loopback())
        });
        local || numbers
    }
}

/// This machine's address towards the rest of the world, if there is one. Nothing is sent: the system is asked which way it would be.
fn outward() -> Option<IpAddr> {
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).ok()?;
    socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9)).ok()?;
    socket.local_addr().ok().map(|address| address.ip()).filter(|ip| !ip.is_unspecified())
}

/// Whether two texts are the same, in a time that does not depend on where they differ.
fn alike(one: &str, other: &str) -> bool {
    let differ = one.bytes().zip(other.bytes()).fold(0, |differ, (a, b)| differ | (a ^ b));
    one.len() == other.len() && differ == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(
        guard: &Guard,
        uri: &str,
        host: &str,
        origin: Option<&str>,
        needs: Credentials,
    ) -> Result<(), Refusal> {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().unwrap());
        if let Some(origin) = origin {
            headers.insert(header::ORIGIN, origin.parse().unwrap());
        }
        guard.check(&uri.parse().unwrap(), &headers, needs)
    }

    #[test]
    fn only_own_pages_come_in() {
        let guard = Guard::new("127.0.0.1:8417".parse().unwrap(), None);
        let own = Some("http://127.0.0.1:8417");
        assert_eq!(asked(&guard, "/link", "127.0.0.1:8417", own, Credentials::Origin), Ok(()));
        assert_eq!(
            asked(&guard, "/link", "localhost:8417", Some("http://localhost:8417"), Credentials::Origin),
            Ok(())
        );
        assert_eq!(asked(&guard, "/", "127.0.0.1:8417", None, Credentials::Token), Ok(()));
        assert_eq!(asked(&guard, "/link", "127.0.0.1:8417", None, Credentials::Origin), Err(Refusal::Origin));
        for origin in ["http://evil.example", "null", "http://127.0.0.1:8418", "https://127.0.0.1:8417"] {
            assert_eq!(
                asked(&guard, "/", "127.0.0.1:8417", Some(origin), Credentials::Token),
                Err(Refusal::Origin)
            );
        }
        for host in ["evil.example:8417", "127.0.0.1:80", "10.0.0.1:8417", "127.0.0.1"] {
            assert_eq!(asked(&guard, "/", host, None, Credentials::Token), Err(Refusal::Host), "{host}");
        }
    }

    #[test]
    fn the_network_needs_the_token() {
        let guard = Guard::new("0.0.0.0:8417".parse().unwrap(), Some("abc123".into()));
        let host = "192.168.1.7:8417";
        assert_eq!(asked(&guard, "/?x=1&token=abc123", host, None, Credentials::Token), Ok(()));
        for uri in ["/", "/?token=", "/?token=abc12", "/?token=abc1234", "/?token=abc124"] {
            assert_eq!(asked(&guard, uri, host, None, Credentials::Token), Err(Refusal::Token), "{uri}");
        }
        assert_eq!(asked(&guard, "/assets/app.js", host, None, Credentials::Nothing), Ok(()));
        assert_eq!(
            asked(&guard, "/?token=abc123", "name.example:8417", None, Credentials::Token),
            Err(Refusal::Host)
        );
    }
}
