//! The session as pages meet it: words in, messages and work out.

use super::*;
use crate::simulation::tests::spec;
use serde_json::Value;
use unripple_tasks::{Progress, Silent};

fn session() -> Session {
    let told = Settled { source: "small".into(), device: "virtual".into(), address: None };
    Session::new(Instrument::build(spec(), &mut Silent).unwrap(), told)
}

/// A page's words, as its link reads them.
fn hear(session: &mut Session, page: u64, words: &str) {
    session.hear(page, Command::read(words).unwrap());
}

/// So many seconds in pictures, with time for everything.
fn pass(session: &mut Session, seconds: f64) {
    (0..(seconds * 30.0) as usize).for_each(|_| session.advance(1.0 / 30.0, 1, &mut || true));
}

/// The messages of a kind.
fn told(out: &[Out], kind: &str) -> Vec<Value> {
    let text = |out: &Out| match out {
        Out::Text(of, text) if of == kind => Some(serde_json::from_str(text).unwrap()),
        _ => None,
    };
    out.iter().filter_map(text).collect()
}

#[test]
fn fingers_of_a_page_that_goes_are_lifted_and_no_others() {
    let mut session = session();
    for page in [1, 2] {
        hear(&mut session, page, r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#);
    }
    pass(&mut session, 0.4);
    let fingers = |out: &[Out]| told(out, "status").pop().unwrap()["fingers"].as_array().unwrap().len();
    assert_eq!(fingers(&session.take()), 2);
    session.leave(1);
    pass(&mut session, 0.4);
    assert_eq!(fingers(&session.take()), 1);
}

#[test]
fn what_is_edited_while_something_is_built_is_built_next_and_once() {
    let mut session = session();
    let build = |spec| Errand::build(spec, &Stop::default(), &Lane::new(0));
    assert!(matches!(session.errand(), Some(Errand::Compute(Task::Design(of), _)) if of.edit == 0));
    session.take();
    let thicker = |mm: f64| format!(r#"{{"do":"edit","thickness_mm":{mm}}}"#);
    hear(&mut session, 1, &thicker(0.2));
    let Some(Errand::Build(first, _)) = session.errand() else { panic!("nothing to build") };
    let building =
        |out: &[Out]| told(out, "building").iter().map(|told| told["on"] == true).collect::<Vec<_>>();
    assert_eq!(building(&session.take()), [true]);
    for mm in [0.21, 0.22, 0.23] {
        hear(&mut session, 1, &thicker(mm));
        assert!(session.errand().is_none(), "two are built at once");
    }
    session.done(build(first));
    let Some(Errand::Build(last, _)) = session.errand() else { panic!("the last edit is lost") };
    assert!((last.surface.sheet.thickness - 0.23e-3).abs() < 1e-12);
    session.done(build(last));
    assert!(session.errand().is_none());
    let out = session.take();
    assert_eq!(building(&out), [false, true, false]);
    let surfaces = told(&out, "surface");
    assert_eq!(surfaces.last().unwrap()["values"]["thickness_mm"], 0.23);
    assert_eq!(told(&out, "settings").len(), 2, "one for each that is played");
    // Of the figures that were asked for, only the newest surface's are left to do.
    session.done(Done::Computed);
    let edit = surfaces.last().unwrap()["edit"].as_u64().unwrap();
    assert!(matches!(session.errand(), Some(Errand::Compute(Task::Design(of), _)) if of.edit == edit));
}

#[test]
fn what_a_page_asks_for_is_refused_to_that_page() {
    let mut session = session();
    session.take();
    hear(&mut session, 7, r#"{"do":"open","name":"nowhere"}"#);
    hear(&mut session, 8, r#"{"do":"measure","id":1,"at":[[62,90]],"edit":99}"#);
    let refused = |out: &Out| match out {
        Out::Refuse(page, why) => Some((*page, why.clone())),
        _ => None,
    };
    let refused: Vec<_> = session.take().iter().filter_map(refused).collect();
    assert_eq!(refused.iter().map(|(page, _)| *page).collect::<Vec<_>>(), [7, 8]);
    assert!(refused[0].1.contains("hudin-2012") && refused[1].1.contains("found 99"), "{refused:?}");
}

/// What is computed next, its request and its flag, after whatever was computed before has ended.
fn next(session: &mut Session) -> (Option<(u64, u64)>, Stop) {
    session.done(Done::Computed);
    let Some(Errand::Compute(task, stop)) = session.errand() else { panic!("nothing to compute") };
    (task.asked().map(|asked| (asked.page, asked.id)), stop)
}

/// The pages and requests that are told to have been stopped.
fn stopped(session: &mut Session) -> Vec<(u64, u64)> {
    let stopped = session.take().into_iter().filter_map(|out| match out {
        Out::Stopped(page, id) => Some((page, id)),
        _ => None,
    });
    stopped.collect()
}

/// Has pages ask for measurements, each by its page and number. The first is begun before the others are asked for.
fn measuring(asked: &[(u64, u64)]) -> (Session, Stop) {
    let mut session = session();
    assert_eq!(next(&mut session).0, None);
    let measure = |session: &mut Session, (page, id): (u64, u64)| {
        hear(session, page, &format!(r#"{{"do":"measure","id":{id},"at":[[62,90]]}}"#));
    };
    measure(&mut session, asked[0]);
    let (first, stop) = next(&mut session);
    assert_eq!((first, stop.watch().cancelled()), (Some(asked[0]), false));
    asked[1..].iter().for_each(|asked| measure(&mut session, *asked));
    (session, stop)
}

#[test]
fn what_a_page_stops_is_given_up_whether_it_runs_or_waits() {
    let (mut session, stop) = measuring(&[(1, 10), (2, 20), (3, 10)]);
    hear(&mut session, 3, r#"{"do":"stop","id":10}"#);
    assert_eq!(stopped(&mut session), [(3, 10)]);
    assert!(!stop.watch().cancelled(), "that of another page is given up");
    hear(&mut session, 1, r#"{"do":"stop","id":10}"#);
    // The worker answers for what it has begun.
    assert!(stop.watch().cancelled() && stopped(&mut session).is_empty());
    assert_eq!(next(&mut session).0, Some((2, 20)));
    // Nothing of this number is computed any more.
    hear(&mut session, 1, r#"{"do":"stop","id":10}"#);
    assert_eq!(stopped(&mut session), [(1, 10)]);
}

#[test]
fn a_page_that_goes_takes_back_what_it_asked_for() {
    let (mut session, stop) = measuring(&[(1, 10), (2, 20), (1, 11)]);
    assert!(stop.watch().cancelled(), "whoever asks for something newer wants the older no more");
    hear(&mut session, 1, r#"{"do":"compare","id":12,"at":[[62,90]],"methods":["one-bit","inverse"]}"#);
    assert_eq!(next(&mut session).0, Some((2, 20)));
    assert!(stopped(&mut session).is_empty(), "a comparison takes the place of a measurement");
    session.leave(1);
    assert_eq!(stopped(&mut session), [(1, 11), (1, 12)]);
    session.done(Done::Computed);
    assert!(session.errand().is_none());
}

#[test]
fn a_newer_surface_hurries_the_one_before() {
    let mut session = session();
    let Some(Errand::Compute(Task::Design(_), design)) = session.errand() else { panic!("no figures") };
    hear(&mut session, 1, r#"{"do":"edit","thickness_mm":0.2}"#);
    let Some(Errand::Build(_, build)) = session.errand() else { panic!("nothing to build") };
    assert!(design.is_hurried() && !build.is_hurried());
    hear(&mut session, 1, r#"{"do":"undo"}"#);
    assert!(session.errand().is_none() && build.is_hurried() && !build.watch().cancelled());
    // At the end nothing goes on.
    drop(session);
    assert!(design.watch().cancelled() && build.watch().cancelled());
}

#[test]
fn the_same_words_and_times_give_the_same_pictures() {
    let pictures = || {
        let mut session = session();
        hear(&mut session, 1, r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#);
        pass(&mut session, 0.3);
        let frames = session.take().into_iter().filter_map(|out| match out {
            Out::Frame(_, bytes, _) => Some(bytes),
            _ => None,
        });
        frames.collect::<Vec<_>>()
    };
    let (one, other) = (pictures(), pictures());
    assert!(one.len() > 5 && one == other);
}

#[test]
fn what_was_chosen_is_told_at_once_and_before_it_is_played() {
    let mut session = session();
    let chosen = |session: &mut Session| told(&session.take(), "chosen").pop().unwrap_or_default();
    assert_eq!(chosen(&mut session)["rate_hz"], 10.0);
    hear(&mut session, 1, r#"{"do":"settings","method":"one-bit"}"#);
    let Some(Errand::Build(first, _)) = session.errand() else { panic!("nothing to build") };
    assert_eq!(chosen(&mut session)["method"], "one-bit");
    hear(&mut session, 1, r#"{"do":"settings","rate_hz":5}"#);
    session.done(Errand::build(first, &Stop::default(), &Lane::new(0)));
    let said = session.take();
    // What is played first has the rate of before, and pages know that it does not last.
    assert_eq!(told(&said, "settings").pop().unwrap()["rate_hz"], 10.0);
    assert_eq!(told(&said, "chosen").pop().unwrap()["rate_hz"], 5.0);
    hear(&mut session, 1, r#"{"do":"settings","method":"magic"}"#);
    assert_eq!(chosen(&mut session)["method"], "one-bit");
}

#[test]
fn a_page_takes_back_its_own_edits_and_those_of_pages_that_have_gone() {
    let mut session = session();
    for (page, tension) in [(1, 150), (2, 160), (1, 170)] {
        hear(&mut session, page, &format!(r#"{{"do":"edit","tension_n_per_m":{tension}}}"#));
    }
    session.renew();
    let mut undo = |page: u64, gone: Option<u64>| {
        gone.into_iter().for_each(|gone| session.leave(gone));
        session.take();
        hear(&mut session, page, r#"{"do":"undo"}"#);
        session.renew();
        let said = session.take();
        let refused = said.iter().any(|out| matches!(out, Out::Refuse(of, _) if *of == page));
        let tension =
            told(&said, "surface").pop().map(|surface| surface["values"]["tension_n_per_m"].clone());
        (refused, tension)
    };
    assert_eq!(undo(2, None), (true, None));
    assert_eq!(undo(1, None), (false, Some(json!(160.0))));
    assert_eq!(undo(1, None), (true, None));
    assert_eq!(undo(1, Some(2)), (false, Some(json!(150.0))));
}
