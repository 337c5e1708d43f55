//! Interpolation of responses at any place from those at measured points: kriging with the covariance of waves.

use super::medium::{SpectralLine, Waves};
use super::neighbourhood::{Patches, nearest};
use super::options::{BetweenOptions, Interpolation};
use super::spectra::Spectra;
use super::stray::StrayTrial;
use super::system::distances;
use super::triangles::Triangles;
use super::uncertainty::Uncertainty;
use crate::CalibrateError;
use rayon::prelude::*;
use unripple_core::{Point, SampledResponses};

/// Number of frequencies at which the expected error is computed; between them it is interpolated linearly, since it is smooth in
/// frequency. Twice as many take twice as long and change the result little.
const NODES: usize = 32;

/// Number of nearest points from which the expected error is computed: points farther away explain hardly anything. The work
/// grows with the cube of this number.
const WITNESSES: usize = 160;

/// Interpolator of impulse responses: computes the responses at any place from those at measured points.
///
/// With [`Interpolation::Kernel`], the field of each actuator is modelled, frequency by frequency, as a random isotropic field of
/// the sheet's wavenumber k, whose values at two places a distance r apart have the covariance J0(kr) (Cook et al., J. Acoust.
/// Soc. Am. 27, 1955, in two dimensions). The most likely value at a place, given those at the points, is that of a Gaussian
/// process (Rasmussen and Williams, *Gaussian Processes for Machine Learning*, 2006, eqs. 2.25 and 2.26):
///
/// ```text
/// h(x) = k(x)ᵀ (K + N)⁻¹ h,   variance 1 - k(x)ᵀ (K + N)⁻¹ k(x)
/// ```
///
/// where h are the responses at the points, K their covariances with each other, k(x) those with the place x, and N the power of
/// noise, of gain errors and of position errors. The equations are solved once; each new place costs one product.
///
/// Kriging returns frequencies up to [`BetweenOptions::top`] only; the two simpler methods interpolate the samples themselves,
/// unfiltered.
///
/// ```
/// use unripple_calibrate::{Between, BetweenOptions};
/// use unripple_core::{Conditions, Outline, Point, Port, SampledResponses, Shape};
///
/// // A wave of 300 Hz and 50 m/s to the right, known every 40 mm, a quarter of its length.
/// let k = |omega: f64| omega / 50.0;
/// let omega = std::f64::consts::TAU * 300.0;
/// let wave = |x: f64, i: usize| ((k(omega) * x).cos() * (omega * i as f64 / 8e3).cos()) as f32;
/// let points: Vec<Point> =
///     (0..40).map(|i| Point::new(0.02 + 0.04 * f64::from(i % 8), 0.02 + 0.04 * f64::from(i / 8))).collect();
/// let data = points.iter().flat_map(|p| (0..161).map(|i| wave(p.x, i))).collect();
/// let outline = Outline::new(Shape::Rectangle { width: 0.32, height: 0.2 });
/// let conditions = Conditions { rate: 8e3, band: [0.0, 400.0], lambda_min: 0.125, outline };
/// let ports = vec![Port { name: "a1".into(), at: Point::new(0.01, 0.01) }];
/// let measured = SampledResponses::new(ports, points, conditions, 161, data)?;
///
/// let between = Between::plan(&measured, k, &BetweenOptions::default())?;
/// let place = Point::new(0.155, 0.1);
/// let found = between.at(place)?;
/// assert!((0..161).all(|i| (found.response(0, 0)[i] - wave(place.x, i)).abs() < 0.05));
/// assert!(between.error(place)?.relative < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Between<'r> {
    responses: &'r SampledResponses,
    spectra: Spectra,
    waves: Waves,
    way: Way,
}

#[derive(Debug)]
enum Way {
    Nearest,
    Linear(Triangles),
    Kernel(Patches),
}

