//! Universal files written by hand, in the columns that their description prescribes.

/// A dataset between its marks.
pub fn dataset(number: &str, lines: &[&str]) -> String {
    format!("    -1\n{number:>6}\n{}\n    -1\n", lines.join("\n"))
}

/// The quantity of an axis: its number, name and unit.
pub fn axis(quantity: u32, label: &str, unit: &str) -> String {
    format!("{quantity:10}{:5}{:5}{:5} {label:<20} {unit:<20}", 0, 0, 0)
}

/// Records 1 to 11 of a function: type and number of its data, spacing, first abscissa and distance, and the response's quantity.
pub fn head(data: u32, count: usize, spacing: u32, start: f64, step: f64) -> Vec<String> {
    vec![
        "a plate".into(),
        "NONE".into(),
        "01-Jan-00 00:00:00".into(),
        "NONE".into(),
        "NONE".into(),
        format!(
            "{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}",
            4, 1, 0, 0, "NONE", 12, 3, "shaker", 7, -3
        ),
        format!(
            "{data:10}{count:10}{spacing:10}{:>13}{:>13}{:>13}",
            format!("{start:.5e}"),
            format!("{step:.5e}"),
            "0.0"
        ),
        axis(18, "Frequency", "Hz"),
        axis(12, "Acceleration", "m/s^2"),
        axis(13, "Force", "N"),
        axis(0, "NONE", "NONE"),
    ]
}

/// A function as text, of these lines of values.
pub fn function(head: &[String], values: &[&str]) -> String {
    let lines: Vec<&str> = head.iter().map(String::as_str).chain(values.iter().copied()).collect();
    dataset("58", &lines)
}

/// A binary function: the order and the bytes of its values.
pub fn binary(head: &[String], order: u32, values: &[u8]) -> Vec<u8> {
    let first = format!("    58b{order:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", 2, 11, values.len(), 0, 0, 0, 0);
    let mut file = format!("    -1\n{first}\n{}\n", head.join("\n")).into_bytes();
    file.extend_from_slice(values);
    file.extend_from_slice(b"\n    -1\n");
    file
}
