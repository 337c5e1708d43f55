//! Quantities of a surface that natural frequencies may tell, each as a factor on what its file says.

use unripple_core::{Edge, Edges, Surface};

/// A quantity of a surface that is fitted: it is multiplied by one factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Tension of the sheet, in N/m.
    Tension,
    /// All moduli of the sheet together, told by Young's modulus (along the grain, if there is one), in Pa.
    Modulus,
    /// Young's modulus along the grain alone, in Pa.
    YoungAlong,
    /// Young's modulus across the grain alone, in Pa.
    YoungAcross,
    /// Shear modulus of a sheet with grain alone, in Pa.
    Shear,
    /// Springs of all sides of the outer rim together, told by the first of them.
    Spring,
    /// Translational springs of all sides of the outer rim together, in N/m².
    Lift,
    /// Rotational springs of all sides of the outer rim together, in N.
    Tilt,
    /// Springs of one side of the outer rim, by its index in the order of the file.
    Side(usize),
}

/// The name of the springs of a single side, without its number.
const SIDE: &str = "spring-";

/// Quantities that have a name of their own.
const NAMED: [(&str, Quantity); 8] = [
    ("tension", Quantity::Tension),
    ("modulus", Quantity::Modulus),
    ("young-along", Quantity::YoungAlong),
    ("young-across", Quantity::YoungAcross),
    ("shear", Quantity::Shear),
    ("spring", Quantity::Spring),
    ("lift", Quantity::Lift),
    ("tilt", Quantity::Tilt),
];

impl Quantity {
    /// Names of all quantities, for messages.
    pub fn names() -> String {
        let names: Vec<&str> = NAMED.iter().map(|(name, _)| *name).collect();
        format!("{}, {SIDE}1 and so on for one side", names.join(", "))
    }

    /// The quantity of this name; `None` if there is none.
    pub fn named(name: &str) -> Option<Self> {
        let side = || name.strip_prefix(SIDE)?.parse::<usize>().ok()?.checked_sub(1).map(Self::Side);
        NAMED.iter().find(|(known, _)| *known == name).map(|(_, quantity)| *quantity).or_else(side)
    }

