//! Nodes, units and functions of universal files: every form of data, odd files, and faults named by their place.

use crate::uff_text::{axis, binary, dataset, function, head};
use unripple_exchange::{Uff, read_uff, write_uff};

fn read(text: &str) -> Uff {
    read_uff(text.as_bytes(), "t.uff").unwrap()
}

fn refused(text: &[u8]) -> String {
    read_uff(text, "t.uff").unwrap_err().to_string()
}

/// The values of the only function of a file.
fn values(bytes: &[u8]) -> (bool, Vec<f64>) {
    let uff = read_uff(bytes, "t.uff").unwrap();
    assert_eq!(uff.functions.len(), 1);
    (uff.functions[0].complex, uff.functions[0].values.clone())
}

#[test]
fn nodes_of_both_datasets_and_units_are_read() {
    let units = dataset(
        "164",
        &[
            "         5mm (milli-newton)           2",
            "  1.00000000000000000D+03  1.00000000000000000D+03  1.00000000000000000D+00",
            "  2.73149999999999977D+02",
        ],
    );
    let old =
        dataset("15", &["         1         0         0         8  1.20000E+01  3.10000E+01  0.00000E+00"]);
    let new = dataset(
        "2411",
        &[
            "         2         1         1        11",
            "   6.2000000000000000D+01   9.0000000000000000D+01   0.0000000000000000D+00",
        ],
    );
    let other = dataset("151", &["whatever", "        -1", "is in it"]);
    let uff = read(&[units, old, new, other].concat());
    let known = uff.units.unwrap();
    assert_eq!(
        (known.code, known.name.as_str(), known.length, known.force),
        (5, "mm (milli-newton)", 1e3, 1e3)
    );
    assert_eq!(
        uff.nodes.iter().map(|n| (n.label, n.at)).collect::<Vec<_>>(),
        [(1, [12.0, 31.0, 0.0]), (2, [62.0, 90.0, 0.0])]
    );
    assert_eq!((uff.nodes[1].dataset, uff.nodes[1].line), (3, 13));
    assert_eq!(uff.others.get("151"), Some(&1));
}

#[test]
fn a_function_says_what_it_is() {
    let text = function(&head(5, 2, 1, 0.0, 2.5), &["  1.00000E+00  2.00000E+00 -3.00000E+00  4.00000E+00"]);
    let uff = read(&text);
    let f = &uff.functions[0];
    assert_eq!((f.kind, f.start, f.step, f.complex), (4, 0.0, 2.5, true));
    assert_eq!((f.response.name.as_str(), f.response.node, f.response.direction), ("", 12, 3));
    assert_eq!((f.reference.name.as_str(), f.reference.node, f.reference.direction), ("shaker", 7, -3));
    assert_eq!((f.numerator.quantity, f.numerator.unit.as_str()), (12, "m/s^2"));
    assert_eq!((f.denominator.quantity, f.denominator.label.as_str()), (13, "Force"));
    assert_eq!((f.title.as_str(), f.dataset, f.line), ("a plate", 1, 2));
    assert_eq!(f.values, [1.0, 2.0, -3.0, 4.0]);
}

