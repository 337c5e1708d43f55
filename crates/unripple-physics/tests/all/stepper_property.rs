//! Over random sheets, loads and rates: energy never grows by itself, responses are reciprocal, blocks do not matter.

use crate::stepper_common;

use proptest::prelude::*;
use std::sync::Arc;
use stepper_common::*;
use unripple_core::*;
use unripple_physics::stepper::*;
use unripple_physics::{Circuit, Footprint, Housing, Load};

/// Shapes without any order: every place has numbers of its own.
#[derive(Debug)]
struct Wild {
    modes: usize,
    scale: f64,
}

impl Shapes for Wild {
    fn modes(&self) -> usize {
        self.modes
    }

    fn at(&self, p: Point, row: &mut [f64]) {
        let values = noise((p.x * 1e6).round() as u64 * 1_000_003 + (p.y * 1e6).round() as u64, row.len());
        row.iter_mut().zip(values).for_each(|(row, value)| *row = self.scale * value);
    }
}

/// How far loads reach where results are compared to each other: a mass so heavy that it leaves 1e-12 of an impulse leaves
/// as few digits of it.
const MILD: f64 = 4.0;

/// From 10^low to 10^high, or nothing at all.
fn wide(low: f64, high: f64) -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 4 => (low..high).prop_map(|x| 10f64.powf(x))]
}

fn place() -> impl Strategy<Value = Point> {
    (1..150u32, 1..150u32).prop_map(|(x, y)| mm(f64::from(x), f64::from(y)))
}

fn circuit() -> impl Strategy<Value = Circuit> {
    let bl = (-3.0..3.0).prop_map(|x| 10f64.powf(x));
    let resistance = (-3.0..3.0).prop_map(|x| 10f64.powf(x));
    (bl, resistance, wide(-9.0, 2.0)).prop_map(|(force_constant, resistance, inductance)| Circuit {
        force_constant,
        resistance,
        inductance,
    })
}

/// Housings of 10 g to 100 kg, seldom one.
fn housing() -> impl Strategy<Value = Option<Housing>> {
    let mass = (-2.0..2.0).prop_map(|x| 10f64.powf(x));
    let housing = (mass, wide(-2.0, 2.0), wide(-2.0, 2.0)).prop_map(|(mass, damping, stiffness)| Housing {
        mass,
        damping,
        stiffness,
    });
    prop_oneof![3 => Just(None), 1 => housing.prop_map(Some)]
}

/// Loads whose values reach from 10^-reach to 10^reach, some with a housing.
fn any_load(reach: f64) -> impl Strategy<Value = Load> {
    let values = (wide(-reach, reach), wide(-reach, reach), wide(-reach, reach));
    (place(), values, proptest::option::of(circuit()), housing()).prop_map(
        |(at, values, circuit, housing)| Load {
            footprint: Footprint::point(at),
            mass: values.0,
            damping: values.1,
            stiffness: values.2,
            circuit,
            housing,
        },
    )
}

fn channel(reach: f64) -> impl Strategy<Value = Channel> {
    (place(), proptest::option::of(any_load(reach)), any::<[bool; 2]>()).prop_map(
        |(at, load, [same, voltage])| {
            let footprint = match &load {
                Some(load) if same || load.housing.is_some() => load.footprint.clone(),
                _ => Footprint::point(at),
            };
            let voltage = voltage && load.as_ref().is_some_and(|load| load.circuit.is_some());
            Channel { footprint, gain: 1.0, load, voltage }
        },
    )
}

/// A rate, a sheet whose ω dt and σ dt reach 20, and how strongly its modes are felt.
fn sheet() -> impl Strategy<Value = (f64, Plant)> {
    let pole = (wide(-4.0, 1.3), wide(-6.0, 1.3));
    let poles = proptest::collection::vec(pole, 1..10);
    ((0.0..7.0).prop_map(|x: f64| 10f64.powf(x)), poles, -2.0..2.0).prop_map(
        |(rate, poles, scale): (f64, _, f64)| {
            let poles: Vec<Pole> =
                poles.iter().map(|(w, s): &(f64, f64)| Pole::new(w * rate, s * rate)).collect();
            let shapes = Wild { modes: poles.len(), scale: 10f64.powf(scale) };
            (rate, Plant::new(&poles, Arc::new(shapes), square()).unwrap())
        },
    )
}

