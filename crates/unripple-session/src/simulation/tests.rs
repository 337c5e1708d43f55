//! The surface at work, as pages see it.

use super::*;
use crate::outbox::Out;
use serde_json::json;
use unripple::core::Surface;
use unripple::physics::design::papers_surface;
use unripple_tasks::Silent;

/// A small film that is simulated alone, without any device.
pub(crate) fn spec() -> Spec {
    let mut surface: Surface = papers_surface();
    surface.emission.band[1] = 700.0;
    Spec::simulated(surface)
}

/// Whoever has time for a little.
fn some(blocks: usize) -> impl FnMut() -> bool {
    let mut left = blocks;
    move || {
        left = left.saturating_sub(1);
        left > 0
    }
}

/// The newest message of a kind.
fn told(said: &[Out], kind: &str) -> Value {
    let text = said.iter().rev().find_map(|out| match out {
        Out::Text(of, text) if of == kind => Some(text),
        _ => None,
    });
    text.map_or(Value::Null, |text| serde_json::from_str(text).unwrap())
}

/// What is said to pages, in order: the kinds of texts, and `frame`.
fn order(said: &[Out]) -> Vec<&str> {
    let named = said.iter().map(|out| match out {
        Out::Text(kind, _) => Some(kind.as_str()),
        Out::Frame(..) => Some("frame"),
        _ => None,
    });
    named.flatten().collect()
}

/// A simulation that has run for a while, with a page that looks, and what it said.
fn running() -> (Simulation, Vec<Out>) {
    let (mut simulation, mut out) =
        (Simulation::new(Instrument::build(spec(), &mut Silent).unwrap()), Outbox::default());
    simulation.begin(&mut out);
    for _ in 0..50 {
        simulation.advance(0.02, 1, &mut some(20), &mut out);
    }
    (simulation, out.take())
}

#[test]
fn the_clock_of_another_surface_is_told_before_how_it_is_played() {
    let (mut simulation, said) = running();
    let before = told(&said, "status")["head_s"].as_f64().unwrap();
    assert!(before > 0.01 && order(&said).contains(&"frame"), "{before}");
    let other = Instrument::build(Spec { load: true, ..spec() }, &mut Silent).unwrap();
    let mut out = Outbox::default();
    simulation.obey(Order::Play(Box::new(other), json!({ "is": "settings", "load": true })), &mut out);
    let said = out.take();
    let status = told(&said, "status");
    assert!(status["head_s"].as_f64().unwrap() < 1e-3, "the clock of before: {status}");
    assert_eq!(status["clock_s"], 0.0);
    assert_eq!(order(&said), ["status", "transport", "settings"]);
}

#[test]
fn a_surface_that_is_played_otherwise_is_seen_while_time_stands_still() {
    for speed in [0.02, 1.0] {
        let (mut simulation, _) = running();
        let mut out = Outbox::default();
        let paused = wire::Transport { speed: Some(speed), paused: Some(true), ..wire::Transport::default() };
        simulation.obey(Order::Transport(paused), &mut out);
        let mut other = spec();
        other.surface.sheet.tension = 150.0;
        let other = Instrument::build(other, &mut Silent).unwrap();
        simulation.obey(Order::Play(Box::new(other), json!({ "is": "settings" })), &mut out);
        simulation.advance(0.1, 1, &mut some(20), &mut out);
        assert!(simulation.transport.paused && simulation.head() > 0.0, "{speed}");
        assert!(order(&out.take()).contains(&"frame"));
        let head = simulation.head();
        simulation.advance(0.1, 1, &mut some(20), &mut out);
        assert_eq!(simulation.head(), head);
    }
}

/// The first mode of the film is at 166 Hz.
#[test]
fn a_band_without_modes_is_refused_in_the_words_of_the_commands() {
    let mut empty = spec();
    empty.surface.emission.band = [0.0, 120.0];
    let Err(error) = Instrument::build(empty.clone(), &mut Silent) else { panic!("a band without modes") };
    let why = unripple::act::model(&empty.surface, None, &[]).unwrap_err().to_string();
    assert_eq!(error.to_string(), why);
    assert!(why.contains("found none (the next mode is at 16"), "{why}");
}

#[test]
fn without_a_scale_the_limit_alone_sets_the_level() {
    let known = Instrument::build(spec(), &mut Silent).unwrap();
    assert!(known.level.full.is_some() && known.level.to_string().contains("threshold of touch"));
    let unknown = Instrument::build(Spec { without_scale: true, ..spec() }, &mut Silent).unwrap();
    assert!(unknown.level.full.is_none());
    assert!(unknown.level.to_string().ends_with("its displacement is unknown"), "{}", unknown.level);
}

/// The time between two, in s, at which a place has moved most, as far as states are remembered; and how far, in m.
fn strongest(simulation: &Simulation, at: Point, [from, to]: [f64; 2]) -> (f64, f32) {
    let Instrument { plant, handle, .. } = &simulation.instrument;
    let (weights, rate) = (lens::weights(plant, &[at]), simulation.instrument.rate());
    let found = handle.history(|history| {
        let past = past::Past { history, rate, velocity: false };
        let newest = past.back(to);
        let trace = past.trace(&weights, newest, past.back(from) - newest + 1);
        let most = (0..trace.len()).max_by(|a, b| trace[*a].abs().total_cmp(&trace[*b].abs())).unwrap();
        let back = newest + trace.len() - 1 - most;
        ((history.newest() as f64 - (back * history.stride()) as f64) / rate, trace[most].abs())
    });
    found.unwrap()
}

