//! Truth: noise, decay and distortion that were put in.

use crate::signals_bench;

use signals_bench::{Noise, Plant, RATE, error, hear, limited, rms};
use unripple_calibrate::signals::{
    Average, Band, CrossSpectra, Decay, Deconvolver, Harmonics, Inversion, Outliers, Quality, Reciprocity,
    Split, Sweep, clipped, snr_db,
};

#[test]
fn repeats_tell_the_noise_that_was_put_in() {
    let signal = Plant::new(1, 60, 0.05).response(12_000);
    for db in [0.0, 20.0, 40.0] {
        let repeats: Vec<Vec<f64>> = (0..6)
            .map(|seed| {
                let mut repeat = signal.clone();
                Noise(seed).spoil(&mut repeat, db);
                repeat
            })
            .collect();
        let slices: Vec<&[f64]> = repeats.iter().map(Vec::as_slice).collect();
        let average = Average::of(&slices, Outliers::default()).unwrap();
        assert!(average.kept.iter().all(|kept| *kept));
        // 5 · 12 000 degrees of freedom: 0.6 % of the noise's power; the signal's is less sure at 0 dB.
        let expected = db + 10.0 * 6f64.log10();
        assert!((average.snr_db() - expected).abs() < 0.15, "{db}: {}", average.snr_db());
        assert!((average.coherence() - 1.0 / (1.0 + 10f64.powf(-db / 10.0))).abs() < 0.02);
        let gain = error(&repeats[0], &signal) / error(&average.mean, &signal);
        assert!((gain - 6f64.sqrt()).abs() < 0.1, "{gain}");
    }
}

#[test]
fn outliers_are_left_out() {
    let signal = Plant::new(2, 60, 0.05).response(6_000);
    let mut repeats: Vec<Vec<f64>> = (0..5)
        .map(|seed| {
            let mut repeat = signal.clone();
            Noise(seed).spoil(&mut repeat, 40.0);
            repeat
        })
        .collect();
    Noise(77).spoil(&mut repeats[1], 10.0);
    repeats[3][100] = f64::NAN;
    let slices: Vec<&[f64]> = repeats.iter().map(Vec::as_slice).collect();
    let average = Average::of(&slices, Outliers::default()).unwrap();
    assert_eq!(average.kept, [true, false, true, false, true]);
    assert!(average.correlations[0] > 0.999 && average.correlations[1] < 0.99);
    assert!(error(&average.mean, &signal) < 0.01);
    assert!(Average::of(&[], Outliers::default()).is_err());
    assert!(Average::of(&[&signal, &signal[1..]], Outliers::default()).is_err());
    let one = Average::of(&[&signal], Outliers::default()).unwrap();
    assert!(one.mean == signal && one.noise.is_nan());
}

#[test]
fn a_reference_channel_takes_the_amplifier_out_and_coherence_tells_the_noise() {
    let response = Plant::new(3, 100, 0.03).response(9_000);
    let stimulus = Sweep { seconds: 0.5, silence: 0.3, ..Sweep::default() }.stimulus().unwrap();
    let samples = stimulus.samples().len();
    // An amplifier that is late and dull, heard by the reference as by the surface.
    let amplifier = [0.0, 0.0, 0.3 * RATE, 0.5 * RATE, 0.2 * RATE];
    let driven = hear(&amplifier, stimulus.samples(), samples);
    let clean = hear(&response, &driven, samples);
    let band = stimulus.band();
    let mut spectra = CrossSpectra::new(samples, RATE).unwrap();
    let mut noise = Noise(4);
    for _ in 0..40 {
        // White noise over all of the rate: in band it is 48/7.2 times weaker.
        let mut heard = clean.clone();
        noise.spoil(&mut heard, 10.0);
        spectra.add(&driven, &heard).unwrap();
    }
    let flat = Band { low: [band.low[1]; 2], high: [band.high[0]; 2] };
    let power = |signal: &[f64]| {
        let mut inside = signal.to_vec();
        flat.limit(&mut inside, RATE).unwrap();
        rms(&inside).powi(2)
    };
    let share = power(&clean);
    let level = rms(&clean).powi(2) * 0.1 * (flat.high[0] - flat.low[1]) / (RATE / 2.0);
    let expected = share / (share + level);
    // Of noise alone the coherence of 40 repeats is 1/40 on average.
    let expected = expected + (1.0 - expected) / 40.0;
    assert!(
        (spectra.coherence_in(flat) - expected).abs() < 0.002,
        "{} {expected}",
        spectra.coherence_in(flat)
    );
    let inversion = Inversion { band: Some(band), lead: 2_000, ..Inversion::default() };
    let mut found = vec![0.0; 11_000];
    spectra.response(&inversion, &mut found).unwrap();
    let wrong = error(&found, &limited(&response, band, 2_000));
    assert!(wrong < 0.05, "{wrong}");
}

