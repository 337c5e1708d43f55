//! The local properties of a sheet: mass per area, tension and bending stiffness at each point.

use crate::PhysicsError;
use unripple_core::{Grain, Point, Profile, Scatterer, ScattererKind, Surface, require};

/// The properties of a sheet at one point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Local {
    /// Mass per area, in kg/m².
    pub(crate) mass: f64,
    /// Tension, in N/m.
    pub(crate) tension: f64,
    /// Bending stiffness D11, D12, D16, D22, D26, D66 for the curvatures u_xx, u_yy and 2u_xy, in N·m.
    pub(crate) bending: [f64; 6],
}

/// A sheet with its orthotropy, its profiles, and the masses and discs fixed to it.
///
/// The bending energy is ½∫κᵀDκ, κ = (u_xx, u_yy, 2u_xy); D grows as the thickness cubed, the mass as the thickness. With a glued
/// disc the sheet is a laminate of two layers (Jones, *Mechanics of Composite Materials*, 1999, section 4.2) with extensional
/// stiffness A, coupling stiffness B and bending stiffness D. Without in-plane forces its bending stiffness is D - B A⁻¹ B. Where
/// discs overlap, the additions of each to the bare sheet are summed.
#[derive(Clone, Debug)]
pub(crate) struct Fabric {
    /// Width and height of the bounding box that profiles span, in metres.
    extent: (f64, f64),
    /// The properties of the sheet where all factors of its profiles are 1.
    nominal: Local,
    /// The nominal sheet as a layer: elastic moduli in Pa, thickness in metres.
    layer: Layer,
    thickness: Option<Profile>,
    tension: Option<Profile>,
    added_mass: Option<Profile>,
    discs: Vec<Disc>,
    masses: Vec<(Point, f64)>,
}

/// A layer in plane stress: Q11, Q12, Q16, Q22, Q26, Q66 for the strains ε_x, ε_y and γ_xy, in Pa, and its thickness in
/// metres.
#[derive(Clone, Copy, Debug)]
struct Layer {
    moduli: [f64; 6],
    thickness: f64,
}

/// A disc glued to the sheet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disc {
    /// Centre of the disc, in metres.
    pub(crate) at: Point,
    /// Radius of the disc, in metres.
    pub(crate) radius: f64,
    /// Mass per area of the disc, in kg/m².
    mass: f64,
    layer: Layer,
}

/// Allowed values of a thickness, a mass or a radius, in words.
const POSITIVE: &str = "a positive finite number";
/// Allowed values of a tension or a point mass, in words.
const NOT_NEGATIVE: &str = "0 or more";
/// Allowed values of Poisson's ratio of an isotropic solid, in words.
const POISSON: &str = "more than -1, at most 0.5";

impl Fabric {
    /// The local properties of a surface's sheet.
    ///
    /// # Errors
    /// [`PhysicsError::Range`] for a thickness or its factor, a mass per area, a grain's moduli or a disc's radius that is not
    /// positive; for a negative tension, point mass or Young's modulus; for ν12 ν21 of 1 or more. The mass per area checked is the least
    /// of the sheet's plus the least of the added mass.
    pub(crate) fn of(surface: &Surface) -> Result<Self, PhysicsError> {
        let (sheet, uneven) = (&surface.sheet, &surface.sheet.uneven);
        let range = |profile: &Option<Profile>, plain: f64| profile.as_ref().map_or(plain, |p| p.range().0);
        let (thinnest, slackest) = (range(&uneven.thickness, 1.0), range(&uneven.tension, 1.0));
        require("thickness in m", sheet.thickness > 0.0, POSITIVE, sheet.thickness)?;
        require("least factor of the thickness", thinnest > 0.0, POSITIVE, thinnest)?;
        require("tension in N/m", sheet.tension >= 0.0, NOT_NEGATIVE, sheet.tension)?;
        require("least factor of the tension", slackest >= 0.0, NOT_NEGATIVE, slackest)?;
        let mass = sheet.density * sheet.thickness;
        let lightest = mass * thinnest + range(&uneven.added_mass, 0.0);
        require("least mass per area in kg/m²", lightest > 0.0, POSITIVE, lightest)?;
        let moduli = moduli(sheet.young, sheet.poisson, uneven.grain)?;
        let layer = Layer { moduli, thickness: sheet.thickness };
        let nominal = Local { mass, tension: sheet.tension, bending: layer.bending() };
        let mut fabric = Self {
            extent: surface.outline.extent(),
            nominal,
            layer,
            thickness: uneven.thickness.clone(),
            tension: uneven.tension.clone(),
            added_mass: uneven.added_mass.clone(),
            discs: Vec::new(),
            masses: Vec::new(),
        };
        uneven.scatterers.iter().try_for_each(|scatterer| fabric.fix(scatterer))?;
        if !fabric.bends() && fabric.masses.iter().any(|(_, mass)| *mass > 0.0) {
            // The compliance of a membrane at a point is infinite.
            return Err(PhysicsError::Unsupported {
                what: "a point mass on a sheet without bending stiffness",
                expected: "a disc, or a sheet that resists bending",
                found: "a mass at a point, where such a sheet gives way".into(),
            });
        }
        Ok(fabric)
    }