    /// The name of this quantity; sides are counted from 1, in the order of the file.
    pub fn name(self) -> String {
        match self {
            Self::Side(side) => format!("{SIDE}{}", side + 1),
            _ => NAMED.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| *name).to_owned(),
        }
    }

    /// Quantities that are fitted where none are named: of a sheet under tension the tension, of a plate its modulus or, with grain, its
    /// three moduli; and the springs, if a side of the outer rim has any.
    pub fn usual(surface: &Surface) -> Vec<Self> {
        let sheet = &surface.sheet;
        let mut all = match (sheet.tension > 0.0, sheet.uneven.grain.is_some()) {
            (true, _) => vec![Self::Tension],
            (false, true) => vec![Self::YoungAlong, Self::YoungAcross, Self::Shear],
            (false, false) => vec![Self::Modulus],
        };
        if Self::Spring.value(surface).is_some() {
            all.push(Self::Spring);
        }
        all
    }

    /// The quantity's value for a surface, in SI units; `None` if the surface has none or if it is 0, which no factor changes. That of
    /// springs is the translational stiffness, or the rotational one where there is no other.
    pub fn value(self, surface: &Surface) -> Option<f64> {
        let sheet = &surface.sheet;
        let grain = sheet.uneven.grain.as_ref();
        let found = match self {
            Self::Tension => sheet.tension,
            Self::Modulus => sheet.young,
            Self::YoungAlong => grain.map(|_| sheet.young)?,
            Self::YoungAcross => grain?.young_across,
            Self::Shear => grain?.shear,
            Self::Spring => springs(surface).find_map(|(_, lift, tilt)| first(lift, tilt))?,
            Self::Lift => springs(surface).map(|(_, lift, _)| lift).find(|lift| *lift > 0.0)?,
            Self::Tilt => springs(surface).map(|(_, _, tilt)| tilt).find(|tilt| *tilt > 0.0)?,
            Self::Side(side) => {
                let (_, lift, tilt) = springs(surface).find(|(i, ..)| *i == side)?;
                first(lift, tilt)?
            }
        };
        (found > 0.0).then_some(found)
    }

    /// The unit of [`Quantity::value`] for a surface.
    pub fn unit(self, surface: &Surface) -> &'static str {
        let lifts = |side: Option<usize>| {
            springs(surface).any(|(i, lift, _)| lift > 0.0 && side.is_none_or(|side| side == i))
        };
        match self {
            Self::Tension => "N/m",
            Self::Modulus | Self::YoungAlong | Self::YoungAcross | Self::Shear => "Pa",
            Self::Spring if lifts(None) => "N/m²",
            Self::Side(side) if lifts(Some(side)) => "N/m²",
            Self::Lift => "N/m²",
            Self::Spring | Self::Side(_) | Self::Tilt => "N",
        }
    }

    /// Multiplies this quantity of a surface by a factor.
    pub fn scale(self, surface: &mut Surface, factor: f64) {
        let sheet = &mut surface.sheet;
        match self {
            Self::Tension => sheet.tension *= factor,
            Self::Modulus => {
                sheet.young *= factor;
                if let Some(grain) = &mut sheet.uneven.grain {
                    grain.young_across *= factor;
                    grain.shear *= factor;
                }
            }
            Self::YoungAlong => sheet.young *= factor,
            Self::YoungAcross => {
                if let Some(grain) = &mut sheet.uneven.grain {
                    grain.young_across *= factor;
                }
            }
            Self::Shear => {
                if let Some(grain) = &mut sheet.uneven.grain {
                    grain.shear *= factor;
                }
            }
            Self::Spring => each_spring(surface, |_| true, [factor, factor]),
            Self::Lift => each_spring(surface, |_| true, [factor, 1.0]),
            Self::Tilt => each_spring(surface, |_| true, [1.0, factor]),
            Self::Side(side) => each_spring(surface, |i| i == side, [factor, factor]),
        }
    }
}

/// The translational stiffness, or else the rotational one.
fn first(lift: f64, tilt: f64) -> Option<f64> {
    [lift, tilt].into_iter().find(|stiffness| *stiffness > 0.0)
}

/// The sides of the outer rim that have springs: index, translational and rotational stiffness.
pub(super) fn springs(surface: &Surface) -> impl Iterator<Item = (usize, f64, f64)> + '_ {
    let count = surface.outline.shape.sides().len();
    (0..count).filter_map(|side| match surface.outline.edges.of(side) {
        Edge::Elastic { lift, tilt } => Some((side, lift, tilt)),
        _ => None,
    })
}

/// Multiplies both stiffnesses of the sides that `which` chooses by two factors.
fn each_spring(surface: &mut Surface, which: impl Fn(usize) -> bool, [by_lift, by_tilt]: [f64; 2]) {
    let outline = &mut surface.outline;
    let scaled = |side: usize, edge: Edge| match edge {
        Edge::Elastic { lift, tilt } if which(side) => {
            Edge::Elastic { lift: lift * by_lift, tilt: tilt * by_tilt }
        }
        other => other,
    };
    let count = outline.shape.sides().len();
    outline.edges = match &outline.edges {
        Edges::All(edge) if (0..count).all(&which) => Edges::All(scaled(0, *edge)),
        edges => Edges::PerSide((0..count).map(|side| scaled(side, edges.of(side))).collect()),
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        let sides = [Quantity::Side(0), Quantity::Side(3)];
        for quantity in NAMED.iter().map(|(_, quantity)| *quantity).chain(sides) {
            assert_eq!(Quantity::named(&quantity.name()), Some(quantity));
        }
        for wrong in ["", "spring-0", "spring-x", "spring-", "density"] {
            assert_eq!(Quantity::named(wrong), None, "{wrong}");
        }
    }
}
