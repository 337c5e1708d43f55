//! Numbers of things in reports.

/// A number of things that are named as one is: `1 layout`, `2 layouts`.
pub(crate) fn several(number: usize, one: &str) -> String {
    format!("{number} {one}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::several;

    #[test]
    fn one_thing_is_no_plural() {
        assert_eq!([0, 1, 2].map(|number| several(number, "layout")), ["0 layouts", "1 layout", "2 layouts"]);
    }
}
