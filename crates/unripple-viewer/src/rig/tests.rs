use super::*;
use crate::board::Notice;
use serde_json::json;
use unripple::core::Surface;
use unripple::focus::Method;
use unripple::physics::design::papers_surface;

fn spec() -> Spec {
    let mut surface: Surface = papers_surface();
    surface.emission.band[1] = 700.0;
    Spec {
        surface,
        stored: None,
        without_scale: false,
        method: Method::TimeReversal,
        effect: PULSES.into(),
        window: None,
        rate: 10.0,
        load: false,
        device: None,
        follow: None,
    }
}

fn told(board: &Board, kind: &str) -> Value {
    let Some(Notice::Text(text)) = board.newest(kind) else { return Value::Null };
    serde_json::from_str(&text).unwrap()
}

/// What is on the board, in the order in which it was put up: the kinds of texts, and `frame`.
fn order(board: &Board) -> Vec<String> {
    let name = |(_, notice)| match notice {
        Notice::Text(text) => {
            let value: Value = serde_json::from_str(&text).unwrap();
            value["is"].as_str().unwrap().to_owned()
        }
        Notice::Frame(..) => "frame".to_owned(),
    };
    board.since(0).into_iter().map(name).collect()
}

/// A rig that has run for a second of its surface, with a page that looks.
fn running(board: &Arc<Board>) -> Rig {
    let mut rig = Rig::new(board.clone(), Instrument::build(spec()).unwrap());
    for _ in 0..50 {
        // Each brings as much as can be computed in a frame's time.
        rig.pass(0.02);
    }
    rig.show();
    rig.tell();
    rig
}

#[test]
fn the_clock_of_another_surface_is_told_before_how_it_is_played() {
    let board = Arc::new(Board::new());
    let _page = board.enter(1).unwrap();
    let mut rig = running(&board);
    let before = told(&board, "status")["head_s"].as_f64().unwrap();
    assert!(before > 0.01 && order(&board).contains(&"frame".to_owned()), "{before}");
    let other = Instrument::build(Spec { load: true, ..spec() }).unwrap();
    rig.obey(Order::Play(Box::new(other), json!({ "is": "settings", "load": true })));
    let status = told(&board, "status");
    assert!(status["head_s"].as_f64().unwrap() < 1e-3, "the clock of before: {status}");
    assert_eq!(status["clock_s"], 0.0);
    assert_eq!(order(&board), ["status", "transport", "settings"]);
}

#[test]
fn a_surface_that_is_played_otherwise_is_seen_while_time_stands_still() {
    let board = Arc::new(Board::new());
    let _page = board.enter(1).unwrap();
    let mut rig = running(&board);
    let slowly = wire::Transport { speed: Some(0.02), paused: Some(true), ..wire::Transport::default() };
    rig.obey(Order::Transport(slowly));
    rig.obey(Order::Play(Box::new(Instrument::build(spec()).unwrap()), json!({ "is": "settings" })));
    rig.pass(0.1);
    rig.show();
    assert!(rig.transport.paused && rig.head() > 0.0);
    assert!(order(&board).contains(&"frame".to_owned()));
    let head = rig.head();
    rig.pass(0.1);
    assert_eq!(rig.head(), head);
}

#[test]
fn without_a_scale_the_limit_alone_sets_the_level() {
    let known = Instrument::build(spec()).unwrap();
    assert!(known.level.full.is_some() && known.level.to_string().contains("threshold of touch"));
    let unknown = Instrument::build(Spec { without_scale: true, ..spec() }).unwrap();
    assert!(unknown.level.full.is_none());
    assert!(unknown.level.to_string().ends_with("what it moves is not known"), "{}", unknown.level);
}
