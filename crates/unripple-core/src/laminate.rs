//! Layered sheets reduced to one homogeneous layer of the same bending stiffness: classical lamination
//! theory.

use crate::Material;

/// One layer of a laminate.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Young's modulus in Pa.
    pub young: f64,
    /// Mass density in kg/m³.
    pub density: f64,
    /// Poisson's ratio, without a unit.
    pub poisson: f64,
    /// Tensile strength in Pa, if known.
    pub strength: Option<f64>,
    /// Thickness in metres.
    pub thickness: f64,
}

impl Layer {
    /// A layer of a built-in material, `thickness` in metres.
    pub fn of(material: &Material, thickness: f64) -> Self {
        let &Material { young, density, poisson, strength, .. } = material;
        Self { young, density, poisson, strength: Some(strength), thickness }
    }

    /// Stiffness in plane strain, E/(1−ν²), in Pa.
    fn stiffness(&self) -> f64 {
        self.young / (1.0 - self.poisson * self.poisson)
    }
}

/// A homogeneous sheet with the mass, the bending stiffness and the strength of a laminate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laminate {
    /// Young's modulus in Pa with which a homogeneous sheet of this thickness has the bending stiffness of
    /// the laminate.
    pub young: f64,
    /// Mean density in kg/m³.
    pub density: f64,
    /// Mean Poisson's ratio, weighted by in-plane stiffness.
    pub poisson: f64,
    /// Tensile strength in Pa of the homogeneous sheet: its stress where the first layer of the laminate
    /// yields, in tension or in bending, whichever is less. `None` if the strength of some layer is
    /// unknown.
    pub strength: Option<f64>,
    /// Total thickness of all layers in metres.
    pub thickness: f64,
    /// Height of the neutral plane above the underside of the first layer, in metres.
    pub neutral: f64,
}

