//! The 256 colours of a movie.

use crate::colour::Rgb;
use crate::colourmap::ColourMap;

/// Colours of the map, an odd number so that a diverging one keeps its middle; fewer, and bands show in a smooth
/// field.
const MAP: usize = 127;
/// Greys from black to white, for text: as many steps as its smooth rims need to look smooth.
const GREYS: usize = 33;
/// Colours of the map that are also held mixed with black or white, for the rims of what lies over the field. 127 +
/// 33 + 3 x 32 = 256 colours, which an indexed picture may have.
const MIXED: usize = 32;

/// A palette, and the nearest of its colours to any other.
#[derive(Clone, Debug)]
pub(crate) struct Inks {
    colours: Vec<Rgb>,
    /// Nearest colour of each cell of a cube of 32 x 32 x 32.
    nearest: Vec<u8>,
}

impl Inks {
    /// The palette for a colour map.
    pub fn new(map: ColourMap) -> Self {
        let position = |i: usize, count: usize| i as f64 / (count - 1) as f64;
        let mut colours: Vec<Rgb> = (0..MAP).map(|i| map.colour(position(i, MAP))).collect();
        colours.extend((0..GREYS).map(|i| {
            let grey = (255.0 * position(i, GREYS)).round() as u8;
            Rgb(grey, grey, grey)
        }));
        for (share, other) in [(1.0 / 3.0, 0.0), (2.0 / 3.0, 0.0), (0.5, 255.0)] {
            let mix = |channel: u8| (f64::from(channel) * (1.0 - share) + other * share).round() as u8;
            colours.extend((0..MIXED).map(|i| {
                let Rgb(r, g, b) = map.colour(position(i, MIXED));
                Rgb(mix(r), mix(g), mix(b))
            }));
        }
        let nearest = (0..32 * 32 * 32).map(|cell| closest(&colours, cell)).collect();
        Self { colours, nearest }
    }

    /// Index of the map's colour at a position from 0 to 1.
    pub fn of(&self, position: f64) -> u8 {
        (position.clamp(0.0, 1.0) * (MAP - 1) as f64 + 0.5) as u8
    }

    /// Index, 0 to 255, of the palette's colour nearest to any other.
    pub fn nearest(&self, Rgb(r, g, b): Rgb) -> u8 {
        match (r, g, b) {
            (255, 255, 255) => (MAP + GREYS - 1) as u8,
            _ => self.nearest[usize::from(r >> 3) << 10 | usize::from(g >> 3) << 5 | usize::from(b >> 3)],
        }
    }

    /// The colour of an index.
    pub fn colour(&self, index: u8) -> Rgb {
        self.colours[usize::from(index)]
    }

    /// The colours as the bytes of a PNG palette, `[colour][red, green, blue]`.
    pub fn palette(&self) -> Vec<u8> {
        self.colours.iter().flat_map(|&Rgb(r, g, b)| [r, g, b]).collect()
    }
}

/// Index of the colour nearest to the middle of a cell of the cube.
fn closest(colours: &[Rgb], cell: usize) -> u8 {
    let middle = |shift: usize| ((cell >> shift & 31) as i32) * 8 + 4;
    let (r, g, b) = (middle(10), middle(5), middle(0));
    let distance = |Rgb(x, y, z): &Rgb| {
        let (dr, dg, db) = (i32::from(*x) - r, i32::from(*y) - g, i32::from(*z) - b);
        2 * dr * dr + 4 * dg * dg + 3 * db * db
    };
    (0..=u8::MAX).zip(colours).min_by_key(|(_, colour)| distance(colour)).map_or(0, |(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_palette_is_full_and_every_colour_has_a_near_one() {
        for map in [ColourMap::Diverging, ColourMap::Sequential] {
            let inks = Inks::new(map);
            assert_eq!(inks.colours.len(), 256);
            for colour in [Rgb::BLACK, Rgb::WHITE, Rgb::GREY, map.colour(0.2), map.colour(0.9)] {
                let Rgb(r, g, b) = inks.colour(inks.nearest(colour));
                let off = r.abs_diff(colour.0).max(g.abs_diff(colour.1)).max(b.abs_diff(colour.2));
                assert!(off <= 16, "{colour} became {}", Rgb(r, g, b));
            }
            assert_eq!(inks.colour(inks.nearest(Rgb::WHITE)), Rgb::WHITE);
        }
    }
}