#[test]
fn noise_at_a_known_level_is_told() {
    let signal = Plant::new(5, 100, 0.05).response(16_000);
    for db in [-3.0, 10.0, 30.0, 50.0] {
        let level = rms(&signal) * 10f64.powf(-db / 20.0);
        let before = Noise(6).of(16_000, level);
        let heard: Vec<f64> = Noise(7).of(16_000, level).iter().zip(&signal).map(|(n, x)| n + x).collect();
        assert!((snr_db(&heard, &before) - db).abs() < 0.25, "{db}: {}", snr_db(&heard, &before));
    }
    assert_eq!(snr_db(&[0.1], &[1.0]), f64::NEG_INFINITY);
    assert_eq!(snr_db(&[0.1], &[0.0]), f64::INFINITY);
    let silence = Quality::of(&[0.0; 500], &[0.0; 10], RATE).unwrap();
    assert_eq!((silence.decay, silence.onset), (None, None));
}

#[test]
fn decays_are_found_in_their_noise() {
    for (decay, samples) in [(0.07, 24_000), (0.02, 24_000), (0.15, 24_000), (0.07, 4_000)] {
        for db in [f64::INFINITY, 50.0, 30.0, 15.0] {
            let mut response = Plant::new(8, 306, decay).response(samples);
            let level = rms(&response[..480]) * 10f64.powf(-db / 20.0);
            response.iter_mut().zip(Noise(9).of(samples, level)).for_each(|(x, n)| *x += n);
            let found = Decay::of(&response, RATE).unwrap().unwrap();
            let wrong = (found.time - decay).abs();
            assert!(wrong < 4.0 * found.error + 0.002 * decay, "{decay} at {db} dB: {found:?}");
            assert!(found.error < 0.12 * decay, "{decay} at {db} dB: {found:?}");
            if (15.0..=30.0).contains(&db) && samples as f64 > 4.0 * decay * RATE {
                assert!((found.noise.sqrt() / level - 1.0).abs() < 0.1, "{} {level}", found.noise.sqrt());
            }
        }
    }
    assert_eq!(Decay::of(&Noise(10).of(24_000, 1.0), RATE), Ok(None));
    assert_eq!(Decay::of(&[1.0; 5], RATE), Ok(None));
    assert_eq!(Decay::of(&[], RATE), Ok(None));
    assert_eq!(Decay::of(&[f64::NAN; 500], RATE), Ok(None));
}

/// Everything heard of a sweep through a device and a plant, deconvolved, its harmonics told apart.
fn harmonics(device: impl Fn(f64) -> f64, response: &[f64], noise_db: f64) -> Harmonics {
    let sweep = Sweep { seconds: 3.0, silence: 0.5, ..Sweep::default() };
    let stimulus = sweep.stimulus().unwrap();
    let played: Vec<f64> = stimulus.samples().iter().map(|x| device(*x)).collect();
    let mut heard = hear(response, &played, played.len());
    Noise(11).spoil(&mut heard, noise_db);
    let lead = 2_000;
    let plan = Deconvolver::new(&stimulus, heard.len(), &Inversion { lead, ..Inversion::default() }).unwrap();
    let mut whole = vec![0.0; plan.size()];
    plan.deconvolve(&heard, &mut whole, &mut plan.workspace()).unwrap();
    Harmonics::of(&whole, &sweep, &Split { start: 0, lead, window: 8_000, highest_order: 5, band: None })
        .unwrap()
}

#[test]
fn polynomials_have_the_harmonics_that_they_have() {
    // x + a x² + b x³ of a sine: (1 + 3b/4) of the first, a/2 of the second, b/4 of the third harmonic.
    let (a, b) = (0.02, 0.01);
    let found = harmonics(|x| x + a * x * x + b * x * x * x, &[RATE], f64::INFINITY);
    let first = 1.0 + 0.75 * b;
    for (order, amplitude) in [(2, a / 2.0), (3, b / 4.0)] {
        let level = 20.0 * (amplitude / first).log10();
        let harmonic = &found.orders[order - 2];
        assert_eq!(harmonic.order, order);
        assert!((harmonic.level_db() - level).abs() < 0.1, "{order}: {} for {level}", harmonic.level_db());
    }
    assert!(found.orders[2..].iter().all(|harmonic| harmonic.level_db() < -80.0));
    let total = 20.0 * ((a / 2.0).hypot(b / 4.0) / first).log10();
    assert!((found.distortion_db() - total).abs() < 0.1);
}

