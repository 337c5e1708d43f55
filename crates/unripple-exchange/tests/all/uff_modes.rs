//! Modes of universal files: normal and complex ones, and what is refused.

use crate::uff_text::dataset;
use unripple_exchange::{Mode, Uff, read_uff, write_uff};

/// Records 1 to 5 of a dataset of modes.
const DESCRIPTION: [&str; 5] = ["a plate", "NONE", "NONE", "NONE", "NONE"];

fn of(lines: &[&str]) -> Vec<u8> {
    dataset("55", &[&DESCRIPTION[..], lines].concat()).into_bytes()
}

fn mode(lines: &[&str]) -> Mode {
    let mut modes = read_uff(&of(lines), "t.uff").unwrap().modes;
    assert_eq!(modes.len(), 1);
    modes.remove(0)
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 5e-6 * b.abs()
}

#[test]
fn a_normal_mode_is_read() {
    let read = mode(&[
        "         1         2         2         8         2         3",
        "         2         4         1         5",
        "  1.00000E+02  2.00000E+00  6.00000E-01  0.00000E+00",
        "         7",
        "  0.00000E+00  0.00000E+00  5.00000E-01",
        "         8",
        "  0.00000E+00  0.00000E+00 -2.50000E-01",
    ]);
    let omega = 200.0 * std::f64::consts::PI;
    assert_eq!((read.number, read.quantity, read.complex, read.scale), (5, 8, false, [2.0, 0.0]));
    assert!(near(read.eigenvalue[0], -0.6 * omega) && near(read.eigenvalue[1], 0.8 * omega), "{read:?}");
    assert_eq!(
        read.shape,
        [(7, vec![[0.0; 2], [0.0; 2], [0.5, 0.0]]), (8, vec![[0.0; 2], [0.0; 2], [-0.25, 0.0]])]
    );
}

#[test]
fn hysteretic_damping_is_half_its_loss_factor_at_resonance() {
    let read = mode(&[
        "         1         2         1         8         2         1",
        "         2         4         1         1",
        "  1.00000E+02  1.00000E+00  0.00000E+00  2.00000E-02",
        "         7",
        "  1.00000E+00",
    ]);
    assert!(near(-read.eigenvalue[0] / read.eigenvalue[0].hypot(read.eigenvalue[1]), 0.01));
}

#[test]
fn a_complex_mode_is_read_and_written() {
    let read = mode(&[
        "         1         3         2         8         5         3",
        "         2         6         1         1",
        " -1.00000E+01  6.28000E+02  0.00000E+00  1.25600E+03  0.00000E+00  0.00000E+00",
        "         7",
        "  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  5.00000E-01  1.00000E-01",
    ]);
    assert_eq!((read.eigenvalue, read.scale, read.complex), ([-10.0, 628.0], [0.0, 1256.0], true));
    assert_eq!(read.shape[0].1[2], [0.5, 0.1]);
    let written = write_uff(&Uff { modes: vec![read.clone()], ..Uff::default() }).unwrap();
    let again = read_uff(&written, "t.uff").unwrap().modes.remove(0);
    assert_eq!((again.shape, again.scale, again.complex), (read.shape, read.scale, true));
    assert!(near(again.eigenvalue[0], -10.0) && near(again.eigenvalue[1], 628.0));
}

#[test]
fn a_normal_mode_is_written_with_six_digits() {
    let shape =
        (1..=9).map(|node| (node, vec![[0.0; 2], [0.0; 2], [f64::from(node as i32) / 7.0, 0.0]])).collect();
    let known = Mode {
        number: 3,
        quantity: 8,
        eigenvalue: [-1.5, 777.0],
        scale: [1.0, 0.0],
        shape,
        ..Mode::default()
    };
    let written = write_uff(&Uff { modes: vec![known.clone()], ..Uff::default() }).unwrap();
    let again = read_uff(&written, "t.uff").unwrap().modes.remove(0);
    assert_eq!((again.number, again.quantity, again.scale), (3, 8, [1.0, 0.0]));
    assert!(near(again.eigenvalue[1], 777.0) && (again.eigenvalue[0] + 1.5).abs() < 1e-5, "{again:?}");
    for (a, b) in again.shape.iter().zip(&known.shape) {
        assert!(a.0 == b.0 && near(a.1[2][0], b.1[2][0]));
    }
}

#[test]
fn faults_are_named_by_their_lines() {
    let kind = "         1         2         1         8         2         1";
    let numbers = "         2         4         1         1";
    let parameters = "  1.00000E+02  1.00000E+00  0.00000E+00  0.00000E+00";
    for (lines, part) in [
        (vec![kind, numbers, "  1.00000E+02  1.00000E+00  1.00000E+00"], "a damping ratio from 0 to below 1"),
        (
            vec!["         1         5         1         8         2         1", numbers, parameters],
            "the kind of analysis 2",
        ),
        (
            vec!["         1         2         1         8         4         1", numbers, parameters],
            "the type of the data 2",
        ),
        (
            vec!["         1         2         1         8         2      9999", numbers, parameters],
            "1 to 9 values of a node, found 9999",
        ),
        (
            vec![kind, numbers, parameters, "         1"],
            "line 12: expected the values of a node, found the end of the dataset",
        ),
        (
            vec![kind, numbers, parameters, "         1", "          inf"],
            "line 12: expected a value, a finite number",
        ),
    ] {
        let error = read_uff(&of(&lines), "t.uff").unwrap_err().to_string();
        assert!(error.contains(part), "{error}: {part}");
    }
}