    /// Adds a scatterer: a mass at a point, or a disc glued on.
    fn fix(&mut self, scatterer: &Scatterer) -> Result<(), PhysicsError> {
        match scatterer.kind {
            ScattererKind::Mass(mass) => {
                require("point mass in kg", mass >= 0.0, NOT_NEGATIVE, mass)?;
                self.masses.push((scatterer.at, mass));
            }
            ScattererKind::Disc { radius, thickness, young, density, poisson } => {
                require("radius of a disc in m", radius > 0.0, POSITIVE, radius)?;
                require("thickness of a disc in m", thickness > 0.0, POSITIVE, thickness)?;
                require("density of a disc in kg/m³", density >= 0.0, NOT_NEGATIVE, density)?;
                let layer = Layer { moduli: moduli(young, poisson, None)?, thickness };
                self.discs.push(Disc { at: scatterer.at, radius, mass: density * thickness, layer });
            }
        }
        Ok(())
    }

    /// The properties of the bare sheet if it is uniform; `None` if it has profiles.
    pub(crate) fn uniform(&self) -> Option<Local> {
        let even = self.thickness.is_none() && self.tension.is_none() && self.added_mass.is_none();
        even.then_some(self.nominal)
    }

    /// Whether the bare sheet resists bending.
    pub(crate) fn bends(&self) -> bool {
        self.nominal.bending.iter().any(|d| *d != 0.0)
    }

    /// The properties of the sheet at a point (m), with its discs: mass in kg/m², tension in N/m, bending
    /// stiffness in N·m.
    #[cfg(test)]
    pub(crate) fn at(&self, point: Point) -> Local {
        let on = self.discs.iter().filter(|disc| disc.at.distance(point) <= disc.radius);
        on.fold(self.bare(point), |sum, disc| sum.plus(&self.added_by(disc, point)))
    }

    /// The properties of the sheet without discs at a point (m): mass in kg/m², tension in N/m, bending
    /// stiffness in N·m.
    pub(crate) fn bare(&self, point: Point) -> Local {
        let factor = |p: &Option<Profile>| p.as_ref().map_or(1.0, |p| p.at(point, self.extent));
        let thickness = factor(&self.thickness);
        let added = self.added_mass.as_ref().map_or(0.0, |p| p.at(point, self.extent));
        Local {
            mass: self.nominal.mass * thickness + added,
            tension: self.nominal.tension * factor(&self.tension),
            bending: self.nominal.bending.map(|d| d * thickness.powi(3)),
        }
    }

    /// What a disc adds to the properties of the sheet at a point (m) under it: mass in kg/m², bending
    /// stiffness in N·m.
    pub(crate) fn added_by(&self, disc: &Disc, point: Point) -> Local {
        let factor = self.thickness.as_ref().map_or(1.0, |p| p.at(point, self.extent));
        let sheet = Layer { thickness: self.layer.thickness * factor, ..self.layer };
        let (both, alone) = (laminate(&sheet, &disc.layer), sheet.bending());
        Local { mass: disc.mass, tension: 0.0, bending: std::array::from_fn(|i| both[i] - alone[i]) }
    }

    /// The discs glued to the sheet.
    pub(crate) fn discs(&self) -> &[Disc] {
        &self.discs
    }

    /// The point masses on the sheet: position (m) and mass in kg.
    pub(crate) fn masses(&self) -> &[(Point, f64)] {
        &self.masses
    }
}

