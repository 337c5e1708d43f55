//! Calibration data of supported sheets whose modes are known in closed form, with modes above the band.

#![allow(dead_code)]

use std::f64::consts::{PI, TAU};
use unripple_calibrate::Measured;
use unripple_calibrate::signals::{Band, shift};
use unripple_core::{
    Actuator, ActuatorKind, Air, Conditions, Decay, Edge, Edges, Emission, Finger, Outline, Point, Port,
    Random, SampledResponses, Shape, Sheet, Surface, Uneven,
};
use unripple_physics::Medium;

/// Duration of each response that is kept, in s, and samples before time 0 in which ringing of the band's edges is
/// computed.
pub const KEPT: f64 = 0.1;
const BEFORE: usize = 64;

/// The paper's film in half its band, with a supported rim.
pub fn film() -> Surface {
    let places =
        [(12., 31.), (9., 84.), (40., 140.), (95., 137.), (141., 106.), (138., 44.), (103., 11.), (50., 9.)];
    sheet((0.15, 0.15), (4e9, 1400.0, 0.3), (0.125e-3, 200.0, 0.07), ([0.0, 1500.0], 48e3), &places)
}

/// A glass plate.
pub fn plate() -> Surface {
    let places = [
        (14., 27.),
        (17., 88.),
        (58., 107.),
        (121., 110.),
        (186., 93.),
        (189., 31.),
        (133., 12.),
        (71., 15.),
    ];
    sheet((0.2, 0.12), (72e9, 2500.0, 0.22), (0.7e-3, 0.0, 0.03), ([0.0, 10_000.0], 48e3), &places)
}

/// An aluminium panel that rings for long.
pub fn panel() -> Surface {
    let places = [(20., 35.), (60., 260.), (170., 230.), (215., 60.), (120., 20.), (25., 160.)];
    sheet((0.24, 0.3), (70e9, 2700.0, 0.33), (1e-3, 0.0, 0.25), ([0.0, 2500.0], 48e3), &places)
}

fn sheet(
    (width, height): (f64, f64),
    (young, density, poisson): (f64, f64, f64),
    (thickness, tension, decay): (f64, f64, f64),
    (band, rate): ([f64; 2], f64),
    places: &[(f64, f64)],
) -> Surface {
    let actuators = places.iter().enumerate().map(|(n, (x, y))| Actuator {
        name: format!("a{}", n + 1),
        at: Point::from_mm(*x, *y),
        kind: ActuatorKind::Force,
        contact_radius: 0.0,
    });
    Surface {
        name: "sheet".into(),
        outline: Outline::new(Shape::Rectangle { width, height }).with_edges(Edges::All(Edge::Supported)),
        sheet: Sheet {
            material: "sheet".into(),
            young,
            density,
            poisson,
            strength: None,
            thickness,
            tension,
            decay: Decay::Time(decay),
            air: Air::None,
            uneven: Uneven::default(),
        },
        emission: Emission { band, rate, limit: 1.0, rms_limit: None },
        finger: Finger::default(),
        accuracy: None,
        actuators: actuators.collect(),
    }
}

/// A true surface, its sensors and its probe.
pub struct Truth {
    pub surface: Surface,
    /// Highest mode, as a multiple of the top of the band.
    pub rings: f64,
    /// Signal-to-noise ratio of the sensors and of the probe, in dB.
    pub snr: f64,
    /// Latency that was not found, in samples.
    pub late: f64,
    /// The probe's gain, and its delay relative to the sensors in s.
    pub probe: (f64, f64),
    pub random: Random,
}

impl Truth {
    pub fn of(surface: Surface) -> Self {
        let random = Random::seeded(17);
        Self { surface, rings: 1.47, snr: 60.0, late: 0.0, probe: (1.0, 0.0), random }
    }

    fn samples(&self) -> usize {
        (KEPT * self.surface.emission.rate) as usize + 1
    }

    pub fn swept(&self) -> [f64; 2] {
        [60.0, 1.2 * self.surface.emission.band[1]]
    }

