//! Blows of a hammer with a force sensor: known responses struck by known forces, and the hammer of a virtual surface.

use crate::measured_bench;

use measured_bench::{WORLD, World};
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::*;
use unripple_calibrate::signals::Band;
use unripple_core::{Device, FORCE, Point, Random, Responses};
use unripple_devices::{Handle, Tap, Virtual, VirtualOptions};
use unripple_physics::sample;

/// Samples per second, those of the virtual surfaces.
const RATE: f64 = 48e3;

/// Three modes, as frequency in Hz, decay time in s and weight at each of two sensors.
const MODES: [(f64, f64, [f64; 2]); 3] =
    [(310.0, 0.03, [40.0, 25.0]), (740.0, 0.025, [-30.0, 35.0]), (1330.0, 0.02, [20.0, -45.0])];

/// Velocity at a sensor in m/s, some time in s after an impulse of 1 N·s.
fn response(sensor: usize, time: f64) -> f64 {
    let one = |(hz, decay, weight): &(f64, f64, [f64; 2])| {
        weight[sensor] * (-time / decay).exp() * (std::f64::consts::TAU * hz * time).cos()
    };
    if time < 0.0 { 0.0 } else { MODES.iter().map(one).sum() }
}

/// The force of a push, and what both sensors record of it from rest, 0.3 s in all, with noise of a standard deviation.
fn strike(push: &[f64], noise: f64, random: &mut Random) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (start, samples) = (1500, 14_400);
    let mut force = vec![0.2; samples];
    force[start..start + push.len()].iter_mut().zip(push).for_each(|(to, f)| *to += f);
    let heard = |sensor: usize| -> Vec<f64> {
        let mut heard = vec![0.01; samples];
        for (k, f) in push.iter().enumerate().filter(|(_, f)| **f != 0.0) {
            for (i, x) in heard[start + k..].iter_mut().enumerate() {
                *x += f / RATE * response(sensor, i as f64 / RATE);
            }
        }
        heard
    };
    let mut sensors = vec![heard(0), heard(1)];
    sensors.iter_mut().flatten().for_each(|x| *x += noise * random.normal());
    (force, sensors)
}

/// Responses from some blows, and the error of each relative to the true one from 2 ms on, where the band has taken nothing from it.
fn measured(noise: f64, blows: u64) -> (Channel, Vec<f64>) {
    let mut random = Random::seeded(4);
    let mut all = Vec::new();
    for seed in 0..blows {
        let push = Tap::half_sine(3.0 + seed as f64, 0.3e-3, RATE);
        let (force, sensors) = strike(push.force(), noise, &mut random);
        all.extend(struck(&force, &sensors, &[], (RATE, 9600)).unwrap().into_iter().map(Result::unwrap));
    }
    assert_eq!(all.len() as u64, blows);
    let channel = hammered(&all, Vec::new(), 4801, (RATE, Band::within(60.0, 2400.0))).unwrap();
    let off = |sensor: usize| {
        let (mut left, mut whole) = (0.0, 0.0);
        for (i, h) in channel.responses[sensor].iter().enumerate().skip(96).take(3800) {
            let truth = response(sensor, i as f64 / RATE);
            (left, whole) = (left + (h - truth).powi(2), whole + truth * truth);
        }
        (left / whole).sqrt()
    };
    let off = vec![off(0), off(1)];
    (channel, off)
}

#[test]
fn known_responses_are_found_in_their_unit() {
    let (channel, off) = measured(0.0, 3);
    assert!(off.iter().all(|off| *off < 0.01), "{off:?}");
    let coherence: Vec<f64> = channel.quality.iter().map(|q| q.coherence.unwrap()).collect();
    assert!(coherence.iter().all(|share| *share > 0.9999), "{coherence:?}");
    let blows = channel.account.blows.clone().unwrap();
    assert_eq!((blows.used, blows.usable_to_hz), (3, None));
    assert!(blows.peaks_n.iter().zip([3.0, 4.0, 5.0]).all(|(found, peak)| (found / peak - 1.0).abs() < 0.01));
}

/// Noise that is added shows in coherence and signal-to-noise ratio as it does in the error of the responses.
#[test]
fn noise_shows_in_coherence_and_in_the_stated_ratio() {
    let (clean, _) = measured(0.0, 8);
    let (channel, _) = measured(1e-3, 8);
    for sensor in 0..2 {
        let (mut left, mut whole) = (0.0, 0.0);
        for (h, truth) in channel.responses[sensor].iter().zip(&clean.responses[sensor]) {
            (left, whole) = (left + (h - truth).powi(2), whole + truth * truth);
        }
        let real = 10.0 * f64::log10(whole / left);
        let said = channel.quality[sensor].snr_db;
        // What is kept of a recording has all of its signal and half of its noise, which is not white after the deconvolution.
        assert!((said - real).abs() < 4.5, "sensor {sensor}: {said:.1} dB stated, {real:.1} dB real");
        let [quiet, noisy] = [&clean, &channel].map(|c| c.quality[sensor].coherence.unwrap());
        assert!(noisy < quiet - 1e-5, "{noisy} {quiet}");
        assert!(channel.bands[sensor].iter().all(|band| band.coherence.is_some()));
    }
}

