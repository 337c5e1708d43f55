//! A good surface file, and the faults of what becomes of it.

use unripple_store::{Fault, parse_surface};

pub const GOOD: &str = r#"format = 1
name = "film"
[outline]
rectangle_mm = [150, 100]
edge = "clamped"
[sheet]
material = "BoPET"
thickness_mm = 0.125
tension_n_per_m = 200
decay_time_ms = 70
air = "none"
[drive]
band_hz = [0, 3000]
sample_rate_hz = 48000
[[actuator]]
name = "left"
at_mm = [12, 31]
kind = "force"
"#;

pub fn faults(text: &str) -> Vec<Fault> {
    parse_surface(text, "film.toml").map_or_else(|faults| faults.faults().to_vec(), |_| Vec::new())
}

/// The one fault after `from` becomes `to` in the good file.
pub fn fault(from: &str, to: &str) -> Fault {
    assert!(GOOD.contains(from), "{from}");
    let list = faults(&GOOD.replacen(from, to, 1));
    assert_eq!(list.len(), 1, "{list:#?}");
    list[0].clone()
}

/// The line of text of the one fault.
pub fn says(from: &str, to: &str) -> String {
    let fault = fault(from, to);
    format!("{}:{}: {fault}", fault.line, fault.column)
}
