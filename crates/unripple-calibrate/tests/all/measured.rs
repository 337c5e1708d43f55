//! Responses measured on a surface that is not as it is told, and the focus that they give.

use crate::measured_bench;

use measured_bench::*;
use unripple_calibrate::measure::*;
use unripple_calibrate::{Between, BetweenOptions, CalibrateError};
use unripple_core::Point;
use unripple_devices::{Interface, VirtualOptions};
use unripple_physics::{Medium, sample};

const AT: Point = Point { x: 0.062, y: 0.090 };

#[test]
fn latency_is_found_to_a_tenth_of_a_sample() {
    for latency in [0.0, 37.4, 1203.0] {
        let interface = Interface { latency, ..Interface::default() };
        let device = WORLD.device_with(&VirtualOptions { interface, ..VirtualOptions::default() });
        let session = WORLD.session(&device, &MeasureOptions::default());
        let handle = device.handle();
        let found =
            session.find_latency(&mut Hands::new(device, handle), 0, AT, &WORLD.model).unwrap().unwrap();
        println!("latency {latency}: found {found:.3?}");
        assert!((found[0] - latency).abs() < 0.1);
    }
}

/// Points half a shortest wavelength apart, as far as they bear on the target, and a target between them.
#[test]
fn measured_points_focus_between_them() {
    let device = WORLD.device();
    let session = WORLD.session(&device, &MeasureOptions::default());
    let handle = device.handle();
    let mut rig = Hands::new(device, handle);
    let points: Vec<Point> = (0..49)
        .map(|i| Point::from_mm(39.0 + 7.25 * f64::from(i % 7), 68.0 + 7.25 * f64::from(i / 7)))
        .collect();
    let measured = WORLD.probed(&mut rig, &session, &points);
    let medium = Medium::of(&WORLD.surface.sheet);
    let between =
        Between::plan(&measured, |omega| medium.wavenumber(omega), &BetweenOptions::default()).unwrap();
    let share = WORLD.share(&between.at(AT).unwrap(), AT);
    println!("time reversal from points around: {share:.4} of the true contrast");
    assert!(share >= 0.98);
}

#[test]
fn taps_of_unknown_shape_and_strength_are_enough() {
    let device = WORLD.device();
    let options = MeasureOptions { repeats: 2, ..MeasureOptions::default() };
    let wires = Wires::by_name(&WORLD.ports(), unripple_core::Device::layout(&device), &[]).unwrap();
    let layout = unripple_core::Device::layout(&device).clone();
    let session = TapSession::new(&WORLD.surface, &layout, &wires, WORLD.model.clone(), &options).unwrap();
    let handle = device.handle();
    let mut rig = Hands::new(device, handle);
    let places = [AT, Point::from_mm(100.0, 60.0), Point::from_mm(50.0, 40.0), Point::from_mm(85.0, 110.0)];
    let mut shares = Vec::new();
    for (number, at) in places.into_iter().enumerate() {
        let channel = session.measure(&mut rig, number, at, 0).unwrap();
        let share = WORLD.share(&WORLD.sampled(&[at], std::slice::from_ref(&channel)), at);
        println!("tapped at {at}: {share:.4}, explained {:.3?}", channel.quality[0].coherence);
        shares.push(share);
    }
    assert!(shares.iter().sum::<f64>() / shares.len() as f64 >= 0.95);
}

#[test]
fn a_channel_that_clips_and_one_that_is_dead_are_bad() {
    let mut interface = Interface { drive_gains: vec![1.0; 8], ..Interface::default() };
    interface.drive_gains[2] = 0.0;
    let mut options = VirtualOptions { interface, ..VirtualOptions::default() };
    let fault = |options: &VirtualOptions| {
        let device = WORLD.device_with(options);
        let session = WORLD.session(&device, &MeasureOptions::default());
        let handle = device.handle();
        let found = session.measure(&mut Hands::new(device, handle), 0, AT, 0, Listen::Probe).unwrap();
        session.fault(&found[0]).unwrap_or_default()
    };
    let dead = fault(&options);
    assert!(dead.contains("actuator 3") && dead.contains("signal to noise"), "{dead}");
    options.interface.drive_gains.clear();
    options.faults.clip = Some(0.6);
    let clipped = fault(&options);
    assert!(clipped.contains("distortion"), "{clipped}");
}