#[test]
fn a_soft_tip_is_said_to_end_below_the_band() {
    let push = Tap::half_sine(5.0, 1.5e-3, RATE);
    let (force, sensors) = strike(push.force(), 0.0, &mut Random::seeded(1));
    let blow = struck(&force, &sensors, &[], (RATE, 9600)).unwrap().remove(0).unwrap();
    let channel = hammered(&[blow], Vec::new(), 4801, (RATE, Band::within(60.0, 2400.0))).unwrap();
    let blows = channel.account.blows.clone().unwrap();
    // A half sine of length T is 20 dB down at 1.3033 / T.
    assert!((blows.usable_to_hz.unwrap() - 868.9).abs() < 15.0, "{blows:?}");
    assert!(channel.account.said()[0].contains("20 dB below"), "{:?}", channel.account.said());
    assert_eq!(channel.quality[0].coherence, None);
}

#[test]
fn clipped_sensors_are_refused_unless_they_are_left_out() {
    let push = Tap::half_sine(5.0, 0.3e-3, RATE);
    let (force, mut sensors) = strike(push.force(), 0.0, &mut Random::seeded(1));
    let most = sensors[1].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    sensors[1].iter_mut().for_each(|x| *x = x.clamp(-0.3 * most, 0.3 * most));
    let of = |deaf: &[usize]| struck(&force, &sensors, deaf, (RATE, 9600)).unwrap().remove(0);
    assert!(matches!(of(&[]), Err(BlowFault::Overload { .. })), "{:?}", of(&[]).err());
    assert!(of(&[1]).is_ok());
    assert!(hammered(&[], vec![], 10, (RATE, Band::within(60.0, 2400.0))).is_err());
}

/// A rig that strikes a virtual surface with a hammer that hits double now and then.
struct Hammerer {
    device: Virtual,
    handle: Handle,
    refused: Vec<String>,
}

impl Rig for Hammerer {
    fn device(&mut self) -> &mut dyn Device {
        &mut self.device
    }

    fn ready(&mut self, number: usize, _at: Point, attempt: u64) -> Result<(), CalibrateError> {
        self.handle.rest(number as u64 * 100 + attempt);
        Ok(())
    }

    fn tap(&mut self, number: usize, at: Point, attempt: u64) -> Result<(), CalibrateError> {
        let after = (SILENCE * 128) as f64 / RATE + 0.02;
        self.handle
            .tap(&Tap::hammer(number as u64 * 31 + attempt, RATE), at, after)
            .map_err(|error| CalibrateError::Rig { number, why: error.to_string() })
    }

    fn refused(&mut self, _number: usize, why: &str) {
        self.refused.push(why.to_owned());
    }
}

/// Gain of found responses relative to the true ones, and the share, as amplitude, by which they differ otherwise.
fn against(world: &World, at: Point, found: &[Vec<f64>]) -> [f64; 2] {
    let Responses::Modal(plant) = &world.plant else { panic!() };
    let real = sample(plant, &[at], found[0].len());
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (a, response) in found.iter().enumerate() {
        let both = real.response(a, 0).iter().zip(response);
        for (x, y) in both.take(response.len() - 100).skip(96) {
            let (x, y) = (f64::from(*x), *y);
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
    }
    [xy / xx, (1.0 - xy * xy / (xx * yy)).sqrt()]
}

#[test]
fn the_hammer_of_a_virtual_surface_measures_its_responses() {
    let device = WORLD.device_with(&VirtualOptions { hammer: true, ..VirtualOptions::default() });
    let layout = device.layout().clone();
    assert_eq!(layout.inputs.last().map(String::as_str), Some(FORCE));
    let wires = Wires::by_name(&WORLD.ports(), &layout, &[]).unwrap();
    let options = MeasureOptions { repeats: 3, ..MeasureOptions::default() };
    let session = HammerSession::new(&WORLD.surface, &layout, &wires, 1.0, &options).unwrap();
    let mut rig = Hammerer { handle: device.handle(), device, refused: Vec::new() };
    let mut refused = 0;
    for (number, (x, y)) in [(62.0, 90.0), (100.0, 60.0), (40.0, 111.0)].into_iter().enumerate() {
        let at = Point::from_mm(x, y);
        let channel = session.measure(&mut rig, number, at, 0).unwrap();
        let [gain, off] = against(&WORLD, at, &channel.responses);
        println!("{at}: gain {gain:.4}, off by {off:.4}, {:?}", channel.account.blows);
        // Gains of the virtual surface's channels are off by 0.5 % each.
        assert!((gain - 1.0).abs() < 0.02 && off < 0.06, "{at}: {gain} {off}");
        let blows = channel.account.blows.unwrap();
        assert_eq!(blows.used, 3);
        assert!(blows.refused.iter().all(|fault| matches!(fault, BlowFault::Double { .. })));
        refused += blows.refused.len();
    }
    assert_eq!(rig.refused.len(), refused);
    let plain = WORLD.device();
    let wires = Wires::by_name(&WORLD.ports(), plain.layout(), &[]).unwrap();
    let lacking = HammerSession::new(&WORLD.surface, plain.layout(), &wires, 1.0, &options);
    assert!(lacking.unwrap_err().to_string().contains("`force`"));
}
