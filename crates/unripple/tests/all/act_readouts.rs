//! An act reads the surface on two grids at most, whatever level it is brought to, and judges what is emitted.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};
use unripple::act::{Act, Level, Readouts, model};
use unripple::core::{ModalResponses, Point, Responses, Shapes};
use unripple::field::{Field, Grid};
use unripple::focus::{Method, Options, Target};
use unripple::physics::design::papers_surface;
use unripple_linalg::Mat;

/// Points of a grid that are read at once, all but the last. The integral of the sound reads fewer of its own at once.
const CHUNK: usize = 256;

/// Shapes that count how often whole chunks of a grid are read, by their first points.
#[derive(Debug)]
struct Counted {
    shapes: Arc<dyn Shapes>,
    chunks: Mutex<HashMap<[u64; 2], usize>>,
}

impl Shapes for Counted {
    fn modes(&self) -> usize {
        self.shapes.modes()
    }

    fn at(&self, point: Point, row: &mut [f64]) {
        self.shapes.at(point, row);
    }

    fn at_all(&self, points: &[Point]) -> Mat<f64> {
        if points.len() == CHUNK {
            let first = [points[0].x.to_bits(), points[0].y.to_bits()];
            *self.chunks.lock().unwrap().entry(first).or_default() += 1;
        }
        self.shapes.at_all(points)
    }
}

#[test]
fn an_act_reads_two_grids_at_most_once_each() {
    let mut surface = papers_surface();
    // Thin, so that slopes bound the level and the fine grid is asked for it too; thick, so that they do not, and to a higher frequency, since
    // its waves are longer and a grid is to have whole chunks.
    for (thickness, top) in [(0.1e-3, 2000.0), (2e-3, 8000.0)] {
        surface.sheet.thickness = thickness;
        surface.emission.band = [0.0, top];
        let Responses::Modal(known) = model(&surface, None, &[]).unwrap() else { panic!() };
        let chunks = |cells: f64| Grid::new(&known.conditions, cells).unwrap().inside.len() / CHUNK;
        let most = chunks(4.0) + chunks(8.0);
        assert!(chunks(4.0) > 0 && chunks(8.0) > chunks(4.0));
        for (method, level) in [
            (Method::TimeReversal, Level::Linear),
            (Method::OneBit, Level::Linear),
            (Method::Limited, Level::Linear),
            (Method::Limited, Level::Peak(1e-6)),
            (Method::TimeReversal, Level::Felt(1.0)),
            (Method::TimeReversal, Level::Limit),
        ] {
            let shapes = Arc::new(Counted { shapes: known.shapes.clone(), chunks: Mutex::default() });
            let responses = Responses::Modal(ModalResponses { shapes: shapes.clone(), ..known.clone() });
            let options = Options {
                window: 0.012,
                limit: 100.0 * surface.emission.limit,
                method,
                ..Options::default()
            };
            let targets = [Target::at(Point::from_mm(62.0, 90.0))];
            let act =
                Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
            // What planning reads is not the act's.
            let focuser = unripple::focus::Focuser::new(&responses, &options).unwrap();
            let focused = focuser.focus(&targets).unwrap();
            shapes.chunks.lock().unwrap().clear();
            let on = act.readouts();
            let sent = act.send(&focuser, focused, &on).unwrap();
            let judged = act.judge(&sent, &on).unwrap();
            let read = shapes.chunks.lock().unwrap().clone();
            println!("{thickness} m, {} at {level:?}: {} of {most} chunks", method.name(), read.len());
            assert!(read.values().all(|times| *times == 1), "a grid was read twice: {read:?}");
            assert!(read.len() >= chunks(8.0) && read.len() <= most);
            // The drive that is judged is the one that is emitted, on a grid of its own too.
            let own = Field::new(&responses, &sent.drive, 8.0).unwrap();
            assert_eq!(own.measure(&sent.aims, sent.period).unwrap().targets, judged.measured.targets);
        }
    }
}

#[test]
fn acts_on_one_surface_share_what_it_takes_to_read_it() {
    let mut surface = papers_surface();
    surface.emission.band = [0.0, 1500.0];
    let responses = model(&surface, None, &[]).unwrap();
    let on = Readouts::of(&responses);
    let targets = [Target::at(Point::from_mm(62.0, 90.0))];
    for method in [Method::TimeReversal, Method::Concentrate] {
        let options = Options { window: 0.012, method, ..Options::default() };
        let level = Level::Linear;
        let act =
            Act { surface: &surface, responses: &responses, targets: &targets, options: &options, level };
        let [alone, shared] = [act.run().unwrap(), act.run_on(&on).unwrap()];
        assert_eq!(alone.drive, shared.drive);
        assert_eq!(alone.judged.measured.targets, shared.judged.measured.targets);
    }
}
