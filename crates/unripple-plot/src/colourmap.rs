//! Perceptually uniform colour maps (Oklab).

use crate::colour::{Oklch, Rgb};
use std::sync::LazyLock;

/// A perceptually uniform colour map, computed in Oklab so that equal steps of the value are equal steps to the eye.
///
/// # Example
/// ```
/// use unripple_plot::{ColourMap, Rgb};
/// let middle = ColourMap::Diverging.colour(0.5);
/// assert!(middle.0 > 240 && middle.2 > 240); // zero is white
/// assert_ne!(ColourMap::Sequential.colour(0.0), ColourMap::Sequential.colour(1.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourMap {
    /// Dark violet through blue and green to light yellow, for values of one sign. Lightness rises throughout.
    Sequential,
    /// Blue through white to red, symmetric in lightness about its middle, for signed values.
    #[default]
    Diverging,
}

/// Number of colours a map is tabulated in; odd, so that the diverging map has an exact middle.
pub(crate) const LEVELS: usize = 255;

/// The two maps as tables, made once at their first use.
static SEQUENTIAL: LazyLock<[Rgb; LEVELS]> = LazyLock::new(|| tabulate(sequential));
static DIVERGING: LazyLock<[Rgb; LEVELS]> = LazyLock::new(|| tabulate(diverging));

impl ColourMap {
    /// The colour at a position from 0 to 1, clamped; not-a-number gives the colour at 0.
    pub fn colour(self, position: f64) -> Rgb {
        self.colours()[level(position)]
    }

    /// The whole table, from 0 to 1.
    pub(crate) fn colours(self) -> &'static [Rgb; LEVELS] {
        match self {
            Self::Sequential => &SEQUENTIAL,
            Self::Diverging => &DIVERGING,
        }
    }
}

/// Index into a map's table of a position from 0 to 1.
pub(crate) fn level(position: f64) -> usize {
    (position.clamp(0.0, 1.0) * (LEVELS - 1) as f64).round() as usize
}

/// Lightness from dark to light while the hue turns from violet to yellow, chroma kept where a screen can show it.
fn sequential(t: f64) -> Oklch {
    let chroma = 0.085 + 0.07 * t.powi(3) + 0.03 * (1.0 - t).powi(4);
    Oklch::new(0.25 + 0.68 * t, chroma, 300.0 - 195.0 * t)
}

/// Two arms of one lightness and chroma profile, blue below the middle and red above.
fn diverging(t: f64) -> Oklch {
    let side = 2.0 * t - 1.0;
    let chroma = 0.152 * (side.abs() / 0.42).tanh() / (1.0f64 / 0.42).tanh();
    Oklch::new(0.975 - 0.575 * side.abs(), chroma, if side < 0.0 { 262.0 } else { 27.0 })
}

/// Samples a path at equal distances along it in Oklab.
fn tabulate(path: fn(f64) -> Oklch) -> [Rgb; LEVELS] {
    const FINE: usize = 4096;
    let at = |i: usize| i as f64 / FINE as f64;
    let mut travelled = vec![0.0; FINE + 1];
    for i in 0..FINE {
        let (p, q) = (path(at(i)).lab(), path(at(i + 1)).lab());
        let step = p.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        travelled[i + 1] = travelled[i] + step;
    }
    std::array::from_fn(|level| {
        let wanted = travelled[FINE] * level as f64 / (LEVELS - 1) as f64;
        let next = travelled.partition_point(|&distance| distance < wanted).clamp(1, FINE);
        let (before, after) = (travelled[next - 1], travelled[next]);
        let within = (wanted - before) / (after - before);
        path(at(next - 1) + within.clamp(0.0, 1.0) / FINE as f64).rgb()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE L* of an sRGB colour (IEC 61966-2-1, D65), another space than the one the maps are made in.
    fn cie_lightness(Rgb(r, g, b): Rgb) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let y = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        if y > 216.0 / 24389.0 { 116.0 * y.cbrt() - 16.0 } else { y * 24389.0 / 27.0 }
    }

    fn lightness(map: ColourMap) -> Vec<f64> {
        map.colours().iter().map(|&colour| cie_lightness(colour)).collect()
    }

    #[test]
    fn sequential_lightness_rises_throughout() {
        let lightness = lightness(ColourMap::Sequential);
        for pair in lightness.windows(4) {
            assert!(pair[3] > pair[0], "{pair:?}");
        }
        assert!(lightness[0] < 25.0 && lightness[LEVELS - 1] > 85.0, "{lightness:?}");
    }

    #[test]
    fn diverging_lightness_rises_to_its_middle_and_falls_symmetrically() {
        let lightness = lightness(ColourMap::Diverging);
        let half = LEVELS / 2;
        for i in 0..half - 3 {
            assert!(lightness[i + 3] > lightness[i]);
            assert!(lightness[LEVELS - 4 - i] > lightness[LEVELS - 1 - i]);
        }
        for i in 0..LEVELS {
            assert!((lightness[i] - lightness[LEVELS - 1 - i]).abs() < 3.0, "{i}");
        }
        assert!(lightness[half] > 96.0);
    }

    #[test]
    fn every_colour_can_be_shown_unclipped() {
        for path in [sequential, diverging] {
            for i in 0..=1000 {
                let rgb = path(f64::from(i) / 1000.0).linear_rgb();
                assert!(rgb.iter().all(|c| (-1e-3..=1.001).contains(c)), "{i} {rgb:?}");
            }
        }
    }

    #[test]
    fn equal_steps_look_equal() {
        for map in [ColourMap::Sequential, ColourMap::Diverging] {
            let lightness = lightness(map);
            let steps: Vec<f64> =
                (16..LEVELS).step_by(16).map(|i| (lightness[i] - lightness[i - 16]).abs()).collect();
            let mean = steps.iter().sum::<f64>() / steps.len() as f64;
            assert!(steps.iter().all(|s| (0.4..1.7).contains(&(s / mean))), "{map:?} {steps:?}");
        }
    }

    #[test]
    fn odd_positions_are_clamped() {
        for map in [ColourMap::Sequential, ColourMap::Diverging] {
            assert_eq!(map.colour(f64::NAN), map.colour(0.0));
            assert_eq!(map.colour(-3.0), map.colour(0.0));
            assert_eq!(map.colour(f64::INFINITY), map.colour(1.0));
        }
    }
}
