//! No figure depends on the number of threads: equal to the last bit on one, two and four.

use unripple::act::{Act, Level, model};
use unripple::core::{Contact, Point, Responses, Surface};
use unripple::focus::{Method, Options, Target};
use unripple::physics::sample;

/// A drive and what was found of it, all digits.
fn figures(surface: &Surface, method: Method) -> String {
    let responses = model(surface, None, &[]).unwrap();
    let targets =
        [Target::at(Point::from_mm(62.0, 60.0)), Target::at(Point::from_mm(90.0, 40.0)).with_gain(-0.5)];
    let options = Options { window: 0.012, limit: surface.emission.limit, method, ..Options::default() };
    let level = Level::Linear;
    let act = Act { surface, responses: &responses, targets: &targets, options: &options, level };
    let acted = act.run().unwrap();
    let report = serde_json::to_string(&acted.report(surface, &options)).unwrap();
    let channels = acted.drive.channels().iter().flatten().map(|x| x.to_bits());
    format!("{report} {:?}", channels.collect::<Vec<_>>())
}

fn are_one(what: &str, work: impl Fn() -> String + Sync) {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(&work)
    };
    let first = on(1);
    for threads in [2, 4] {
        assert!(on(threads) == first, "{what}: other figures on {threads} threads");
    }
}

#[test]
fn figures_of_a_focus_are_one() {
    for (name, top) in [("hudin-2012", 2000.0), ("stadium-film", 900.0), ("glass-plate", 9000.0)] {
        let mut surface = unripple_store::load_surface(name).unwrap();
        surface.emission.band = [0.0, top];
        for method in [Method::TimeReversal, Method::Concentrate, Method::Limited, Method::Robust] {
            are_one(&format!("{name}, {}", method.name()), || figures(&surface, method));
        }
    }
}

#[test]
fn figures_of_what_is_felt_are_one() {
    let mut film = unripple_store::load_surface("hudin-2012").unwrap();
    film.emission.band = [0.0, 2000.0];
    are_one("felt", || figures(&film, Method::Felt));
}

#[test]
fn responses_under_a_finger_are_one() {
    let mut film = unripple_store::load_surface("stadium-film").unwrap();
    film.emission.band = [0.0, 900.0];
    let finger = Contact { at: Point::from_mm(70.0, 60.0), finger: film.finger };
    are_one("under a finger", || {
        let Responses::Modal(modal) = model(&film, None, &[finger]).unwrap() else { return String::new() };
        let heard = sample(&modal, &[Point::from_mm(70.0, 60.0), Point::from_mm(30.0, 40.0)], 400);
        let bits = |point: usize| -> Vec<u32> {
            (0..modal.ports.len())
                .flat_map(|port| heard.response(port, point).iter().map(|h| h.to_bits()))
                .collect()
        };
        format!("{:?} {:?}", modal.poles, [0, 1].map(bits))
    });
}