fn contact(reach: f64) -> impl Strategy<Value = Contact> {
    (place(), (wide(-reach, reach), wide(-reach, reach), wide(-reach, reach))).prop_map(|(at, values)| {
        Contact {
            at,
            finger: Finger { mass: values.0, damping: values.1, stiffness: values.2, contact_radius: 0.0 },
        }
    })
}

/// What is done to a sheet that was struck: fingers that stay or move, and where to.
#[derive(Debug)]
struct Acts {
    contacts: Vec<Contact>,
    to: Option<Point>,
    substeps: usize,
    seed: u64,
}

fn acts(reach: f64, moving: bool) -> impl Strategy<Value = Acts> {
    let contacts = proptest::collection::vec(contact(reach), 0..4);
    (contacts, place(), 1usize..3, any::<u64>()).prop_map(move |(contacts, to, substeps, seed)| Acts {
        contacts,
        to: moving.then_some(to),
        substeps,
        seed,
    })
}

impl Acts {
    fn perform(&self, surface: &mut VirtualSurface, sample: usize) {
        for (id, contact) in self.contacts.iter().enumerate() {
            let id = id as u64;
            match (sample, self.to) {
                (5, _) => surface.touch(id, contact).unwrap(),
                (10 | 23, Some(to)) => surface.move_to(id, to).unwrap(),
                (20, Some(_)) => surface.move_to(id, contact.at).unwrap(),
                (60, _) => surface.lift(id).unwrap(),
                _ => {}
            }
        }
    }

    /// The most that energy grows by over one sample without drive, relative to what there is at first, and to what the
    /// same drive gives the bare sheet if that is more.
    fn growth(&self, (rate, plant): &(f64, Plant), channels: &[Channel]) -> [f64; 2] {
        let options = StepperOptions {
            fade: 9.0 / rate,
            glide: 7.0 / rate,
            substeps: self.substeps,
            ..Default::default()
        };
        let drive = noise(self.seed, 3 * channels.len());
        let struck = |channels: &[Channel]| {
            let mut surface = VirtualSurface::new(plant, channels, *rate, &options).unwrap();
            run(&mut surface, &drive);
            surface
        };
        let bare: Vec<Channel> =
            channels.iter().map(|channel| Channel::force(channel.footprint.clone())).collect();
        let (mut surface, bare) = (struck(channels), struck(&bare).energy());
        let (first, mut before, mut most) = (surface.energy(), surface.energy(), 0.0);
        for sample in 0..100 {
            self.perform(&mut surface, sample);
            rest(&mut surface, 1);
            let energy = surface.energy();
            assert!(energy.is_finite());
            most = f64::max(most, energy - before);
            before = energy;
        }
        if most > 0.0 { [most / first, most / first.max(bare)] } else { [0.0; 2] }
    }
}

