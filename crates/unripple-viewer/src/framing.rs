//! Which other pages may show the viewer's page in a frame: their origins, and the header that tells browsers so.

use crate::ViewError;
use axum::http::HeaderValue;
use std::fmt;
use std::str::FromStr;

/// What the page may load: its own files alone.
const LOADS: &str =
    "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; base-uri 'none'; form-action 'none'";

/// Hosts that are this machine, of which an origin may leave the port open.
const LOCAL: [&str; 2] = ["localhost", "127.0.0.1"];

/// Longest name of a host, and of each of its parts (RFC 1035, 2.3.4).
const LONGEST: usize = 253;
const LONGEST_PART: usize = 63;

/// An origin, `scheme://host[:port]`, whose pages may show the viewer's page in a frame.
///
/// A page that frames another one can neither read it nor speak for it: the framed page keeps its own origin, which the server asks
/// for at each request and WebSocket link. But it can lay the framed page unseen over something that invites to a press, and so have a
/// person press the viewer's buttons, which drive a real surface. Against that browsers know one remedy, the directive
/// `frame-ancestors` of the header `Content-Security-Policy`: it lists the origins of all pages that may stand around a page. By
/// default it is `'none'`; each `Origin` adds itself, and nothing else can be written into the header with it, since a host is
/// letters, digits, hyphens and dots, and a port is digits.
///
/// The port may be `*` on `localhost` and `127.0.0.1`, as in `http://localhost:*`. A page from there was served by a program on this
/// machine. Such a program needs no press of anybody's: where no token is asked for it can connect itself, with any headers; where one
/// is, a page cannot be framed by whoever does not know its address with the token. What `*` gives away is that the page of any local
/// program may frame this one, one behind a port that is forwarded from another machine included.
///
/// The server sets no cookies: access is by the address alone. So what browsers do with cookies in frames (SameSite, partitions) neither
/// helps nor hinders.
///
/// ```
/// use unripple_viewer::Origin;
///
/// assert_eq!("https://lab.example:8443".parse::<Origin>()?.to_string(), "https://lab.example:8443");
/// assert!("http://127.0.0.1:*".parse::<Origin>().is_ok());
/// for wrong in ["*", "http://*", "http://lab.example:*", "http://lab.example/", "http://a; script-src *", "'self'"] {
///     assert!(wrong.parse::<Origin>().is_err());
/// }
/// # Ok::<(), unripple_viewer::ViewError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin(String);

impl FromStr for Origin {
    type Err = ViewError;

    /// Reads an origin; anything else, including an origin that is followed by a path, is
    /// [`ViewError::Range`].
    fn from_str(text: &str) -> Result<Self, ViewError> {
        let legal = text.split_once("://").is_some_and(|(scheme, rest)| {
            let (host, port) = match rest.split_once(':') {
                Some((host, port)) => (host, Some(port)),
                None => (rest, None),
            };
            let open = port == Some("*") && LOCAL.contains(&host);
            matches!(scheme, "http" | "https") && is_host(host) && (open || port.is_none_or(is_port))
        });
        if legal {
            return Ok(Self(text.into()));
        }
        let local = LOCAL.join(" and ");
        let expected = format!("scheme://host[:port], http or https, where the port of {local} may be *");
        Err(ViewError::Range { what: "framed_by", expected, found: format!("`{}`", text.escape_debug()) })
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Whether a text is the name of a host or an address of the fourth version of IP. One of the sixth has no place in the header (CSP 3, 2.3.1).
fn is_host(text: &str) -> bool {
    let is_part = |part: &str| {
        let letters = part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-');
        letters && (1..=LONGEST_PART).contains(&part.len()) && !part.starts_with('-') && !part.ends_with('-')
    };
    text.len() <= LONGEST && text.split('.').all(is_part)
}

/// Whether a text is the number of a port.
fn is_port(text: &str) -> bool {
    // Reading a number also accepts a sign.
    text.bytes().all(|byte| byte.is_ascii_digit()) && text.parse::<u16>().is_ok_and(|port| port > 0)
}

/// The header `Content-Security-Policy` of all answers: which files a page may load, and the origins whose
/// pages may show it in a frame.
pub fn policy(framed_by: &[Origin]) -> HeaderValue {
    let origins: Vec<&str> = framed_by.iter().map(|origin| origin.0.as_str()).collect();
    let ancestors = if origins.is_empty() { "'none'".into() } else { origins.join(" ") };
    HeaderValue::from_str(&format!("{LOADS}; frame-ancestors {ancestors}"))
        // An origin is visible ASCII, which a header takes; were it not, nothing would be allowed.
        .unwrap_or(HeaderValue::from_static("default-src 'none'; frame-ancestors 'none'"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn origin(text: &str) -> Result<Origin, ViewError> {
        text.parse()
    }

    #[test]
    fn origins_are_read_and_nothing_else_is() {
        for right in [
            "http://localhost:8888",
            "http://localhost",
            "http://localhost:*",
            "http://127.0.0.1:*",
            "https://lab-2.example.org",
            "https://xn--bcher-kva.example:65535",
            "http://10.0.0.7:80",
        ] {
            assert_eq!(origin(right).unwrap().to_string(), right);
        }
        for wrong in [
            "",
            "*",
            "'self'",
            "localhost:8888",
            "http:",
            "http://",
            "http://*",
            "http://*.example.org",
            "http://lab.example:*",
            "http://127.0.0.2:*",
            "http://localhost:",
            "http://localhost:0",
            "http://localhost:+80",
            "http://localhost:65536",
            "http://localhost:80:81",
            "http://localhost:**",
            "http://localhost:8888/",
            "http://localhost:8888/lab",
            "http://localhost:8888?x",
            "http://user@localhost",
            "http://[::1]:8888",
            "ws://localhost:8888",
            "HTTP://localhost:8888",
            "javascript://localhost",
            "http://a..b",
            "http://-a.b",
            "http://a_b",
            "http://bücher.example",
            "http://localhost http://evil.example",
            "http://localhost;script-src *",
            "http://localhost; script-src *",
            "http://localhost,http://evil.example",
            "http://localhost\r\nX-Evil: 1",
            "http://localhost:*\n",
            " http://localhost",
        ] {
            let error = origin(wrong).unwrap_err();
            assert!(matches!(&error, ViewError::Range { what: "framed_by", .. }), "{wrong:?}: {error}");
            assert!(!error.to_string().contains(['\r', '\n']), "{error}");
        }
        assert!(origin(&format!("http://{}", "a.".repeat(200))).is_err());
        assert!(origin(&format!("http://{}.example", "a".repeat(64))).is_err());
    }

    #[test]
    fn nobody_frames_a_page_who_was_not_named() {
        let told = |origins: &[&str]| {
            let origins: Vec<Origin> = origins.iter().map(|text| origin(text).unwrap()).collect();
            policy(&origins).to_str().unwrap().to_owned()
        };
        assert!(told(&[]).starts_with("default-src 'self'; "));
        assert!(told(&[]).ends_with("; frame-ancestors 'none'"));
        let two = told(&["http://localhost:*", "https://lab.example"]);
        assert!(two.ends_with("; frame-ancestors http://localhost:* https://lab.example"), "{two}");
        assert_eq!(two.matches(';').count(), told(&[]).matches(';').count());
    }
}
