//! Recordings with the faults of benches, from a film in closed form: what is survived is right, what is not is named.

use crate::recorded_bench;

use recorded_bench::*;
use unripple_calibrate::CalibrateError;
use unripple_calibrate::measure::{Listen, MeasureOptions};

/// A film of six actuators up to 1 kHz.
fn film() -> Bench {
    Bench::new(6, 1000.0, 0.07)
}

fn quiet() -> MeasureOptions {
    MeasureOptions { highest_order: 3, ..MeasureOptions::default() }
}

#[test]
fn a_sheet_that_rings_for_half_a_second_is_measured() {
    for decay in [0.07, 0.2, 0.5] {
        let bench = Bench::new(4, 600.0, decay);
        let options = MeasureOptions::for_model(&bench.model);
        let (sensors, found, session) =
            bench.measured(&options, &Faults::default(), &Faults::default()).unwrap();
        for channel in sensors.iter().chain([&found]) {
            assert_eq!(session.fault(channel), None, "{decay} s");
            let snr = channel.quality.iter().map(|q| q.snr_db).fold(f64::INFINITY, f64::min);
            let distortion = channel.quality.iter().filter_map(|q| q.distortion_db).fold(-300.0, f64::max);
            println!("{decay} s: signal to noise {snr:.1} dB, distortion {distortion:.1} dB");
            assert!(snr > 80.0 && distortion < -60.0);
        }
        let off = bench.off(&found, &session);
        println!("{decay} s: off by {:.2} %", 100.0 * off);
        assert!(off < 0.015);
        assert!(options.warnings(&bench.model).is_empty());
        assert_eq!(found.account.said(), Vec::<String>::new());
    }
}

#[test]
fn options_too_short_for_the_ringing_are_warned_of() {
    let bench = Bench::new(2, 400.0, 0.5);
    let short = MeasureOptions { response_length: 0.1, ..MeasureOptions::for_model(&bench.model) };
    let said = short.warnings(&bench.model);
    assert!(
        said.len() == 1 && said[0].starts_with("response: 100 ms are short") && said[0].contains("500 ms")
    );
    let usual = Bench::new(2, 400.0, 0.07);
    assert_eq!(MeasureOptions::for_model(&usual.model), MeasureOptions::default());
    assert!(MeasureOptions::default().warnings(&usual.model).is_empty());
}

#[test]
fn two_clocks_are_found_and_brought_together() {
    let bench = film();
    for ppm in [200.0, 50.0, 5.0, -120.0] {
        let faults = Faults { ppm, noise_db: Some(50.0), ..Faults::default() };
        let (sensors, found, session) = bench.measured(&quiet(), &faults, &faults).unwrap();
        let [first, second] = [&sensors[0].account, &found.account].map(|account| account.clock_ppm.unwrap());
        let off = bench.off(&found, &session);
        println!("{ppm}: found {first:.2}, {second:.2}; off by {:.2} %", 100.0 * off);
        assert!((first - ppm).abs() < 1.0 && (second - ppm).abs() < 1.0);
        assert!(off < 0.03);
        assert!(found.account.said().iter().any(|said| said.contains("resampled")));
    }
    let apart = Faults { ppm: 400.0, ..Faults::default() };
    match bench.measured(&quiet(), &apart, &apart) {
        Err(CalibrateError::Recording { what, found, .. }) => {
            assert!(what.contains("clocks") && found.contains("400.0"), "{what}: {found}");
        }
        other => panic!("{:?}", other.map(|(_, found, _)| found.account)),
    }
}

#[test]
fn clocks_are_told_at_twenty_db_of_noise_as_well() {
    let bench = film();
    let faults = Faults { ppm: 40.0, noise_db: Some(20.0), ..Faults::default() };
    let (_, found, _) = bench.measured(&quiet(), &faults, &faults).unwrap();
    assert!((found.account.clock_ppm.unwrap() - 40.0).abs() < 1.0, "{:?}", found.account);
}

#[test]
fn a_take_that_is_late_is_moved_back() {
    let bench = film();
    for late in [3.37, -12.8, 0.4] {
        let faults = Faults { late, noise_db: Some(60.0), ..Faults::default() };
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &faults).unwrap();
        let off = bench.off(&found, &session);
        println!("{late}: {:?}, off by {:.2} %", found.account.late, 100.0 * off);
        assert!((found.account.late.unwrap() - late).abs() < 0.02 && off < 0.02);
    }
}

