//! Colours, and a palette safe for colour blindness.

use std::f64::consts::PI;

/// An sRGB colour of eight bits a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rgb(
    /// Red, 0 to 255.
    pub u8,
    /// Green, 0 to 255.
    pub u8,
    /// Blue, 0 to 255.
    pub u8,
);

impl Rgb {
    /// Black, for text and axes.
    pub const BLACK: Self = Self(0, 0, 0);
    /// White, the background of figures.
    pub const WHITE: Self = Self(255, 255, 255);
    /// A middle grey for guides. About half as light as paper, so that guides stay behind the data.
    pub const GREY: Self = Self(120, 120, 120);

    /// The seven saturated colours of Okabe and Ito (2008), which remain distinct under every common colour blindness,
    /// ordered so that the first few differ most on white; the index wraps round.
    pub fn palette(index: usize) -> Self {
        const COLOURS: [Rgb; 7] = [
            Rgb(0, 114, 178),
            Rgb(213, 94, 0),
            Rgb(0, 158, 115),
            Rgb(204, 121, 167),
            Rgb(86, 180, 233),
            Rgb(230, 159, 0),
            Rgb(0, 0, 0),
        ];
        COLOURS[index % COLOURS.len()]
    }
}

impl std::fmt::Display for Rgb {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

/// A colour in Oklab's polar form: lightness 0 to 1, chroma, hue in radians (B. Ottosson, 2020).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oklch {
    /// Lightness as seen, 0 (black) to 1 (white).
    pub lightness: f64,
    /// Distance from grey; up to about 0.3 on a screen.
    pub chroma: f64,
    /// Hue in radians.
    pub hue: f64,
}

impl Oklch {
    /// A colour from its lightness (0 to 1), its chroma (from 0, about 0.3 at most on a screen) and its hue
    /// in degrees.
    pub fn new(lightness: f64, chroma: f64, degrees: f64) -> Self {
        Self { lightness, chroma, hue: degrees * PI / 180.0 }
    }

    /// Lightness and the two opponent coordinates `[L, a, b]`, between which distances are perceptual.
    pub fn lab(self) -> [f64; 3] {
        [self.lightness, self.chroma * self.hue.cos(), self.chroma * self.hue.sin()]
    }

    /// Linear light `[red, green, blue]`; outside 0 to 1 where a screen cannot show the colour.
    pub fn linear_rgb(self) -> [f64; 3] {
        let [lightness, a, b] = self.lab();
        let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
        let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
        let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
        [
            4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
            -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
            -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
        ]
    }

    /// The nearest eight-bit colour, channels clipped.
    pub fn rgb(self) -> Rgb {
        let [r, g, b] = self.linear_rgb().map(|linear| {
            let linear = linear.clamp(0.0, 1.0);
            let encoded =
                if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
            (encoded * 255.0).round() as u8
        });
        Rgb(r, g, b)
    }
}
