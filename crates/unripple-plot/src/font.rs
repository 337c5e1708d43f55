//! The typeface of all figures, embedded and parsed once.

use resvg::usvg::fontdb;
use std::sync::{Arc, LazyLock};

/// Family name of the typeface, with a metrically close fall-back for viewers of the SVG that lack it.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

/// Height of a digit over the font size. The typeface's own measure.
pub(crate) const DIGIT_HEIGHT: f64 = 0.729;

/// Depth of letters such as g and p below their line, over the font size. The typeface's own measure.
pub(crate) const DESCENT: f64 = 0.208;

/// The embedded typeface, parsed once at its first use.
static DATABASE: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut database = fontdb::Database::new();
    database.load_font_source(fontdb::Source::Binary(Arc::new(dejavu::sans::regular())));
    database.set_sans_serif_family("DejaVu Sans");
    Arc::new(database)
});

/// The database the renderer looks its font up in.
pub(crate) fn database() -> Arc<fontdb::Database> {
    DATABASE.clone()
}

/// Advance of every character of the Basic Multilingual Plane's first 0x2300 code points, in thousandths of the size.
/// They hold Latin, Greek and the signs of units; what lies beyond counts as [`WIDEST`].
static ADVANCES: LazyLock<Vec<u16>> = LazyLock::new(|| {
    let Ok(face) = ttf_parser::Face::parse(dejavu::sans::regular(), 0) else {
        return Vec::new();
    };
    let units = f64::from(face.units_per_em());
    let advance = |code: u32| {
        let glyph = face.glyph_index(char::from_u32(code)?)?;
        Some((f64::from(face.glyph_hor_advance(glyph)?) / units * 1e3).round() as u16)
    };
    (0..0x2300).map(|code| advance(code).unwrap_or(WIDEST)).collect()
});

/// Advance of a character that is not in the table, in thousandths of the size: rather too much room than letters
/// that overlap.
const WIDEST: u16 = 1000;

/// Width of a line of text, in the unit of `size`.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let advance = |c: char| f64::from(ADVANCES.get(c as usize).copied().unwrap_or(WIDEST));
    text.chars().map(advance).sum::<f64>() * size / 1e3
}

/// A text broken at its spaces into lines at most `most` wide, in the unit of `size`; a wider word has a line of its own.
pub(crate) fn broken(text: &str, most: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_typeface_has_every_sign_a_figure_needs() {
        let face = ttf_parser::Face::parse(dejavu::sans::regular(), 0).unwrap();
        for sign in "−×·±µμλτρσωΔ√∞≤≥°²³⁰¹⁴⁵⁶⁷⁸⁹⁻₀₁₂₃½→≈".chars()
        {
            assert!(face.glyph_index(sign).is_some(), "{sign}");
        }
    }

    #[test]
    fn widths_add_up_and_scale() {
        let (a, b) = (width("Time ", 8.0), width("(ms)", 8.0));
        assert!((width("Time (ms)", 8.0) - a - b).abs() < 1e-12);
        assert!((width("Time (ms)", 16.0) - 2.0 * (a + b)).abs() < 1e-12);
        assert!(width("iii", 8.0) < width("mmm", 8.0));
        assert_eq!(width("", 8.0), 0.0);
    }

    #[test]
    fn text_is_broken_at_spaces_where_it_is_too_wide() {
        let most = width("at the focal", 8.0);
        assert_eq!(broken("at the focal instant", most, 8.0), ["at the focal", "instant"]);
        assert_eq!(broken("at the focal instant", 1.0, 8.0), ["at", "the", "focal", "instant"]);
        assert_eq!(broken("at the  focal ", 1e3, 8.0), ["at the focal"]);
        assert!(broken("", 1e3, 8.0).is_empty());
    }
}