impl<'r> Between<'r> {
    /// Prepares the interpolation of `responses` between their points; `wavenumber` gives k (rad/m) of the sheet's waves at an
    /// angular frequency (rad/s).
    ///
    /// # Errors
    /// [`CalibrateError::Count`] without points, actuators or samples; [`CalibrateError::Range`] for options, wavenumbers or
    /// responses out of range; [`CalibrateError::Singular`] if two points coincide and their responses are said to have no
    /// errors.
    pub fn plan(
        responses: &'r SampledResponses,
        wavenumber: impl Fn(f64) -> f64,
        options: &BetweenOptions,
    ) -> Result<Self, CalibrateError> {
        options.check()?;
        let spectra = Spectra::of(responses, options.top)?;
        let outline = &responses.conditions.outline;
        let points = &responses.points;
        let pitch = (outline.area() / points.len() as f64).sqrt();
        let (width, height) = outline.extent();
        let waves = Waves::of(&spectra, wavenumber, 1.0 / pitch, width.hypot(height), options)?;
        let way = match options.interpolation {
            Interpolation::Nearest => Way::Nearest,
            Interpolation::Linear => Way::Linear(Triangles::of(points)),
            Interpolation::Kernel => Way::Kernel(Patches::of(&spectra, &waves, points, options.most)?),
        };
        Ok(Self { responses, spectra, waves, way })
    }

    /// The responses of every actuator at one place.
    ///
    /// # Errors
    /// [`CalibrateError::Outside`] for a place that is not on the surface.
    pub fn at(&self, place: Point) -> Result<SampledResponses, CalibrateError> {
        self.onto(&[place])
    }

    /// The responses of every actuator at several places, such as those of a denser grid; `places` are the points of the result.
    ///
    /// # Errors
    /// As [`Between::at`].
    pub fn onto(&self, places: &[Point]) -> Result<SampledResponses, CalibrateError> {
        for (place, at) in places.iter().enumerate() {
            self.check(place, *at)?;
        }
        let (actuators, samples) = (self.responses.ports.len(), self.responses.samples());
        let mut data = vec![0.0; places.len() * actuators * samples];
        data.par_chunks_mut(actuators * samples)
            .zip(places)
            .for_each(|(responses, place)| self.respond(*place, responses));
        let conditions = self.responses.conditions.clone();
        Ok(SampledResponses::new(self.responses.ports.clone(), places.to_vec(), conditions, samples, data)?)
    }

    /// Expected error of the interpolated responses at a place (m): the kriging variance, or the error
    /// variance of the fixed weights of the simpler methods. For kriging, the share of stray waves is
    /// estimated around the place: each of the nearest points is left out in turn and predicted from the
    /// others, and the share is chosen that explains the differences. Beside a stray mass it is much larger
    /// than elsewhere.
    ///
    /// # Errors
    /// As [`Between::at`], and [`CalibrateError::Singular`] if the covariance matrix is not positive definite.
    pub fn error(&self, place: Point) -> Result<Uncertainty, CalibrateError> {
        self.check(0, place)?;
        let bins = self.spectra.bins();
        let nodes: Vec<usize> = (0..NODES).map(|i| i * (bins - 1) / (NODES - 1)).collect();
        let witnesses = nearest(&self.responses.points, place, WITNESSES);
        let points: Vec<Point> = witnesses.iter().map(|i| self.responses.points[*i]).collect();
        let (apart, away) =
            (distances(&points), points.iter().map(|p| p.distance(place)).collect::<Vec<_>>());
        let weights = self.weights(place);
        if let Some(weights) = &weights {
            let known: Vec<f64> =
                nodes.iter().map(|node| self.plain_share(&self.line(*node), weights, place)).collect();
            return Ok(self.uncertainty(&nodes, &known));
        }
        let trial = |node: &usize| -> Result<StrayTrial, CalibrateError> {
            let (line, reach) = (self.line(*node), self.around(*node));
            let values = self.spectra.normalised(*node, reach, &witnesses, 1.0 + line.error);
            let hz = *node as f64 * self.spectra.step;
            StrayTrial::of(&self.waves, &line, &apart, &away, &values)
                .ok_or(CalibrateError::Singular { points: points.len(), hz })
        };
        let trials = nodes.par_iter().map(trial).collect::<Result<Vec<_>, _>>()?;
        Ok(self.uncertainty(&nodes, &StrayTrial::shares(&trials)))
    }

    fn check(&self, place: usize, at: Point) -> Result<(), CalibrateError> {
        let outline = &self.responses.conditions.outline;
        if outline.contains(at) {
            return Ok(());
        }
        Err(CalibrateError::Outside { place, at, nearest: outline.nearest(at) })
    }

