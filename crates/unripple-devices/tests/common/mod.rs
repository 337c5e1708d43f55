//! A film with actuators, and blocks through a device.
#![allow(dead_code)] // Each test file uses its own part of this.

use unripple_core::*;

/// The paper's actuators, in mm.
pub const PLACES: [(f64, f64); 8] = [
    (12.0, 31.0),
    (9.0, 84.0),
    (40.0, 140.0),
    (95.0, 137.0),
    (141.0, 106.0),
    (138.0, 44.0),
    (103.0, 11.0),
    (50.0, 9.0),
];

/// The paper's film, up to a frequency.
pub fn film(top: f64) -> Surface {
    let sheet = Sheet {
        material: "BoPET".into(),
        young: 4e9,
        density: 1400.0,
        poisson: 0.3,
        strength: None,
        thickness: 0.125e-3,
        tension: 200.0,
        decay: Decay::Time(0.07),
        air: Air::None,
        uneven: Uneven::default(),
    };
    let actuator = |(i, (x, y)): (usize, &(f64, f64))| Actuator {
        name: format!("a{}", i + 1),
        at: Point::from_mm(*x, *y),
        kind: ActuatorKind::Force,
        contact_radius: 0.0,
    };
    Surface {
        name: "film".into(),
        outline: Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 }),
        sheet,
        emission: Emission { band: [0.0, top], rate: 48e3, limit: 2.0, rms_limit: None },
        finger: Finger::default(),
        actuators: PLACES.iter().enumerate().map(actuator).collect(),
    }
}

/// Every input over so many samples, while outputs play what they are told; 1 is full scale.
pub fn play(device: &mut dyn Device, samples: usize, drive: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let layout = device.layout().clone();
    let (outputs, inputs) = (layout.outputs.len(), layout.inputs.len());
    let mut all = vec![Vec::new(); inputs];
    let mut heard = vec![0.0f32; inputs * layout.block];
    for start in (0..samples).step_by(layout.block) {
        let block: Vec<f32> = (0..outputs * layout.block)
            .map(|n| drive(n / layout.block, start + n % layout.block) as f32)
            .collect();
        device.exchange(&block, &mut heard).unwrap();
        for (line, plane) in all.iter_mut().zip(heard.chunks(layout.block)) {
            line.extend(plane.iter().map(|x| f64::from(*x)));
        }
    }
    all.iter_mut().for_each(|line| line.truncate(samples));
    all
}

/// Nothing driven.
pub fn silence(_: usize, _: usize) -> f64 {
    0.0
}

pub fn rms(line: &[f64]) -> f64 {
    (line.iter().map(|x| x * x).sum::<f64>() / line.len() as f64).sqrt()
}

/// Largest difference, relative to the largest magnitude of the second.
pub fn apart(found: &[f64], exact: &[f64]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let most = exact.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    found.iter().zip(exact).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / most
}

/// Numbers between -1 and 1 that look random.
pub fn noise(seed: u64, count: usize) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..20).for_each(|_| {
        next();
    });
    (0..count).map(|_| next()).collect()
}
