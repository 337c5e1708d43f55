//! What strangers can do to a viewer: nothing.

mod common;

use common::{Served, status, until};
use serde_json::{Value, json};
use std::time::{Duration, Instant};
use tungstenite::Message;
use unripple::core::Random;
use unripple_viewer::Origin;

#[test]
fn strangers_are_turned_away() {
    let served = Served::new(None);
    assert_eq!(status(&served.get("/", "")), 200);
    let policy = "content-security-policy: default-src 'self'";
    assert!(served.get("/", "").to_lowercase().contains(policy));
    assert_eq!(status(&served.get("/", "Origin: http://evil.example\r\n")), 403);
    assert_eq!(status(&served.ask("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n")), 403);
    assert_eq!(served.join("http://evil.example").unwrap_err(), 403);
    for path in [
        "/assets/../Cargo.toml",
        "/assets/..%2f..%2fCargo.toml",
        "/assets/%2e%2e/Cargo.toml",
        "/assets//etc/passwd",
        "/../../etc/passwd",
        "/assets/index.html%00.js",
    ] {
        let answer = served.get(path, "");
        assert!(matches!(status(&answer), 400 | 404), "{path}: {answer}");
        assert!(!answer.contains("[package]") && !answer.contains("root:"), "{path}: {answer}");
    }
    let guarded = Served::new(Some("abcdef123456"));
    assert_eq!(status(&guarded.get("/", "")), 403);
    assert_eq!(status(&guarded.get("/?token=abcdef123456", "")), 200);
}

/// The directive of an answer that says who may frame it.
fn ancestors(answer: &str) -> String {
    let lines = answer.lines().filter_map(|line| line.split_once(": "));
    let mut policies = lines.filter(|(name, _)| name.eq_ignore_ascii_case("content-security-policy"));
    let (_, policy) = policies.next().unwrap();
    assert!(policies.next().is_none(), "{answer}");
    let mut directives = policy.split("; ").filter(|directive| directive.starts_with("frame-ancestors "));
    let found = directives.next().unwrap().to_owned();
    assert!(directives.next().is_none(), "{policy}");
    found
}

#[test]
fn only_pages_that_are_named_may_frame_the_page() {
    let served = Served::new(None);
    for path in ["/", "/assets/app.js", "/surface.toml", "/no-such-file"] {
        assert_eq!(ancestors(&served.get(path, "")), "frame-ancestors 'none'", "{path}");
    }
    let named = ["http://localhost:*", "https://lab.example"].map(|text| text.parse::<Origin>().unwrap());
    let framed = Served::with(Some("abcdef123456"), |view| view.framed_by = named.to_vec());
    let answer =
        framed.get("/?token=abcdef123456", "Sec-Fetch-Dest: iframe\r\nSec-Fetch-Site: cross-site\r\n");
    assert_eq!(status(&answer), 200);
    assert_eq!(ancestors(&answer), "frame-ancestors http://localhost:* https://lab.example");
    assert!(!answer.to_lowercase().contains("set-cookie"), "{answer}");
    // Whoever may frame the page may nothing else: neither open it without the token, nor speak for it.
    assert_eq!(status(&framed.get("/", "")), 403);
    assert_eq!(status(&framed.get("/?token=abcdef123456", "Origin: http://localhost:8888\r\n")), 403);
    assert_eq!(framed.join("http://localhost:8888").unwrap_err(), 403);
    assert_eq!(framed.join("https://lab.example").unwrap_err(), 403);
}

#[test]
fn uploads_that_are_no_surface_change_nothing() {
    let served = Served::new(None);
    let before = served.get("/surface.toml", "");
    let text = before.split("\r\n\r\n").nth(1).unwrap().to_owned();
    assert_eq!(status(&served.post(&"x = 1\n".repeat(60_000))), 413);
    for bad in [
        "".to_owned(),
        "\u{0}\u{1}".to_owned(),
        text.replace("thickness_mm", "thikness_mm"),
        text.replace("rectangle_mm = [150, 150]", "svg = \"../../../../etc/passwd\""),
    ] {
        let answer = served.post(&bad);
        assert_eq!(status(&answer), 400, "{answer}");
        assert!(answer.contains("expected") && !answer.contains("root:"), "{answer}");
    }
    assert_eq!(served.get("/surface.toml", "").split("\r\n\r\n").nth(1), Some(text.as_str()));
    let other = text.replace("tension_n_per_m = 200", "tension_n_per_m = 150");
    assert_eq!(status(&served.post(&other)), 200);
    assert!(served.get("/surface.toml", "").contains("tension_n_per_m = 150"));
}