/// What a channel senses of its own impulse on the bare sheet, if it strikes it.
fn struck(plant: &Plant, channel: &Channel, rate: f64) -> f64 {
    let coil = channel.load.as_ref().and_then(|load| load.circuit).filter(|_| channel.voltage);
    let gain = match coil {
        // The current approaches V/R with the time constant L/R. Its mean over the first sample is 1 - (1 - e^-θ)/θ of that with
        // θ = R/(L·rate), about θ/2 of it in a slow coil.
        Some(coil) => {
            let theta = coil.resistance / (coil.inductance * rate);
            let risen = if theta < 1e-3 { theta / 2.0 } else { 1.0 + (-theta).exp_m1() / theta };
            coil.force_constant / coil.resistance * risen
        }
        None => 1.0,
    };
    let bare = Channel { gain, ..Channel::force(channel.footprint.clone()) };
    let mut surface = VirtualSurface::new(plant, &[bare], rate, &StepperOptions::default()).unwrap();
    run(&mut surface, &[1.0]).0[0]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn energy_never_grows_without_drive(
        sheet in sheet(),
        channels in proptest::collection::vec(channel(MILD), 1..5),
        acts in acts(MILD, false),
    ) {
        let [grown, _] = acts.growth(&sheet, &channels);
        prop_assert!(grown < 1e-9, "{grown:e}");
    }

    #[test]
    fn energy_never_grows_under_moving_fingers(
        sheet in sheet(),
        channels in proptest::collection::vec(channel(MILD), 1..4),
        acts in acts(MILD, true),
    ) {
        let [grown, _] = acts.growth(&sheet, &channels);
        prop_assert!(grown < 1e-9, "{grown:e}");
    }

    // A mass of 1e9 times the sheet's leaves it 1e-9 of an impulse, known to as many digits fewer: here what grows is
    // compared with what the impulse gives the bare sheet.
    #[test]
    fn energy_never_grows_under_absurd_loads(
        sheet in sheet(),
        channels in proptest::collection::vec(channel(6.0), 1..4),
        acts in any::<bool>().prop_flat_map(|moving| acts(6.0, moving)),
    ) {
        let [_, grown] = acts.growth(&sheet, &channels);
        prop_assert!(grown < 1e-9, "{grown:e}");
    }

    #[test]
    fn responses_are_reciprocal_through_loads(
        (rate, plant) in sheet(),
        channels in proptest::collection::vec(channel(MILD), 2..5),
        contacts in proptest::collection::vec(contact(MILD), 0..3),
        substeps in 1usize..3,
    ) {
        let options = StepperOptions { fade: 0.0, substeps, ..Default::default() };
        let mut start = VirtualSurface::new(&plant, &channels, rate, &options).unwrap();
        for (id, contact) in contacts.iter().enumerate() {
            start.touch(id as u64, contact).unwrap();
        }
        rest(&mut start, 2);
        let (frames, last) = (60, channels.len() - 1);
        let response = |from: usize, to: usize| {
            let mut drive = vec![0.0; channels.len() * frames];
            drive[from * frames] = 1.0;
            let (sensors, _) = run(&mut start.clone(), &drive);
            sensors[to * frames..][..frames].to_vec()
        };
        let (there, back) = (response(0, last), response(last, 0));
        // Against what either does to itself, or would without loads: masses may leave little of an impulse.
        let own = |c: usize| peak(&response(c, c)).max(struck(&plant, &channels[c], rate));
        let scale = (own(0) * own(last)).sqrt();
        for (there, back) in there.iter().zip(&back) {
            prop_assert!((there - back).abs() <= 1e-8 * scale, "{there:e} {back:e}, of {scale:e}");
        }
    }

    #[test]
    fn blocks_do_not_matter(
        (rate, plant) in sheet(),
        channels in proptest::collection::vec(channel(MILD), 1..4),
        contact in contact(MILD),
        blocks in proptest::collection::vec(1usize..40, 8),
        seed in any::<u64>(),
    ) {
        let options = StepperOptions { fade: 50.0 / rate, glide: 20.0 / rate, ..Default::default() };
        let mut surface = VirtualSurface::new(&plant, &channels, rate, &options).unwrap();
        surface.set_probes(&[(mm(3.0, 4.0), Reading::Velocity), (mm(3.0, 4.0), Reading::Displacement)]).unwrap();
        surface.touch(1, &contact).unwrap();
        let frames: usize = blocks.iter().sum();
        let drive = noise(seed, channels.len() * frames);
        let (mut sensors, mut probes) = (vec![0.0; drive.len()], vec![0.0; 2 * frames]);
        let mut whole = surface.clone();
        whole.process(frames, &drive, &mut sensors, &mut probes).unwrap();
        let mut first = 0;
        for count in blocks {
            let part = |planes: &[f64]| -> Vec<f64> {
                planes.chunks(frames).flat_map(|plane| plane[first..first + count].to_vec()).collect()
            };
            let (found_sensors, found_probes) = run(&mut surface, &part(&drive));
            prop_assert_eq!(found_sensors, part(&sensors));
            prop_assert_eq!(found_probes, part(&probes));
            first += count;
        }
        prop_assert_eq!(surface.state(), whole.state());
    }

    #[test]
    fn probes_that_move_hear_what_those_set_there_hear(
        (rate, plant) in sheet(),
        channels in proptest::collection::vec(channel(MILD), 1..4),
        places in proptest::collection::vec(place(), 5),
        seed in any::<u64>(),
    ) {
        let probes = |at: [usize; 3]| at.map(|n| (places[n], Reading::Displacement));
        let mut moved = VirtualSurface::new(&plant, &channels, rate, &StepperOptions::default()).unwrap();
        moved.set_probes(&probes([0, 1, 2])).unwrap();
        run(&mut moved, &noise(seed, channels.len() * 30));
        let mut set = moved.clone();
        set.set_probes(&probes([3, 1, 4])).unwrap();
        moved.move_probes(&[(2, places[4]), (0, places[3])]).unwrap();
        prop_assert!(moved.move_probes(&[(1, places[0]), (3, places[0])]).is_err());
        prop_assert!(moved.move_probes(&[(1, places[0]), (2, mm(f64::NAN, 1.0))]).is_err());
        let drive = noise(seed ^ 1, channels.len() * 30);
        prop_assert_eq!(run(&mut moved, &drive), run(&mut set, &drive));
    }

    #[test]
    fn what_is_remembered_is_what_was_and_changes_nothing(
        (rate, plant) in sheet(),
        channels in proptest::collection::vec(channel(MILD), 1..4),
        contact in contact(MILD),
        blocks in proptest::collection::vec(1usize..40, 8),
        stride in 1usize..9,
        seed in any::<u64>(),
    ) {
        let place = mm(3.0, 4.0);
        let mut surface = VirtualSurface::new(&plant, &channels, rate, &StepperOptions::default()).unwrap();
        surface.set_probes(&[(place, Reading::Displacement), (place, Reading::Velocity)]).unwrap();
        surface.touch(1, &contact).unwrap();
        let mut plain = surface.clone();
        surface.remember(stride, 12).unwrap();
        let frames: usize = blocks.iter().sum();
        let (mut first, mut heard) = (0, [Vec::new(), Vec::new()]);
        for count in blocks {
            let drive = noise(seed + first as u64, channels.len() * count);
            let (sensors, probes) = run(&mut surface, &drive);
            let (expected, expected_probes) = run(&mut plain, &drive);
            prop_assert_eq!((sensors, &probes), (expected, &expected_probes));
            prop_assert_eq!(surface.finger_motion(1), plain.finger_motion(1));
            heard.iter_mut().zip(probes.chunks(count)).for_each(|(all, plane)| all.extend_from_slice(plane));
            first += count;
        }
        let history = surface.history().unwrap();
        prop_assert_eq!(history.len(), (frames / stride).min(12));
        prop_assert_eq!(history.newest() as usize, frames / stride * stride);
        prop_assert!(history.state(history.len()).is_none());
        let weights = plant.readout(&[place]);
        for back in 0..history.len() {
            let (displacement, velocity) = history.state(back).unwrap();
            let sample = history.newest() as usize - back * stride - 1;
            for (state, heard) in [displacement, velocity].into_iter().zip(&heard) {
                let terms = || state.iter().enumerate().map(|(m, x)| weights[(0, m)] * f64::from(*x));
                let scale: f64 = terms().map(f64::abs).sum();
                prop_assert!((terms().sum::<f64>() - heard[sample]).abs() <= 1e-6 * scale + 1e-30);
            }
        }
    }

    #[test]
    fn drives_superpose(
        (rate, plant) in sheet(),
        channels in proptest::collection::vec(channel(MILD), 1..4),
        seed in any::<u32>(),
    ) {
        let surface = VirtualSurface::new(&plant, &channels, rate, &StepperOptions::default()).unwrap();
        let count = channels.len() * 50;
        let (one, other) = (noise(u64::from(seed), count), noise(u64::from(seed) + 1, count));
        let both: Vec<f64> = one.iter().zip(&other).map(|(a, b)| 2.0 * a - b).collect();
        let [one, other, both] = [one, other, both].map(|drive| run(&mut surface.clone(), &drive).0);
        let scale = 2.0 * peak(&one) + peak(&other);
        // As above, masses may leave little of an impulse: of what it gives the bare sheet, rounding in fifty samples is left.
        let bare = channels.iter().map(|channel| struck(&plant, channel, rate)).fold(0.0, f64::max);
        for ((one, other), both) in one.iter().zip(&other).zip(&both) {
            let off = (2.0 * one - other - both).abs();
            prop_assert!(off <= 1e-7 * scale + 1e-10 * bare, "{off:e} of {scale:e}, {bare:e} on the bare sheet");
        }
    }
}