/// At the slowest speed 0.15 s of the page are a tenth of a block of the surface.
#[test]
fn a_tap_is_answered_at_once_and_its_focus_seen_at_every_speed() {
    let at = Point::from_mm(62.0, 90.0);
    let (mut simulation, _) = running();
    let mut out = Outbox::default();
    let pass = |simulation: &mut Simulation, seconds: f64| {
        simulation.advance(seconds, 0, &mut || true, &mut Outbox::default());
        simulation.known.fingers.len()
    };
    for speed in [1.0, 1.0 / 200.0, 1.0 / 2000.0] {
        let slow = wire::Transport { speed: Some(speed), ..wire::Transport::default() };
        simulation.obey(Order::Transport(slow), &mut out);
        pass(&mut simulation, 0.25);
        let before = simulation.head();
        simulation.obey(Order::Touch((1, 0), wire::Phase::Down, at), &mut out);
        assert_eq!(pass(&mut simulation, 0.03), 1, "{speed}: nothing is pressed");
        assert!(simulation.head() > before, "{speed}: the surface waits");
        pass(&mut simulation, 0.12);
        simulation.obey(Order::Touch((1, 0), wire::Phase::Up, at), &mut out);
        let focus = before + simulation.instrument.window.seconds;
        let mut parts = 0;
        while pass(&mut simulation, 0.25) > 0 {
            parts += 1;
            assert!(parts < 4000, "{speed}: the finger stays");
        }
        assert!(simulation.transport.shown() >= focus, "{speed}: the finger goes before its focus");
        let (found, _) = strongest(&simulation, at, [before, focus + page_fingers::SHOWN]);
        assert!((found - focus).abs() < 1e-3, "{speed}: most at {found} s instead of {focus} s");
    }
}

#[test]
fn a_tap_while_time_stands_still_is_played_when_it_goes_on() {
    let (mut simulation, _) = running();
    let mut out = Outbox::default();
    let paused =
        |paused| Order::Transport(wire::Transport { paused: Some(paused), ..wire::Transport::default() });
    simulation.obey(paused(true), &mut out);
    for phase in [wire::Phase::Down, wire::Phase::Up] {
        simulation.obey(Order::Touch((1, 0), phase, Point::from_mm(62.0, 90.0)), &mut out);
    }
    simulation.advance(0.1, 1, &mut || true, &mut out);
    assert_eq!(simulation.known.fingers.len(), 1);
    simulation.obey(paused(false), &mut out);
    let begun = simulation.known.tally.started;
    for _ in 0..10 {
        simulation.advance(0.1, 1, &mut || true, &mut out);
    }
    assert!(simulation.known.fingers.is_empty() && simulation.known.tally.started > begun);
}

#[test]
fn what_is_chosen_while_time_stands_still_is_played_when_it_goes_on() {
    let (mut simulation, _) = running();
    let mut out = Outbox::default();
    let stands = |paused| wire::Transport { paused: Some(paused), ..wire::Transport::default() };
    simulation.obey(Order::Transport(stands(true)), &mut out);
    let (head, shown) = (simulation.head(), simulation.transport.shown());
    for rate in [20.0, 30.0] {
        let other = Instrument::build(Spec { rate, ..spec() }, &mut Silent).unwrap();
        simulation.obey(Order::Play(Box::new(other), json!({ "is": "settings", "rate_hz": rate })), &mut out);
        simulation.advance(0.1, 1, &mut some(20), &mut out);
    }
    assert!(
        (simulation.head(), simulation.transport.shown()) == (head, shown) && simulation.transport.paused
    );
    assert_eq!(told(&out.take(), "settings"), Value::Null);
    simulation.obey(Order::Transport(stands(false)), &mut out);
    let said = out.take();
    assert_eq!(told(&said, "settings")["rate_hz"], 30.0);
    assert!(
        simulation.head() < head && !simulation.transport.paused && simulation.instrument.spec.rate == 30.0
    );
}

#[test]
fn effects_are_as_strong_as_pages_ask_for_on_every_instrument() {
    let at = Point::from_mm(62.0, 90.0);
    let (mut simulation, _) = running();
    let mut out = Outbox::default();
    let mut tap = |simulation: &mut Simulation| {
        let before = simulation.head();
        for phase in [wire::Phase::Down, wire::Phase::Up] {
            simulation.obey(Order::Touch((1, 0), phase, at), &mut out);
        }
        // Until the sheet has come to rest, but not until it has forgotten.
        (0..4).for_each(|_| simulation.advance(0.2, 0, &mut || true, &mut out));
        let focus = before + simulation.instrument.window.seconds;
        strongest(simulation, at, [before, focus + page_fingers::SHOWN]).1
    };
    let full = tap(&mut simulation);
    simulation.obey(Order::Gain(-20.0), &mut Outbox::default());
    let soft = tap(&mut simulation);
    assert!((soft / full - 0.1).abs() < 0.01, "{soft} m of {full} m");
    let mut told_to = Outbox::default();
    let other = Instrument::build(Spec { rate: 5.0, ..spec() }, &mut Silent).unwrap();
    simulation.obey(Order::Play(Box::new(other), json!({ "is": "settings" })), &mut told_to);
    assert_eq!(told(&told_to.take(), "transport")["gain_db"], -20.0);
    let other = tap(&mut simulation);
    assert!((other / soft - 1.0).abs() < 0.1, "{other} m instead of {soft} m");
}