impl Laminate {
    /// The laminate of layers bonded without slip, listed from the underside up. `None` if the list is
    /// empty, or if the total thickness or the total in-plane stiffness is not positive.
    ///
    /// The neutral plane lies where bending stretches nothing in all: z₀ = Σ Qᵢ tᵢ zᵢ / Σ Qᵢ tᵢ with Qᵢ = Eᵢ/(1−νᵢ²), tᵢ the layers' thicknesses
    /// and zᵢ their middles. The bending stiffness about it is D = Σ Qᵢ (tᵢ³/12 + tᵢ (zᵢ − z₀)²) (Jones, *Mechanics of Composite Materials*,
    /// 1999, eq. 4.22 to 4.24, where coupling of bending and stretching vanishes by the choice of the plane).
    ///
    /// ```
    /// use unripple_core::{Laminate, Layer, Material};
    ///
    /// let glass = Material::named("glass").expect("a built-in material");
    /// let whole = Laminate::of(&[Layer::of(glass, 1.1e-3)]).expect("a layer");
    /// let halves = Laminate::of(&[Layer::of(glass, 0.5e-3), Layer::of(glass, 0.6e-3)]).expect("layers");
    /// assert!((whole.young / halves.young - 1.0).abs() < 1e-12 && (whole.neutral / halves.neutral - 1.0).abs() < 1e-12);
    /// ```
    pub fn of(layers: &[Layer]) -> Option<Self> {
        let sum = |of: &dyn Fn(&Layer) -> f64| layers.iter().map(of).sum::<f64>();
        let thickness = sum(&|layer| layer.thickness);
        let stretching = sum(&|layer| layer.stiffness() * layer.thickness);
        if !(thickness > 0.0 && stretching > 0.0) {
            return None;
        }
        let mut bottom = 0.0;
        let spans: Vec<[f64; 2]> = layers
            .iter()
            .map(|layer| {
                bottom += layer.thickness;
                [bottom - layer.thickness, bottom]
            })
            .collect();
        let middle = |span: &[f64; 2]| (span[0] + span[1]) / 2.0;
        let placed = || layers.iter().zip(&spans);
        let neutral =
            placed().map(|(l, span)| l.stiffness() * l.thickness * middle(span)).sum::<f64>() / stretching;
        let bending = placed().map(|(l, span)| {
            l.stiffness() * (l.thickness.powi(3) / 12.0 + l.thickness * (middle(span) - neutral).powi(2))
        });
        let bending = bending.sum::<f64>();
        let poisson = sum(&|layer| layer.stiffness() * layer.thickness * layer.poisson) / stretching;
        let young = 12.0 * bending * (1.0 - poisson * poisson) / thickness.powi(3);
        // Curvature and strain at which a layer yields; a layer without stiffness never does.
        let yields = placed().filter(|(layer, _)| layer.young > 0.0).map(|(layer, span)| {
            let farthest = (span[0] - neutral).abs().max((span[1] - neutral).abs());
            let strain = layer.strength? / layer.young;
            Some([strain / farthest, strain])
        });
        let yields = yields.collect::<Option<Vec<_>>>();
        let least =
            |i: usize| yields.as_ref().map(|all| all.iter().map(|y| y[i]).fold(f64::INFINITY, f64::min));
        let strength =
            least(0).zip(least(1)).map(|(curvature, strain)| young * strain.min(curvature * thickness / 2.0));
        let density = sum(&|layer| layer.density * layer.thickness) / thickness;
        Some(Self { young, density, poisson, strength, thickness, neutral })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(young: f64, density: f64, poisson: f64, thickness: f64) -> Layer {
        Layer { young, density, poisson, strength: Some(100e6), thickness }
    }

    /// Bending stiffness per width of a laminate, from its equivalent sheet.
    fn bending(laminate: &Laminate) -> f64 {
        laminate.young * laminate.thickness.powi(3) / 12.0 / (1.0 - laminate.poisson.powi(2))
    }

    #[test]
    fn a_bimetal_has_timoshenkos_stiffness() {
        // Timoshenko 1925, eq. 4 with equal Poisson's ratios: D = E₁t₁³/(12(1−ν²)) · K, K = 4 + 6m + 4m² + nm³ + 1/(nm) over (1 + 1/(nm)).
        let (t1, t2, e1, e2, nu): (f64, f64, f64, f64, f64) = (0.4e-3, 0.9e-3, 200e9, 70e9, 0.3);
        let (m, n) = (t1 / t2, e1 / e2);
        let k = (4.0 + 6.0 * m + 4.0 * m * m + n * m.powi(3) + 1.0 / (n * m)) / (1.0 + n * m) * (n * m);
        let exact = e2 * t2.powi(3) / (12.0 * (1.0 - nu * nu)) * k;
        let found = Laminate::of(&[layer(e1, 7900.0, nu, t1), layer(e2, 2700.0, nu, t2)]).unwrap();
        assert!((bending(&found) / exact - 1.0).abs() < 1e-12, "{} {exact}", bending(&found));
    }

    #[test]
    fn a_sandwich_bends_about_its_middle() {
        // Faces of thickness t about a core of thickness c: D = Q (t³/6 + t (c + t)²/2) + Q_c c³/12.
        let (t, c) = (0.3e-3, 2e-3);
        let (face, core) = (layer(70e9, 2700.0, 0.33, t), layer(0.1e9, 100.0, 0.33, c));
        let q = |e: f64| e / (1.0 - 0.33 * 0.33);
        let exact = q(70e9) * (t.powi(3) / 6.0 + t * (c + t).powi(2) / 2.0) + q(0.1e9) * c.powi(3) / 12.0;
        let found = Laminate::of(&[face.clone(), core, face]).unwrap();
        assert!((bending(&found) / exact - 1.0).abs() < 1e-12);
        assert!((found.neutral - (c / 2.0 + t)).abs() < 1e-15);
        assert!((found.density * found.thickness - 2.0 * 2700.0 * t - 100.0 * c).abs() < 1e-12);
    }

    #[test]
    fn the_first_layer_that_yields_decides() {
        let brittle = Layer { strength: Some(10e6), ..layer(70e9, 2500.0, 0.22, 1e-3) };
        let film = layer(4e9, 1400.0, 0.3, 0.2e-3);
        let found = Laminate::of(&[brittle.clone(), film.clone()]).unwrap();
        // The glass's underside is farther from the neutral plane than its top: it yields first, and in bending.
        let curvature = 10e6 / 70e9 / found.neutral;
        let by_bending = found.young * curvature * found.thickness / 2.0;
        assert!((found.strength.unwrap() / by_bending.min(found.young * 10e6 / 70e9) - 1.0).abs() < 1e-12);
        assert_eq!(Laminate::of(&[Layer { strength: None, ..film }, brittle]).unwrap().strength, None);
        assert_eq!(Laminate::of(&[]), None);
    }
}