impl Local {
    /// The sum of two sets of properties.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            tension: self.tension + other.tension,
            bending: std::array::from_fn(|i| self.bending[i] + other.bending[i]),
        }
    }
}

impl Layer {
    /// Bending stiffness of the layer about its own middle plane, Q h³/12.
    fn bending(&self) -> [f64; 6] {
        self.moduli.map(|q| q * self.thickness.powi(3) / 12.0)
    }
}

/// Plane-stress moduli, turned to the grain's direction: Q11 = E1/(1 - ν12 ν21), Q12 = ν12 Q22, Q66 = G, and ν21 = ν12 E2/E1
/// (Jones, *Mechanics of Composite Materials*, 1999, section 2.6).
fn moduli(young: f64, poisson: f64, grain: Option<Grain>) -> Result<[f64; 6], PhysicsError> {
    require("Young's modulus in Pa", young >= 0.0, NOT_NEGATIVE, young)?;
    let Some(grain) = grain else {
        require("Poisson's ratio", poisson > -1.0 && poisson <= 0.5, POISSON, poisson)?;
        let q = young / (1.0 - poisson * poisson);
        return Ok([q, poisson * q, 0.0, q, 0.0, young / (2.0 * (1.0 + poisson))]);
    };
    require("Young's modulus along the grain in Pa", young > 0.0, POSITIVE, young)?;
    require(
        "Young's modulus across the grain in Pa",
        grain.young_across > 0.0,
        POSITIVE,
        grain.young_across,
    )?;
    require("shear modulus in Pa", grain.shear > 0.0, POSITIVE, grain.shear)?;
    require("direction of the grain in rad", true, "a finite number", grain.direction)?;
    let product = poisson * poisson * grain.young_across / young;
    require("ν12 ν21 of a sheet with a grain", product < 1.0, "less than 1", product)?;
    let (q11, q22) = (young / (1.0 - product), grain.young_across / (1.0 - product));
    Ok(turned([q11, poisson * q22, 0.0, q22, 0.0, grain.shear], grain.direction))
}

/// Moduli of a material whose axes are rotated by an angle (rad): Tᵀ Q T, where T transforms strains to the material's axes.
fn turned(moduli: [f64; 6], angle: f64) -> [f64; 6] {
    let (s, c) = angle.sin_cos();
    let t = [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2.0 * c * s, 2.0 * c * s, c * c - s * s]];
    let q = square(moduli);
    let entry = |i: usize, j: usize| {
        (0..9).map(|n| (n / 3, n % 3)).map(|(a, b)| t[a][i] * q[a][b] * t[b][j]).sum::<f64>()
    };
    [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)]
}

/// Bending stiffness of two layers glued together, without in-plane forces: D - B A⁻¹ B about the sheet's middle plane.
fn laminate(sheet: &Layer, disc: &Layer) -> [f64; 6] {
    let (h, d) = (sheet.thickness, disc.thickness);
    let middle = 0.5 * (h + d);
    let bent = d * (d * d / 12.0 + middle * middle);
    let blend = |of_sheet: f64, of_disc: f64| {
        std::array::from_fn(|i| of_sheet * sheet.moduli[i] + of_disc * disc.moduli[i])
    };
    let (a, b, whole) = (square(blend(h, d)), square(blend(0.0, d * middle)), blend(h * h * h / 12.0, bent));
    let Some(inverse) = inverse(&a) else { return whole };
    let coupled = |i: usize, j: usize| {
        (0..9).map(|n| (n / 3, n % 3)).map(|(p, q)| b[i][p] * inverse[p][q] * b[q][j]).sum::<f64>()
    };
    let places = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
    std::array::from_fn(|n| whole[n] - coupled(places[n].0, places[n].1))
}

/// The symmetric matrix with the entries 11, 12, 16, 22, 26, 66 in Voigt notation.
fn square([a, b, c, d, e, f]: [f64; 6]) -> [[f64; 3]; 3] {
    [[a, b, c], [b, d, e], [c, e, f]]
}

/// The inverse of a symmetric matrix by its cofactors; `None` if it is singular.
fn inverse(m: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cofactor = |i: usize, j: usize| {
        let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    let regular = determinant.abs() > 0.0 && determinant.is_finite();
    regular.then(|| std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / determinant)))
}