#[test]
fn messages_that_mean_nothing_are_refused_and_harm_nobody() {
    let served = Served::new(None);
    let (mut good, mut bad) = (served.page(), served.page());
    until(&mut good, "surface");
    let mut random = Random::seeded(5);
    let letters = r#"{}[]":,do touch edit at_mm 1e999 -null\u0000 finger"#;
    for i in 0..40 {
        let text = match i {
            0 => r#"{"do":"touch","finger":0,"phase":"down","at_mm":[1e999,0]}"#.to_owned(),
            1 => r#"{"do":"edit","actuators":1000000000}"#.to_owned(),
            2 => r#"{"do":"job","start":"calibrate","name":"../../x"}"#.to_owned(),
            3 => r#"{"do":"job","start":"rm -rf /"}"#.to_owned(),
            4 => r#"{"do":"open","name":"../../../etc/passwd"}"#.to_owned(),
            5 => "[".repeat(20_000),
            6 => r#"{"do":"edit","thickness_mm":0}"#.to_owned(),
            _ => {
                let letter = |_| letters.chars().nth((random.uniform() * letters.len() as f64) as usize);
                (0..30).filter_map(letter).collect()
            }
        };
        bad.send(Message::text(text)).unwrap();
        let fault = until(&mut bad, "fault");
        assert!(!fault["text"].as_str().unwrap().is_empty());
    }
    // Bytes, and one message too many of no use: the link is cut, and only that one.
    let mut cut = false;
    for _ in 0..60 {
        cut |= bad.send(Message::binary(vec![0; 100])).is_err();
    }
    cut |= (0..10_000).any(|_| bad.read().is_err());
    assert!(cut);
    good.send(Message::text(r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#)).unwrap();
    let began = Instant::now();
    while until(&mut good, "status")["fingers"].as_array().unwrap().len() != 1 {
        assert!(began.elapsed() < Duration::from_secs(20));
    }
    let mut long = served.page();
    let sent = long.send(Message::text("x".repeat(1 << 20)));
    assert!(sent.is_err() || (0..10_000).any(|_| long.read().is_err()));
}

#[test]
fn fingers_of_a_page_that_goes_are_lifted() {
    let served = Served::new(None);
    let (mut stays, mut goes) = (served.page(), served.page());
    goes.send(Message::text(r#"{"do":"touch","finger":7,"phase":"down","at_mm":[40,50]}"#)).unwrap();
    let mut wait = |count: usize| {
        let began = Instant::now();
        while until(&mut stays, "status")["fingers"].as_array().unwrap().len() != count {
            assert!(began.elapsed() < Duration::from_secs(20));
        }
    };
    wait(1);
    drop(goes);
    wait(0);
}

/// Six fingers on a screen of 120 Hz make more messages than are taken in: of moves the surplus is dropped, a lift never is.
#[test]
fn a_finger_is_lifted_however_fast_its_page_talks() {
    let served = Served::new(None);
    let (mut stays, mut hasty) = (served.page(), served.page());
    let touch = |phase: &str, x: f64| {
        let command = json!({ "do": "touch", "finger": 3, "phase": phase, "at_mm": [x, 50] });
        Message::text(command.to_string())
    };
    let mut wait = |count: usize| {
        let began = Instant::now();
        while until(&mut stays, "status")["fingers"].as_array().unwrap().len() != count {
            assert!(began.elapsed() < Duration::from_secs(20));
        }
    };
    hasty.send(touch("down", 40.0)).unwrap();
    wait(1);
    for i in 0..2000 {
        hasty.send(touch("move", 40.0 + f64::from(i % 30))).unwrap();
    }
    hasty.send(touch("up", 60.0)).unwrap();
    wait(0);
    // The page is still served.
    std::thread::sleep(Duration::from_secs(1));
    hasty.send(touch("down", 40.0)).unwrap();
    wait(1);
}

/// What a page hears, up to an answer, must hold no fault.
#[test]
fn six_fingers_on_a_fast_screen_keep_no_request_from_being_heard() {
    let served = Served::new(None);
    let mut page = served.page();
    let touch = |finger: u32, phase: &str, x: u32| {
        let at_mm = [30 + x % 60, 20 + 20 * finger];
        let command = json!({ "do": "touch", "finger": finger, "phase": phase, "at_mm": at_mm });
        Message::text(command.to_string())
    };
    (0..6).for_each(|finger| page.send(touch(finger, "down", 0)).unwrap());
    // A second of moves at 120 Hz, and a request after it.
    for x in 0..120 {
        (0..6).for_each(|finger| page.send(touch(finger, "move", x)).unwrap());
    }
    page.send(Message::text(r#"{"do":"stop","id":9}"#)).unwrap();
    loop {
        let Message::Text(text) = page.read().unwrap() else { continue };
        let message: Value = serde_json::from_str(&text).unwrap();
        assert_ne!(message["is"], "fault", "{message}");
        if message["is"] == "stopped" {
            break;
        }
    }
    (0..6).for_each(|finger| page.send(touch(finger, "up", 0)).unwrap());
    let began = Instant::now();
    while !until(&mut page, "status")["fingers"].as_array().unwrap().is_empty() {
        assert!(began.elapsed() < Duration::from_secs(20));
    }
}
