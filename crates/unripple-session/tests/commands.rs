//! Whatever a page says is a command within its limits, or is refused in words; an edit makes a surface that its file says as well, or nothing.

use proptest::prelude::*;
use unripple::physics::design::papers_surface;
use unripple_session::{Command, Draft, Edit};
use unripple_store::{parse_surface, to_toml};

/// Messages that are right, to be bent.
const RIGHT: [&str; 10] = [
    r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#,
    r#"{"do":"transport","speed":0.01,"paused":true,"step":-3,"shown_s":1.25}"#,
    r#"{"do":"settings","method":"inverse","effect":"purr","window_ms":null,"rate_hz":5,"load":true,"gain_db":-6}"#,
    r#"{"do":"probe","add":[10,20],"remove":3}"#,
    r#"{"do":"edit","stadium_mm":[60,40],"actuators":5,"edge":"free","material":"glass","settled":false}"#,
    r#"{"do":"edit","actuator":2,"at_mm":[30,40],"thickness_mm":0.2,"tension_n_per_m":1e3}"#,
    r#"{"do":"measure","id":1,"at":[[62,90],[1,2]],"method":"inverse","window_ms":null,"peak_um":40}"#,
    r#"{"do":"compare","id":2,"at":[[62,90]],"methods":["one-bit","inverse"],"off":false}"#,
    r#"{"do":"stop","id":2}"#,
    r#"{"do":"job","start":"calibrate","unknowns":7,"grid_mm":15,"name":"film"}"#,
];

/// One of the messages with some of its bytes replaced, left out or put twice.
fn bent() -> impl Strategy<Value = String> {
    let bend =
        (any::<prop::sample::Index>(), 0..3u8, prop::sample::select(br#"{}[]":,.-+e019 atx\"#.to_vec()));
    (prop::sample::select(&RIGHT[..]), prop::collection::vec(bend, 0..6)).prop_map(|(right, bends)| {
        let mut bytes = right.as_bytes().to_vec();
        for (at, how, byte) in bends {
            let at = at.index(bytes.len());
            match how {
                0 => bytes[at] = byte,
                1 => drop(bytes.remove(at)),
                _ => bytes.insert(at, byte),
            }
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

fn edit() -> impl Strategy<Value = Edit> {
    let some = |range: std::ops::Range<f64>| prop::option::of(range);
    let size = || prop::option::weighted(0.2, prop::array::uniform2(-1.0..400.0));
    let names = prop::option::weighted(
        0.2,
        prop::sample::select(vec!["BoPET", "glass", "nothing", "free", "clamped"]),
    );
    let sheet = (some(-0.1..3.0), some(-1.0..900.0), some(-1.0..500.0), some(10.0..30_000.0));
    let rest = (
        names.clone(),
        names,
        prop::option::of(0usize..20),
        prop::option::of((0usize..20, prop::array::uniform2(-9.0..300.0))),
    );
    (sheet, size(), size(), rest).prop_map(
        |((thickness, tension, decay, top), rectangle, stadium, (material, edge, count, moved))| Edit {
            material: material.map(str::to_owned),
            edge: edge.map(str::to_owned),
            thickness_mm: thickness,
            tension_n_per_m: tension,
            decay_time_ms: decay,
            band_top_hz: top,
            rectangle_mm: rectangle,
            stadium_mm: stadium,
            actuators: count,
            actuator: moved.map(|(index, _)| index),
            at_mm: moved.map(|(_, at)| at),
            ..Edit::default()
        },
    )
}

proptest! {
    #[test]
    fn what_is_bent_is_taken_within_limits_or_refused(text in bent()) {
        match Command::read(&text) {
            Ok(Command::Touch { finger, at_mm, .. }) => {
                prop_assert!(finger < 1000 && at_mm.iter().all(|mm| mm.is_finite() && mm.abs() <= 1e5));
            }
            Ok(Command::Measure(measure)) => prop_assert!((1..=16).contains(&measure.at.len())),
            Ok(_) => {}
            Err(refused) => prop_assert!(!refused.to_string().is_empty()),
        }
    }

    #[test]
    fn what_is_right_is_taken(right in prop::sample::select(&RIGHT[..])) {
        prop_assert!(Command::read(right).is_ok(), "{right}");
    }

    #[test]
    fn an_edit_makes_a_surface_or_nothing(edits in prop::collection::vec(edit(), 1..5)) {
        let mut draft = Draft::new(papers_surface());
        let mut made = vec![draft.surface().clone()];
        for edit in &edits {
            let before = draft.surface().clone();
            match draft.edit(edit) {
                Err(error) => {
                    prop_assert!(error.to_string().contains("expected"));
                    prop_assert_eq!(draft.surface(), &before);
                }
                Ok(()) => {
                    let said = parse_surface(&to_toml(draft.surface()), "saved");
                    prop_assert_eq!(&said.unwrap(), draft.surface());
                    if draft.surface() != &before {
                        made.push(draft.surface().clone());
                    }
                }
            }
        }
        for surface in made.iter().rev() {
            prop_assert_eq!(draft.surface(), surface);
            draft.undo();
        }
    }
}

#[test]
fn a_saved_surface_says_what_was_typed() {
    for tenths in 300_u32..1500 {
        let typed = f64::from(tenths) / 10.0;
        let mut draft = Draft::new(papers_surface());
        draft.edit(&Edit { rectangle_mm: Some([typed, 90.0]), ..Edit::default() }).unwrap();
        let text = to_toml(draft.surface());
        let said = text.lines().find(|line| line.contains("rectangle_mm")).unwrap();
        assert!(said.contains(&format!("[{typed},")), "{typed}: {said}");
    }
}