    /// Velocity at one place per unit impulse of force at another, by the closed form, not limited to a band, without
    /// noise.
    pub fn whole(&self, from: Point, to: Point) -> Vec<f64> {
        let Shape::Rectangle { width, height } = self.surface.outline.shape else { panic!("a rectangle") };
        let medium = Medium::of(&self.surface.sheet);
        let Decay::Time(decay) = self.surface.sheet.decay else { panic!("one decay time") };
        let (rate, samples) = (self.surface.emission.rate, self.samples());
        let top = TAU * self.rings * self.surface.emission.band[1];
        let mass = medium.areal_density * width * height / 4.0;
        let mut h = vec![0.0; samples];
        let k = medium.wavenumber(top);
        for m in 1..=(k * width / PI) as u32 {
            for n in 1..=(k * height / PI) as u32 {
                let (kx, ky) = (PI * f64::from(m) / width, PI * f64::from(n) / height);
                let square = kx * kx + ky * ky;
                let omega = (square * (medium.tension + medium.bending_stiffness * square)
                    / medium.areal_density)
                    .sqrt();
                if omega > top {
                    continue;
                }
                let shape = |p: Point| (kx * p.x).sin() * (ky * p.y).sin();
                let weight = shape(from) * shape(to) / mass;
                let sigma = 1.0 / decay;
                let swing = (omega * omega - sigma * sigma).sqrt();
                // e^{(-σ+jω)t} by steps; the velocity of a struck oscillator is its real part less σ/ω of the imaginary.
                let (c, s) = ((swing / rate).cos(), (swing / rate).sin());
                let fall = (-sigma / rate).exp();
                let (mut re, mut im) = (1.0, 0.0);
                for sample in &mut h {
                    *sample += weight * (re - sigma / swing * im);
                    (re, im) = (fall * (re * c - im * s), fall * (re * s + im * c));
                }
            }
        }
        h
    }

    /// The response as it would be measured: delayed, limited to the swept band, cut off before time 0, with noise.
    pub fn heard(&mut self, from: Point, to: Point, late: f64, gain: f64) -> Vec<f64> {
        let [low, high] = self.swept();
        let rate = self.surface.emission.rate;
        let mut signal = vec![0.0; BEFORE];
        signal.extend(self.whole(from, to));
        Band::within(low, high).limit(&mut signal, rate).unwrap();
        let mut signal = shift(&signal, late).split_off(BEFORE);
        let power = signal.iter().map(|x| x * x).sum::<f64>() / signal.len() as f64;
        let noise = power.sqrt() * 10f64.powf(-self.snr / 20.0);
        signal.iter_mut().for_each(|x| *x = gain * (*x + noise * self.random.normal()));
        signal
    }

    /// Measured responses between the actuators.
    pub fn pairs(&mut self) -> Measured {
        let places: Vec<Point> = self.surface.actuators.iter().map(|a| a.at).collect();
        let mut all = Vec::new();
        for driven in &places {
            for heard in &places {
                all.push(self.heard(*driven, *heard, self.late, 1.0));
            }
        }
        let [low, high] = self.swept();
        let measured = Measured::reciprocal(self.surface.emission.rate, all, [low, high]).unwrap();
        measured.limited_to(Band::within(low, high))
    }

    /// Responses that the probe measures at the places `stood`, with its gain at each, given as those of the places
    /// `said`.
    pub fn probed(&mut self, said: &[Point], stood: &[Point], gains: &[f64]) -> SampledResponses {
        let places: Vec<Point> = self.surface.actuators.iter().map(|a| a.at).collect();
        let (gain, late) = self.probe;
        let mut data = Vec::new();
        for (at, own) in stood.iter().zip(gains) {
            for driven in &places {
                let late = self.late + late * self.surface.emission.rate;
                data.extend(self.heard(*driven, *at, late, gain * own).iter().map(|x| *x as f32));
            }
        }
        let emission = &self.surface.emission;
        let conditions = Conditions {
            rate: emission.rate,
            band: emission.band,
            lambda_min: Medium::of(&self.surface.sheet).lambda_min(emission.band[1]),
            outline: self.surface.outline.clone(),
        };
        let ports = self.surface.actuators.iter().map(|a| Port { name: a.name.clone(), at: a.at }).collect();
        SampledResponses::new(ports, said.to_vec(), conditions, self.samples(), data).unwrap()
    }
}

/// Places some way from the rim.
pub fn places(surface: &Surface, count: usize) -> Vec<Point> {
    let (width, height) = surface.outline.extent();
    let mut random = Random::seeded(4);
    (0..count)
        .map(|_| Point::new(width * random.between(0.15, 0.85), height * random.between(0.15, 0.85)))
        .collect()
}
