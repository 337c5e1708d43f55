use crate::{AIR_CELERITY, Medium, PhysicsError};
use std::f64::consts::TAU;
use unripple_core::{Edge, Shape, Surface};

/// What modes are asked of: a rectangle, how it is held, and up to where.
#[derive(Debug)]
pub(crate) struct Problem {
    /// Width and height, in metres.
    pub(crate) sides: [f64; 2],
    /// The edges at the lower and upper end of x, then of y.
    pub(crate) edges: [[Edge; 2]; 2],
    /// The sheet, with its air.
    pub(crate) medium: Medium,
    /// Poisson's ratio.
    pub(crate) poisson: f64,
    /// Top frequency, in Hz.
    pub(crate) max_hz: f64,
    /// Wavenumber of the sheet at the top, air included, in rad/m.
    pub(crate) k_top: f64,
    /// Relative accuracy of the frequencies.
    pub(crate) accuracy: f64,
}

impl Problem {
    /// The problem a surface poses.
    pub(crate) fn of(surface: &Surface, max_hz: f64, accuracy: f64) -> Result<Self, PhysicsError> {
        let Shape::Rectangle { width, height } = surface.outline.shape else {
            return Err(PhysicsError::Unsupported {
                what: "outline of a surface whose modes are asked for",
                expected: "a rectangle",
                found: shape_name(&surface.outline.shape).to_owned(),
            });
        };
        let sheet = &surface.sheet;
        let medium = Medium::of(sheet);
        let positive = "a positive finite number";
        check("width", width, width > 0.0, positive)?;
        check("height", height, height > 0.0, positive)?;
        check("top frequency in Hz", max_hz, max_hz > 0.0, positive)?;
        check("mass per area in kg/m²", medium.areal_density, medium.areal_density > 0.0, positive)?;
        check("tension in N/m", medium.tension, medium.tension >= 0.0, "0 or more")?;
        let poisson = sheet.poisson;
        check("Poisson's ratio", poisson, poisson > -1.0 && poisson <= 0.5, "more than -1, at most 0.5")?;
        check(
            "bending stiffness in N·m",
            medium.bending_stiffness,
            medium.bending_stiffness >= 0.0,
            "0 or more",
        )?;
        let stiff = medium.tension + medium.bending_stiffness;
        check("tension and bending stiffness together", stiff, stiff > 0.0, "more than 0")?;
        check("accuracy", accuracy, (1e-12..=0.1).contains(&accuracy), "between 1e-12 and 0.1")?;
        let k_top = medium.wavenumber(TAU * max_hz);
        check(
            "top frequency in Hz",
            max_hz,
            k_top.is_finite() && k_top > 0.0,
            "a frequency that waves can have",
        )?;
        check_below_coincidence(&medium, max_hz)?;
        let edge = |side| surface.outline.edge(side);
        Ok(Self {
            sides: [width, height],
            edges: [[edge(3), edge(1)], [edge(0), edge(2)]],
            medium,
            poisson,
            max_hz,
            k_top,
            accuracy,
        })
    }

    /// Whether every mode is a product of two waves.
    pub(crate) fn separable(&self) -> bool {
        self.medium.bending_stiffness == 0.0
            || self.edges.as_flattened().iter().all(|e| *e == Edge::Supported)
    }

    /// Whether x and y may be exchanged.
    pub(crate) fn square(&self) -> bool {
        self.sides[0] == self.sides[1] && self.edges[0] == self.edges[1]
    }

    /// The sheet without its air.
    pub(crate) fn vacuum(&self) -> Medium {
        Medium { air_sides: 0.0, ..self.medium }
    }

    /// ω² of the top in vacuum, in 1/s².
    pub(crate) fn top_square(&self) -> f64 {
        self.vacuum().omega(self.k_top).powi(2)
    }

    /// Mass of the sheet, in kg.
    pub(crate) fn mass(&self) -> f64 {
        self.medium.areal_density * self.sides[0] * self.sides[1]
    }

    /// The frequency in air (rad/s) of a mode whose square in vacuum is given, its wavenumber kept: the air's added mass
    /// is that of a plane wave. Rigid modes keep theirs.
    pub(crate) fn omega_in_air(&self, square: f64) -> f64 {
        let omega = square.sqrt();
        if self.medium.air_sides > 0.0 { self.medium.omega(self.vacuum().wavenumber(omega)) } else { omega }
    }
}

/// A typed error unless `legal` and finite.
pub(crate) fn check(what: &str, found: f64, legal: bool, expected: &str) -> Result<(), PhysicsError> {
    if legal && found.is_finite() {
        return Ok(());
    }
    Err(PhysicsError::Range { what: what.to_owned(), expected: expected.to_owned(), found })
}

fn check_below_coincidence(medium: &Medium, max_hz: f64) -> Result<(), PhysicsError> {
    let always = medium.tension >= medium.areal_density * AIR_CELERITY * AIR_CELERITY;
    let coincidence_hz = if always { 0.0 } else { medium.coincidence_hz().unwrap_or(f64::INFINITY) };
    if medium.air_sides > 0.0 && max_hz >= coincidence_hz {
        return Err(PhysicsError::Coincidence { coincidence_hz, found_hz: max_hz });
    }
    Ok(())
}

fn shape_name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Rectangle { .. } => "a rectangle",
        Shape::Circle { .. } => "a circle",
        Shape::Stadium { .. } => "a stadium",
        Shape::Polygon(_) => "a polygon",
    }
}
