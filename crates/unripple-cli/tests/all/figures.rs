//! Figures: what they say of themselves, how wide they are, and what is drawn of a library.

use crate::common;

use common::{Scratch, json, number, refused};

const FILM: &str = "format = 1\nname = \"A film\"\n[outline]\nrectangle_mm = [150, 150]\n[sheet]\nmaterial = \"BoPET\"\n\
                    thickness_mm = 0.125\ntension_n_per_m = 200\ndecay_time_ms = 70\n[drive]\nband_hz = [0, 700]\n\
                    sample_rate_hz = 16000\n[[actuator]]\nat_mm = [12, 31]\n[[actuator]]\nat_mm = [140, 44]\n";

fn text(out: &str, name: &str) -> String {
    std::fs::read_to_string(format!("{out}/{name}")).unwrap()
}

#[test]
fn figures_say_what_they_show() {
    let scratch = Scratch::new("figures");
    let (file, out, shown) = (scratch.file("film.toml", FILM), scratch.join("out"), scratch.join("shown"));
    json(&["focus", &file, "--at", "62,90", "--window-ms", "20", "-o", &out]);
    let holds = |out: &str, figure: &str, said: &str| {
        let drawn = text(out, figure);
        assert!(drawn.contains(said), "{said} in {figure}");
    };
    holds(&out, "focus.svg", ">at the focal instant, t\u{a0}=\u{a0}20.00\u{a0}ms</text>");
    holds(&out, "focus.svg", ">when largest at the target,");
    holds(&out, "traces.svg", ">focal instant</text>");
    for said in ["velocity", "displacement"] {
        holds(&out, "traces.svg", &format!(">{said} at the target</text>"));
    }
    holds(&out, "traces.svg", ">(62, 90) mm</text>");
    holds(&out, "traces-a.csv", "\"(62, 90) mm\",20,");
    let drive = format!("{out}/drive.wav");
    let field = ["field", &file, "--drive", &drive, "--at", "62,90", "--frames", "0", "-o", &shown];
    json(&field);
    holds(&shown, "snapshot.svg", ">at the instant of largest velocity,");
    json(&[&field[..], &["--at-ms", "19"]].concat());
    holds(&shown, "snapshot.svg", ">at the instant asked for, t\u{a0}=\u{a0}19.00\u{a0}ms</text>");
    holds(&shown, "traces.svg", ">instant asked for</text>");
}