#[test]
fn a_clipped_channel_is_told_from_a_linear_one() {
    let response = Plant::new(12, 100, 0.01).response(8_000);
    let linear = harmonics(|x| x, &response, 50.0);
    let bent = harmonics(|x| x.clamp(-0.8, 0.8), &response, 50.0);
    assert!(linear.distortion_db() < -45.0, "{}", linear.distortion_db());
    assert!(bent.distortion_db() > -30.0, "{}", bent.distortion_db());
    // Clipped symmetrically: odd orders only.
    assert!(bent.orders[1].level_db() > bent.orders[0].level_db() + 15.0);
    // Fourier's third and first coefficient of a sine clipped at its value at α, through no plant at all.
    let bare = harmonics(|x| x.clamp(-0.8, 0.8), &[RATE], f64::INFINITY);
    let (alpha, pi) = (0.8f64.asin(), std::f64::consts::PI);
    let first = (2.0 * alpha + (2.0 * alpha).sin()) / pi;
    let third =
        ((2.0 * alpha).sin() + (4.0 * alpha).sin() / 2.0) / pi - 4.0 * 0.8 * (3.0 * alpha).cos() / (3.0 * pi);
    let numeric = |order: f64| {
        let part = |i: u32| {
            let at = (f64::from(i) + 0.5) / 1e5 * 2.0 * pi;
            at.sin().clamp(-0.8, 0.8) * (order * at).sin()
        };
        (0..100_000).map(part).sum::<f64>() / 5e4
    };
    assert!((numeric(1.0) - first).abs() < 1e-6, "{} {third}", numeric(1.0));
    let level = 20.0 * (numeric(3.0) / numeric(1.0)).abs().log10();
    assert!((bare.orders[1].level_db() - level).abs() < 0.1, "{} for {level}", bare.orders[1].level_db());
    let sine: Vec<f64> = (0..4800).map(|i| (f64::from(i) * 0.004).sin()).collect();
    let flat: Vec<f64> = sine.iter().map(|x| x.clamp(-0.95, 0.95)).collect();
    assert_eq!(clipped(&sine, 1.0), 0);
    assert_eq!(clipped(&flat, 1.0), sine.iter().filter(|x| x.abs() >= 0.95).count());
    assert_eq!(clipped(&[], 1.0), 0);
}

#[test]
fn impossible_splits_are_refused() {
    let sweep = Sweep::default();
    let ok = Split { start: 0, lead: 0, window: 100, highest_order: 3, band: None };
    let noise = Noise(13).of(96_000, 1.0);
    assert!(Harmonics::of(&noise, &sweep, &ok).is_ok());
    for split in [
        Split { window: 0, ..ok },
        Split { window: 96_001, ..ok },
        Split { highest_order: 1, ..ok },
        Split { highest_order: 120, ..ok },
    ] {
        assert!(Harmonics::of(&noise, &sweep, &split).is_err(), "{split:?}");
    }
    assert!(Harmonics::of(&[0.0; 200], &sweep, &ok).is_err());
}

#[test]
fn reversed_and_loud_pairs_stand_out() {
    let (actuators, samples) = (4, 500);
    let mut responses = vec![0.0; actuators * actuators * samples];
    let mut noise = Noise(14);
    for a in 0..actuators {
        for b in a..actuators {
            let one = noise.of(samples, 1.0);
            for (x, y) in [(a, b), (b, a)] {
                let start = (x * actuators + y) * samples;
                responses[start..start + samples].copy_from_slice(&one);
            }
        }
    }
    assert_eq!(Reciprocity::of(&responses, actuators).unwrap().error, 0.0);
    let start = (actuators + 3) * samples; // from 1 to 3
    responses[start..start + samples].iter_mut().for_each(|x| *x = -*x);
    let found = Reciprocity::of(&responses, actuators).unwrap();
    let worst = found.worst.unwrap();
    assert_eq!((worst.pair, found.pairs.len()), ([1, 3], 6));
    assert!((worst.error - 2.0).abs() < 1e-12 && (worst.correlation + 1.0).abs() < 1e-12);
    assert!((found.error - (4.0_f64 / 6.0).sqrt()).abs() < 0.05);
    assert!(Reciprocity::of(&responses[1..], actuators).is_err());
    assert_eq!(Reciprocity::of(&[], 0).unwrap().worst, None);
}