    /// Indices and weights of the points that the two simpler methods use, the same at all frequencies; `None` for kriging.
    fn weights(&self, place: Point) -> Option<Vec<(usize, f64)>> {
        match &self.way {
            Way::Nearest => Some(self.responses.nearest(place).map(|i| (i, 1.0)).into_iter().collect()),
            Way::Linear(triangles) => Some(triangles.weights(place)),
            Way::Kernel(_) => None,
        }
    }

    /// The responses at a place, `[actuator][sample]`.
    fn respond(&self, place: Point, responses: &mut [f32]) {
        let (actuators, samples) = (self.responses.ports.len(), self.responses.samples());
        if let Way::Kernel(patches) = &self.way {
            let Some(neighbourhood) = patches.around(place) else { return };
            let bins = neighbourhood.bins(&self.waves, place, actuators);
            responses.par_chunks_mut(samples).enumerate().for_each(|(actuator, response)| {
                let own = bins.iter().skip(actuator).step_by(actuators).copied();
                self.spectra.cosines.response(own, response);
            });
            return;
        }
        for (point, weight) in self.weights(place).unwrap_or_default() {
            for (actuator, response) in responses.chunks_mut(samples).enumerate() {
                let from = self.responses.response(actuator, point);
                response.iter_mut().zip(from).for_each(|(to, h)| *to += weight as f32 * h);
            }
        }
    }

    /// The bins around one over which powers and errors are averaged.
    fn around(&self, bin: usize) -> std::ops::Range<usize> {
        let reach = self.waves.lines.len() / NODES + 6;
        bin.saturating_sub(reach)..(bin + reach).min(self.waves.lines.len())
    }

    /// Covariance model of a bin, with its relative error averaged over the bins around: the power of a
    /// single bin mostly depends on how far it is from a resonance.
    fn line(&self, bin: usize) -> SpectralLine {
        let (mut errors, mut powers) = (0.0, f64::MIN_POSITIVE);
        for bin in self.around(bin) {
            let power = self.spectra.power(bin);
            errors += power * self.waves.lines[bin].error;
            powers += power;
        }
        SpectralLine { error: errors / powers, ..self.waves.lines[bin] }
    }

    /// Expected power of the error of interpolation with fixed weights w: wᵀ (K + N) w - 2 wᵀ k + 1, relative to the field's
    /// power.
    fn plain_share(&self, line: &SpectralLine, weights: &[(usize, f64)], place: Point) -> f64 {
        let points = &self.responses.points;
        let covariance = |a: Point, b: Point| self.waves.covariance(line, a.distance(b));
        let mut share = 1.0;
        for (i, w) in weights {
            share += w * w * line.error - 2.0 * w * covariance(points[*i], place);
            share += weights.iter().map(|(j, v)| w * v * covariance(points[*i], points[*j])).sum::<f64>();
        }
        share.max(0.0)
    }

    /// Expected error at all bins, interpolated linearly between its values `known` at the bins `nodes`.
    fn uncertainty(&self, nodes: &[usize], known: &[f64]) -> Uncertainty {
        let spectra = &self.spectra;
        let share: Vec<f64> = (0..spectra.bins())
            .map(|bin| {
                let next = nodes.partition_point(|node| *node < bin).clamp(1, nodes.len() - 1);
                let [from, to] = [nodes[next - 1], nodes[next]];
                let t = (bin.saturating_sub(from)) as f64 / (to - from).max(1) as f64;
                known[next - 1] + t.min(1.0) * (known[next] - known[next - 1])
            })
            .collect();
        let scale = 1.0 / (spectra.cosines.period() * self.responses.samples()) as f64;
        let mut squares = vec![0.0; spectra.actuators];
        for (share, powers) in share.iter().zip(spectra.powers.chunks(spectra.actuators)) {
            squares.iter_mut().zip(powers).for_each(|(sum, power)| *sum += scale * share * power);
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        Uncertainty {
            hz: (0..spectra.bins()).map(|bin| bin as f64 * spectra.step).collect(),
            share,
            relative: (mean / spectra.square.max(f64::MIN_POSITIVE)).sqrt(),
            rms: squares.iter().map(|square| square.sqrt()).collect(),
        }
    }
}