#[test]
fn tension_that_drifts_is_followed() {
    let bench = film();
    for tension in [[0.005, 0.005], [0.0, 0.005], [-0.003, 0.002]] {
        let faults = Faults { tension, noise_db: Some(50.0), ..Faults::default() };
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &faults).unwrap();
        let off = bench.off(&found, &session);
        println!("{tension:?}: found {:?}, off by {:.2} %", found.account.drift, 100.0 * off);
        assert!(off < 0.05);
        assert!(found.account.said().iter().any(|said| said.contains("tension")));
    }
    // During the first take, too: what all are brought to is its middle.
    let first = Faults { tension: [-0.0025, 0.0025], ..Faults::default() };
    let (_, found, session) = bench.measured(&quiet(), &first, &Faults::default()).unwrap();
    let off = bench.off(&found, &session);
    println!("in the first: {:?}, off by {:.2} %", found.account.drift, 100.0 * off);
    assert!(off < 0.1);
}

#[test]
fn a_deaf_sensor_of_three_does_not_hide_a_clock() {
    let bench = Bench::new(3, 1000.0, 0.07);
    let deaf = Faults { ppm: 50.0, deaf: Some(1), noise_db: Some(50.0), ..Faults::default() };
    let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &deaf).unwrap();
    let off = bench.off(&found, &session);
    println!("found {:?}, off by {:.2} %", found.account.clock_ppm, 100.0 * off);
    assert!((found.account.clock_ppm.unwrap() - 50.0).abs() < 1.0 && off < 0.03);
}

/// Nothing is known of what a dead actuator makes others hear, nor of what its own sensor hears: rows of zeros.
#[test]
fn tension_is_followed_where_one_of_eight_is_dead() {
    let bench = Bench::new(8, 1000.0, 0.07);
    let noisy = Faults { dead: Some(2), noise_db: Some(50.0), ..Faults::default() };
    let drifted = Faults { tension: [0.005, 0.005], ppm: 30.0, ..noisy.clone() };
    let mut session = bench.session(&quiet());
    let mut rig = bench.rig(&session, &[noisy, drifted]);
    let mut sensors = session.measure(&mut rig, 1, AT, 0, Listen::Sensors).unwrap();
    for (number, sensor) in sensors.iter_mut().enumerate() {
        let silent = sensor.responses.iter_mut().enumerate().filter(|(drive, _)| *drive == 2 || number == 2);
        silent.for_each(|(_, response)| response.fill(0.0));
    }
    session.set_reference(&sensors).unwrap();
    let found = session.measure(&mut rig, 0, AT, 0, Listen::Probe).unwrap().remove(0);
    let truth = bench.truth(session.band(), found.responses[0].len());
    let alive = |rows: &[Vec<f64>]| [&rows[..2], &rows[3..]].concat();
    let off = off(&alive(&found.responses), &alive(&truth));
    println!("{:?}, off by {:.2} %", found.account, 100.0 * off);
    assert!(found.account.drift.unwrap().iter().all(|change| (change - 0.005).abs() < 5e-4));
    assert!((found.account.clock_ppm.unwrap() - 30.0).abs() < 1.0 && off < 0.05);
}

#[test]
fn lost_samples_are_put_back_or_named() {
    let bench = film();
    for (count, at) in [(480_i64, 70_000), (4800, 70_000), (64, 40_000), (-300, 90_000)] {
        let faults = Faults { lost: Some((count, at)), noise_db: Some(50.0), ..Faults::default() };
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &faults).unwrap();
        let off = bench.off(&found, &session);
        println!("{count}: {:?}, off by {:.2} %", found.account.lost, 100.0 * off);
        let lost = found.account.lost[0];
        assert_eq!(lost.samples, count);
        // The recording counts the blocks of silence before, which what is played does not. What rings on after what is
        // kept of a response blurs the place.
        assert!((lost.between_s[0] - (at as f64 - 2048.0) / RATE).abs() < 0.06, "{lost:?}");
        assert!(off < 0.2);
        let first = bench.measured(&quiet(), &faults, &Faults::default());
        match first {
            Err(CalibrateError::Recording { found, .. }) => {
                assert!(found.contains(&format!("{} samples", count.abs())), "{found}");
            }
            other => panic!("{:?}", other.map(|(_, found, _)| found.account)),
        }
    }
}