#[test]
fn every_form_of_text_is_read() {
    let real_single: &[&str] = &["  1.00000E+00  2.00000E+00  3.00000E+00"];
    let real_double: &[&str] = &["  1.000000000000E+00  2.000000000000E+00  3.000000000000E+00"];
    let complex_double: &[&str] = &[
        "  1.000000000000E+00  2.000000000000E+00  3.000000000000D+00  4.000000000000E+00",
        "  5.000000000000E+00  6.000000000000E+00",
    ];
    for (data, spacing, lines, wanted) in [
        (2, 1, real_single, vec![1.0, 2.0, 3.0]),
        (4, 1, real_double, vec![1.0, 2.0, 3.0]),
        (6, 1, complex_double, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        // Abscissae 0, 0.5 and 1 before the values.
        (
            2,
            0,
            &["  0.00000E+00  1.00000E+00  5.00000E-01  2.00000E+00  1.00000E+00  3.00000E+00"],
            vec![1.0, 2.0, 3.0],
        ),
        (
            5,
            0,
            &[
                "  0.00000E+00  1.00000E+00  2.00000E+00  5.00000E-01  3.00000E+00  4.00000E+00",
                "  1.00000E+00  5.00000E+00  6.00000E+00",
            ],
            vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        ),
        (
            4,
            0,
            &[
                "  0.00000E+00  1.000000000000E+00  5.00000E-01  2.000000000000E+00",
                "  1.00000E+00  3.000000000000E+00",
            ],
            vec![1.0, 2.0, 3.0],
        ),
        (
            6,
            0,
            &[
                "  0.00000E+00  1.000000000000E+00  2.000000000000E+00",
                "  5.00000E-01  3.000000000000E+00  4.000000000000E+00",
                "  1.00000E+00  5.000000000000E+00  6.000000000000E+00",
            ],
            vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        ),
    ] {
        let text = function(&head(data, 3, spacing, 0.0, 0.5), lines);
        assert_eq!(values(text.as_bytes()), (data > 4, wanted), "{data} {spacing}");
        if spacing == 0 {
            let uff = read(&text);
            assert_eq!((uff.functions[0].start, uff.functions[0].step), (0.0, 0.5));
        }
    }
}

#[test]
fn both_orders_of_bytes_are_read() {
    let single = |order: u32, values: &[f32]| -> Vec<u8> {
        values.iter().flat_map(|v| if order == 1 { v.to_le_bytes() } else { v.to_be_bytes() }).collect()
    };
    let double = |order: u32, values: &[f64]| -> Vec<u8> {
        values.iter().flat_map(|v| if order == 1 { v.to_le_bytes() } else { v.to_be_bytes() }).collect()
    };
    for order in [1, 2] {
        let file = binary(&head(2, 3, 1, 0.0, 0.5), order, &single(order, &[1.0, -2.5, 3.0]));
        assert_eq!(values(&file), (false, vec![1.0, -2.5, 3.0]));
        let file = binary(&head(5, 2, 1, 0.0, 0.5), order, &single(order, &[1.0, -2.5, 3.0, 4.0]));
        assert_eq!(values(&file), (true, vec![1.0, -2.5, 3.0, 4.0]));
        let file = binary(&head(6, 1, 1, 0.0, 0.5), order, &double(order, &[1e-9, 2.0]));
        assert_eq!(values(&file), (true, vec![1e-9, 2.0]));
        // Abscissae of double and of single precision beside values of double precision.
        let wide = double(order, &[0.0, 1.0, 0.5, 2.0]);
        assert_eq!(values(&binary(&head(4, 2, 0, 0.0, 0.0), order, &wide)), (false, vec![1.0, 2.0]));
        let mixed =
            [single(order, &[0.0]), double(order, &[1.0]), single(order, &[0.5]), double(order, &[2.0])];
        assert_eq!(
            values(&binary(&head(4, 2, 0, 0.0, 0.0), order, &mixed.concat())),
            (false, vec![1.0, 2.0])
        );
        // As many bytes as the mark says, where complex values are counted as real ones.
        let file = binary(&head(6, 2, 1, 0.0, 0.5), order, &double(order, &[1.0, 2.0, 3.0, 4.0]));
        let counted = String::from_utf8_lossy(&file[..60]).replacen("          32", "          16", 1);
        assert_eq!(values(&[counted.as_bytes(), &file[60..]].concat()), (true, vec![1.0, 2.0, 3.0, 4.0]));
        // Said to be in the other order than they are.
        let sines: Vec<f32> = (1..=64_u8).map(|n| f32::from(n).sin()).collect();
        let error = refused(&binary(&head(2, 64, 1, 0.0, 0.5), order, &single(3 - order, &sines)));
        assert!(error.contains("significant byte first"), "{error}");
    }
}

#[test]
fn a_binary_function_may_hold_anything_that_looks_like_a_mark() {
    let mut bytes = b"\n    -1\n    58\n  ".to_vec();
    bytes.resize(16, b' ');
    let file = binary(&head(2, 4, 1, 0.0, 0.5), 1, &bytes);
    let twice = [file.clone(), file].concat();
    assert_eq!(read_uff(&twice, "t.uff").unwrap().functions.len(), 2);
}

#[test]
fn odd_files_are_read() {
    let text = function(&head(2, 3, 1, 0.0, 0.5), &["  1.00000E+00  2.00000E+00  3.00000E+00"]);
    let wanted = read(&text);
    // Padded to 80 columns, with other ends of lines, without the last of them, with blank lines and a mark too many.
    let padded: String = text.lines().map(|line| format!("{line:<80}\r\n")).collect();
    assert_eq!(read(&padded), wanted);
    assert_eq!(read(text.trim_end()), wanted);
    assert_eq!(read(&text.replace("    -1", "-1")), wanted);
    assert_eq!(read(&format!("{text}\n\n")), wanted);
    assert_eq!(read(&format!("{text}    -1\n")), wanted);
    let doubled = read(&format!("{}{text}", text.replace("    -1\n    58", "    -1\n    -1\n    58")));
    assert_eq!(doubled.functions.len(), 2);
}

#[test]
fn uneven_abscissae_are_refused_by_name() {
    let line = "  0.00000E+00  1.00000E+00  5.00000E-01  2.00000E+00  1.50000E+00  3.00000E+00";
    let error = refused(function(&head(2, 3, 0, 0.0, 0.0), &[line]).as_bytes());
    assert!(error.contains("dataset 1, line 9: expected an even abscissa"), "{error}");
    assert!(error.contains("found an uneven one: 0.5 as number 2"), "{error}");
    // Six digits make steps of 1/3 uneven in the last one.
    let line = "  0.00000E+00  1.00000E+00  3.33333E-01  2.00000E+00  6.66667E-01  3.00000E+00";
    let f = &read(&function(&head(2, 3, 0, 0.0, 0.0), &[line])).functions[0];
    assert!((f.step - 1.0 / 3.0).abs() < 1e-6);
}

#[test]
fn faults_are_named_by_dataset_and_line() {
    let good = "  1.00000E+00  2.00000E+00  3.00000E+00";
    let of = |head: &[String], lines: &[&str]| refused(function(head, lines).as_bytes());
    let plain = head(2, 3, 1, 0.0, 0.5);
    let changed = |at: usize, line: &str| {
        let mut head = plain.clone();
        head[at] = line.into();
        head
    };
    for (error, part) in [
        (
            of(&plain, &["  1.00000E+00          NaN  3.00000E+00"]),
            "line 14: expected a value, a finite number, found `NaN`",
        ),
        (of(&plain, &["  1.00000E+00  2.00000E+00"]), "line 14: expected a value, a finite number, found ``"),
        (of(&plain, &[good, good]), "line 15: expected -1 at the end of the dataset"),
        (of(&plain, &[&format!("{good}  4.00000E+00")]), "line 14: expected values in 39 columns"),
        (of(&head(2, 10_000_000, 1, 0.0, 0.5), &[good]), "expected 10000000 values, found"),
        (of(&head(2, 30, 1, 0.0, 0.5), &[good]), "found"),
        (of(&head(2, 0, 1, 0.0, 0.5), &[good]), "line 9: expected the number of values, from 1 up"),
        (of(&head(3, 3, 1, 0.0, 0.5), &[good]), "line 9: expected the type of the data"),
        (of(&head(2, 3, 2, 0.0, 0.5), &[good]), "line 9: expected the spacing"),
        (of(&head(2, 3, 1, 0.0, 0.0), &[good]), "expected a distance of abscissae above 0, found 0"),
        (
            of(&changed(5, "    x"), &[good]),
            "line 8: expected the kind of the function, an integer, in columns 1 to 5",
        ),
        (of(&changed(8, &axis(12, "", "")[..20]), &[" inf"]), "finite"),
        (refused(b"12\n"), "line 1: expected -1, which begins a dataset"),
        (refused(b"    -1\nwhat\n    -1\n"), "dataset 1, line 2: expected the number of a dataset"),
        (refused(b""), "found an empty file"),
        (refused(b"    -1\n    15\n         x\n    -1\n"), "line 3: expected the number of a node"),
        (
            refused(b"    -1\n  2411\n         1\n    -1\n"),
            "expected the coordinates of a node, found the end",
        ),
        (refused(b"    -1\n   164\n         1\n  0.0D+00\n    -1\n"), "a factor of lengths above 0"),
    ] {
        assert!(error.contains(part), "{error}: {part}");
    }
}

#[test]
fn files_that_are_cut_short_are_refused_wherever_that_is() {
    let text = function(
        &head(5, 3, 1, 0.0, 0.5),
        &["  1.00000E+00  2.00000E+00  3.00000E+00  4.00000E+00  5.00000E+00  6.00000E+00"],
    );
    let marked = text.trim_end().len();
    for end in 7..marked - 1 {
        assert!(read_uff(&text.as_bytes()[..end], "t.uff").is_err(), "{end}: {:?}", &text[..end]);
    }
    let file = binary(&head(4, 2, 1, 0.0, 0.5), 1, &[0; 16]);
    let error = refused(&file[..file.len() - 20]);
    assert!(error.contains("expected 16 bytes of values, found"), "{error}");
}

#[test]
fn what_is_written_is_read_again() {
    let third = 1.0 / 3.0;
    let text = function(&head(5, 2, 1, 0.0, 2.5), &["  1.00000E+00  2.00000E+00 -3.00000E+00  4.00000E+00"]);
    let mut uff = read(&text);
    let pair = format!("{:<25}{:<25}", "1.0D0", "1.0D0");
    uff.units = read(&dataset("164", &["         1SI                           2", &pair, "0.0D0"])).units;
    uff.nodes = read(&dataset("2411", &["         7", &pair])).nodes;
    uff.nodes[0].at = [third, -1e-9 * third, 0.0];
    uff.functions[0].values = vec![third, -third * 1e20, 0.0, 1e-100];
    let again = read_uff(&write_uff(&uff).unwrap(), "t.uff").unwrap();
    assert_eq!(again.units, uff.units);
    assert_eq!(again.nodes[0].at, uff.nodes[0].at);
    let (f, g) = (&again.functions[0], &uff.functions[0]);
    assert_eq!(
        (&f.response, &f.reference, &f.numerator, &f.denominator),
        (&g.response, &g.reference, &g.numerator, &g.denominator)
    );
    assert_eq!(
        (f.kind, f.start, f.step, f.complex, &f.title),
        (g.kind, g.start, g.step, g.complex, &g.title)
    );
    for (a, b) in f.values.iter().zip(&g.values) {
        assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} {b}");
    }
    uff.functions[0].reference.name = "a name too long".into();
    assert!(write_uff(&uff).unwrap_err().to_string().contains("names of at most 10"));
}
