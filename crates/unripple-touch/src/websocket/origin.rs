//! Which web pages may connect.

use std::net::Ipv4Addr;

/// Whether a page may connect: one of this machine, or one of a list. Programs that are no browsers send no origin.
///
/// Without this any page that a browser shows could touch the surface, since browsers let every page open a WebSocket
/// to the loopback.
pub(super) fn admitted(origin: &str, allowed: &[String]) -> bool {
    let listed = allowed.iter().any(|other| other.eq_ignore_ascii_case(origin));
    listed || ["http://", "https://"].into_iter().find_map(|s| origin.strip_prefix(s)).is_some_and(loopback)
}

fn loopback(authority: &str) -> bool {
    let split = if authority.ends_with(']') { None } else { authority.rsplit_once(':') };
    let (host, port) = split.unwrap_or((authority, "80"));
    let digits = !port.is_empty() && port.bytes().all(|byte| byte.is_ascii_digit());
    let here = host.eq_ignore_ascii_case("localhost") || host == "[::1]";
    digits && (here || host.parse::<Ipv4Addr>().is_ok_and(|address| address.is_loopback()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_of_this_machine_and_listed_ones_alone() {
        let allowed = ["https://lab.example:8443".to_owned()];
        for good in [
            "http://localhost",
            "http://localhost:8080",
            "https://127.0.0.1:3000",
            "http://127.9.9.9",
            "http://[::1]",
            "http://[::1]:80",
            "https://lab.example:8443",
        ] {
            assert!(admitted(good, &allowed), "{good}");
        }
        for bad in [
            "null",
            "",
            "http://example.com",
            "http://localhost.example.com",
            "http://127.0.0.1.example.com",
            "http://localhost@example.com",
            "http://example.com:localhost",
            "http://localhost:",
            "http://localhost:80x",
            "http://[::2]",
            "http://192.168.1.2:8080",
            "https://lab.example",
            "https://lab.example:8443.example.com",
            "file://localhost",
            "ws://localhost",
            "http://",
        ] {
            assert!(!admitted(bad, &allowed), "{bad}");
        }
    }
}