#[test]
fn samples_lost_at_two_places_are_named() {
    let bench = Bench::new(8, 1000.0, 0.07);
    let twice = Faults {
        lost: Some((480, 30_000)),
        lost_again: Some((300, 110_000)),
        noise_db: Some(50.0),
        ..Faults::default()
    };
    match bench.measured(&quiet(), &Faults::default(), &twice) {
        Err(CalibrateError::Recording { what, found, .. }) => {
            println!("{what}: {found}");
            assert!(what.contains("sweeps") && found.contains("samples lost at several places"), "{found}");
        }
        other => panic!("{:?}", other.map(|(_, found, _)| found.account)),
    }
}

/// Latency that jumps within sweeps leaves nothing to follow: sensors do not know the sweeps again.
#[test]
fn latency_that_jitters_is_named_or_harmless() {
    let bench = film();
    let fault = |jitter: f64| {
        let faults = Faults { jitter, noise_db: Some(50.0), ..Faults::default() };
        match bench.measured(&quiet(), &Faults::default(), &faults) {
            Err(CalibrateError::Recording { found, .. }) => found,
            Err(other) => panic!("{other}"),
            Ok((_, found, session)) => {
                println!("{jitter}: off by {:.2} %", 100.0 * bench.off(&found, &session));
                session.fault(&found).unwrap_or_default()
            }
        }
    };
    assert_eq!(fault(0.3), "");
    for jitter in [16.0, 64.0] {
        let said = fault(jitter);
        println!("{jitter}: {said}");
        assert!(said.contains("a latency that jitters"), "{jitter}: {said}");
    }
}

#[test]
fn what_happened_to_a_second_take_is_said_of_it() {
    let bench = film();
    let fine = Faults { noise_db: Some(50.0), ..Faults::default() };
    let quick = Faults { ppm: 60.0, ..fine.clone() };
    let session = bench.session(&MeasureOptions { repeats: 2, ..quiet() });
    let mut rig = bench.rig(&session, &[fine, quick]);
    let found = session.measure(&mut rig, 0, AT, 0, Listen::Probe).unwrap().remove(0);
    let said = found.account.said();
    assert!(said.iter().any(|said| said.starts_with("take 2: the recording's clock")), "{said:?}");
    assert!(!said.iter().any(|said| said.starts_with("take 1: the recording's clock")), "{said:?}");
}

#[test]
fn the_probes_own_delay_is_taken_out() {
    let bench = film();
    for delay in [1e-3, 0.2104e-3] {
        let faults = Faults { probe_late: delay * RATE, ..Faults::default() };
        let options = MeasureOptions { probe_delay: Some(delay), ..quiet() };
        let (_, found, session) = bench.measured(&options, &Faults::default(), &faults).unwrap();
        let off = bench.off(&found, &session);
        println!("{delay}: off by {:.3} %", 100.0 * off);
        assert!(off < 0.01);
    }
}

#[test]
fn noise_is_called_noise() {
    let bench = film();
    for faults in
        [Faults { noise_db: Some(-3.0), ..Faults::default() }, Faults { bits: Some(4), ..Faults::default() }]
    {
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &faults).unwrap();
        let fault = session.fault(&found);
        let snr: Vec<f64> = found.quality.iter().map(|q| q.snr_db).collect();
        println!("{snr:.1?}: {fault:?}");
        let off = bench.off(&found, &session);
        let real = -20.0 * off.log10();
        println!("{real:.1} dB of noise in what was found");
        let worst = snr.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(fault.is_none_or(|fault| fault.contains("signal to noise")));
        assert!((worst - real).abs() < 6.0, "{worst} {real}");
    }
    let (_, found, session) = bench
        .measured(&quiet(), &Faults::default(), &Faults { noise_db: Some(20.0), ..Faults::default() })
        .unwrap();
    assert_eq!(session.fault(&found), None);
}