#[test]
fn a_device_that_vanishes_loses_nothing_that_is_finished() {
    struct Kept(Vec<Option<f64>>);
    impl Sink for Kept {
        fn missing(&self) -> Vec<usize> {
            (0..self.0.len()).filter(|i| self.0[*i].is_none()).collect()
        }
        fn keep(
            &mut self,
            number: usize,
            channel: &Channel,
            fault: Option<&str>,
        ) -> Result<(), CalibrateError> {
            assert!(fault.is_none(), "{fault:?}");
            self.0[number] = Some(channel.responses[0][7]);
            Ok(())
        }
    }
    let points = [AT, Point::from_mm(70.0, 80.0), Point::from_mm(75.0, 50.0)];
    let mut kept = Kept(vec![None; 3]);
    let run = |vanish_after: Option<u64>, kept: &mut Kept| {
        let interface = Interface { vanish_after, ..Interface::default() };
        let device = WORLD.device_with(&VirtualOptions { interface, ..VirtualOptions::default() });
        let way = Way::Probe(Box::new(WORLD.session(&device, &MeasureOptions::default())));
        let handle = device.handle();
        let mut told = 0;
        let result = campaign(&mut Hands::new(device, handle), &way, &points, kept, 1, &mut |_| {
            told += 1;
            std::ops::ControlFlow::Continue(())
        });
        (result, told)
    };
    let (lost, told) = run(Some(3000), &mut kept);
    assert!(matches!(lost, Err(CalibrateError::Device(_))), "{lost:?}");
    assert!(told == 1 && kept.0[0].is_some() && kept.0[1].is_none());
    let (bad, told) = run(None, &mut kept);
    assert_eq!((bad.unwrap(), told), (0, 2));
    let mut anew = Kept(vec![None; 3]);
    run(None, &mut anew).0.unwrap();
    assert_eq!(kept.0, anew.0);
}

#[test]
fn what_is_measured_is_what_is_true() {
    let device = WORLD.device();
    let session = WORLD.session(&device, &MeasureOptions::default());
    let handle = device.handle();
    let measured = WORLD.probed(&mut Hands::new(device, handle), &session, &[AT]);
    let unripple_core::Responses::Modal(plant) = &WORLD.plant else { panic!() };
    let real = sample(plant, &[AT], measured.samples());
    let (mut off, mut all) = (0.0, 0.0);
    // The first millisecond holds what the band takes from the onset.
    for actuator in 0..8 {
        for i in 48..measured.samples() {
            let [a, b] = [&measured, &real].map(|r| f64::from(r.response(actuator, 0)[i]));
            off += (a - b).powi(2);
            all += b * b;
        }
    }
    let share = (off / all).sqrt();
    println!("measured responses are off by {:.2} %", share * 100.0);
    assert!(share < 0.02);
}

/// What would take gigabytes is refused before any of it is allocated.
#[test]
fn measurements_that_no_memory_holds_are_refused() {
    let device = WORLD.device();
    let layout = unripple_core::Device::layout(&device).clone();
    let refused = |options: MeasureOptions| {
        let wires = Wires::by_name(&WORLD.ports(), &layout, &[]).unwrap();
        Session::new(&WORLD.surface, &layout, wires, &options).unwrap_err().to_string()
    };
    for repeats in [0, 100, usize::MAX] {
        let found = refused(MeasureOptions { repeats, ..MeasureOptions::default() });
        assert!(found.starts_with("repeats: expected 1 to 99, found"), "{found}");
    }
    let long = refused(MeasureOptions { repeats: 9, response_length: 60.0, ..MeasureOptions::default() });
    let expected =
        "samples that are played and recorded at a place: expected at most 536870912: fewer repeats";
    assert!(long.starts_with(expected), "{long}");
}