#[test]
fn harmonics_are_told_by_their_order() {
    let bench = film();
    for harmonics in [[0.01, 0.0], [0.0, 0.01], [0.03, 0.01]] {
        let faults = Faults { harmonics, noise_db: Some(60.0), ..Faults::default() };
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &faults).unwrap();
        println!("{harmonics:?}: {:.4?}", found.account.harmonics);
        let mean = |order: usize| {
            // What is not told from noise is none.
            let all: Vec<f64> = found.account.harmonics.iter().map(|h| h[order].max(0.0)).collect();
            (all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64).sqrt()
        };
        for (order, wanted) in harmonics.into_iter().enumerate() {
            let found = mean(order);
            let near = if wanted > 0.0 { (found / wanted - 1.0).abs() < 0.35 } else { found < 0.004 };
            assert!(near, "order {}: {found} instead of {wanted}", order + 2);
        }
        assert_eq!(session.fault(&found), None);
        assert!(found.account.said().iter().any(|said| said.starts_with("harmonics of the drive")));
        assert!(bench.off(&found, &session) < 0.05);
    }
}

#[test]
fn each_cause_has_its_own_name() {
    let bench = film();
    let said = |faults: Faults| {
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &faults).unwrap();
        session.fault(&found).unwrap_or_default()
    };
    let clipped = said(Faults { clip: Some(0.4), ..Faults::default() });
    assert!(clipped.contains("distortion") && clipped.contains("clipped"), "{clipped}");
    let dead = said(Faults { dead: Some(2), ..Faults::default() });
    assert!(dead.contains("actuator 3: no response was recorded"), "{dead}");
    let dead = said(Faults { dead: Some(2), noise_db: Some(30.0), ..Faults::default() });
    assert!(dead.contains("actuator 3"), "{dead}");
}

#[test]
fn a_knock_is_a_knock_and_a_repeat_stands_in_for_it() {
    let bench = film();
    let knocked = Faults { knock: Some([1.2, 60.0, 0.0]), noise_db: Some(50.0), ..Faults::default() };
    let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &knocked).unwrap();
    let fault = session.fault(&found).unwrap_or_default();
    println!("{:?}: {fault}", found.account.knocks);
    // The recording begins with blocks of silence that do not count.
    assert!(fault.starts_with("a knock at 1.1") && found.account.knocks.len() == 1, "{fault}");
    let fine = Faults { noise_db: Some(50.0), ..Faults::default() };
    let options = MeasureOptions { repeats: 2, ..quiet() };
    let session = bench.session(&options);
    let mut rig = bench.rig(&session, &[knocked, fine]);
    let found = session.measure(&mut rig, 0, AT, 0, Listen::Probe).unwrap().remove(0);
    assert_eq!(session.fault(&found), None);
    assert!(found.account.said().iter().any(|said| said.contains("left out")), "{:?}", found.account.said());
    let off = bench.off(&found, &session);
    println!("with a repeat: off by {:.2} %", 100.0 * off);
    assert!(off < 0.02);
}

/// A finger's tap has little in the upper half of the band, where the sweeps still ring.
#[test]
fn a_soft_knock_is_a_knock_however_strong() {
    let bench = film();
    for strength in [10.0, 100.0] {
        let soft = Faults { knock: Some([1.2, strength, 2e-3]), noise_db: Some(60.0), ..Faults::default() };
        let (_, found, session) = bench.measured(&quiet(), &Faults::default(), &soft).unwrap();
        let fault = session.fault(&found).unwrap_or_default();
        println!("{strength}: {:?}: {fault}", found.account.knocks);
        assert!(
            fault.starts_with("a knock at 1.1") && found.account.knocks.len() == 1,
            "{strength}: {fault}"
        );
    }
}

#[test]
fn quality_is_told_by_thirds_of_an_octave() {
    let bench = film();
    let noisy = Faults { noise_db: Some(40.0), ..Faults::default() };
    let options = MeasureOptions { repeats: 3, ..quiet() };
    let session = bench.session(&options);
    let mut rig = bench.rig(&session, &[noisy]);
    let found = session.measure(&mut rig, 0, AT, 0, Listen::Probe).unwrap().remove(0);
    let bands = &found.bands[0];
    println!("{bands:.1?}");
    assert!(bands.len() >= 9 && bands.windows(2).all(|pair| pair[0].hz < pair[1].hz));
    // The film has its first mode at 160 Hz and few more at first: thirds without one hold little.
    let loud: Vec<_> = bands.iter().filter(|band| band.hz > 240.0).collect();
    assert!(loud.iter().all(|band| band.snr_db > 20.0 && band.coherence.unwrap() > 0.97), "{loud:?}");
    assert!(options.repeats_for(&found, 20.0) == 1 && options.repeats_for(&found, 300.0) == 0);
}
